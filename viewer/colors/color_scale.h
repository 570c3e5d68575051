// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "colors/color_map.h"
#include "transillum/scene.h"

namespace transillum::viewer {

/// What of red, green and blue is shown.
enum class ColorMode { true_color, luminance, red, green, blue };

/// Rec. 709.
double luminance(const Rgb& value);

/// The way from a quantity of patches (radiosity, W/m², if nothing else is said) to the screen, the
/// same in every view.
class ColorScale {
 public:
  ColorMode mode = ColorMode::true_color;
  ColorMap map = ColorMap::viridis;
  bool logarithmic = false;
  double exposure = 0;       ///< EV: 2^exposure times B is shown as white where it reaches 1
  double gamma = 2.2;        ///< true color: shown = (2^exposure B)^(1/gamma)
  bool above = false;        ///< some patches are brighter than `high`
  bool below = false;        ///< some are darker than `low`, and not 0
  double low = 0, high = 1;  ///< W/m², ends of the color map; 0 < low < high where logarithmic

  Color8 color(const Rgb& radiosity) const;
  /// The colors of many patches at once.
  void color(std::span<const Rgb> radiosity, std::vector<Color8>& colors) const;

  /// The shown value: luminance or one channel; luminance in true color.
  double value(const Rgb& radiosity) const;
  /// Where `value` lies between low and high, not clamped.
  double position(double value) const;
  /// Inverse of position().
  double value_at(double position) const;
  /// Values worth a label on the bar, ascending, within [low, high].
  std::vector<double> ticks() const;

  /// Sets the ends of the color map. Linear: from 0 to the brightest patch that does not emit,
  /// for beside its sources a room is dark. Logarithmic: to the brightest of all.
  void fit_range(const Scene& scene, std::span<const Rgb> radiosity);
  /// The same, to the largest of all; where they are `balanced` the map's middle is 0.
  void fit_range(std::span<const Rgb> values, bool balanced = false);
  /// Widens or narrows the range as far as must be: low < high, and 0 < low where logarithmic.
  void repair_range();
  /// Finds whether some values lie beyond the range.
  void find_out_of_range(std::span<const Rgb> values);
  /// Sets the exposure such that what does not emit is well lit: the 95th percentile by area
  /// comes out nearly white. A scene where all patches emit counts them all.
  void fit_exposure(const Scene& scene, std::span<const Rgb> radiosity);

 private:
  template <class Counts>
  void fit_range_where(std::span<const Rgb> values, const Counts& counts);
};

/// Area of the patches by where their value lies in the range, from low to high in `bins` parts,
/// as shares of the largest part. Values beyond the ends count in none.
std::vector<double> histogram(const ColorScale& scale, const Scene& scene,
                              std::span<const Rgb> values, int bins);

}  // namespace transillum::viewer
