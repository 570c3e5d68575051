// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// The drawing primitives that VTK's charts call, on Cairo. Colors, widths and fonts come from the
// pen, brush and text properties of vtkContextDevice2D.
#include "io/vtk/cairo_context_device.h"

#include <vtkBrush.h>
#include <vtkMatrix3x3.h>
#include <vtkObjectFactory.h>
#include <vtkPen.h>
#include <vtkTextProperty.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace transillum {
namespace {

/// Lengths of dashes and gaps, in line widths.
std::vector<double> dashes_of(int line_type) {
  switch (line_type) {
    case vtkPen::DASH_LINE:
      return {4, 2.25};
    case vtkPen::DOT_LINE:
      return {1, 2};
    case vtkPen::DASH_DOT_LINE:
      return {5.5, 2, 1, 2};
    case vtkPen::DASH_DOT_DOT_LINE:
      return {3, 1.5, 1, 1.5, 1, 1.5};
    case vtkPen::DENSE_DOT_LINE:
      return {1, 1};
    default:
      return {};
  }
}

/// Corners of a polygonal marker, relative to its center.
/// @param s half its size, @param w half the width of the bars of crosses
std::vector<std::pair<double, double>> marker_corners(int shape, double s, double w) {
  switch (shape) {
    case marker_pointer:
      return {{-0.7 * s, -s}, {0, 0}, {0.7 * s, -s}};
    case VTK_MARKER_SQUARE:
      return {{-s, -s}, {s, -s}, {s, s}, {-s, s}};
    case marker_triangle:
      return {{-1.2 * s, s}, {0, -1.2 * s}, {1.2 * s, s}};
    case marker_down:
      return {{-1.2 * s, -s}, {0, 1.2 * s}, {1.2 * s, -s}};
    case VTK_MARKER_DIAMOND:
      return {{-1.3 * s, 0}, {0, -1.3 * s}, {1.3 * s, 0}, {0, 1.3 * s}};
    case VTK_MARKER_CROSS:
      return {{-s, -s + w}, {-s + w, -s}, {0, -w}, {s - w, -s}, {s, -s + w}, {w, 0},
              {s, s - w},   {s - w, s},   {0, w},  {-s + w, s}, {-s, s - w}, {-w, 0}};
    case VTK_MARKER_PLUS:
      return {{-w, -s}, {w, -s}, {w, -w}, {s, -w}, {s, w},   {w, w},
              {w, s},   {-w, s}, {-w, w}, {-s, w}, {-s, -w}, {-w, -w}};
    default:
      return {};
  }
}

}  // namespace

vtkStandardNewMacro(CairoContextDevice);

CairoContextDevice::CairoContextDevice() : matrices_(1) {
  cairo_matrix_init_identity(&matrices_.back());
}

void CairoContextDevice::draw_on(cairo_t* cairo, double height) {
  cairo_ = cairo;
  height_ = height;
}

CairoContextDevice::Place CairoContextDevice::place(const float* point) const {
  double x = point[0], y = point[1];
  cairo_matrix_transform_point(&matrices_.back(), &x, &y);
  return {x, height_ - y};
}

void CairoContextDevice::set(const unsigned char* color) const {
  cairo_set_source_rgba(cairo_, color[0] / 255.0, color[1] / 255.0, color[2] / 255.0,
                        color[3] / 255.0);
}

void CairoContextDevice::stroke() const {
  const double width = Pen->GetWidth();
  std::vector<double> dashes = dashes_of(Pen->GetLineType());
  for (double& length : dashes) {
    length *= width;
  }
  cairo_set_dash(cairo_, dashes.data(), static_cast<int>(dashes.size()), 0);
  cairo_set_line_width(cairo_, width);
  set(Pen->GetColor());
  cairo_stroke(cairo_);
  cairo_set_dash(cairo_, nullptr, 0, 0);
}

void CairoContextDevice::DrawPoly(float* points, int n, unsigned char*, int) {
  if (n < 2 || Pen->GetLineType() == vtkPen::NO_PEN) {
    return;
  }
  cairo_new_path(cairo_);
  Place begin = place(points), end = place(points + 2 * (n - 1));
  if (n == 2 && (begin.x == end.x || begin.y == end.y)) {
    // Align horizontal and vertical lines with whole pixels, so that they are sharp.
    double width = Pen->GetWidth(), none = 0;
    cairo_user_to_device_distance(cairo_, &width, &none);
    const double middle = std::max(1L, std::lround(width)) % 2 == 1 ? 0.5 : 0;
    const auto snap = [&](Place& p) {
      cairo_user_to_device(cairo_, &p.x, &p.y);
      p = {std::round(p.x - middle) + middle, std::round(p.y - middle) + middle};
      cairo_device_to_user(cairo_, &p.x, &p.y);
    };
    snap(begin);
    snap(end);
  }
  cairo_move_to(cairo_, begin.x, begin.y);
  for (int k = 1; k + 1 < n; ++k) {
    const Place p = place(points + 2 * k);
    cairo_line_to(cairo_, p.x, p.y);
  }
  cairo_line_to(cairo_, end.x, end.y);
  // Round joins of a dense line take most of the drawing time and are not visible.
  cairo_set_line_join(cairo_, n > 100 ? CAIRO_LINE_JOIN_BEVEL : CAIRO_LINE_JOIN_ROUND);
  stroke();
}

void CairoContextDevice::DrawLines(float* points, int n, unsigned char* colors, int components) {
  for (int k = 0; k + 1 < n; k += 2) {
    DrawPoly(points + 2 * k, 2, colors, components);
  }
}

void CairoContextDevice::DrawPoints(float* points, int n, unsigned char* colors, int components) {
  DrawMarkers(VTK_MARKER_CIRCLE, false, points, n, colors, components);
}

void CairoContextDevice::DrawMarkers(int shape, bool, float* points, int n, unsigned char*, int) {
  const double half = 0.69 * Pen->GetWidth();  // 11 pixels wide for VTK's smallest width, 8 pixels
  cairo_set_line_width(cairo_, 0.36 * half);
  cairo_set_line_join(cairo_, CAIRO_LINE_JOIN_ROUND);
  cairo_reset_clip(cairo_);
  for (int k = 0; k < n; ++k) {
    const Place center = place(points + 2 * k);
    if (clips_ && !is_inside(center)) {
      continue;
    }
    trace_marker(shape, center, half);
    set(Brush->GetColor());
    cairo_fill_preserve(cairo_);
    set(Pen->GetColor());
    cairo_stroke(cairo_);
  }
  if (clips_) {
    clip();
  }
}

void CairoContextDevice::DrawColoredPolygon(float* points, int n, unsigned char*, int) {
  if (Brush->GetOpacity() == 0) {
    return;
  }
  cairo_new_path(cairo_);
  for (int k = 0; k < n; ++k) {
    const Place p = place(points + 2 * k);
    cairo_line_to(cairo_, p.x, p.y);
  }
  set(Brush->GetColor());
  cairo_fill(cairo_);
}

void CairoContextDevice::trace_marker(int shape, const Place& center, double half) const {
  cairo_new_path(cairo_);
  if (shape == marker_dot || shape == VTK_MARKER_CIRCLE) {
    cairo_arc(cairo_, center.x, center.y, shape == marker_dot ? half / 2.5 : half, 0,
              2 * std::numbers::pi);
    return;
  }
  const auto corners = marker_corners(shape, half, half / 2.5);
  for (const auto& [dx, dy] : corners) {
    cairo_line_to(cairo_, center.x + dx, center.y + dy);
  }
  if (!corners.empty()) {
    cairo_close_path(cairo_);
  }
}

void CairoContextDevice::select_font() const {
  cairo_select_font_face(cairo_, TextProp->GetFontFamilyAsString(), CAIRO_FONT_SLANT_NORMAL,
                         TextProp->GetBold() ? CAIRO_FONT_WEIGHT_BOLD : CAIRO_FONT_WEIGHT_NORMAL);
  cairo_set_font_size(cairo_, TextProp->GetFontSize());
}

void CairoContextDevice::DrawString(float* point, const Text& text) {
  select_font();
  cairo_font_extents_t font;
  cairo_font_extents(cairo_, &font);
  cairo_text_extents_t extents;
  cairo_text_extents(cairo_, text.c_str(), &extents);
  double down = -font.descent;  // of the baseline below the point
  if (TextProp->GetVerticalJustification() == VTK_TEXT_CENTERED) {
    down = (font.ascent - font.descent) / 2;
  }
  if (TextProp->GetVerticalJustification() == VTK_TEXT_TOP) {
    down = font.ascent;
  }
  const double align = TextProp->GetJustification() == VTK_TEXT_LEFT       ? 0
                       : TextProp->GetJustification() == VTK_TEXT_CENTERED ? 0.5
                                                                           : 1;
  const Place p = place(point);
  const double* color = TextProp->GetColor();
  cairo_set_source_rgb(cairo_, color[0], color[1], color[2]);
  cairo_save(cairo_);
  cairo_translate(cairo_, p.x, p.y);
  cairo_rotate(cairo_, -TextProp->GetOrientation() * std::numbers::pi / 180);
  cairo_move_to(cairo_, -align * extents.x_advance, down);
  cairo_show_text(cairo_, text.c_str());
  cairo_restore(cairo_);
}

void CairoContextDevice::ComputeStringBounds(const Text& text, float bounds[4]) {
  select_font();
  cairo_font_extents_t font;
  cairo_font_extents(cairo_, &font);
  cairo_text_extents_t extents;
  cairo_text_extents(cairo_, text.c_str(), &extents);
  bounds[0] = bounds[1] = 0;
  bounds[2] = static_cast<float>(extents.x_advance);
  bounds[3] = static_cast<float>(font.ascent + font.descent);
}

void CairoContextDevice::ComputeJustifiedStringBounds(const char* text, float bounds[4]) {
  ComputeStringBounds(text, bounds);
  const double turn = std::fmod(std::abs(TextProp->GetOrientation()), 180);
  if (turn > 45 && turn < 135) {
    std::swap(bounds[2], bounds[3]);
  }
}

void CairoContextDevice::SetMatrix(vtkMatrix3x3* matrix) {
  cairo_matrix_init(&matrices_.back(), matrix->GetElement(0, 0), matrix->GetElement(1, 0),
                    matrix->GetElement(0, 1), matrix->GetElement(1, 1), matrix->GetElement(0, 2),
                    matrix->GetElement(1, 2));
}

void CairoContextDevice::GetMatrix(vtkMatrix3x3* matrix) {
  const cairo_matrix_t& m = matrices_.back();
  const double elements[9] = {m.xx, m.xy, m.x0, m.yx, m.yy, m.y0, 0, 0, 1};
  matrix->DeepCopy(elements);
}

void CairoContextDevice::MultiplyMatrix(vtkMatrix3x3* matrix) {
  const cairo_matrix_t before = matrices_.back();
  SetMatrix(matrix);
  cairo_matrix_multiply(&matrices_.back(), &matrices_.back(), &before);
}

void CairoContextDevice::EnableClipping(bool enable) {
  clips_ = enable;
  cairo_reset_clip(cairo_);
  if (clips_) {
    clip();
  }
}

void CairoContextDevice::clip() const {
  cairo_new_path(cairo_);
  cairo_rectangle(cairo_, clip_[0] - 1, height_ - clip_[1] - clip_[3] - 1, clip_[2] + 2,
                  clip_[3] + 2);
  cairo_clip(cairo_);
}

bool CairoContextDevice::is_inside(const Place& p) const {
  const double x = p.x - clip_[0], y = height_ - p.y - clip_[1];
  return x > -1 && x < clip_[2] + 1 && y > -1 && y < clip_[3] + 1;
}

}  // namespace transillum
