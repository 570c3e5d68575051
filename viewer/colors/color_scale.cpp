// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Colors, ranges, ticks and histograms of a quantity of the patches.
#include "colors/color_scale.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "base/round_step.h"
#include "transillum/at.h"

namespace transillum::viewer {

namespace {

// A table instead of pow(): all patches are recolored many times per second.
class GammaTable {
 public:
  explicit GammaTable(double gamma) {
    for (std::size_t i = 0; i < shown_.size(); ++i) {
      shown_[i] = static_cast<std::uint8_t>(
          std::lround(255 * std::pow(static_cast<double>(i) / steps, 1 / gamma)));
    }
  }
  std::uint8_t operator()(double linear) const { return at(shown_, std::lround(linear * steps)); }

 private:
  static constexpr int steps = 8192;
  std::array<std::uint8_t, steps + 1> shown_;
};

Rgb expose(const Rgb& radiosity, double factor) {
  // A patch that is too bright is scaled down, which keeps its hue. Linear functions may be below
  // 0.
  const auto exposed_channel = [factor](double b) { return std::max(factor * b, 0.0); };
  const Rgb exposed{exposed_channel(radiosity.r), exposed_channel(radiosity.g),
                    exposed_channel(radiosity.b)};
  const double largest = max_abs(exposed);
  if (!std::isfinite(largest)) {
    return {1, 1, 1};
  }
  const double scale = largest > 1 ? 1 / largest : 1;
  const auto channel = [&](double x) { return std::clamp(scale * x, 0.0, 1.0); };
  return {channel(exposed.r), channel(exposed.g), channel(exposed.b)};
}

}  // namespace

double ColorScale::value(const Rgb& b) const {
  switch (mode) {
    case ColorMode::red:
      return b.r;
    case ColorMode::green:
      return b.g;
    case ColorMode::blue:
      return b.b;
    case ColorMode::true_color:
    case ColorMode::luminance:
      break;
  }
  return luminance(b);
}

double ColorScale::position(double v) const {
  if (!logarithmic) {
    return (v - low) / (high - low);
  }
  return v > 0 ? std::log(v / low) / std::log(high / low) : 0.0;
}

double ColorScale::value_at(double t) const {
  return logarithmic ? low * std::pow(high / low, t) : low + t * (high - low);
}

Color8 ColorScale::color(const Rgb& radiosity) const {
  std::vector<Color8> colors;
  color(std::span(&radiosity, 1), colors);
  return colors.front();
}

void ColorScale::color(std::span<const Rgb> radiosity, std::vector<Color8>& colors) const {
  colors.resize(radiosity.size());
  if (mode == ColorMode::true_color) {
    const GammaTable table(gamma);
    const double factor = std::exp2(exposure);
    std::transform(radiosity.begin(), radiosity.end(), colors.begin(), [&](const Rgb& b) -> Color8 {
      const Rgb exposed = expose(b, factor);
      return {table(exposed.r), table(exposed.g), table(exposed.b)};
    });
  } else {
    std::transform(radiosity.begin(), radiosity.end(), colors.begin(), [&](const Rgb& b) {
      const double v = value(b);
      return std::isnan(v)          ? omitted_color
             : marks_zero && v == 0 ? zero_color
                                    : color_of(map, position(v));
    });
  }
}

Rgb ColorScale::exposed(const Rgb& radiosity) const {
  return expose(radiosity, std::exp2(exposure));
}

Color8 ColorScale::shown(const Rgb& exposed) const {
  const auto channel = [this](double x) {
    return static_cast<std::uint8_t>(std::lround(255 * std::pow(x, 1 / gamma)));
  };
  return {channel(exposed.r), channel(exposed.g), channel(exposed.b)};
}

std::vector<double> ColorScale::ticks() const {
  std::vector<double> values;
  if (!(high > low)) {
    return values;
  }
  if (logarithmic) {
    const double decades = std::log10(high / low);
    const int every = std::max(1, static_cast<int>(std::ceil(decades / 8)));
    const auto first = static_cast<int>(std::floor(std::log10(low)));
    const auto last = static_cast<int>(std::ceil(std::log10(high)));
    for (int e = first; e <= last; e += every) {
      for (const double lead : {1.0, 2.0, 5.0}) {
        if (lead != 1 && decades > 3) {
          continue;
        }
        const double v = lead * std::pow(10.0, e);
        if (v >= low * (1 - 1e-9) && v <= high * (1 + 1e-9)) {
          values.push_back(v);
        }
      }
    }
  } else {
    const double step = round_step(high - low, 6);
    for (double k = std::ceil(low / step - 1e-9); k * step <= high + 1e-9 * step; ++k) {
      values.push_back(k * step);
    }
  }
  return values;
}

template <class Counts>
void ColorScale::fit_range_where(std::span<const Rgb> values, const Counts& counts) {
  std::vector<double> positive;
  double brightest_counting = 0, brightest = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double v = value(values[i]);
    if (!(v > 0) || !std::isfinite(v)) {
      continue;
    }
    positive.push_back(v);
    brightest = std::max(brightest, v);
    if (counts(i)) {
      brightest_counting = std::max(brightest_counting, v);
    }
  }
  high = !logarithmic && brightest_counting > 0 ? brightest_counting
         : brightest > 0                        ? brightest
                                                : 1;
  low = logarithmic ? 1e-3 * high : 0;
  if (!logarithmic || positive.empty()) {
    return;
  }
  // The darkest 1 % would stretch the scale over many nearly empty decades.
  const auto dark = positive.begin() + std::ssize(positive) / 100;
  std::nth_element(positive.begin(), dark, positive.end());
  low = std::max(*dark, 1e-6 * high);
  if (!(high > 1.01 * low)) {
    low = high / 2;
    high = high * 2;
  }
}

void ColorScale::fit_range(const Scene& scene, std::span<const Rgb> radiosity) {
  fit_range_where(radiosity, [&](std::size_t i) {
    return max_abs(scene.exitance(static_cast<PatchId>(i))) == 0;
  });
  find_out_of_range(radiosity);
}

void ColorScale::fit_range(std::span<const Rgb> values, bool balanced) {
  if (balanced) {
    high = 0;
    for (const Rgb& v : values) {
      if (const double size = std::abs(value(v)); std::isfinite(size)) {
        high = std::max(high, size);
      }
    }
    if (!(high > 0)) {
      high = 1;
    }
    low = -high;
  } else {
    fit_range_where(values, [](std::size_t) { return true; });
  }
  find_out_of_range(values);
}

void ColorScale::repair_range() {
  if (logarithmic && !(high > 0)) {
    high = 1;
  }
  if (logarithmic && !(low > 0)) {
    low = 1e-3 * high;
  }
  if (!(high > low)) {
    high = logarithmic ? 10 * low : low + 1;
  }
}

void ColorScale::find_out_of_range(std::span<const Rgb> values) {
  above = below = zeros = false;
  for (const Rgb& rgb : values) {
    const double v = value(rgb);
    above = above || v > high;
    below = below || (v < low && v != 0);
    zeros = zeros || v == 0;
  }
}

std::vector<double> histogram(const ColorScale& scale, const Scene& scene,
                              std::span<const Rgb> values, int bins) {
  std::vector<double> area(static_cast<std::size_t>(bins));
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double v = scale.value(values[i]);
    if (scale.logarithmic && !(v > 0)) {
      continue;
    }
    const double t = scale.position(v);
    if (!(t >= 0 && t <= 1)) {
      continue;
    }
    const auto bin = std::min(static_cast<std::size_t>(t * bins), area.size() - 1);
    area[bin] += scene.patch(static_cast<PatchId>(i)).area;
  }
  const double most = area.empty() ? 0 : *std::max_element(area.begin(), area.end());
  if (most > 0) {
    for (double& fraction : area) {
      fraction /= most;
    }
  }
  return area;
}

void ColorScale::fit_exposure(const Scene& scene, std::span<const Rgb> radiosity) {
  std::vector<std::pair<double, double>> brightness_area;
  double area = 0;
  for (const bool count_emitters : {false, true}) {
    for (PatchId i = 0; i < scene.patch_count(); ++i) {
      const double brightness = max_abs(at(radiosity, i));
      const bool counts = count_emitters || max_abs(scene.exitance(i)) == 0;
      if (!counts || !(brightness > 0) || !std::isfinite(brightness)) {
        continue;
      }
      brightness_area.emplace_back(brightness, scene.patch(i).area);
      area += scene.patch(i).area;
    }
    if (!brightness_area.empty()) {
      break;
    }
  }
  if (brightness_area.empty()) {
    return;
  }
  std::sort(brightness_area.begin(), brightness_area.end());
  double darker = 0;
  double white = brightness_area.back().first;
  for (const auto& [brightness, patch_area] : brightness_area) {
    darker += patch_area;
    if (darker >= 0.95 * area) {
      white = brightness;
      break;
    }
  }
  exposure = std::log2(0.85 / white);
}

}  // namespace transillum::viewer
