// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Maps as SVG figures: title, one path per patch with a tool tip, scale bar, axes and legend. The
// classes and attributes of the paths are described in data/FILES.md.
#include <algorithm>
#include <cmath>
#include <string>

#include "io/maps/map_drawing.h"
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

/// A name of at most `max_size` bytes: the end of a longer one, after an ellipsis. The end is the
/// distinctive part of a path.
std::string shortened(const std::string& text, std::size_t max_size) {
  std::string clean = clean_text(text);
  if (clean.size() <= max_size) {
    return clean;
  }
  std::size_t begin = clean.size() - max_size;
  while (begin < clean.size() && (clean[begin] & 0xc0) == 0x80) {
    ++begin;  // inside a character
  }
  return "\u2026" + clean.substr(begin);
}

class SvgFigure {
 public:
  SvgFigure(std::ostream& out, const Scene& scene, const VisibilityMap& map,
            const MapPictureOptions& options)
      : text_(out), scene_(scene), map_(map), options_(options) {
    layout_ = fit_map(map, options.size - 2 * padding, options.size - header - footer);
    width_ = std::max(layout_.width + 2 * padding, in_pixels() ? least_width + 130 : least_width);
    height_ = layout_.height + header + footer;
    left_ = (width_ - layout_.width) / 2;
    layout_.transform.middle.x += left_;
    layout_.transform.middle.y += header;
  }

  void write() {
    begin();
    add_header();
    add_map();
    if (!map_.corners.empty()) {
      add_scale_bar();
    }
    add_axes();
    add_legend();
    text_.add("</svg>\n");
  }

 private:
  static constexpr double padding = 24, header = 104, footer = 92, least_width = 470;
  /// Upper bound of the mean width of the title's bold letters, pixels.
  static constexpr double title_letter = 13;

  std::string heading(const std::string& scene_name) const {
    return map_.receiver == no_patch
               ? fmt::format("Visibility map of {}", scene_name)
               : fmt::format("Visible from patch {} of {}", map_.receiver, scene_name);
  }

  void begin() {
    text_.add("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n");
    text_.add(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" role=\"img\" width=\"{0:.0f}\" "
        "height=\"{1:.0f}\" viewBox=\"0 0 {0:.0f} {1:.0f}\">\n",
        width_, height_);
    text_.add("  <title>{}</title>\n", xml_text(heading(scene_.name())));
    const Vec3& omega = map_.frame.omega;
    text_.add("  <desc>transillum " TRANSILLUM_VERSION
              "; direction omega = {}, {}, {}; view along omega; {} pixels per meter</desc>\n",
              omega.x, omega.y, omega.z, layout_.transform.scale);
    text_.add("{}", style);
    text_.add("  <rect class=\"page\" width=\"100%\" height=\"100%\"/>\n");
  }

  void add_header() {
    const auto room = static_cast<std::size_t>((width_ - 2 * padding) / title_letter);
    const std::size_t fixed = heading({}).size();
    const std::string name = shortened(scene_.name(), room > fixed + 8 ? room - fixed : 8);
    text_.add("  <text class=\"title\" x=\"{}\" y=\"42\">{}</text>\n", padding,
              xml_text(heading(name)));
    const Vec3& omega = map_.frame.omega;
    text_.add(
        "  <text x=\"{}\" y=\"66\">View along \u03c9 = ({:.4g}, {:.4g}, {:.4g}), toward the "
        "light</text>\n",
        padding, omega.x, omega.y, omega.z);
    double area = 0;
    int patches = 0;
    PatchId last = no_patch;
    for (const VisibilityMap::Polygon& polygon : map_.polygons) {
      area += polygon.area;
      patches += polygon.patch != last ? 1 : 0;
      last = polygon.patch;
    }
    const std::string parts = in_pixels() ? fmt::format("pixels of {:.3g} m", map_.pixels.side)
                                          : fmt::format("{} polygons", map_.polygons.size());
    text_.add("  <text x=\"{}\" y=\"86\">{} of {} patches, {}, total area {:.4g} m\u00b2</text>\n",
              padding, patches, scene_.patch_count(), parts, area);
  }

  void add_map() {
    text_.add(
        "  <rect class=\"ground\" x=\"{:.2f}\" y=\"{:.2f}\" width=\"{:.2f}\" height=\"{:.2f}\" "
        "rx=\"4\" fill=\"{}\"/>\n",
        left_, header, layout_.width, layout_.height, hex(map_colors::ground));
    add_window();
    // crispEdges: no background shows between adjacent rectangles.
    text_.add("  <g class=\"map\" stroke-width=\"{:.3g}\" stroke-opacity=\"0.6\"{}>\n",
              line_width(map_, layout_.transform.scale),
              in_pixels() ? " shape-rendering=\"crispEdges\"" : "");
    auto first = map_.polygons.begin();
    while (first != map_.polygons.end()) {
      const auto last = std::find_if(first, map_.polygons.end(), [&](const auto& polygon) {
        return polygon.patch != first->patch || polygon.front_facing != first->front_facing;
      });
      add_patch({&*first, static_cast<std::size_t>(last - first)});
      first = last;
    }
    text_.add("  </g>\n");
    if (in_pixels()) {
      add_pixel_marks();
    }
    add_labels();
    const std::string reason = empty_map_reason(scene_, map_);
    if (reason.empty()) {
      return;
    }
    text_.add("  <text class=\"note\" x=\"{:.2f}\" y=\"{:.2f}\">{}</text>\n", width_ / 2,
              header + layout_.height / 2, xml_text(reason));
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

  bool in_pixels() const { return map_.pixels.side > 0; }

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
         place_labels(options_.labels, layout_.transform, left_, layout_.width)) {
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
              in_pixels() ? "patch pixel" : "patch", any.patch, any.front_facing ? "front" : "back",
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

  void add_scale_bar() {
    // The largest 1, 2 or 5 times a power of ten that is at most a quarter of the width.
    const double max_length = width_ / 4 / layout_.transform.scale;
    const double power = std::pow(10.0, std::floor(std::log10(max_length)));
    const double lead = max_length / power;
    const double meters = power * (lead >= 5 ? 5 : lead >= 2 ? 2 : 1);
    const double length = meters * layout_.transform.scale;
    const double y = height_ - 62;
    text_.add("  <path class=\"rule\" d=\"M{0} {2}v8M{0} {3}H{1:.2f}M{1:.2f} {2}v8\"/>\n", padding,
              padding + length, y - 4, y);
    text_.add("  <text x=\"{:.2f}\" y=\"{}\">{:g} m</text>\n", padding + length + 10, y + 4.5,
              meters);
  }

  void add_axes() {
    const double x = width_ - padding - 18, y = height_ - 56;
    text_.add(
        "  <path class=\"rule\" d=\"M{0} {1}h-22m5 -4l-5 4l5 4M{0} {1}v-22m-4 5l4 -5l4 5\"/>\n", x,
        y);
    text_.add("  <text class=\"end\" x=\"{}\" y=\"{}\">u</text>\n", x - 28, y + 4);
    text_.add("  <text x=\"{}\" y=\"{}\">v</text>\n", x + 7, y - 13);
  }

  /// Whether nothing is above a part of the receiver.
  bool leaves_a_gap() const {
    const double area = total_area(map_.window);
    double open = area;
    for (const VisibilityMap::Polygon& polygon : map_.polygons) {
      open -= polygon.area;
    }
    return open > 1e-6 * area;
  }

  void add_legend() {
    double x = padding;
    const auto entry = [&](const Color8& color, const char* label, double width) {
      text_.add(
          "  <rect class=\"swatch\" x=\"{}\" y=\"{}\" width=\"16\" height=\"12\" rx=\"2\" "
          "fill=\"{}\"/>\n",
          x, height_ - 32, hex(color));
      text_.add("  <text x=\"{}\" y=\"{}\">{}</text>\n", x + 22, height_ - 21.5, label);
      x += width;
    };
    const auto add = [&](PatchRole role, const char* label, double width) {
      const auto found =
          std::find_if(map_.polygons.begin(), map_.polygons.end(), [&](const auto& polygon) {
            // Ignore polygons too small to be visible, such as rounding residues.
            const double pixels = polygon.area * std::pow(layout_.transform.scale, 2);
            return pixels > 0.1 && role_of(scene_, polygon) == role;
          });
      if (found != map_.polygons.end()) {
        entry(color_of(scene_, *found, options_), label, width);
      }
    };
    // The meaning of the caller's colors is not known here.
    if (options_.patch_colors.empty()) {
      add(PatchRole::emits, "emits", 84);
      add(PatchRole::reflects, "reflects", 102);
    }
    add(PatchRole::back_side, "back side", 112);
    if (leaves_a_gap()) {
      entry(map_colors::nothing, "nothing above", 132);
    }
    if (!map_.pixels.differences.empty()) {
      entry(map_colors::difference,
            fmt::format("differs ({:.2g} %)", 100 * difference_fraction(map_)).c_str(), 0);
    }
  }

  TextBuffer text_;
  const Scene& scene_;
  const VisibilityMap& map_;
  const MapPictureOptions& options_;
  MapLayout layout_;
  double width_ = 0, height_ = 0, left_ = 0;
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
