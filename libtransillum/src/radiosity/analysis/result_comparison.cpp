// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Compares the radiosity of two results, patch by patch. Input: two Solutions, from solves or from
// read_result().
#include "radiosity/analysis/result_comparison.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <tuple>
#include <utility>
#include <vector>

#include "radiosity/reflected_light.h"
#include "transillum/at.h"
#include "transillum/errors.h"

namespace transillum {
namespace {

std::string text_of(const Rgb& c) { return fmt::format("{} {} {}", c.r, c.g, c.b); }

std::string outline_difference(const Scene& one, const Scene& other, PatchId i) {
  const auto a = one.outline(i), b = other.outline(i);
  if (a.size() != b.size()) {
    return fmt::format("patch {} has {} corners in one and {} in the other", i, a.size(), b.size());
  }
  for (std::size_t k = 0; k < a.size(); ++k) {
    const Vec3 &p = one.point(a[k]), &q = other.point(b[k]);
    if (p != q) {
      return fmt::format("patch {} has corner {} at {} {} {} in one and {} {} {} in the other", i,
                         k, p.x, p.y, p.z, q.x, q.y, q.z);
    }
  }
  return {};
}

/// |value| over `unit`; 0 / 0 is 0.
double relative(double value, double unit) {
  if (value == 0) {
    return 0;
  }
  return unit > 0 ? value / unit : std::numeric_limits<double>::infinity();
}

/// Sums over some patches.
class DifferenceSums {
 public:
  /// @param unit largest |B|, which squares are scaled by: squares of very large or very small
  /// radiosities are out of range
  explicit DifferenceSums(double unit) : scale_(unit > 0 ? 1 / unit : 1) {}

  /// @param reflected light of the first result
  void add(PatchId i, const Rgb& first, const Rgb& second, const Rgb& reflected) {
    const Rgb difference = second - first;
    squares_ += sum_of_squares(difference);
    reference_squares_ += sum_of_squares(reflected);
    reference_ = std::max(reference_, max_abs(reflected));
    if (max_abs(difference) > largest_) {
      largest_ = max_abs(difference);
      result_.worst = i;
      result_.first = first;
      result_.second = second;
    }
  }
  RadiosityDifference result() const {
    RadiosityDifference result = result_;
    result.rms = std::sqrt(relative(squares_, reference_squares_));
    result.largest = relative(largest_, reference_);
    return result;
  }

 private:
  double sum_of_squares(const Rgb& value) const {
    const Rgb scaled = scale_ * value;
    return scaled.r * scaled.r + scaled.g * scaled.g + scaled.b * scaled.b;
  }

  double scale_;
  double squares_ = 0, reference_squares_ = 0, reference_ = 0, largest_ = 0;
  RadiosityDifference result_;
};

}  // namespace

std::string material_difference(const Scene& one, PatchId i, const Scene& other, PatchId j) {
  for (const auto& [name, a, b] : {std::tuple{"E", one.exitance(i), other.exitance(j)},
                                   {"rho", one.reflectance(i), other.reflectance(j)}}) {
    if (a != b) {
      return fmt::format("{} {} in one and {} in the other", name, text_of(a), text_of(b));
    }
  }
  return {};
}

std::string scene_difference(const Scene& one, const Scene& other) {
  if (one.patch_count() != other.patch_count()) {
    return fmt::format("one has {} patches and the other {}", one.patch_count(),
                       other.patch_count());
  }
  for (PatchId i = 0; i < one.patch_count(); ++i) {
    if (std::string outline = outline_difference(one, other, i); !outline.empty()) {
      return outline;
    }
    if (std::string material = material_difference(one, i, other, i); !material.empty()) {
      return fmt::format("patch {} has {}", i, material);
    }
  }
  return {};
}

namespace {

bool knows_sky(const Solution& solution) {
  return solution.sky.is_set() || solution.sky_irradiance.empty();
}

/// Whether two skies give the same light.
bool are_same(const Sky& one, const Sky& other) {
  return one.exitance == other.exitance &&
         (!one.is_set() ||
          (one.model == other.model && (one.model == SkyModel::uniform || one.up == other.up)));
}

std::string text_of(const Sky& sky) {
  if (!sky.is_set()) {
    return "none";
  }
  std::string text = fmt::format("a sky of {} W/m2, {}", text_of(sky.exitance), name_of(sky.model));
  if (sky.model != SkyModel::uniform) {
    text += fmt::format(", up {} {} {}", sky.up.x, sky.up.y, sky.up.z);
  }
  return text;
}

}  // namespace

std::string sky_difference(const Solution& one, const Solution& other) {
  if (!knows_sky(one) || !knows_sky(other) || are_same(one.sky, other.sky)) {
    return {};
  }
  return fmt::format("one has {}, and the other has {}", text_of(one.sky), text_of(other.sky));
}

namespace {

/// Over the patches of `part` that do not emit, or all of `part` where those reflect nothing.
RadiosityDifference difference_of(const std::vector<PatchId>& part, const Solution& first,
                                  const Solution& second) {
  std::vector<Rgb> exitance, b;
  double unit = 0;
  for (const PatchId i : part) {
    exitance.push_back(first.scene->exitance(i));
    b.push_back(at(first.radiosity, i));
    unit = std::max({unit, max_abs(b.back()), max_abs(at(second.radiosity, i))});
  }
  const ReflectedLight light(std::move(exitance), 1);
  const std::vector<char> measured = light.measured(b);
  DifferenceSums sums(unit);
  for (std::size_t k = 0; k < part.size(); ++k) {
    if (measured[k] != 0) {
      sums.add(part[k], b[k], at(second.radiosity, part[k]), light.of(k, b[k]));
    }
  }
  return sums.result();
}

}  // namespace

ResultComparison compare_results(const Solution& first, const Solution& second) {
  const Scene& scene = *first.scene;
  if (const std::string difference = scene_difference(scene, *second.scene); !difference.empty()) {
    throw InputError("the results are of different scenes: " + difference);
  }
  std::vector<PatchId> all(scene.patches().size());
  std::iota(all.begin(), all.end(), 0);
  const std::size_t groups = scene.groups().size();
  std::vector<std::vector<PatchId>> parts(groups + 1);  // the last: no group
  for (PatchId i = 0; i < scene.patch_count(); ++i) {
    const std::int32_t group = scene.patch(i).group;
    parts[group == no_group ? groups : static_cast<std::size_t>(group)].push_back(i);
  }
  ResultComparison comparison{difference_of(all, first, second), {}, sky_difference(first, second)};
  for (std::size_t g = 0; g < parts.size(); ++g) {
    if (!parts[g].empty()) {
      comparison.groups.push_back({g == groups ? no_group : static_cast<std::int32_t>(g),
                                   std::ssize(parts[g]), difference_of(parts[g], first, second)});
    }
  }
  return comparison;
}

}  // namespace transillum
