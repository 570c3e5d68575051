// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Texts, lines and markers of charts, by Cairo or by another device.
#include "io/drawing/chart_canvas.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "io/text.h"

namespace transillum {
namespace {

/// Lengths of dashes and gaps, in line widths.
std::vector<double> dashes_of(ChartDashes dashes) {
  switch (dashes) {
    case ChartDashes::solid:
      return {};
    case ChartDashes::dashes:
      return {4, 2.25};
    case ChartDashes::dots:
      return {1, 2};
    case ChartDashes::dash_dot:
      return {5.5, 2, 1, 2};
    case ChartDashes::dash_dot_dot:
      return {3, 1.5, 1, 1.5, 1, 1.5};
    case ChartDashes::fine_dots:
      return {1, 1};
  }
  return {};
}

/// Corners of a marker relative to its center; none of round ones.
/// @param s half its size
std::vector<ChartPoint> marker_corners(ChartMarker marker, double s) {
  const double w = s / 2.5;  // half the width of the bars of crosses
  switch (marker) {
    case ChartMarker::none:
    case ChartMarker::dot:
    case ChartMarker::circle:
      return {};
    case ChartMarker::pointer:
      return {{-0.7 * s, -s}, {0, 0}, {0.7 * s, -s}};
    case ChartMarker::square:
      return {{-s, -s}, {s, -s}, {s, s}, {-s, s}};
    case ChartMarker::triangle:
      return {{-1.2 * s, s}, {0, -1.2 * s}, {1.2 * s, s}};
    case ChartMarker::diamond:
      return {{-1.3 * s, 0}, {0, -1.3 * s}, {1.3 * s, 0}, {0, 1.3 * s}};
    case ChartMarker::down:
      return {{-1.2 * s, -s}, {0, 1.2 * s}, {1.2 * s, -s}};
    case ChartMarker::cross:
      return {{-s, -s + w}, {-s + w, -s}, {0, -w}, {s - w, -s}, {s, -s + w}, {w, 0},
              {s, s - w},   {s - w, s},   {0, w},  {-s + w, s}, {-s, s - w}, {-w, 0}};
    case ChartMarker::plus:
      return {{-w, -s}, {w, -s}, {w, -w}, {s, -w}, {s, w},   {w, w},
              {w, s},   {-w, s}, {-w, w}, {-s, w}, {-s, -w}, {-w, -w}};
  }
  return {};
}

}  // namespace

void ChartCanvas::set(const ChartColor& color) {
  cairo_set_source_rgb(cairo_, color.red / 255.0, color.green / 255.0, color.blue / 255.0);
}

std::pair<std::vector<ChartPoint>, bool> ChartCanvas::path() const {
  std::vector<ChartPoint> points;
  bool closed = false;
  cairo_path_t* path = cairo_copy_path_flat(cairo_);
  for (int k = 0; k < path->num_data; k += path->data[k].header.length) {
    const cairo_path_data_t* data = path->data + k;
    if (data->header.type == CAIRO_PATH_CLOSE_PATH) {
      closed = true;
    } else if (!closed) {  // after it stands a move to the begin
      points.push_back({data[1].point.x, data[1].point.y});
    }
  }
  cairo_path_destroy(path);
  return {std::move(points), closed};
}

void ChartCanvas::fill_path(const ChartColor& color) {
  if (device_) {
    device_->fill(path().first, color);
    return;
  }
  set(color);
  cairo_fill_preserve(cairo_);
}

void ChartCanvas::stroke_path(const ChartColor& color, double width,
                              const std::vector<double>& dashes) {
  if (device_) {
    const auto [points, closed] = path();
    device_->stroke(points, closed, color, width, dashes);
    return;
  }
  set(color);
  cairo_set_dash(cairo_, dashes.data(), static_cast<int>(dashes.size()), 0);
  cairo_set_line_width(cairo_, width);
  cairo_stroke(cairo_);
}

void ChartCanvas::select(const ChartText& look) {
  cairo_select_font_face(cairo_, font_.c_str(), CAIRO_FONT_SLANT_NORMAL,
                         look.bold ? CAIRO_FONT_WEIGHT_BOLD : CAIRO_FONT_WEIGHT_NORMAL);
  cairo_set_font_size(cairo_, look.size);
}

double ChartCanvas::width_of(const std::string& text, const ChartText& look) {
  select(look);
  cairo_text_extents_t extents;
  cairo_text_extents(cairo_, text.c_str(), &extents);
  return extents.x_advance;
}

std::string ChartCanvas::elided(const std::string& text, double room, const ChartText& look) {
  if (width_of(text, look) <= room) {
    return text;
  }
  std::size_t fits = 0, end = text.size();  // bytes
  while (fits < end) {
    const std::size_t middle = (fits + end + 1) / 2;
    if (width_of(clean_text(text.substr(0, middle)) + "…", look) <= room) {
      fits = middle;
    } else {
      end = middle - 1;
    }
  }
  while (fits > 0 && (static_cast<unsigned char>(text[fits]) & 0xC0) == 0x80) {
    --fits;
  }
  return fits == 0 ? std::string() : text.substr(0, fits) + "…";
}

void ChartCanvas::draw(const std::string& text, const ChartPoint& at, double align,
                       const ChartText& look, bool upward) {
  if (device_) {
    device_->text(text, at, align, look, upward);
    return;
  }
  const double begin = -align * width_of(text, look);
  cairo_font_extents_t font;
  cairo_font_extents(cairo_, &font);
  set(look.color);
  cairo_save(cairo_);
  cairo_translate(cairo_, at.x, at.y);
  cairo_rotate(cairo_, upward ? -std::numbers::pi / 2 : 0);
  cairo_move_to(cairo_, begin, (font.ascent - font.descent) / 2);
  cairo_show_text(cairo_, text.c_str());
  cairo_restore(cairo_);
}

void ChartCanvas::fill(const ChartArea& area, const ChartColor& color) {
  cairo_new_path(cairo_);
  cairo_rectangle(cairo_, area.left, area.top, area.right - area.left, area.bottom - area.top);
  fill_path(color);
  cairo_new_path(cairo_);
}

/// The nearest point where the edges of a vertical or horizontal line are edges of pixels.
ChartPoint ChartCanvas::on_pixels(const ChartPoint& point, double width, bool is_vertical) {
  double none = 0, x = point.x, y = point.y;
  cairo_user_to_device_distance(cairo_, &width, &none);
  const double middle = std::max(1L, std::lround(width)) % 2 == 1 ? 0.5 : 0;
  cairo_user_to_device(cairo_, &x, &y);
  double& across = is_vertical ? x : y;
  across = std::round(across - middle) + middle;
  cairo_device_to_user(cairo_, &x, &y);
  return {x, y};
}

void ChartCanvas::draw(std::span<const ChartPoint> points, const ChartPen& pen) {
  const bool is_vertical = points.size() == 2 && points[0].x == points[1].x;
  const bool is_horizontal = points.size() == 2 && points[0].y == points[1].y;
  const bool has_pixels =
      !device_ && cairo_surface_get_type(cairo_get_target(cairo_)) == CAIRO_SURFACE_TYPE_IMAGE;
  cairo_new_path(cairo_);
  for (const ChartPoint& point : points) {
    const ChartPoint at = has_pixels && (is_vertical || is_horizontal)
                              ? on_pixels(point, pen.width, is_vertical)
                              : point;
    cairo_line_to(cairo_, at.x, at.y);
  }
  std::vector<double> dashes = dashes_of(pen.dashes);
  for (double& length : dashes) {
    length *= pen.width;
  }
  // Round joins of a dense line take most of the drawing time and are not visible.
  cairo_set_line_join(cairo_, points.size() > 100 ? CAIRO_LINE_JOIN_BEVEL : CAIRO_LINE_JOIN_ROUND);
  stroke_path(pen.color, pen.width, dashes);
}

void ChartCanvas::draw_marker(const ChartPoint& center, const ChartSeries& series,
                              const ChartColor& paper) {
  if (series.marker == ChartMarker::none) {
    return;
  }
  const double half = std::max(5.5, 1.6 * series.width), edge = 0.36 * half;
  cairo_new_path(cairo_);
  const ChartColor& inside = series.hollow ? paper : series.color;
  if (series.marker == ChartMarker::dot || series.marker == ChartMarker::circle) {
    const double radius = series.marker == ChartMarker::dot ? half / 2.5 : half;
    // A disk includes its edge: one step instead of two, for lines of many dots.
    cairo_arc(cairo_, center.x, center.y, radius + (series.hollow ? 0 : edge / 2), 0,
              2 * std::numbers::pi);
    if (!series.hollow) {
      fill_path(inside);
      cairo_new_path(cairo_);
      return;
    }
    if (device_) {
      cairo_close_path(cairo_);
    }
  } else {
    for (const ChartPoint& corner : marker_corners(series.marker, half)) {
      cairo_line_to(cairo_, center.x + corner.x, center.y + corner.y);
    }
    cairo_close_path(cairo_);
  }
  fill_path(inside);
  cairo_set_line_join(cairo_, CAIRO_LINE_JOIN_ROUND);
  stroke_path(series.color, edge, {});
}

void ChartCanvas::clip_nothing() {
  if (device_) {
    device_->clip_nothing();
    return;
  }
  cairo_reset_clip(cairo_);
}

void ChartCanvas::clip(const ChartArea& area) {
  if (device_) {
    device_->clip(area);
    return;
  }
  cairo_rectangle(cairo_, area.left, area.top, area.right - area.left, area.bottom - area.top);
  cairo_clip(cairo_);
}

}  // namespace transillum
