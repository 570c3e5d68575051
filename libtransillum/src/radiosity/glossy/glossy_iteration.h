// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// The state of a glossy solve: GlossySolver::Impl. glossy_passes.cpp gathers along passes,
// glossy_iteration.cpp ends iterations, glossy_solver.cpp has the public class and the results.
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "base/worker_threads.h"
#include "radiosity/error/error_estimate.h"
#include "radiosity/exchange/visible_area_sums.h"
#include "radiosity/glossy/directional_exchanges.h"
#include "radiosity/glossy/glossy_data.h"
#include "radiosity/solver/pass_statistics.h"
#include "radiosity/solver/solver_input.h"
#include "radiosity/solver/solver_timing.h"

namespace transillum {

struct [[gnu::visibility("hidden")]] GlossySolver::Impl {
  /// Sums over the passes of a replica, which is a solve of its own.
  struct Replica {
    VisibleAreaSums areas;
    std::vector<double> sky_area;  ///< uncovered area times relative radiance; empty without a sky
    std::vector<Rgb> irradiance;   ///< H of the last finished iteration, W/m²
    std::vector<Rgb> gathered;     ///< sum_p sum_j A(i,j,p) L_j(p) of the one under way, W/sr
  };

  SolverInput input;
  std::vector<Material> materials;     ///< materials of the scene, or those that replaced them
  std::vector<std::int32_t> of_patch;  ///< index into them, by patch
  bool has_other_materials = false;    ///< they differ from the scene's
  std::shared_ptr<const GlossyLight::Data> light;  ///< replaced, never changed: solutions share it
  std::vector<PatchId> glossy;                     ///< the glossy patches, by index
  std::unique_ptr<PassStatistics> statistics;
  std::unique_ptr<DirectionalExchanges> kept;
  int known_passes = 0;        ///< that `statistics` has, and `kept` where available
  bool kept_finished = false;  ///< all passes are in `kept`
  bool lobes_pending = false;  ///< light->lobes do not belong to `materials` yet
  /// Tables of which those that fit are copied, as GlossyLight::Data::lobes.
  std::vector<std::shared_ptr<const LobeTables>> old_lobes;
  bool has_light = false;         ///< an iteration was finished: irradiance and Phi are its
  std::vector<Rgb> irradiance;    ///< H of the last finished iteration, W/m²: mean over replicas
  std::vector<Rgb> from_sky;      ///< the part of it from sky and sun; empty without both
  std::vector<Replica> replicas;  ///< one or more
  std::vector<Rgb> incoming;      ///< Phi by glossy patch and pass, of the iteration under way
  std::vector<double> sky_seen;   ///< uncovered area times relative radiance, by glossy patch and
                                  ///< pass, over the patch's area
  std::vector<double> seen;       ///< by glossy patch and pass: area that receivers see of it, m²
  std::vector<IterationRecord> records;
  double last_change = 0;  ///< change of radiance, W/(m² sr)
  ErrorSurfaces surfaces;  ///< empty without replicas
  bool finished = false, converged = false;
  int pass = 0;  ///< passes done in the iteration under way
  double energy_defect = 0;
  SolverTiming timing;
  double iteration_seconds = 0;
  SolveProgress::Stage stage = SolveProgress::Stage::passes;
  double stage_fraction = 0, stage_seconds = 0;
  std::size_t stage_lobes = 0;
  double reflection_seconds = 0;  ///< time in the last iteration

  /// The first shot with the emission of `materials`; null without one.
  std::shared_ptr<const DirectLight> shot;
  /// The former input.shot, to which `statistics` refer until they begin again.
  std::shared_ptr<const DirectLight> retired_shot;

  explicit Impl(SolverInput solver_input);

  const Material& material(std::size_t i) const {
    return materials[static_cast<std::size_t>(of_patch[i])];
  }
  std::size_t passes() const { return light->passes(); }
  bool has_sun() const { return !input.sun.irradiance.empty(); }
  /// The factor from what a replica gathers to its H.
  double scale(std::size_t r, std::size_t i) const;
  /// The sum of the fractions that patch i reflects diffusely and by its lobe.
  Rgb reflectance(std::size_t i) const {
    return material(i).reflectance + used_lobe(material(i)).reflectance;
  }
  /// B for an irradiance of each patch, W/m².
  std::vector<Rgb> radiosity(const std::vector<Rgb>& received) const;
  /// @throws InputError
  void check_count(const std::vector<Material>& given,
                   const std::vector<std::int32_t>& by_patch) const;
  /// Sets radiance to the emission E, or keeps the light that arrived last. The lobes of
  /// `materials` are scaled by the next iteration.
  void start(Start from = Start::emission);
  /// Numbers the glossy patches and finds the directions from which a first shot and the sun light
  /// them. Changes nothing where it throws.
  /// @throws std::runtime_error where what is kept of them by direction does not fit into memory;
  /// Canceled
  void find_glossy(GlossyLight::Data& data);
  /// The first shot for other materials, each a patch's; null without one.
  /// @throws InputError as with_materials()
  std::shared_ptr<const DirectLight> shot_of(const std::vector<Material>& given,
                                             const std::vector<std::int32_t>& by_patch) const;
  void check_radiance_memory(std::size_t patches, std::size_t directions) const;
  void forget_passes();
  /// One iteration, or of its passes only the next; returns false where the observer did, or
  /// where passes are left.
  bool iterate(const Observer& observer, bool one_pass = false);
  SolveProgress progress() const;
  SolveStatistics solve_statistics() const;
  /// Nothing for other materials than the scene's, whose light is what errors are relative to.
  ErrorEstimate error_estimate() const;
  /// Bound of what further iterations would change of B, W/m²; after the first.
  std::vector<Rgb> left() const;
  void add_form_factor_sums(Solution& solution) const;
  /// Whether any patch has another E, rho or lobe than in the scene.
  bool materials_differ() const;

 private:
  /// Light that a pass brings, of patches by their number.
  struct PassLight {
    std::vector<Rgb> gathered;
    Pass pass;  ///< for statistics, if the direction is new
    DirectionalExchanges::Sorted sorted;
  };
  bool gather_passes(WorkerThreads& workers, const Observer& observer, bool one_pass);
  PassLight make(int k, bool from_kept) const;
  void gather(const std::vector<Transfer>& exchanges, std::size_t k, std::vector<Rgb>& sum) const;
  /// Sets what is kept by glossy patch and pass, which no other pass writes.
  void set_of_pass(int k, bool is_new, const PassLight& made);
  void add_new(int k, PassLight& made);
  void add_all(const std::vector<PassLight>& batch, WorkerThreads& workers);
  void finish_iteration(WorkerThreads& workers, const Observer& observer);
  /// The result of an iteration, before it replaces the result of the one before.
  struct Next {
    std::shared_ptr<GlossyLight::Data> light;
    std::vector<std::vector<Rgb>> received;  ///< H by replica and patch, W/m²
    std::vector<Rgb> from_sky;               ///< mean over replicas; empty without a sky
  };
  Next next_light() const;
  /// Radiance of glossy patches without their lobes, W/(m² sr).
  struct Lambertian {
    const std::vector<Rgb>&before, &after;
  };
  /// Sets data.reflected of replica r to what the lobes reflect of `arriving` and of rays.
  LobeTables::Change reflect(GlossyLight::Data& data, std::size_t r,
                             const std::vector<Rgb>& arriving, const Lambertian& lambertian,
                             WorkerThreads& workers, const LobeReport& report) const;
  /// Sets the lambertian and the reflected radiance of replica r in `next`.
  LobeTables::Change reflect(std::size_t r, Next& next, WorkerThreads& workers,
                             const LobeReport& report) const;
  /// Scales lobes that are pending.
  void make_lobes(WorkerThreads& workers, const Observer& observer);
  /// Tells `observer` of a stage of lobes, of which each replica is an equal part.
  std::function<LobeReport(std::size_t)> report_of(SolveProgress::Stage now,
                                                   const Observer& observer);
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
