// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Maps as PDF: the figure of the SVG file, drawn by Cairo. Polygons are vectors, text is text.
#include <fmt/format.h>

#include <algorithm>
#include <numbers>
#include <ostream>
#include <span>
#include <string>

#include "io/drawing/cairo_surface.h"
#include "io/drawing/chart_canvas.h"
#include "io/drawing/map_label.h"
#include "io/maps/map_figure.h"
#include "io/maps/map_writers.h"

namespace transillum {
namespace {

constexpr ChartColor text_ink{0x5a, 0x64, 0x72};
constexpr ChartColor note_ink{0xa4, 0xad, 0xb8}, paper{255, 255, 255};
constexpr double edge_opacity = 0.6;

/// Draws a map's figure on a page.
class MapPage {
 public:
  MapPage(cairo_t* cairo, const Scene& scene, const VisibilityMap& map,
          const MapPictureOptions& options, const MapFigure& figure)
      : cairo_(cairo),
        canvas_(cairo, label_font),
        scene_(scene),
        map_(map),
        options_(options),
        figure_(figure) {}

  void draw() {
    if (!options_.transparent) {
      canvas_.fill({0, 0, figure_.width, figure_.height}, paper);
    }
    const double left = MapFigure::padding;
    text(figure_.short_title, left, MapFigure::title_base,
         {MapFigure::title_size, map_title_ink, true});
    text(figure_.direction, left, MapFigure::direction_base);
    text(figure_.content, left, MapFigure::content_base);
    cairo_save(cairo_);
    draw_map();
    cairo_restore(cairo_);
    cairo_set_line_cap(cairo_, CAIRO_LINE_CAP_SQUARE);
    if (figure_.scale_bar) {
      draw_scale_bar(*figure_.scale_bar);
    }
    draw_axes();
    draw_legend();
  }

 private:
  using Polygons = std::span<const VisibilityMap::Polygon>;

  /// @param base  of the text's base line; the middle of the letters is above it
  void text(const std::string& line, double left, double base,
            const ChartText& look = {MapFigure::text_size, text_ink}, double align = 0) {
    constexpr double middle = 0.35;  // fraction of the height of the font
    canvas_.draw(line, {left, base - middle * look.size}, align, look);
  }
  void set(const Color8& color, double opacity = 1) {
    cairo_set_source_rgba(cairo_, color.r / 255.0, color.g / 255.0, color.b / 255.0, opacity);
  }
  void add_path(Polygons polygons) {
    for (const VisibilityMap::Polygon& polygon : polygons) {
      cairo_new_sub_path(cairo_);
      for (const Vec2& p : map_.outline(polygon)) {
        const Vec2 at = figure_.layout.transform.to_pixels(p);
        cairo_line_to(cairo_, at.x, at.y);
      }
      cairo_close_path(cairo_);
    }
  }
  void fill(Polygons polygons, const Color8& color, double opacity = 1) {
    cairo_new_path(cairo_);
    add_path(polygons);
    set(color, opacity);
    cairo_fill(cairo_);
  }
  void add_box(double left, double top, double width, double height, double radius) {
    const double quarter = std::numbers::pi / 2;
    const double right = left + width - radius, bottom = top + height - radius;
    cairo_new_path(cairo_);
    cairo_arc(cairo_, right, top + radius, radius, -quarter, 0);
    cairo_arc(cairo_, right, bottom, radius, 0, quarter);
    cairo_arc(cairo_, left + radius, bottom, radius, quarter, 2 * quarter);
    cairo_arc(cairo_, left + radius, top + radius, radius, 2 * quarter, 3 * quarter);
    cairo_close_path(cairo_);
  }

  void draw_map() {
    const MapLayout& layout = figure_.layout;
    if (!options_.transparent) {
      add_box(figure_.left, MapFigure::header, layout.width, layout.height, 4);
      set(map_colors::ground);
      cairo_fill(cairo_);
    }
    fill(map_.window, map_colors::nothing);
    draw_patches();
    for (const VisibilityMap::Polygon& polygon : map_.pixels.differences) {
      fill({&polygon, 1}, map_colors::difference, map_colors::difference_opacity);
    }
    draw_borders();
    for (const PlacedLabel& label :
         place_labels(options_.labels, layout.transform, figure_.left, layout.width)) {
      draw_map_label(cairo_, label);
    }
    if (!figure_.empty_reason.empty()) {
      text(figure_.empty_reason, figure_.width / 2, MapFigure::header + layout.height / 2,
           {MapFigure::note_size, note_ink}, 0.5);
    }
  }

  /// Draws all polygons of one patch as one path, with their edges in a map that is not in pixels.
  void draw_patches() {
    cairo_set_line_join(cairo_, CAIRO_LINE_JOIN_ROUND);
    cairo_set_line_width(cairo_, line_width(map_, figure_.layout.transform.scale));
    auto first = map_.polygons.begin();
    while (first != map_.polygons.end()) {
      const auto last = std::find_if(first, map_.polygons.end(), [&](const auto& polygon) {
        return polygon.patch != first->patch || polygon.front_facing != first->front_facing;
      });
      const Polygons polygons(&*first, static_cast<std::size_t>(last - first));
      fill(polygons, color_of(scene_, *first, options_));
      if (!figure_.in_pixels) {
        add_path(polygons);
        set(map_colors::edge, edge_opacity);
        cairo_stroke(cairo_);
      }
      first = last;
    }
  }

  void draw_borders() {
    const std::vector<Vec2>& ends = map_.pixels.borders;
    cairo_set_line_cap(cairo_, CAIRO_LINE_CAP_SQUARE);
    for (std::size_t k = 0; k + 1 < ends.size(); k += 2) {
      const Vec2 a = figure_.layout.transform.to_pixels(ends[k]),
                 b = figure_.layout.transform.to_pixels(ends[k + 1]);
      cairo_move_to(cairo_, a.x, a.y);
      cairo_line_to(cairo_, b.x, b.y);
    }
    set(map_colors::edge, edge_opacity);
    cairo_stroke(cairo_);
  }

  void draw_line(std::initializer_list<ChartPoint> points) {
    canvas_.draw(points, {map_title_ink, 1.5});
  }
  void draw_scale_bar(const MapFigure::ScaleBar& bar) {
    draw_line({{bar.left, bar.y - 4}, {bar.left, bar.y + 4}});
    draw_line({{bar.left, bar.y}, {bar.right, bar.y}});
    draw_line({{bar.right, bar.y - 4}, {bar.right, bar.y + 4}});
    text(fmt::format("{:g} m", bar.meters), bar.right + 10, bar.y + 4.5);
  }
  void draw_axes() {
    const auto [x, y] = figure_.axes;
    draw_line({{x, y}, {x - 22, y}});
    draw_line({{x - 17, y - 4}, {x - 22, y}, {x - 17, y + 4}});
    draw_line({{x, y}, {x, y - 22}});
    draw_line({{x - 4, y - 17}, {x, y - 22}, {x + 4, y - 17}});
    const ChartText look{MapFigure::text_size, text_ink};
    text("u", x - 28, y + 4, look, 1);
    text("v", x + 7, y - 13, look);
  }
  void draw_legend() {
    cairo_set_line_width(cairo_, 0.5);
    for (const MapFigure::LegendEntry& entry : figure_.legend) {
      add_box(entry.left, figure_.legend_top, 16, 12, 2);
      set(entry.color);
      cairo_fill_preserve(cairo_);
      set(map_colors::edge);
      cairo_stroke(cairo_);
      text(entry.label, entry.left + 22, figure_.legend_top + 10.5);
    }
  }

  cairo_t* cairo_;
  ChartCanvas canvas_;
  const Scene& scene_;
  const VisibilityMap& map_;
  const MapPictureOptions& options_;
  const MapFigure& figure_;
};

}  // namespace

void write_map_pdf(std::ostream& out, const Scene& scene, const VisibilityMap& map,
                   const MapPictureOptions& options) {
  const MapFigure figure(scene, map, options);
  write_pdf(out, figure.width, figure.height, figure.title,
            [&](cairo_t* cairo) { MapPage(cairo, scene, map, options, figure).draw(); });
}

}  // namespace transillum
