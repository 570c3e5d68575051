// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "state/vertical.h"

#include <cmath>

#include "transillum/at.h"

namespace transillum::viewer {

namespace {

constexpr Vec3 usual{0, 1, 0}, along_z{0, 0, 1};

/// Whether what emits faces down where +y is up.
bool lamps_face_down(const Scene& scene) {
  constexpr double most = 0.9;
  double down = 0, all = 0;
  for (const Patch& patch : scene.patches()) {
    const double power = max_abs(at(scene.materials(), patch.material).exitance) * patch.area;
    down -= power * dot(patch.normal, usual);
    all += power;
  }
  return all > 0 && down > most * all;
}

}  // namespace

LikelyVertical likely_vertical(const Scene& scene) {
  constexpr double level = 0.995;  // cosine of the tilt of a level face
  constexpr double clearly = 1.2;
  constexpr double least_fraction = 0.02;  // a few small faces tell nothing
  double by_usual = 0, by_z = 0, all = 0;
  for (const Patch& patch : scene.patches()) {
    all += patch.area;
    by_usual += std::abs(dot(patch.normal, usual)) > level ? patch.area : 0;
    by_z += std::abs(dot(patch.normal, along_z)) > level ? patch.area : 0;
  }
  const auto is_larger = [&](double one, double other) {
    return one > clearly * other && one > least_fraction * all;
  };
  if (is_larger(by_z, by_usual)) {
    return {along_z, true};
  }
  return {usual, is_larger(by_usual, by_z) || lamps_face_down(scene)};
}

void Vertical::show_scene(const Scene& scene, const std::optional<Vec3>& known) {
  const LikelyVertical likely = known ? LikelyVertical{*known, true} : likely_vertical(scene);
  up_ = likely.up;
  is_clear_ = likely.is_clear;
  is_guess_ = !known && (!is_clear_ || !(up_ == usual));
  emit changed();
}

Vec3 Vertical::other() const { return up_ == usual ? along_z : usual; }

void Vertical::choose(const Vec3& up) {
  if (up_ == up && !is_guess_) {
    return;
  }
  up_ = up;
  is_guess_ = false;
  emit changed();
}

}  // namespace transillum::viewer
