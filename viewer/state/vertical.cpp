// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "state/vertical.h"

#include <cmath>

namespace transillum::viewer {

namespace {

constexpr Vec3 usual{0, 1, 0}, other{0, 0, 1};

}  // namespace

Vec3 likely_vertical(const Scene& scene) {
  constexpr double level = 0.995;  // cosine of the tilt of a level face
  constexpr double clearly = 1.2;
  constexpr double least_fraction = 0.02;  // a few small faces tell nothing
  double by_usual = 0, by_other = 0, all = 0;
  for (const Patch& patch : scene.patches()) {
    all += patch.area;
    by_usual += std::abs(dot(patch.normal, usual)) > level ? patch.area : 0;
    by_other += std::abs(dot(patch.normal, other)) > level ? patch.area : 0;
  }
  return by_other > clearly * by_usual && by_other > least_fraction * all ? other : usual;
}

void Vertical::show_scene(const Scene& scene, const std::optional<Vec3>& known) {
  up_ = known ? *known : likely_vertical(scene);
  is_guess_ = !known && !(up_ == usual);
  emit changed();
}

void Vertical::choose(const Vec3& up) {
  if (up_ == up && !is_guess_) {
    return;
  }
  up_ = up;
  is_guess_ = false;
  emit changed();
}

}  // namespace transillum::viewer
