// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "transillum/cancellation.h"
#include "transillum/export.h"
#include "transillum/linear_basis.h"
#include "transillum/scene.h"
#include "transillum/solve_options.h"

namespace TRANSILLUM_API transillum {

/// Default threshold of R²/A from which a source is treated as small: of 2,048 directions, fewer
/// than one on average meets it from a point half a scene away.
inline constexpr double small_source_ratio = 1000;

/// The threshold called `name`: `auto` (first_shot_where_it_pays), a number >= 0, or `none`.
/// @returns nothing for `none`.
/// @throws InputError listing the choices.
std::optional<double> first_shot_from_name(const std::string& name);

/// The patches of small bright sources (paper, section 5.2). A source is a set of emitting patches
/// connected by shared points. It is small if R²/A >= `ratio`, where R is the scene's diagonal and
/// A the source's area, and bright if it emits at least 1/10,000 of the scene's power.
/// @param scene the scene.
/// @param ratio >= 0; 0 selects all bright sources.
/// @returns patches, ascending.
std::vector<PatchId> find_small_sources(const Scene& scene, double ratio = small_source_ratio);

/// The sources that a first shot treats: find_small_sources(); or where it pays, by an estimate of
/// both costs from counts, so that it does not depend on the machine (decisions/0052-accuracy.md).
/// @param scene the scene.
/// @param threshold R²/A, or first_shot_where_it_pays.
/// @param directions M, of the passes to come.
/// @param basis of the solve: linear terms cost a shot more than passes.
/// @param cancellation checked during computation.
/// @returns patches, ascending.
/// @throws Canceled
std::vector<PatchId> first_shot_sources(const Scene& scene, double threshold, int directions,
                                        Basis basis = Basis::constant,
                                        const Cancellation& cancellation = {});
/// The name that first_shot_from_name() reads.
std::string name_of_first_shot(const std::optional<double>& threshold);

/// The direct light from some sources to all patches.
struct DirectLight {
  /// The contribution of the sources of one material.
  struct Contribution {
    int material = 0;                ///< index into Scene::materials()
    std::vector<double> irradiance;  ///< H for an exitance of 1, one per patch
    /// Coefficients of phi_1 and phi_2 of H for an exitance of 1; empty with Basis::constant.
    std::vector<std::array<double, 2>> linear_terms = {};
  };
  /// The contribution of one source to one patch.
  struct Pair {
    PatchId receiver = 0;   ///< patch that receives
    PatchId source = 0;     ///< patch that emits
    double irradiance = 0;  ///< H for an exitance of 1, above 0
  };

  std::vector<Rgb> irradiance;   ///< H, W/m², one per patch
  std::vector<Rgb> exitance;     ///< E of the sources, which has been shot; 0 for other patches
  std::vector<PatchId> sources;  ///< ascending
  double power_fraction = 0;     ///< power of the sources over all power emitted
  /// Sorted by material; empty if they would exceed 256 MiB.
  std::vector<Contribution> contributions;
  /// Estimated error of `irradiance`, W/m², one per patch: the error of partly hidden pairs, which
  /// are computed by points. Empty if unknown (with_materials()).
  std::vector<Rgb> irradiance_error = {};
  /// ShotOptions::points by which the light of each patch was computed; empty if unknown.
  std::vector<int> points = {};
  std::int64_t integrated_pairs = 0;  ///< SolveStatistics::integrated_pairs
  /// Linear terms of `irradiance`, W/m², one per patch; empty with Basis::constant.
  std::vector<LinearTerm> linear_terms = {};
  /// Estimated errors of `linear_terms`, of points even where nothing stands between. Empty if
  /// unknown, and with Basis::constant.
  std::vector<LinearTerm> linear_term_errors = {};
  /// The patches whose pairs are known, ascending: those with lobes, in a solve in which lobes take
  /// part. Their reflection depends on where the light comes from.
  std::vector<PatchId> paired = {};
  std::vector<Pair> pairs = {};  ///< shoot_pairs(), for `paired`
};

/// Options of a first shot.
struct ShotOptions {
  int threads = 0;  ///< 0: all cores are used; the result does not depend on it
  /// linear: the linear terms of H are computed too, by points of one polygon; the means
  /// have the same bits as with constant functions
  Basis basis = Basis::constant;
  /// Number of points along a polygon as large as its distance from the other, where something is
  /// between, up to EngineOptions::largest_points; 0 means default_points.
  int points = 0;
  /// The number of points without a choice.
  static constexpr int default_points = 16;
};

/// The options by which a solve makes its first shot.
ShotOptions shot_options(const SolveOptions& options);

/// Distributes the emission of `sources` to all patches by exact form factors: of whole polygons
/// where nothing stands between, else by points of one polygon with exact shadows
/// (decisions/0022-first-shot.md). Time grows as sources times patches times polygons between them.
/// @param scene the scene.
/// @param sources find_small_sources(), or any emitting patches, ascending.
/// @param options how.
/// @param cancellation checked during computation.
/// @param progress if set, called at intervals with the fraction of pairs done, in [0,1], on this
/// thread; also while one pair takes long.
/// @throws Canceled
DirectLight shoot(const Scene& scene, const std::vector<PatchId>& sources,
                  const ShotOptions& options = {}, const Cancellation& cancellation = {},
                  const std::function<void(double)>& progress = {});

/// Shoots the sources of `light` at some patches again, by other options: replaces the sums,
/// contributions, errors and pairs of these patches.
/// @param scene the scene of `light`.
/// @param receivers patches, ascending.
/// @param options as for shoot(), with the same basis.
/// @param light with contributions and errors as shoot() and shoot_pairs() have made them.
/// @param cancellation as for shoot(), as well as `progress`. `light` is then incomplete.
/// @throws Canceled
void shoot_again(const Scene& scene, const std::vector<PatchId>& receivers,
                 const ShotOptions& options, DirectLight& light,
                 const Cancellation& cancellation = {},
                 const std::function<void(double)>& progress = {});

/// The single contributions of sources to some patches, of which shoot() adds up all.
/// @param scene the scene.
/// @param sources as for shoot().
/// @param receivers patches, ascending.
/// @param options as for shoot(); pairs have no linear terms.
/// @param cancellation checked during computation.
/// @param progress as for shoot().
/// @returns pairs by receiver, then source.
/// @throws Canceled
std::vector<DirectLight::Pair> shoot_pairs(const Scene& scene, const std::vector<PatchId>& sources,
                                           const std::vector<PatchId>& receivers,
                                           const ShotOptions& options = {},
                                           const Cancellation& cancellation = {},
                                           const std::function<void(double)>& progress = {});

/// The direct light of the same sources after a change of materials, from the parts of `light`. The
/// result has no parts.
/// @param light of `scene`.
/// @param scene the scene.
/// @param materials as many as the scene has, in the same order; with patch_materials any number.
/// @param patch_materials index into `materials` for each patch; if empty, Patch::material applies.
/// @throws InputError where `light` belongs to another scene or has no parts, or where sources of
/// one part now differ in exitance.
DirectLight with_materials(const DirectLight& light, const Scene& scene,
                           const std::vector<Material>& materials,
                           std::span<const std::int32_t> patch_materials = {});

}  // namespace TRANSILLUM_API transillum
