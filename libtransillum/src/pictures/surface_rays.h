// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "transillum/scene.h"
#include "visibility/embree/embree_scene.h"

namespace transillum {

/// Two vectors that make a right-handed frame with a unit normal.
struct TangentFrame {
  explicit TangentFrame(const Vec3& normal);
  Vec3 turned(const Vec3& local) const { return local.x * u + local.y * v + local.z * w; }

  Vec3 u, v, w;
};

/// Directions about +z, distributed by the cosine: two sets, each of which fills the hemisphere;
/// those next to each other in a set are similar.
std::array<std::vector<Vec3>, 2> cosine_directions(int count, double shift_u, double shift_v);

/// The start of rays from a point of a surface, in Embree's coordinates.
/// @param normal unit
Vec3 start_of_rays(const EmbreeScene& scene, const Vec3& x, const Vec3& normal);

/// The first meeting of a ray.
struct Met {
  PatchId patch = no_patch;  ///< no_patch: nothing is met
  bool is_lit = false;       ///< on its front
  Vec3 place;                ///< m
};
/// The first meeting of one ray.
/// @param start in Embree's coordinates
/// @param direction unit
Met met_by(const EmbreeScene& scene, const Vec3& start, const Vec3& direction);
/// Number of rays that Embree follows at a time.
constexpr std::size_t ray_packet = 16;
/// The first meetings of up to ray_packet similar rays from a point.
std::array<Met, ray_packet> met_by(const EmbreeScene& scene, const Vec3& start,
                                   std::span<const Vec3> directions);

/// Whether nothing that can send light is seen from a point of a surface, only backs of faces: it
/// is under a solid that stands on the surface.
/// @param dark_sky rays that meet nothing bring no light either
bool is_covered(const EmbreeScene& scene, const Vec3& x, const Vec3& normal, bool dark_sky);

}  // namespace transillum
