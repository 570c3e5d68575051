// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Colors, layout, line widths and texts that the SVG and PNG pictures of a map share.
#include "io/maps/map_drawing.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "transillum/at.h"

namespace transillum {
namespace {

/// The sRGB transfer function; `linear` is clamped to [0,1].
std::uint8_t encoded(double linear) {
  const double x = std::clamp(linear, 0.0, 1.0);
  const double s = x <= 0.0031308 ? 12.92 * x : 1.055 * std::pow(x, 1 / 2.4) - 0.055;
  return static_cast<std::uint8_t>(std::lround(255 * s));
}

Color8 encoded(const Rgb& linear) {
  return {encoded(linear.r), encoded(linear.g), encoded(linear.b)};
}

struct Box {
  double x0 = HUGE_VAL, y0 = HUGE_VAL, x1 = -HUGE_VAL, y1 = -HUGE_VAL;

  void add(const Vec2& p) {
    x0 = std::min(x0, p.x);
    y0 = std::min(y0, p.y);
    x1 = std::max(x1, p.x);
    y1 = std::max(y1, p.y);
  }
};

}  // namespace

PatchRole role_of(const Scene& scene, const VisibilityMap::Polygon& polygon) {
  if (polygon.front_facing) {
    return PatchRole::back_side;
  }
  return max_abs(scene.exitance(polygon.patch)) > 0 ? PatchRole::emits : PatchRole::reflects;
}

Color8 color_of(const Scene& scene, const VisibilityMap::Polygon& polygon,
                const MapPictureOptions& options) {
  if (!polygon.front_facing && !options.patch_colors.empty()) {
    const auto& color = at(options.patch_colors, polygon.patch);
    return {color[0], color[1], color[2]};
  }
  const Rgb& exitance = scene.exitance(polygon.patch);
  const Rgb& reflectance = scene.reflectance(polygon.patch);
  switch (role_of(scene, polygon)) {
    case PatchRole::emits:
      return encoded({exitance.r / max_abs(exitance), exitance.g / max_abs(exitance),
                      exitance.b / max_abs(exitance)});
    case PatchRole::reflects:
      return encoded(Rgb{0.02, 0.02, 0.02} + 0.5 * reflectance);
    case PatchRole::back_side:
      break;
  }
  // A trace of the surface's own hue distinguishes neighbors.
  return encoded(Rgb{0.05, 0.062, 0.08} + 0.04 * reflectance);
}

MapLayout fit_map(const VisibilityMap& map, double width, double height) {
  constexpr double margin = 0.03, least_fraction = 0.3;
  Box box;
  for (const Vec2& p : map.corners) {
    box.add(p);
  }
  if (map.corners.empty()) {
    box.add({0, 0});
  }
  const double size = std::max(box.x1 - box.x0, box.y1 - box.y0);
  // Even for an empty or very narrow map, the picture has a minimum width.
  const double wide = size > 0 ? std::max(box.x1 - box.x0, least_fraction * size) : 1;
  const double high = size > 0 ? std::max(box.y1 - box.y0, least_fraction * size) : least_fraction;
  const double border = margin * std::max(width, height);
  MapLayout layout;
  layout.transform.scale = std::min((width - 2 * border) / wide, (height - 2 * border) / high);
  layout.transform.center = {box.x0 + (box.x1 - box.x0) / 2, box.y0 + (box.y1 - box.y0) / 2};
  layout.width = wide * layout.transform.scale + 2 * border;
  layout.height = high * layout.transform.scale + 2 * border;
  layout.transform.middle = {layout.width / 2, layout.height / 2};
  return layout;
}

double total_area(const std::vector<VisibilityMap::Polygon>& polygons) {
  double sum = 0;
  for (const VisibilityMap::Polygon& polygon : polygons) {
    sum += polygon.area;
  }
  return sum;
}

double line_width(const VisibilityMap& map, double scale) {
  if (map.pixels.side > 0) {
    return std::clamp(0.15 * scale * map.pixels.side, 0.3, 1.0);
  }
  if (map.polygons.empty()) {
    return 0;
  }
  const double side =
      scale * std::sqrt(total_area(map.polygons) / static_cast<double>(map.polygons.size()));
  return std::clamp(0.02 * side, 0.1, 0.8);
}

double difference_fraction(const VisibilityMap& map) {
  const double shown = total_area(map.window.empty() ? map.polygons : map.window);
  return shown > 0 ? total_area(map.pixels.differences) / shown : 0;
}

std::string empty_map_reason(const Scene& scene, const VisibilityMap& map) {
  if (!map.polygons.empty()) {
    return {};
  }
  if (map.receiver == no_patch) {
    return "every patch that was processed is edge-on to the direction";
  }
  if (!map.window.empty()) {
    return fmt::format("nothing is above patch {}", map.receiver);
  }
  const double cosine = dot(scene.patch(map.receiver).normal, map.frame.omega);
  return fmt::format("patch {} is {} the direction and sees nothing", map.receiver,
                     cosine < -1e-9 ? "back-facing along" : "edge-on to");
}

std::vector<PlacedLabel> place_labels(const std::vector<MapLabel>& labels,
                                      const MapTransform& transform, double left, double width) {
  constexpr double shift = 16, line = 1.4 * label_size, letter = 0.65 * label_size;
  struct LabelBox {
    double begin, end, base;
  };
  std::vector<LabelBox> taken;
  std::vector<PlacedLabel> placed;
  for (const MapLabel& label : labels) {
    const Vec2 point = transform.to_pixels(label.point);
    const bool to_left = point.x > left + width / 2;
    const double beside = to_left ? point.x - shift : point.x + shift;
    const auto letters = std::count_if(label.text.begin(), label.text.end(),
                                       [](char c) { return (c & 0xc0) != 0x80; });
    const double room = letter * static_cast<double>(letters);
    LabelBox box{to_left ? beside - room : beside, to_left ? beside : beside + room,
                 std::max(point.y - shift, line)};
    const auto hides = [&box](const LabelBox& other) {
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
