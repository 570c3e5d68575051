// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// The cost of a pass of engine fast by patch and face: which faces make a model slow, and why.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "transillum/bsp_tree.h"
#include "transillum/cancellation.h"
#include "transillum/engine.h"
#include "transillum/scene.h"
#include "transillum/vec3.h"
#include "visibility/queries/query_cost.h"

namespace transillum {

/// The cost of some passes.
struct PatchCosts {
  int passes = 0;                  ///< >= 1
  double seconds = 0;              ///< wall time of the measurement, s
  std::vector<PatchCost> patches;  ///< one per patch, sums over the passes

  /// The sum over all patches.
  PatchCost total() const;
};

/// Some of a solve's directions, evenly spread in its list: one in 64, at least 1 and at most 4;
/// nothing of an empty list.
std::vector<Vec3> directions_to_measure(std::span<const Vec3> directions);

/// Measures the cost of passes: runs each twice, one after the other on the calling thread. The
/// time of a patch is the shorter one, as other programs may have interrupted the longer.
/// @param engine fast.
/// @param scene the scene.
/// @param tree BSP tree of `scene`.
/// @param directions omega of the passes; at least one.
/// @param moments EngineOptions::moments.
/// @param cancellation checked throughout.
/// @throws InputError for another engine, which has no queries, and without directions; Canceled
PatchCosts patch_costs(Engine engine, std::shared_ptr<const Scene> scene,
                       std::shared_ptr<const BspTree> tree, std::span<const Vec3> directions,
                       bool moments, const Cancellation& cancellation = {});

/// The cost of the patches of a face.
struct FaceCost {
  PatchId patch = no_patch;  ///< the first of them, which tells face, group and material
  std::int64_t patches = 0;  ///< their number
  PatchCost cost;            ///< their sum
};
/// The faces that take most time, by decreasing time.
/// @param most number of faces to return
std::vector<FaceCost> costly_faces(const Scene& scene, const PatchCosts& costs, std::size_t most);

}  // namespace transillum
