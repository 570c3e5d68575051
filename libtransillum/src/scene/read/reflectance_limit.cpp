// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "scene/read/reflectance_limit.h"

#include <fmt/format.h>

namespace transillum {
namespace {

/// Values this near to 1 are 1 but for the digits of the file.
constexpr double rounding_of_one = 1e-6;

}  // namespace

double lower_reflectance(Rgb& reflectance, const ReadOptions& options) {
  const double least = options.max_reflectance.value_or(1 - rounding_of_one);
  const double lowered = options.max_reflectance.value_or(ReadOptions::default_max_reflectance);
  bool any = false;
  for (double* rho : {&reflectance.r, &reflectance.g, &reflectance.b}) {
    if (*rho > least) {
      *rho = lowered;
      any = true;
    }
  }
  return any ? lowered : 0;
}

void lower_reflectance(Rgb& reflectance, const ReadOptions& options, const std::string& place,
                       Warnings& notes) {
  const Rgb given = reflectance;
  const double lowered = lower_reflectance(reflectance, options);
  if (lowered > 0) {
    notes.add("reflectances, lowered",
              fmt::format("{}reflectance rho {:.6g} {:.6g} {:.6g} is lowered to {}", place, given.r,
                          given.g, given.b, lowered));
  }
}

}  // namespace transillum
