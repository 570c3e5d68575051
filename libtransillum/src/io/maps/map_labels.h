// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <string>
#include <vector>

#include "io/maps/map_drawing.h"

namespace transillum {

/// Where a label is drawn, pixels.
struct PlacedLabel {
  std::string text;
  Vec2 point;            ///< the place that it points at
  Vec2 base;             ///< begin of the text on its base line, or its end
  bool ends_at = false;  ///< whether `base` is the end
};

/// Height of the letters of labels, pixels.
inline constexpr double label_size = 15;

/// Places the labels of a map in a rectangle of the given width: each beside its point, toward the
/// middle, and below those that it would hide. Widths of texts are estimated.
std::vector<PlacedLabel> place_labels(const std::vector<MapLabel>& labels,
                                      const MapTransform& transform, double left, double width);

}  // namespace transillum
