// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <span>
#include <vector>

#include "colors/color_scale.h"
#include "model/per_direction_visibility.h"

namespace transillum::viewer {

/// What a patch receives along one direction: one term of the outer sum of eq. 11.
struct ReceivedLight {
  int pass = 0;                  ///< from 0
  bool opposite = false;         ///< along -omega of the pass
  double cosine = 0;             ///< of the patch's normal with the direction
  double area = 0;               ///< it sees lit sides of, m² of the plane
  Rgb irradiance;                ///< added to its H, W/m²
  PatchId brightest = no_patch;  ///< the source that adds most luminance, if any does

  friend bool operator==(const ReceivedLight&, const ReceivedLight&) = default;
};

/// One for each direction of `visible_areas`, in their order, both ways where the run goes both.
/// @param radiosity B(n), W/m², one a patch
/// @param passes M; an irradiance is the M-th part of 4/A_i times area and B, summed up
std::vector<ReceivedLight> received_light(
    const PerDirectionVisibility::Request& asked,
    std::span<const PerDirectionVisibility::VisibleAreas> visible_areas,
    const std::vector<Rgb>& radiosity, int passes);

}  // namespace transillum::viewer
