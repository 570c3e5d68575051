// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <iosfwd>
#include <span>
#include <string>

#include "io/drawing/line_chart.h"
#include "io/text.h"

namespace transillum {

/// Writes what is drawn as SVG: vectors, text as text, and pictures.
class SvgDevice : public ChartDevice {
 public:
  /// Writes the head.
  /// @param width, height  of the page, pixels of a screen with scale 1
  /// @param font  family of all texts
  /// @param title, description  for screen readers; any bytes
  SvgDevice(std::ostream& out, double width, double height, const std::string& font,
            const std::string& title, const std::string& description);
  /// Writes the end.
  ~SvgDevice() override;

  void fill(std::span<const ChartPoint> corners, const ChartColor& color) override;
  void stroke(std::span<const ChartPoint> points, bool closed, const ChartColor& color,
              double width, std::span<const double> dashes) override;
  void text(const std::string& text, const ChartPoint& at, double align, const ChartText& look,
            bool upward) override;
  void clip(const ChartArea& area) override;
  void clip_nothing() override;
  /// @param png  the bytes of a PNG file, which fill the area
  void image(const ChartArea& area, const std::string& png);
  /// Moves the origin of what is drawn from here on.
  void move_origin(const ChartPoint& origin) { origin_ = origin; }

 private:
  /// Writes the corners as data of a path.
  void add_path(std::span<const ChartPoint> points, bool closed);
  ChartPoint placed(const ChartPoint& point) const {
    return {origin_.x + point.x, origin_.y + point.y};
  }

  TextBuffer text_;
  ChartPoint origin_;
  int clips_ = 0;  ///< areas so far
};

}  // namespace transillum
