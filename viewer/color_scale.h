// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "color_map.h"
#include "transillum/scene.h"

namespace transillum::viewer {

/// What of B is shown.
enum class ColorMode { true_color, luminance, red, green, blue };

/// The way from radiosity (W/m²) to the screen, the same in every view.
class ColorScale {
 public:
  ColorMode mode = ColorMode::true_color;
  ColorMap map = ColorMap::viridis;
  bool logarithmic = false;
  double exposure = 0;       ///< EV: 2^exposure times B is shown as white where it reaches 1
  double gamma = 2.2;        ///< true colour: shown = (2^exposure B)^(1/gamma)
  bool above = false;        ///< some patches are brighter than `high`
  double low = 0, high = 1;  ///< W/m², ends of the colour map; 0 < low < high where logarithmic

  Color8 color(const Rgb& radiosity) const;
  /// The colours of many patches at once.
  void color(std::span<const Rgb> radiosity, std::vector<Color8>& colors) const;

  /// The shown value: luminance (Rec. 709) or one channel; luminance in true colour.
  double value(const Rgb& radiosity) const;
  /// Where `value` lies between low and high, not clamped.
  double position(double value) const;
  /// Inverse of position().
  double value_at(double position) const;
  /// Values worth a label on the bar, ascending, within [low, high].
  std::vector<double> ticks() const;

  /// Sets the ends of the colour map. Linear: from 0 to the brightest patch that does not emit,
  /// for beside its sources a room is dark. Logarithmic: to the brightest of all.
  void fit_range(const Scene& scene, std::span<const Rgb> radiosity);
  /// Sets the exposure such that what does not emit is well lit: the 95th percentile by area
  /// comes out nearly white. A scene where all patches emit counts them all.
  void fit_exposure(const Scene& scene, std::span<const Rgb> radiosity);
};

}  // namespace transillum::viewer
