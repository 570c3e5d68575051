// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// The exposure of results that show colors.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "io/results/result_writers.h"
#include "transillum/at.h"
#include "transillum/errors.h"
#include "transillum/files.h"

namespace transillum {
namespace {

/// The value that the largest channel of B does not exceed on 98 % of the area.
/// @param emitting whether patches that emit count too
double bright(const Solution& solution, bool emitting) {
  constexpr double fraction = 0.98;
  std::vector<std::pair<double, double>> values;  // B, and area
  double area = 0;
  for (PatchId i = 0; i < solution.scene->patch_count(); ++i) {
    if (emitting || max_abs(solution.scene->exitance(i)) == 0) {
      values.emplace_back(max_abs(at(solution.radiosity, i)), solution.scene->patch(i).area);
      area += values.back().second;
    }
  }
  std::sort(values.begin(), values.end());
  double below = 0;
  for (const auto& [value, of_patch] : values) {
    below += of_patch;
    if (below >= fraction * area) {
      return value;
    }
  }
  return 0;
}

}  // namespace

void DisplayOptions::validate() const {
  if (exposure && !(*exposure > 0 && std::isfinite(*exposure))) {
    throw InputError(fmt::format("exposure: {} is not a finite number greater than 0", *exposure));
  }
  if (up && !(std::abs(norm(*up) - 1) <= 1e-9)) {
    throw InputError(
        fmt::format("up: the vector {} {} {} is not a unit vector", up->x, up->y, up->z));
  }
}

double automatic_exposure(const Solution& solution) {
  const double without_sources = bright(solution, false);
  const double white = without_sources > 0 ? without_sources : bright(solution, true);
  return white > 0 ? 1 / white : 1;
}

double exposure_of(const Solution& solution, const DisplayOptions& display) {
  return display.exposure ? *display.exposure : automatic_exposure(solution);
}

}  // namespace transillum
