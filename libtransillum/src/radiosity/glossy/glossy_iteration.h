// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// The state of a glossy solve: GlossySolver::Impl. glossy_passes.cpp gathers along passes,
// glossy_iteration.cpp ends iterations, glossy_solver.cpp has the public class and the results.
#pragma once

#include <memory>
#include <vector>

#include "base/worker_threads.h"
#include "radiosity/glossy/directional_exchanges.h"
#include "radiosity/glossy/glossy_data.h"
#include "radiosity/solver/pass_statistics.h"
#include "radiosity/solver/solver_input.h"
#include "radiosity/solver/solver_timing.h"

namespace transillum {

struct [[gnu::visibility("hidden")]] GlossySolver::Impl {
  SolverInput input;
  std::vector<Material> materials;     ///< materials of the scene, or those that replaced them
  std::vector<std::int32_t> of_patch;  ///< index into them, by patch
  std::shared_ptr<const GlossyLight::Data> light;  ///< replaced, never changed: solutions share it
  std::vector<PatchId> glossy;                     ///< the glossy patches, by index
  std::unique_ptr<PassStatistics> statistics;
  std::unique_ptr<DirectionalExchanges> kept;
  int known_passes = 0;        ///< that `statistics` has, and `kept` where available
  bool kept_finished = false;  ///< all passes are in `kept`
  bool lobes_pending = false;  ///< light->lobes do not belong to `materials` yet
  std::shared_ptr<const LobeTables> old_lobes;  ///< tables of which those that fit are copied
  bool has_light = false;        ///< an iteration was finished: irradiance and Phi are its
  std::vector<Rgb> irradiance;   ///< H of the last finished iteration, W/m²
  std::vector<Rgb> from_sky;     ///< the part of it from the sky; empty without one
  std::vector<Rgb> gathered;     ///< sum_p sum_j A(i,j,p) L_j(p) of the iteration under way, W/sr
  std::vector<Rgb> incoming;     ///< Phi by glossy patch and pass, of the iteration under way
  std::vector<double> sky_area;  ///< uncovered area times relative radiance, over all passes
  std::vector<double> sky_seen;  ///< the same by glossy patch and pass, over the patch's area
  std::vector<double> seen;      ///< by glossy patch and pass: area that receivers see of it, m²
  std::vector<IterationRecord> records;
  double last_change = 0;  ///< change of radiance, W/(m² sr)
  bool finished = false, converged = false;
  int pass = 0;  ///< passes done in the iteration under way
  double energy_defect = 0;
  SolverTiming timing;
  double iteration_seconds = 0;
  SolveProgress::Stage stage = SolveProgress::Stage::passes;
  double stage_fraction = 0, stage_seconds = 0;
  std::size_t stage_lobes = 0;
  double reflection_seconds = 0;  ///< time in the last iteration

  explicit Impl(SolverInput solver_input);

  const Material& material(std::size_t i) const {
    return materials[static_cast<std::size_t>(of_patch[i])];
  }
  std::size_t passes() const { return light->passes(); }
  /// The factor from gathered() to H.
  double scale(std::size_t i) const;
  /// @throws InputError
  void check_count(const std::vector<Material>& given,
                   const std::vector<std::int32_t>& by_patch) const;
  /// Sets radiance to the emission E, or keeps the light that arrived last. The lobes of
  /// `materials` are scaled by the next iteration.
  void start(Start from = Start::emission);
  /// Numbers the glossy patches.
  /// @throws std::runtime_error where what is kept of them by direction does not fit into memory
  void find_glossy(GlossyLight::Data& data);
  void check_radiance_memory(std::size_t patches, std::size_t directions) const;
  void forget_passes();
  /// One iteration, or of its passes only the next; returns false where the observer did, or
  /// where passes are left.
  bool iterate(const Observer& observer, bool one_pass = false);
  SolveProgress progress() const;
  SolveStatistics solve_statistics() const;

 private:
  /// Light that a pass brings, of patches by their number.
  struct PassLight {
    std::vector<Rgb> gathered;
    Pass pass;  ///< for statistics, if the direction is new
    DirectionalExchanges::Sorted sorted;
  };
  bool gather_passes(WorkerThreads& workers, const Observer& observer, bool one_pass);
  PassLight make(int k, bool from_kept) const;
  void gather(const std::vector<Transfer>& exchanges, int k, std::vector<Rgb>& sum) const;
  /// Sets what is kept by glossy patch and pass, which no other pass writes.
  void set_of_pass(int k, bool is_new, const PassLight& made);
  void add_new(int k, PassLight& made);
  void add_all(const std::vector<PassLight>& batch, WorkerThreads& workers);
  void finish_iteration(WorkerThreads& workers, const Observer& observer);
  /// Scales lobes that are pending.
  void make_lobes(WorkerThreads& workers, const Observer& observer);
  /// Tells `observer` of a stage of lobes.
  LobeReport report_of(SolveProgress::Stage now, const Observer& observer);
  Rgb lambertian_of(std::size_t i, const Rgb& received) const;
  double defect_of_energy() const;
  double rho_max() const;
  /// Ends an iteration.
  /// @param change of radiance
  /// @param reflected light of each patch, its lobe included, W/m²
  /// @param changes of `reflected` by the iteration, W/m²
  void record(const LobeTables::Change& change, std::vector<Rgb> reflected,
              const std::vector<Rgb>& changes);
};

}  // namespace transillum
