// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Layout of a map's figure: title and two lines, the map, scale bar, axes and legend.
#include "io/maps/map_figure.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "io/text.h"

namespace transillum {
namespace {

constexpr double least_width = 470;
/// Least height of the room for the map, so that even the smallest figure shows it.
constexpr double least_map_height = 64;
/// Upper bound of the mean width of the title's bold letters, pixels.
constexpr double title_letter = 13;

/// Whether a byte of UTF-8 is the first of a character.
bool begins_character(char byte) { return (byte & 0xc0) != 0x80; }

/// A name of at most `most` characters: the end of a longer one, after an ellipsis. The end is the
/// distinctive part of a path.
std::string shortened(const std::string& text, std::size_t most) {
  const std::string clean = clean_text(text);
  std::size_t characters = 0;
  for (std::size_t k = clean.size(); k-- > 0;) {
    if (begins_character(clean[k]) && ++characters == most && k > 0) {
      return "\u2026" + clean.substr(k);
    }
  }
  return clean;
}

/// A title of at most `most` characters: the begin of a longer one, before an ellipsis.
std::string cut(const std::string& text, std::size_t most) {
  const std::string clean = clean_text(text);
  std::size_t characters = 0;
  for (std::size_t k = 0; k < clean.size(); ++k) {
    if (begins_character(clean[k]) && ++characters > most) {
      return clean.substr(0, k) + "\u2026";
    }
  }
  return clean;
}

std::string heading(const VisibilityMap& map, const std::string& scene_name) {
  return map.receiver == no_patch
             ? fmt::format("Visibility map of {}", scene_name)
             : fmt::format("Visible from patch {} of {}", map.receiver, scene_name);
}

std::string content_of(const Scene& scene, const VisibilityMap& map) {
  int patches = 0;
  PatchId last = no_patch;
  for (const VisibilityMap::Polygon& polygon : map.polygons) {
    patches += polygon.patch != last ? 1 : 0;
    last = polygon.patch;
  }
  const std::string parts = map.pixels.side > 0 ? fmt::format("pixels of {:.3g} m", map.pixels.side)
                                                : fmt::format("{} polygons", map.polygons.size());
  return fmt::format("{} of {} patches, {}, total area {:.4g} m\u00b2", patches,
                     scene.patch_count(), parts, total_area(map.polygons));
}

/// The largest 1, 2 or 5 times a power of ten that is at most a quarter of the width.
MapFigure::ScaleBar scale_bar_of(const MapFigure& figure) {
  const double scale = figure.layout.transform.scale;
  const double max_length = figure.width / 4 / scale;
  const double power = std::pow(10.0, std::floor(std::log10(max_length)));
  const double lead = max_length / power;
  const double meters = power * (lead >= 5 ? 5 : lead >= 2 ? 2 : 1);
  return {MapFigure::padding, MapFigure::padding + meters * scale, figure.height - 62, meters};
}

/// Whether nothing is above a part of the receiver.
bool leaves_a_gap(const VisibilityMap& map) {
  const double area = total_area(map.window);
  double open = area;
  for (const VisibilityMap::Polygon& polygon : map.polygons) {
    open -= polygon.area;
  }
  return open > 1e-6 * area;
}

std::vector<MapFigure::LegendEntry> legend_of(const Scene& scene, const VisibilityMap& map,
                                              const MapPictureOptions& options, double scale) {
  std::vector<MapFigure::LegendEntry> entries;
  double left = MapFigure::padding;
  const auto entry = [&](const Color8& color, const std::string& label, double width) {
    entries.push_back({color, label, left});
    left += width;
  };
  const auto add = [&](PatchRole role, const char* label, double width) {
    const auto found =
        std::find_if(map.polygons.begin(), map.polygons.end(), [&](const auto& polygon) {
          // Ignore polygons too small to be visible, such as rounding residues.
          const double pixels = polygon.area * std::pow(scale, 2);
          return pixels > 0.1 && role_of(scene, polygon) == role;
        });
    if (found != map.polygons.end()) {
      entry(color_of(scene, *found, options), label, width);
    }
  };
  // The meaning of the caller's colors is not known here.
  if (options.patch_colors.empty()) {
    add(PatchRole::emits, "emits", 84);
    add(PatchRole::reflects, "reflects", 102);
  }
  add(PatchRole::back_side, "back side", 112);
  if (leaves_a_gap(map)) {
    entry(map_colors::nothing, "nothing above", 132);
  }
  if (!map.pixels.differences.empty()) {
    entry(map_colors::difference, fmt::format("differs ({:.2g} %)", 100 * difference_fraction(map)),
          0);
  }
  return entries;
}

}  // namespace

MapFigure::MapFigure(const Scene& scene, const VisibilityMap& map, const MapPictureOptions& options)
    : in_pixels(map.pixels.side > 0),
      layout(fit_map(map, options.size - 2 * padding,
                     std::max(options.size - header - footer, least_map_height))) {
  width = std::max(layout.width + 2 * padding, in_pixels ? least_width + 130 : least_width);
  height = layout.height + header + footer;
  left = (width - layout.width) / 2;
  layout.transform.middle.x += left;
  layout.transform.middle.y += header;

  const auto room = static_cast<std::size_t>((width - 2 * padding) / title_letter);
  const std::size_t fixed = heading(map, {}).size();
  title = options.title.value_or(heading(map, scene.name()));
  short_title = options.title
                    ? cut(title, room)
                    : heading(map, shortened(scene.name(), room > fixed + 8 ? room - fixed : 8));
  const Vec3& omega = map.frame.omega;
  direction = fmt::format("View along \u03c9 = ({:.4g}, {:.4g}, {:.4g}), toward the light", omega.x,
                          omega.y, omega.z);
  content = content_of(scene, map);
  empty_reason = empty_map_reason(scene, map);
  if (!map.corners.empty()) {
    scale_bar = scale_bar_of(*this);
  }
  axes = {width - padding - 18, height - 56};
  legend = legend_of(scene, map, options, layout.transform.scale);
  legend_top = height - 32;
}

}  // namespace transillum
