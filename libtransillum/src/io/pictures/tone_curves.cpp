// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "base/choice.h"
#include "transillum/errors.h"
#include "transillum/files.h"
#include "transillum/picture.h"

namespace transillum {
namespace {

constexpr std::array tone_curves{
    Choice{ToneCurve::linear, "linear", nullptr, "proportional, clipped with the hue kept"},
    Choice{ToneCurve::aces, "aces", "ACES", "film curve of ACES, by Narkowicz"},
    Choice{ToneCurve::filmic, "filmic", nullptr, "film curve of Hable"},
};

/// K. Narkowicz, "ACES filmic tone mapping curve", 2016.
double aces(double x) {
  return std::min(x * (2.51 * x + 0.03) / (x * (2.43 * x + 0.59) + 0.14), 1.0);
}

/// J. Hable, "Filmic tonemapping operators", 2010, before the division by its white.
double hable(double x) {
  constexpr double a = 0.15, b = 0.50, c = 0.10, d = 0.20, e = 0.02, f = 0.30;
  return (x * (a * x + c * b) + d * e) / (x * (a * x + b) + d * f) - e / f;
}

double filmic(double x) {
  constexpr double exposure = 2, white = 11.2;
  return std::min(hable(exposure * x) / hable(white), 1.0);
}

/// Limits also what would make a quotient of two infinite numbers.
double channel(double light, double (*curve)(double)) {
  constexpr double largest = 1e6;
  return std::max(curve(std::clamp(light, 0.0, largest)), 0.0);
}

void check_positive(const char* what, double value) {
  if (!(value > 0 && std::isfinite(value))) {
    throw InputError(fmt::format("{}: {} is not a finite number greater than 0", what, value));
  }
}

}  // namespace

template <>
const Choices& choices_of<ToneCurve>() {
  return texts_of<tone_curves>("tone curve");
}

void PictureLook::validate() const { check_positive("exposure", exposure); }

void FalseColors::validate() const { check_positive("upper end of the scale", highest); }

Rgb shown_color(const Rgb& radiance, const PictureLook& look) {
  const Rgb light = std::numbers::pi * look.exposure * radiance;
  if (look.tone != ToneCurve::linear) {
    const auto curve = look.tone == ToneCurve::aces ? aces : filmic;
    return {channel(light.r, curve), channel(light.g, curve), channel(light.b, curve)};
  }
  // Linear functions on patches may be below 0.
  const Rgb shown{std::max(light.r, 0.0), std::max(light.g, 0.0), std::max(light.b, 0.0)};
  return 1 / std::max({shown.r, shown.g, shown.b, 1.0}) * shown;
}

}  // namespace transillum
