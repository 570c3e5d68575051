// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <string>
#include <vector>

#include "io/drawing/line_chart.h"
#include "transillum/files.h"
#include "transillum/vec3.h"

namespace transillum {

class ChartCanvas;

/// The values at which a scale from 0 to `highest` is labeled: all multiples of a round number.
std::vector<double> color_bar_ticks(double highest);

inline constexpr const char* scale_font = "DejaVu Sans";
inline constexpr ChartColor scale_ink{26, 26, 31}, scale_paper{255, 255, 255};
/// Height of the letters beside a picture, pixels.
double scale_text_size(double picture_height);

/// The scale of false colors beside a picture. Lengths are in pixels.
class ColorBar {
 public:
  /// @param text_size  height of its letters
  ColorBar(const FalseColors& colors, double text_size);

  /// From the lower end, 0, to the upper end, 1.
  double fraction_of(const Rgb& radiance) const;
  double width(ChartCanvas& canvas) const;
  /// Room for the title.
  double least_height(ChartCanvas& canvas) const;
  /// Draws the bar without the paper.
  void draw(ChartCanvas& canvas, const ChartArea& area) const;
  /// The quantity and its unit.
  const std::string& title() const { return title_; }

 private:
  double label_left() const { return 3.3 * size_; }
  ChartText look() const { return {size_, scale_ink}; }

  double unit_, highest_;  ///< per W/m², and in that unit
  std::string title_;
  double size_;  ///< height of the font
  std::vector<double> ticks_;
};

}  // namespace transillum
