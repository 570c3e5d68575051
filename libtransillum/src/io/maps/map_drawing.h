// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "transillum/map_files.h"
#include "transillum/scene.h"
#include "transillum/visibility_map.h"

namespace transillum {

// What the pictures of a map have in common.

/// sRGB.
struct Color8 {
  std::uint8_t r, g, b;
};

namespace map_colors {
/// Light is looked at before a dark, neutral ground, as in the viewer.
inline constexpr Color8 ground{0x1d, 0x21, 0x27};
inline constexpr Color8 edge{0x0a, 0x0c, 0x0f};
/// A receiver's own polygon where nothing is above it.
inline constexpr Color8 nothing{0x2c, 0x32, 0x3b};
/// Where a picture in pixels shows not what is there.
inline constexpr Color8 difference{0x19, 0xe3, 0xff};
inline constexpr double difference_opacity = 0.85;
}  // namespace map_colors

enum class PatchLook {
  emits,      ///< shines down with light of its own
  reflects,   ///< shines down what it reflects
  back_side,  ///< receives from above and shows its back
};
PatchLook look_of(const Scene& scene, const VisibilityMap::Polygon& polygon);
/// As the options say, or emitters bright in the hue of their exitance, reflectors dimmer in that
/// of their reflectance; back sides nearly gray.
Color8 color_of(const Scene& scene, const VisibilityMap::Polygon& polygon,
                const MapPictureOptions& options);

/// From meters on the plane to pixels, x to the right and y downward. Seen along omega, u points
/// to the left.
struct MapTransform {
  Vec2 center;       ///< meters; lies at `middle`
  Vec2 middle;       ///< pixels
  double scale = 1;  ///< pixels a meter

  Vec2 to_pixels(const Vec2& p) const {
    return {middle.x - scale * (p.x - center.x), middle.y - scale * (p.y - center.y)};
  }
};

/// A rectangle of pixels that shows all of a map, with a margin round it.
struct MapPlate {
  double width = 0, height = 0;
  MapTransform transform;  ///< from the plate's upper left corner
};
/// The largest plate of the map's own proportions, or nearly, that fits in width x height.
MapPlate fit_map(const VisibilityMap& map, double width, double height);

/// m².
double total_area(const std::vector<VisibilityMap::Polygon>& polygons);

/// Width in pixels of the lines between polygons: thinner where they crowd. Of a picture in pixels
/// that of its borders.
double line_width(const VisibilityMap& map, double scale);

/// Shares of the window, or of all that is seen: what a picture in pixels shows wrongly.
double difference_share(const VisibilityMap& map);

}  // namespace transillum
