// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// A VTK 2-D context device that draws on Cairo; chart_painter.cpp passes it to VTK's chart.
#pragma once

#include <cairo.h>
#include <vtkContextDevice2D.h>
#include <vtkRenderingCoreEnums.h>
#include <vtkStdString.h>

#include <algorithm>
#include <vector>

class vtkUnicodeString;

namespace transillum {

/// Markers of this device beyond VTK's own.
enum CairoMarker {
  marker_dot = VTK_MARKER_UNKNOWN + 1,
  marker_pointer,
  marker_triangle,
  marker_down
};

/// Draws VTK's charts on any Cairo surface, without a window or OpenGL. Primitives that line charts
/// do not use, such as images and wedges, are not drawn. y runs upward from the bottom, as in VTK.
class CairoContextDevice : public vtkContextDevice2D {
  /// VTK's string class, which is std::string from some version on.
  template <class Text>
  static Text text_of(void (vtkContextDevice2D::*)(float*, const Text&));
  using Text = decltype(text_of(&vtkContextDevice2D::DrawMathTextString));

 public:
  static CairoContextDevice* New();
  // clang-format off
  vtkTypeMacro(CairoContextDevice, vtkContextDevice2D)
      // clang-format on

      /// Sets the context to draw with, which must outlive this object, and the height of the part
      /// of the surface to draw on.
      void draw_on(cairo_t* cairo, double height);

  void DrawPoly(float* points, int n, unsigned char* colors, int components) override;
  void DrawLines(float* points, int n, unsigned char* colors, int components) override;
  void DrawPoints(float* points, int n, unsigned char* colors, int components) override;
  /// Draws the markers whose centers are inside the clipping rectangle, unclipped.
  void DrawMarkers(int shape, bool highlight, float* points, int n, unsigned char* colors,
                   int components) override;
  void DrawQuad(float* points, int n) override { DrawColoredPolygon(points, n, nullptr, 0); }
  void DrawColoredPolygon(float* points, int n, unsigned char* colors, int components) override;
  void DrawString(float* point, const Text& text) override;
  /// Bounds of a line of text, relative to its lower left corner.
  void ComputeStringBounds(const Text& text, float bounds[4]) override;
  void ComputeJustifiedStringBounds(const char* text, float bounds[4]) override;
  void DrawMathTextString(float* point, const Text& text) override { DrawString(point, text); }

  void SetMatrix(vtkMatrix3x3* matrix) override;
  void GetMatrix(vtkMatrix3x3* matrix) override;
  void MultiplyMatrix(vtkMatrix3x3* matrix) override;
  void PushMatrix() override { matrices_.push_back(matrices_.back()); }
  void PopMatrix() override { matrices_.pop_back(); }
  void SetClipping(int* rectangle) override { std::copy(rectangle, rectangle + 4, clip_); }
  void EnableClipping(bool enable) override;

  void DrawPointSprites(vtkImageData*, float*, int, unsigned char*, int) override {}
  void DrawEllipseWedge(float, float, float, float, float, float, float, float) override {}
  void DrawEllipticArc(float, float, float, float, float, float) override {}
  void DrawImage(float*, float, vtkImageData*) override {}
  void DrawImage(const vtkRectf&, vtkImageData*) override {}
  void SetColor4(unsigned char*) override {}
  void SetTexture(vtkImageData*, int) override {}
  void SetPointSize(float) override {}
  void SetLineWidth(float) override {}
  void SetLineType(int) override {}

  // Pure virtual up to VTK 9.1, where nothing calls them; removed in later versions.
  virtual void DrawString(float*, const vtkUnicodeString&) {}                   // NOLINT
  virtual void ComputeStringBounds(const vtkUnicodeString&, float bounds[4]) {  // NOLINT
    std::fill(bounds, bounds + 4, 0.0F);
  }

 protected:
  CairoContextDevice();
  ~CairoContextDevice() override = default;

 private:
  struct Place {
    double x, y;
  };
  Place place(const float* point) const;
  bool is_inside(const Place& p) const;
  void clip() const;
  void set(const unsigned char* color) const;
  void stroke() const;
  void trace_marker(int shape, const Place& center, double half) const;
  void select_font() const;

  cairo_t* cairo_ = nullptr;
  double height_ = 0;
  std::vector<cairo_matrix_t> matrices_;
  bool clips_ = false;
  int clip_[4] = {0, 0, 0, 0};  ///< left, bottom, width, height
};

}  // namespace transillum
