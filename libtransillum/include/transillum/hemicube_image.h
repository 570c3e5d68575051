// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

#include "transillum/bsp_tree.h"
#include "transillum/hemicube.h"

namespace transillum {

/// What engine hemicube sees from the middle of one patch: the item buffers of the five sides.
///
/// Unfolded they make a cross of 2R by 2R cells, its corners empty: the top in the middle, about it
/// the four half sides, their bases outward. Column and row run along the cube's x and y; the
/// patch's normal points at who looks at it with x to the right, y up.
struct HemicubeImage {
  PatchId patch = no_patch;
  int resolution = 0;                ///< R
  std::vector<PatchId> items;        ///< a pixel; no_patch: nothing, or a back
  std::vector<double> delta;         ///< a pixel: its form factor
  std::vector<double> form_factors;  ///< a patch: F_ij, the row that the engine makes of it

  int cross() const { return 2 * resolution; }
  /// The pixel that a cell of the cross shows; nothing in its corners.
  std::optional<std::size_t> pixel_at(int column, int row) const;
};

/// @param tree of `scene`.
/// @throws InputError as hemicube_form_factors(), Canceled
HemicubeImage hemicube_image(const std::shared_ptr<const Scene>& scene,
                             const std::shared_ptr<const BspTree>& tree, PatchId patch,
                             const HemicubeOptions& options, const Cancellation& cancellation = {});

}  // namespace transillum
