// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Maps as SVG figures: title, one path per patch with a tool tip, scale bar, axes and legend. The
// classes and attributes of the paths are described in data/FILES.md.
#include <algorithm>
#include <cmath>
#include <string>

#include "io/maps/map_figure.h"
#include "io/maps/map_writers.h"
#include "io/text.h"
#include "transillum/errors.h"

namespace transillum {
namespace {

constexpr const char* style = R"(  <style>
    text { font-family: "DejaVu Sans", "Helvetica Neue", Arial, sans-serif; fill: #5a6472; font-size: 13px; }
    .page { fill: #ffffff; }
    .title { fill: #1b212a; font-size: 20px; font-weight: bold; }
    .note { fill: #a4adb8; font-size: 15px; text-anchor: middle; }
    .rule { stroke: #1b212a; stroke-width: 1.5; fill: none; stroke-linecap: square; }
    .end { text-anchor: end; }
    .swatch { stroke: #0a0c0f; stroke-width: 0.5; }
    .patch { stroke: #0a0c0f; stroke-linejoin: round; }
    .pixel { stroke: none; }
    .border { stroke: #0a0c0f; fill: none; stroke-linecap: square; }
    .label { font-size: 15px; font-weight: bold; fill: #ffffff; stroke: #000000; stroke-width: 4; paint-order: stroke; }
    .pointer { stroke: #ffffff; stroke-width: 2; fill: #ffffff; }
    .patch:hover { stroke: #ff3e9e; stroke-width: 2; }
  </style>
)";

std::string hex(const Color8& c) { return fmt::format("#{:02x}{:02x}{:02x}", c.r, c.g, c.b); }

class SvgFigure {
 public:
  SvgFigure(std::ostream& out, const Scene& scene, const VisibilityMap& map,
            const MapPictureOptions& options)
      : text_(out),
        scene_(scene),
        map_(map),
        options_(options),
        figure_(scene, map, options),
        layout_(figure_.layout) {}

  void write() {
    begin();
    add_header();
    add_map();
    if (figure_.scale_bar) {
      add_scale_bar(*figure_.scale_bar);
    }
    add_axes();
    add_legend();
    text_.add("</svg>\n");
  }

 private:
  static constexpr double padding = MapFigure::padding, header = MapFigure::header;

  void begin() {
    text_.add("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n");
    text_.add(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" role=\"img\" width=\"{0:.0f}\" "
        "height=\"{1:.0f}\" viewBox=\"0 0 {0:.0f} {1:.0f}\">\n",
        figure_.width, figure_.height);
    text_.add("  <title>{}</title>\n", xml_text(figure_.title));
    const Vec3& omega = map_.frame.omega;
    text_.add("  <desc>transillum " TRANSILLUM_VERSION
              "; direction omega = {}, {}, {}; view along omega; {} pixels per meter</desc>\n",
              omega.x, omega.y, omega.z, layout_.transform.scale);
    text_.add("{}", style);
    if (!options_.transparent) {
      text_.add("  <rect class=\"page\" width=\"100%\" height=\"100%\"/>\n");
    }
  }

  void add_header() {
    text_.add("  <text class=\"title\" x=\"{}\" y=\"{}\">{}</text>\n", padding,
              MapFigure::title_base, xml_text(figure_.short_title));
    text_.add("  <text x=\"{}\" y=\"{}\">{}</text>\n", padding, MapFigure::direction_base,
              figure_.direction);
    text_.add("  <text x=\"{}\" y=\"{}\">{}</text>\n", padding, MapFigure::content_base,
              figure_.content);
  }

  void add_map() {
    if (!options_.transparent) {
      text_.add(
          "  <rect class=\"ground\" x=\"{:.2f}\" y=\"{:.2f}\" width=\"{:.2f}\" height=\"{:.2f}\" "
          "rx=\"4\" fill=\"{}\"/>\n",
          figure_.left, header, layout_.width, layout_.height, hex(map_colors::ground));
    }
    add_window();
    // crispEdges: no background shows between adjacent rectangles.
    text_.add("  <g class=\"map\" stroke-width=\"{:.3g}\" stroke-opacity=\"0.6\"{}>\n",
              line_width(map_, layout_.transform.scale),
              figure_.in_pixels ? " shape-rendering=\"crispEdges\"" : "");
    auto first = map_.polygons.begin();
    while (first != map_.polygons.end()) {
      const auto last = std::find_if(first, map_.polygons.end(), [&](const auto& polygon) {
        return polygon.patch != first->patch || polygon.front_facing != first->front_facing;
      });
      add_patch({&*first, static_cast<std::size_t>(last - first)});
      first = last;
    }
    text_.add("  </g>\n");
    if (figure_.in_pixels) {
      add_pixel_marks();
    }
    add_labels();
    if (figure_.empty_reason.empty()) {
      return;
    }
    text_.add("  <text class=\"note\" x=\"{:.2f}\" y=\"{:.2f}\">{}</text>\n", figure_.width / 2,
              header + layout_.height / 2, xml_text(figure_.empty_reason));
  }

  void add_outlines(std::span<const VisibilityMap::Polygon> polygons) {
    for (const VisibilityMap::Polygon& polygon : polygons) {
      char command = 'M';
      for (const Vec2& p : map_.outline(polygon)) {
        const Vec2 at = layout_.transform.to_pixels(p);
        text_.add("{}{:.7g} {:.7g}", command, at.x, at.y);
        command = 'L';
      }
      text_.add("Z");
    }
  }

  void add_pixel_marks() {
    for (const VisibilityMap::Polygon& polygon : map_.pixels.differences) {
      text_.add("    <path class=\"difference\" fill=\"{}\" fill-opacity=\"{}\" d=\"",
                hex(map_colors::difference), map_colors::difference_opacity);
      add_outlines({&polygon, 1});
      text_.add("\"><title>{} is visible here</title></path>\n",
                polygon.patch == no_patch ? std::string("nothing")
                                          : fmt::format("patch {}", polygon.patch));
    }
    const std::vector<Vec2>& ends = map_.pixels.borders;
    text_.add("  <path class=\"border\" stroke-width=\"{:.3g}\" stroke-opacity=\"0.6\" d=\"",
              line_width(map_, layout_.transform.scale));
    for (std::size_t k = 0; k + 1 < ends.size(); k += 2) {
      const Vec2 a = layout_.transform.to_pixels(ends[k]),
                 b = layout_.transform.to_pixels(ends[k + 1]);
      text_.add("M{:.7g} {:.7g}L{:.7g} {:.7g}", a.x, a.y, b.x, b.y);
    }
    text_.add("\"/>\n");
  }

  void add_labels() {
    for (const PlacedLabel& label :
         place_labels(options_.labels, layout_.transform, figure_.left, layout_.width)) {
      text_.add(
          "  <path class=\"pointer\" d=\"M{0:.2f} {1:.2f}L{2:.2f} {3:.2f}M{4:.2f} {1:.2f}a3 3 0 1 "
          "0 6 "
          "0a3 3 0 1 0 -6 0\"/>\n",
          label.point.x, label.point.y, label.base.x, label.base.y, label.point.x - 3);
      text_.add("  <text class=\"label{}\" x=\"{:.2f}\" y=\"{:.2f}\">{}</text>\n",
                label.ends_at ? " end" : "", label.base.x, label.base.y, xml_text(label.text));
    }
  }

  void add_window() {
    if (map_.window.empty()) {
      return;
    }
    text_.add("  <path class=\"receiver p{}\" fill=\"{}\" d=\"", map_.receiver,
              hex(map_colors::nothing));
    add_outlines(map_.window);
    text_.add("\"><title>patch {} sees nothing here</title></path>\n", map_.receiver);
  }

  /// Writes all polygons of one patch as one path.
  void add_patch(std::span<const VisibilityMap::Polygon> polygons) {
    const VisibilityMap::Polygon& any = polygons.front();
    double area = 0;
    for (const VisibilityMap::Polygon& polygon : polygons) {
      area += polygon.area;
    }
    text_.add("    <path class=\"{} p{} {}{}\" data-area=\"{}\" fill=\"{}\" d=\"",
              figure_.in_pixels ? "patch pixel" : "patch", any.patch,
              any.front_facing ? "front" : "back",
              role_of(scene_, any) == PatchRole::emits ? " emits" : "", area,
              hex(color_of(scene_, any, options_)));
    add_outlines(polygons);
    text_.add("\"><title>patch {} ({}): {}; area {:.4g} m\u00b2</title></path>\n", any.patch,
              xml_text(scene_.material(any.patch).name), description(any), area);
  }

  std::string description(const VisibilityMap::Polygon& polygon) const {
    const Rgb& exitance = scene_.exitance(polygon.patch);
    switch (role_of(scene_, polygon)) {
      case PatchRole::emits:
        return fmt::format("emits {:.4g}, {:.4g}, {:.4g} W/m\u00b2", exitance.r, exitance.g,
                           exitance.b);
      case PatchRole::reflects:
        return "reflects";
      case PatchRole::back_side:
        break;
    }
    return "back side, " + sources_text(polygon.patch);
  }

  /// Which patches a receiver sees, by falling area.
  std::string sources_text(PatchId patch) const {
    constexpr std::size_t max_listed = 6;
    const auto [first, last] =
        std::equal_range(map_.exchanges.begin(), map_.exchanges.end(), Transfer{patch, 0, 0},
                         [](const auto& a, const auto& b) { return a.receiver < b.receiver; });
    if (first == last) {
      return "sees no patch";
    }
    std::vector<Transfer> seen(first, last);
    std::stable_sort(seen.begin(), seen.end(),
                     [](const auto& a, const auto& b) { return a.area > b.area; });
    std::string text = seen.size() == 1 ? "sees patch " : "sees patches ";
    for (std::size_t k = 0; k < std::min(max_listed, seen.size()); ++k) {
      text += fmt::format("{}{}", k > 0 ? ", " : "", seen[k].source);
    }
    if (seen.size() > max_listed) {
      text += fmt::format(" and {} more", seen.size() - max_listed);
    }
    return text;
  }

  void add_scale_bar(const MapFigure::ScaleBar& bar) {
    text_.add("  <path class=\"rule\" d=\"M{0} {2}v8M{0} {3}H{1:.2f}M{1:.2f} {2}v8\"/>\n", bar.left,
              bar.right, bar.y - 4, bar.y);
    text_.add("  <text x=\"{:.2f}\" y=\"{}\">{:g} m</text>\n", bar.right + 10, bar.y + 4.5,
              bar.meters);
  }

  void add_axes() {
    const auto [x, y] = figure_.axes;
    text_.add(
        "  <path class=\"rule\" d=\"M{0} {1}h-22m5 -4l-5 4l5 4M{0} {1}v-22m-4 5l4 -5l4 5\"/>\n", x,
        y);
    text_.add("  <text class=\"end\" x=\"{}\" y=\"{}\">u</text>\n", x - 28, y + 4);
    text_.add("  <text x=\"{}\" y=\"{}\">v</text>\n", x + 7, y - 13);
  }

  void add_legend() {
    for (const MapFigure::LegendEntry& entry : figure_.legend) {
      text_.add(
          "  <rect class=\"swatch\" x=\"{}\" y=\"{}\" width=\"16\" height=\"12\" rx=\"2\" "
          "fill=\"{}\"/>\n",
          entry.left, figure_.legend_top, hex(entry.color));
      text_.add("  <text x=\"{}\" y=\"{}\">{}</text>\n", entry.left + 22, figure_.legend_top + 10.5,
                entry.label);
    }
  }

  TextBuffer text_;
  const Scene& scene_;
  const VisibilityMap& map_;
  const MapPictureOptions& options_;
  const MapFigure figure_;
  const MapLayout& layout_;
};

}  // namespace

void MapPictureOptions::validate() const {
  if (size < smallest_size || size > largest_size) {
    throw InputError(fmt::format("the size of the picture is {} pixels, but must be from {} to {}",
                                 size, smallest_size, largest_size));
  }
}

void write_map_svg(std::ostream& out, const Scene& scene, const VisibilityMap& map,
                   const MapPictureOptions& options) {
  options.validate();
  SvgFigure(out, scene, map, options).write();
}

}  // namespace transillum
