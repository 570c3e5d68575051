// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <span>
#include <vector>

#include "colors/color_scale.h"
#include "model/per_direction_visibility.h"

namespace transillum::viewer {

/// The light that a patch receives along one direction: one term of the outer sum of eq. 11.
struct ReceivedLight {
  int pass = 0;                  ///< from 0
  bool opposite = false;         ///< along -omega of the pass
  double cosine = 0;             ///< between the patch's normal and the direction
  double area = 0;               ///< area of front sides that the patch sees, m² on the plane
  Rgb irradiance;                ///< contribution to H of the patch, W/m²
  PatchId brightest = no_patch;  ///< the source of the largest contribution (luminance), if any

  friend bool operator==(const ReceivedLight&, const ReceivedLight&) = default;
};

/// The request for what a patch sees along the first `count` directions of an iteration.
PerDirectionVisibility::Request visibility_request(const SolverSnapshot& snapshot, int iteration,
                                                   int count, PatchId patch);

/// One entry per direction of `visible_areas`, in their order; in a two-way run omega and then
/// -omega of each pass.
/// @param radiosity B(n), W/m², one per patch
/// @param passes M: a contribution is 4/(A_i M) times the sum of visible area times B, with 2M
///        instead of M in a two-way run
std::vector<ReceivedLight> received_light(
    const PerDirectionVisibility::Request& request,
    std::span<const PerDirectionVisibility::VisibleAreas> visible_areas,
    const std::vector<Rgb>& radiosity, int passes);

}  // namespace transillum::viewer
