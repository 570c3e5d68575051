// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

#include "transillum/bsp_tree.h"
#include "transillum/hemicube.h"

namespace transillum {

/// The item buffers of engine hemicube at the center of one patch: five sides of half a cube.
///
/// Unfolded, they form a cross in 2R by 2R cells with empty corners: the top side in the middle,
/// around it the four half sides with their bases outward. Columns and rows run along the cube's x
/// and y axes; the patch's normal points toward the viewer, x to the right, y up.
struct HemicubeImage {
  PatchId patch = no_patch;          ///< the patch at whose center the cube stands
  int resolution = 0;                ///< R
  std::vector<PatchId> items;        ///< per pixel; no_patch: nothing, or a back side
  std::vector<double> delta;         ///< per pixel: its form factor
  std::vector<double> form_factors;  ///< per patch j: F_ij, the sum of its pixels

  /// Cells along a side of the cross.
  int cross() const { return 2 * resolution; }
  /// Index of the pixel in a cell of the cross; nothing in its empty corners.
  std::optional<std::size_t> pixel_at(int column, int row) const;
};

/// Draws one hemicube.
/// @param scene the scene.
/// @param tree BSP tree of `scene`.
/// @param patch the patch at whose center the cube stands.
/// @param options resolution applies.
/// @param cancellation checked during computation.
/// @throws InputError as hemicube_form_factors()
/// @throws Canceled
HemicubeImage hemicube_image(const std::shared_ptr<const Scene>& scene,
                             const std::shared_ptr<const BspTree>& tree, PatchId patch,
                             const HemicubeOptions& options, const Cancellation& cancellation = {});

}  // namespace transillum
