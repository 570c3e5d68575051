// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "io/maps/map_labels.h"

#include <algorithm>
#include <cmath>

namespace transillum {

std::vector<PlacedLabel> place_labels(const std::vector<MapLabel>& labels,
                                      const MapTransform& transform, double left, double width) {
  constexpr double shift = 16, line = 1.4 * label_size, letter = 0.65 * label_size;
  struct Box {
    double begin, end, base;
  };
  std::vector<Box> taken;
  std::vector<PlacedLabel> placed;
  for (const MapLabel& label : labels) {
    const Vec2 point = transform.to_pixels(label.point);
    const bool to_left = point.x > left + width / 2;
    const double beside = to_left ? point.x - shift : point.x + shift;
    const auto letters = std::count_if(label.text.begin(), label.text.end(),
                                       [](char c) { return (c & 0xc0) != 0x80; });
    const double room = letter * static_cast<double>(letters);
    Box box{to_left ? beside - room : beside, to_left ? beside : beside + room,
            std::max(point.y - shift, line)};
    const auto hides = [&box](const Box& other) {
      return box.begin < other.end && other.begin < box.end &&
             std::abs(box.base - other.base) < line;
    };
    while (std::any_of(taken.begin(), taken.end(), hides)) {
      box.base += line / 4;
    }
    taken.push_back(box);
    placed.push_back({label.text, point, {beside, box.base}, to_left});
  }
  return placed;
}

}  // namespace transillum
