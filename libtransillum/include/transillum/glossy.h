// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Beyond diffuse surfaces (the paper's last sentence; ALGORITHM.md 6.14). A patch keeps what
// arrives along each direction of the set, and reflects it by a diffuse part and a lobe. The
// radiance of a patch is constant over it and depends on the direction:
//   L_i(omega) = (E_i + rho_i H_i) / pi + k_i w sum_d f_i(omega_d, omega) Phi_i(d),
//   w = 4 pi / (2M).
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "transillum/bsp_tree.h"
#include "transillum/cancellation.h"
#include "transillum/engine.h"
#include "transillum/export.h"
#include "transillum/radiosity_solver.h"
#include "transillum/scene.h"
#include "transillum/solution.h"
#include "transillum/solve_options.h"

namespace TRANSILLUM_API transillum {

/// The lobe of a material as a glossy solve uses it: where rho + k would be 1 or more, or within
/// 1e-6 of it, k is lowered, per channel, so that they add up to 0.98, or to rho if that is more.
Lobe used_lobe(const Material& material);
/// Whether the lobe of any patch reflects something.
bool has_lobes(const Scene& scene);
/// The patches whose lobes reflect something, ascending.
std::vector<PatchId> patches_with_lobes(const Scene& scene);
/// The exponent of the Phong lobe that is about as wide. For LobeShape::ggx, with alpha =
/// roughness², it is ln 2 / alpha²: both lobes fall to a quarter at the same angle.
double equivalent_exponent(const Lobe& lobe);
/// Largest equivalent_exponent() that M passes resolve: M/10, ten directions within a lobe.
double resolved_exponent(int directions);
/// Sentences about the lobes of the scene's patches: which are lowered (used_lobe()), and which are
/// too narrow for M passes; with replicas, M is the number of passes of each.
std::vector<std::string> lobe_warnings(const Scene& scene, int directions);

/// The reflectance distribution of a lobe that reflects all light, in the limit of infinitely many
/// directions: f(a, b) = p(a, b) s(cos a) s(cos b), with p = cos^n of the angle between b and the
/// mirror direction of a, or p = 1 / (1 + (alpha² - 1) cos² h)², h being the half vector's angle.
/// s is the function with which the integral of f cos over the hemisphere is 1 for every direction;
/// the shadowing of microfacets and the like are such products already.
///
/// Threads: immutable once made.
class LobeFunction {
 public:
  /// Computes s. `lobe` gives shape, exponent and roughness.
  /// @throws Canceled
  explicit LobeFunction(const Lobe& lobe, const Cancellation& cancellation = {});
  ~LobeFunction();
  /// The moved-from object may only be destroyed or assigned to.
  LobeFunction(LobeFunction&&) noexcept;
  /// The moved-from object may only be destroyed or assigned to.
  LobeFunction& operator=(LobeFunction&&) noexcept;

  /// s of a direction whose cosine with the normal is `cosine`, 0 to 1.
  double scale(double cosine) const;
  /// f(a, b), 1/sr; 0 where one of them is below the surface.
  /// @param a, b, normal unit vectors; a and b point away from the surface.
  double value(const Vec3& a, const Vec3& b, const Vec3& normal) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// Radiance by direction, of all patches of a scene.
///
/// Threads: immutable, so any number of threads may read it.
class GlossyLight {
 public:
  struct Data;  ///< its contents; private to the library
  /// For GlossySolver.
  explicit GlossyLight(std::shared_ptr<const Data> data);

  /// The scene.
  const Scene& scene() const;
  /// omega of each pass, replica by replica; the sets are these and their opposites.
  const std::vector<Vec3>& directions() const;
  /// Whether patch i has a lobe, so that the functions below differ by direction within a replica.
  bool is_glossy(PatchId i) const;
  /// The direction of the set along which patch i sends and receives light in a pass: omega, or its
  /// opposite, whichever is above the patch. Unit.
  Vec3 direction(PatchId i, int pass) const;
  /// Phi_i: flux density that arrives along direction(i, pass), W/(m² sr), one per pass; it
  /// contains the cosine, but no light of a first shot or sun. Empty for a patch without a lobe.
  std::span<const Rgb> arriving(PatchId i) const;
  /// Irradiance of patch i by the sun, which arriving() omits, W/m²; 0 for a patch without a lobe.
  Rgb sun_irradiance(PatchId i) const;
  /// Radiance that patch i sends along direction(i, pass), W/(m² sr), after the last iteration, in
  /// the pass's replica.
  Rgb leaving(PatchId i, int pass) const;
  /// Radiance of patch i in any direction, W/(m² sr): the last reflection is evaluated for it, as
  /// the mean over replicas. 0 below the patch.
  /// @param toward unit, away from the surface.
  Rgb radiance(PatchId i, const Vec3& toward) const;
  /// Radiance of each patch from its center toward a point.
  /// @param eye m
  /// @param threads 0: all cores
  std::vector<Rgb> radiance_toward(const Vec3& eye, int threads = 0) const;

 private:
  std::shared_ptr<const Data> data_;
};

/// Solves for radiance that depends on the direction, by the same passes as a RadiositySolver.
///
/// With R replicas, each is a solve of its own: R sets of M / R directions, whose B, H and radiance
/// are averaged (ALGORITHM.md 6.14).
///
/// Threads: at most one thread at a time may call it. Passes and lobes are distributed over
/// options.threads threads; the bits of the result do not depend on their number.
class GlossySolver {
 public:
  /// Prepares a solve; makes no pass.
  /// @param scene the scene.
  /// @param options of the solve run; `glossy` must be set.
  /// @param parts what the caller has already; SolverResources::sums is not used.
  /// @param cancellation checked here and in solve().
  /// @throws InputError, Canceled
  GlossySolver(std::shared_ptr<const Scene> scene, const SolveOptions& options,
               SolverResources parts = {}, const Cancellation& cancellation = {});
  ~GlossySolver();
  /// The moved-from object may only be destroyed or assigned to.
  GlossySolver(GlossySolver&&) noexcept;
  /// The moved-from object may only be destroyed or assigned to.
  GlossySolver& operator=(GlossySolver&&) noexcept;

  /// Called after each batch of passes and each iteration, and while lobes are scaled or reflect;
  /// returns whether to continue, which a stage of lobes does in any case.
  using Observer = std::function<bool(const SolveProgress&)>;
  /// Iterates until the radiance settles or the observer returns false; may be called again.
  /// Returns whether it has finished.
  /// @throws Canceled: what is finished remains.
  bool solve(const Observer& observer = {});
  /// Continues the solve as far as `until` says, or until the observer returns false.
  /// @returns whether the solve is unfinished.
  /// @throws Canceled: what is finished remains.
  bool advance(RadiositySolver::Until until, const Observer& observer = {});
  /// Start of the iterations after a change of materials.
  enum class Start {
    emission,  ///< E, as a new solve: the same bits
    current,   ///< the light that arrived in the last iteration, where there is one: fewer
               ///< iterations if the change is small, with the same limit
  };
  /// Replaces rho, E and lobes and starts to iterate again, with the transfers that are kept. Where
  /// a patch gets a lobe that had none, the passes are made again.
  /// The next iteration scales lobes; those that stay the same are kept.
  /// @param materials as many as the scene has, for the same patches; with `of_patch`, any number.
  /// @param of_patch index into `materials` of each patch; if empty, the scene's indices apply.
  /// @param start what the iteration starts with.
  /// @throws InputError; std::runtime_error where the radiance by direction does not fit into
  /// memory. Nothing is changed then.
  void set_materials(const std::vector<Material>& materials,
                     const std::vector<std::int32_t>& of_patch = {}, Start start = Start::emission);
  /// The scene, shared.
  std::shared_ptr<const Scene> shared_scene() const;
  /// The options it was constructed with.
  const SolveOptions& options() const;
  /// The error estimate from replicas, for B of the last finished iteration. None before the first,
  /// and for other materials than the scene's.
  ErrorEstimate error_estimate() const;
  /// The first shot, of the scene's own materials; all 0 if there is none.
  std::shared_ptr<const DirectLight> direct_light() const;
  /// The current state.
  SolveProgress progress() const;
  /// omega of each pass, replica by replica.
  const std::vector<Vec3>& directions() const;
  /// The result so far; complete once the solve has finished. Its `scene` is the constructor's.
  Solution solution() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace TRANSILLUM_API transillum
