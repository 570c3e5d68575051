// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "io/maps/map_drawing.h"
#include "transillum/map_files.h"
#include "transillum/scene.h"
#include "transillum/visibility_map.h"

namespace transillum {

// Colors, layout and line widths that the SVG and PNG pictures of a map share.

/// sRGB.
struct Color8 {
  std::uint8_t r, g, b;
};

namespace map_colors {
/// Background of the map: dark and neutral, as in the viewer.
inline constexpr Color8 ground{0x1d, 0x21, 0x27};
inline constexpr Color8 edge{0x0a, 0x0c, 0x0f};
/// The receiver's projection where nothing is above it.
inline constexpr Color8 nothing{0x2c, 0x32, 0x3b};
/// Where a map in pixels differs from the exact map.
inline constexpr Color8 difference{0x19, 0xe3, 0xff};
inline constexpr double difference_opacity = 0.85;
}  // namespace map_colors

/// The side of a patch that is visible along omega.
enum class PatchRole {
  emits,      ///< the front; its exitance is > 0
  reflects,   ///< the front; it only reflects
  back_side,  ///< the back: the patch receives from above
};
PatchRole role_of(const Scene& scene, const VisibilityMap::Polygon& polygon);
/// Fill color: options.patch_colors if given; otherwise emitters bright in the hue of their
/// exitance, reflectors darker in the color of their reflectance. Back sides are nearly gray.
Color8 color_of(const Scene& scene, const VisibilityMap::Polygon& polygon,
                const MapPictureOptions& options);

/// From meters on the plane to pixels, x to the right and y downward. In a view along omega, u
/// points to the left.
struct MapTransform {
  Vec2 center;       ///< meters; drawn at `middle`
  Vec2 middle;       ///< pixels
  double scale = 1;  ///< pixels per meter

  Vec2 to_pixels(const Vec2& p) const {
    return {middle.x - scale * (p.x - center.x), middle.y - scale * (p.y - center.y)};
  }
};

/// Size in pixels of a rectangle that shows all of a map with a margin, and the map's place in it.
struct MapLayout {
  double width = 0, height = 0;
  MapTransform transform;  ///< pixels are counted from the rectangle's upper left corner
};
/// The largest layout that fits in width x height with the map's proportions, limited to 0.3 : 1.
MapLayout fit_map(const VisibilityMap& map, double width, double height);

/// Sum of the areas, m².
double total_area(const std::vector<VisibilityMap::Polygon>& polygons);

/// Width in pixels of the lines between polygons, thinner for smaller polygons; of a map in pixels,
/// of the borders between pixels. @param scale pixels per meter
double line_width(const VisibilityMap& map, double scale);

/// Area in which a map in pixels differs from the exact one, as a fraction of the receiver's
/// projection or, without a receiver, of the map.
double difference_fraction(const VisibilityMap& map);

/// Where a label is drawn, pixels.
struct PlacedLabel {
  std::string text;
  Vec2 point;            ///< the point that it marks
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
