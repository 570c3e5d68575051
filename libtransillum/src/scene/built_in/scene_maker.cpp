// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "scene/built_in/scene_maker.h"

#include <algorithm>

#include "scene/built_in/footprint.h"

namespace transillum {

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

}  // namespace transillum
