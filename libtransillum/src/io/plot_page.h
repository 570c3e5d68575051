// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <cairo.h>

#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace transillum {

struct PlotColor {
  double r, g, b;
};
enum class Marker { circle, square, triangle, diamond, down, cross, plus };
inline constexpr int marker_count = 7;

/// How a line is drawn, so that it can be told from the others without colour.
struct PlotStyle {
  PlotColor color{};
  Marker marker{};
  std::vector<double> dashes;  ///< on, off, …; none: solid
  bool filled = true;
};

/// A page under Cairo's pens, in points of 1600 x 960, large enough for a projector.
class PlotPage {
 public:
  static constexpr double width = 1600, height = 960;
  static constexpr double line_width = 4, marker_size = 11;
  static constexpr PlotColor ink{0.1, 0.1, 0.12};

  /// Takes `surface` over. One of another size gets the page as large as it can be, in its middle.
  PlotPage(cairo_surface_t* surface, double surface_width, double surface_height);
  explicit PlotPage(cairo_surface_t* surface) : PlotPage(surface, width, height) {}

  /// Clips to a rectangle until the next call of unclip().
  void clip(double x, double y, double w, double h) const;
  void unclip() const;
  void line(const std::vector<std::pair<double, double>>& points, const PlotColor& color,
            double thickness, const std::vector<double>& dashes = {}) const;
  /// `align` 0 begins, 0.5 is centred, 1 ends at x; y is the base line. Text wider than `most`
  /// shrinks.
  void text(const std::string& text, double x, double y, double size, double align,
            double most = width) const;
  void text_upwards(const std::string& words, double x, double y, double size) const;
  double width_of(const std::string& text, double size) const;
  void marker(const PlotStyle& style, double x, double y) const;

  /// What was drawn is on the surface from now on. finish(): and no more will be.
  /// @throws std::runtime_error where anything went wrong.
  void flush() const;
  void finish() const;
  static void check(cairo_status_t status);
  cairo_surface_t* surface() const { return surface_.get(); }

 private:
  cairo_t* cairo() const { return cairo_.get(); }
  void set(const PlotColor& c) const { cairo_set_source_rgb(cairo(), c.r, c.g, c.b); }
  void trace(Marker marker, double x, double y) const;

  std::unique_ptr<cairo_surface_t, void (*)(cairo_surface_t*)> surface_;
  std::unique_ptr<cairo_t, void (*)(cairo_t*)> cairo_;
};

}  // namespace transillum
