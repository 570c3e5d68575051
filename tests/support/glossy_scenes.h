// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// A box in a cube with lobes, and comparisons of its solutions.
#pragma once

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include "support/scenes.h"
#include "transillum/at.h"
#include "transillum/solve_options.h"

namespace transillum::testing {

inline Lobe phong(double fraction, double exponent) {
  Lobe lobe{.reflectance = {fraction, fraction, fraction}};
  lobe.exponent = exponent;
  return lobe;
}

inline Lobe ggx(double fraction, double roughness) {
  Lobe lobe{.reflectance = {fraction, fraction, fraction}, .shape = LobeShape::ggx};
  lobe.roughness = roughness;
  return lobe;
}

/// A closed cube around a box. Faces get materials by their number: `of` changes the material of
/// face f.
template <class Change>
SceneDescription box_description(Change of, int wall = 3, int side = 1) {
  SceneDescription d = box_in_cube(wall, side).description();
  for (std::size_t f = 0; f < d.face_count(); ++f) {
    Material material = at(d.materials, d.face_material[f]);
    of(f, material);
    d.face_material[f] = static_cast<std::int32_t>(d.materials.size());
    d.materials.push_back(material);
  }
  return d;
}

template <class Change>
std::shared_ptr<const Scene> box_scene(Change of) {
  return std::make_shared<const Scene>(box_description(of));
}

/// The same with lobes that reflect next to nothing on a third of the faces.
inline std::shared_ptr<const Scene> box_with_weak_lobes() {
  return box_scene([](std::size_t f, Material& material) {
    if (f % 3 == 0) {
      material.lobe = phong(1e-200, 10);
    }
  });
}

/// The same with lobes of three kinds on about half of the faces; rho + k <= 0.8.
inline SceneDescription glossy_box_description() {
  return box_description([](std::size_t f, Material& material) {
    material.reflectance = {0.3, 0.2, 0.4};
    if (f % 4 == 1) {
      material.lobe = phong(0.4, 8);
    } else if (f % 4 == 2) {
      material.lobe = ggx(0.3, 0.6);
    } else if (f % 8 == 3) {
      material.lobe = phong(0.35, 2.5);
    }
  });
}

inline std::shared_ptr<const Scene> glossy_box() {
  return std::make_shared<const Scene>(glossy_box_description());
}

/// Without a first shot.
inline SolveOptions glossy_options(int directions) {
  return {.directions = directions, .first_shot = {}, .tolerance = 1e-13, .glossy = true};
}

inline double largest(const std::vector<Rgb>& values) {
  double result = 0;
  for (const Rgb& v : values) {
    result = std::max(result, max_abs(v));
  }
  return result;
}

/// RMS of a - b over the RMS of b - E, over channels and patches that do not emit.
inline double relative_error(const Scene& scene, const std::vector<Rgb>& a,
                             const std::vector<Rgb>& b) {
  double errors = 0, values = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (max_abs(scene.exitance(static_cast<PatchId>(i))) == 0) {
      const Rgb off = (a[i] - b[i]) * (a[i] - b[i]), value = b[i] * b[i];
      errors += off.r + off.g + off.b;
      values += value.r + value.g + value.b;
    }
  }
  return std::sqrt(errors / values);
}

inline double largest_difference(const std::vector<Rgb>& a, const std::vector<Rgb>& b) {
  double result = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    result = std::max(result, max_abs(a[i] - b[i]));
  }
  return result / largest(b);
}

}  // namespace transillum::testing
