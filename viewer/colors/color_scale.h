// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <span>
#include <vector>

#include "colors/color_map.h"
#include "geometry/luminance.h"
#include "transillum/scene.h"

namespace transillum::viewer {

/// How red, green and blue are shown.
enum class ColorMode { true_color, luminance, red, green, blue };

/// Maps a quantity of patches (W/m² for radiosity, else the unit of the quantity) to colors, the
/// same in all views.
class ColorScale {
 public:
  ColorMode mode = ColorMode::true_color;
  ColorMap map = default_color_map;
  bool logarithmic = false;
  double exposure = 0;       ///< EV: B is white if 2^exposure B reaches 1
  double gamma = 2.2;        ///< true color: shown = (2^exposure B)^(1/gamma)
  bool marks_zero = false;   ///< 0 is shown in zero_color
  bool zeros = false;        ///< some values are 0
  bool above = false;        ///< some values are above `high`
  bool below = false;        ///< some values are below `low`, and not 0
  double low = 0, high = 1;  ///< ends of the color map; low < high; 0 < low if logarithmic

  Color8 color(const Rgb& radiosity) const;
  /// The colors of many patches at once.
  void color(std::span<const Rgb> radiosity, std::vector<Color8>& colors) const;

  /// Light in true color before its gamma, each channel in [0, 1]; what is too bright keeps its
  /// hue.
  Rgb exposed(const Rgb& radiosity) const;
  /// The color of such light, or of a mean of it.
  Color8 shown(const Rgb& exposed) const;

  /// The shown value: one channel, or the luminance.
  double value(const Rgb& radiosity) const;
  /// Position of `value` in the range: 0 at low, 1 at high, not clamped.
  double position(double value) const;
  /// Inverse of position().
  double value_at(double position) const;
  /// Values of the ticks on the bar, ascending, within [low, high].
  std::vector<double> ticks() const;

  /// Sets the range. Linear: from 0 to the brightest patch that does not emit, because a room is
  /// much darker than its light sources. Logarithmic: to the brightest patch.
  void fit_range(const Scene& scene, std::span<const Rgb> radiosity);
  /// Fits the range to all values.
  /// @param balanced  symmetric around 0
  void fit_range(std::span<const Rgb> values, bool balanced = false);
  /// Changes the range as little as needed for low < high, and 0 < low if logarithmic.
  void repair_range();
  /// Sets `above`, `below` and `zeros`.
  void find_out_of_range(std::span<const Rgb> values);
  /// Sets the exposure so that the 95th percentile (by area) of the patches that do not emit is
  /// nearly white. If all patches emit, all are counted.
  void fit_exposure(const Scene& scene, std::span<const Rgb> radiosity);

 private:
  template <class Counts>
  void fit_range_where(std::span<const Rgb> values, const Counts& counts);
};

/// Area of the patches per bin of the range from low to high, relative to the largest bin. Values
/// outside the range are not counted.
std::vector<double> histogram(const ColorScale& scale, const Scene& scene,
                              std::span<const Rgb> values, int bins);

}  // namespace transillum::viewer
