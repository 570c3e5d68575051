// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "scene/built_in/built_in_makers.h"

#include <algorithm>
#include <array>
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

SceneMaker::MaterialNumber SceneMaker::material(const std::string& name, const Rgb& reflectance,
                                                const Rgb& exitance, const Lobe& lobe) {
  description_.materials.push_back({name, reflectance, exitance, lobe});
  return static_cast<MaterialNumber>(description_.materials.size()) - 1;
}

void SceneMaker::face(const std::vector<PointId>& outline, MaterialNumber material) {
  description_.add_face(outline, material);
}

void SceneMaker::face(const std::vector<Vec3>& outline, MaterialNumber material) {
  std::vector<PointId> corners;
  for (const Vec3& p : outline) {
    corners.push_back(point(p));
  }
  face(corners, material);
}

void SceneMaker::walls(const Block& b, Facing facing, MaterialNumber material) {
  const std::array<std::array<int, 2>, 4> corners{{{0, 0}, {1, 0}, {1, 1}, {0, 1}}};
  for (std::size_t i = 0; i < 4; ++i) {
    const auto [ax, ay] = corners[i];
    const auto [bx, by] = corners[(i + 1) % 4];
    std::vector<Vec3> outline{b.at(ax, ay, 0), b.at(bx, by, 0), b.at(bx, by, 1), b.at(ax, ay, 1)};
    if (facing == Facing::inward) {
      std::reverse(outline.begin(), outline.end());
    }
    face(outline, material);
  }
}

void SceneMaker::floor(const std::vector<Vec3>& outline, const std::vector<Block>& standing,
                       MaterialNumber material) {
  std::vector<std::vector<Vec3>> footprints;
  for (const Block& b : standing) {
    footprints.push_back({b.at(0, 0, 0), b.at(1, 0, 0), b.at(1, 1, 0), b.at(0, 1, 0)});
  }
  for (const auto& part : floor_around_all(outline, footprints, {0, 0, 1})) {
    face(part, material);
  }
}

void SceneMaker::standing_block(const Block& b, MaterialNumber material) {
  walls(b, Facing::outward, material);
  face(std::vector<Vec3>{b.at(0, 0, 1), b.at(1, 0, 1), b.at(1, 1, 1), b.at(0, 1, 1)}, material);
}

void SceneMaker::block(const Block& b, Facing facing, MaterialNumber material) {
  walls(b, facing, material);
  std::vector<Vec3> top{b.at(0, 0, 1), b.at(1, 0, 1), b.at(1, 1, 1), b.at(0, 1, 1)};
  std::vector<Vec3> bottom{b.at(0, 0, 0), b.at(0, 1, 0), b.at(1, 1, 0), b.at(1, 0, 0)};
  if (facing == Facing::inward) {
    std::reverse(top.begin(), top.end());
    std::reverse(bottom.begin(), bottom.end());
  }
  face(bottom, material);
  face(top, material);
}

void SceneMaker::lit_ceiling(const Rectangle& room, const Rectangle& lamp, double z,
                             MaterialNumber ceiling, MaterialNumber light) {
  const auto corners = [z](const Rectangle& r) {
    // Clockwise seen from above, counter-clockwise seen from below.
    return std::array<Vec3, 4>{
        {{r.x0, r.y0, z}, {r.x0, r.y1, z}, {r.x1, r.y1, z}, {r.x1, r.y0, z}}};
  };
  const std::array<Vec3, 4> outer = corners(room), inner = corners(lamp);
  for (std::size_t i = 0; i < 4; ++i) {
    const std::size_t next = (i + 1) % 4;
    face(std::vector<Vec3>{outer[i], outer[next], inner[next], inner[i]}, ceiling);
  }
  face(std::vector<Vec3>(inner.begin(), inner.end()), light);
}

SceneDescription SceneMaker::take(const std::string& name) {
  description_.name = name;
  description_.points = table_.take();
  return std::move(description_);
}

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
