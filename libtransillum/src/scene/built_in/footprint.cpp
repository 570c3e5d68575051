// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "scene/built_in/footprint.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace transillum {
namespace {

using Outline = std::vector<Vec3>;

/// Distance of p from the line a b, > 0 on the left; 0 if within rounding.
double distance_left(const Vec3& a, const Vec3& b, const Vec3& p, const Vec3& up) {
  const double distance = dot(cross(b - a, p - a), up) / norm(b - a);
  return std::abs(distance) < 1e-12 * norm(b - a) ? 0.0 : distance;
}

/// The parts of a convex outline to the right and to the left of the line a b; a part without area
/// has fewer than three corners.
std::pair<Outline, Outline> split(const Outline& outline, const Vec3& a, const Vec3& b,
                                  const Vec3& up) {
  Outline right, left;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Vec3& p = outline[i];
    const Vec3& q = outline[(i + 1) % outline.size()];
    const double here = distance_left(a, b, p, up), there = distance_left(a, b, q, up);
    if (here >= 0) {
      left.push_back(p);
    }
    if (here <= 0) {
      right.push_back(p);
    }
    if ((here < 0 && there > 0) || (here > 0 && there < 0)) {
      const Vec3 x = p + here / (here - there) * (q - p);
      left.push_back(x);
      right.push_back(x);
    }
  }
  return {right, left};
}

/// Whether an edge of `by` separates the two convex outlines.
bool separated(const Outline& by, const Outline& other, const Vec3& up) {
  for (std::size_t i = 0; i < by.size(); ++i) {
    const Vec3& a = by[i];
    const Vec3& b = by[(i + 1) % by.size()];
    if (std::all_of(other.begin(), other.end(),
                    [&](const Vec3& p) { return distance_left(a, b, p, up) <= 0; })) {
      return true;
    }
  }
  return false;
}

}  // namespace

std::vector<Outline> floor_around(const Outline& floor, const Outline& footprint, const Vec3& up) {
  if (separated(footprint, floor, up) || separated(floor, footprint, up)) {
    return {floor};
  }
  std::vector<Outline> parts;
  Outline rest = floor;
  for (std::size_t i = 0; i < footprint.size(); ++i) {
    auto [outside, inside] = split(rest, footprint[i], footprint[(i + 1) % footprint.size()], up);
    if (outside.size() >= 3) {
      parts.push_back(std::move(outside));
    }
    rest = std::move(inside);
  }
  return parts;
}

std::vector<Outline> floor_around_all(const Outline& floor, const std::vector<Outline>& footprints,
                                      const Vec3& up) {
  std::vector<Outline> parts{floor};
  for (const Outline& footprint : footprints) {
    std::vector<Outline> remaining;
    for (const Outline& part : parts) {
      auto around = floor_around(part, footprint, up);
      std::move(around.begin(), around.end(), std::back_inserter(remaining));
    }
    parts = std::move(remaining);
  }
  return parts;
}

}  // namespace transillum
