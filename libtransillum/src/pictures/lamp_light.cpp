// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "pictures/lamp_light.h"

#include <algorithm>
#include <functional>
#include <map>
#include <set>
#include <utility>

#include "pictures/surface_rays.h"
#include "transillum/at.h"
#include "transillum/glossy.h"

namespace transillum {
namespace {

std::vector<PatchId> emitting_patches(const Scene& scene) {
  std::vector<PatchId> patches;
  for (PatchId i = 0; i < scene.patch_count(); ++i) {
    if (max_abs(scene.exitance(i)) > 0) {
      patches.push_back(i);
    }
  }
  return patches;
}

/// An emitting face.
struct Face {
  double power = 0;     ///< W / pi
  double exitance = 0;  ///< W/m²
};

/// The mean irradiance of what reflects, in the brightest channel, W/m².
double mean_irradiance(const Solution& solution) {
  double sum = 0, area = 0;
  for (PatchId i = 0; i < solution.scene->patch_count(); ++i) {
    const Rgb reflected = at(solution.radiosity, i) - solution.scene->exitance(i);
    const Rgb rho = reflectance_of(solution, i);
    double irradiance = -1;
    for (const auto& [b, part] :
         {std::pair{reflected.r, rho.r}, {reflected.g, rho.g}, {reflected.b, rho.b}}) {
      irradiance = part > 0 ? std::max(irradiance, b / part) : irradiance;
    }
    if (irradiance >= 0) {
      sum += solution.scene->patch(i).area * irradiance;
      area += solution.scene->patch(i).area;
    }
  }
  return area > 0 ? sum / area : 0;
}

/// The first patches of the faces that are treated as lamps: as many as a picture can afford, the
/// most powerful first, and none that only the last 1/10,000 of the power comes from. Of more than
/// a few, those that are not much brighter than what reflects light are gathered like that, with as
/// little noise: a sphere of faces that serves as a sky.
std::set<PatchId> lamps_among(const std::map<PatchId, Face>& faces, const Solution& solution) {
  constexpr std::size_t few = 64, most = 512;
  constexpr double least = 1e-4, contrast = 4;
  const double dim = faces.size() > few ? contrast * mean_irradiance(solution) : 0;
  double left = 0;
  std::vector<std::pair<double, PatchId>> by_power;
  for (const auto& [patch, face] : faces) {
    left += face.power;
    if (face.exitance > dim) {
      by_power.emplace_back(-face.power, patch);
    }
  }
  std::sort(by_power.begin(), by_power.end());
  const double negligible = least * left;
  std::set<PatchId> chosen;
  for (const auto& [power, patch] : by_power) {
    if (chosen.size() == most || left <= negligible) {
      break;
    }
    chosen.insert(patch);
    left += power;
  }
  return chosen;
}

}  // namespace

Rgb reflectance_of(const Solution& solution, PatchId patch) {
  const Rgb& diffuse = solution.scene->reflectance(patch);
  return solution.glossy ? diffuse + used_lobe(solution.scene->material(patch)).reflectance
                         : diffuse;
}

LampLight::LampLight(const Solution& solution, const EmbreeScene& embree,
                     const Cancellation& cancellation)
    : scene_(solution.scene),
      embree_(embree),
      sun_irradiance_(solution.sky.sun.irradiance),
      finder_(*scene_, cancellation),
      lamps_(finder_.lamps(emitting_patches(*scene_))) {
  if (solution.sky.sun.is_set()) {
    sun_rays_ = rays_of(solution.sky.sun);
  }
  // Parts of one patch stay together.
  std::map<PatchId, Face> faces;
  for (const LampPolygon& lamp : lamps_) {
    Face& face = faces[lamp.patches.front()];
    face.exitance = max_abs(lamp.exitance);
    face.power += norm(area_vector(lamp.outline)) * face.exitance;
  }
  const std::set<PatchId> chosen = lamps_among(faces, solution);
  double all = 0, exact = 0;
  for (const auto& [patch, face] : faces) {
    all += face.power;
    exact += chosen.contains(patch) ? face.power : 0;
  }
  gathered_part_ = all > 0 ? 1 - exact / all : 0;
  gathered_count_ = static_cast<int>(faces.size() - chosen.size());
  std::erase_if(lamps_,
                [&](const LampPolygon& lamp) { return !chosen.contains(lamp.patches.front()); });
  for (const LampPolygon& lamp : lamps_) {
    patches_.insert(patches_.end(), lamp.patches.begin(), lamp.patches.end());
  }
  std::sort(patches_.begin(), patches_.end());
  patches_.erase(std::unique(patches_.begin(), patches_.end()), patches_.end());
}

LampLight::Views& LampLight::views_of(PatchId patch, const Cancellation& cancellation) const {
  // Past more blockers than this, finding the blockers of single points is faster.
  constexpr std::size_t most_blockers = 12;
  constexpr std::size_t most_patches = 256;
  ViewsByPatch& views = views_.local();
  if (const auto found = views.find(patch); found != views.end()) {
    return found->second;
  }
  if (views.size() >= most_patches) {
    views.clear();
  }
  Views of_patch;
  for (const LampPolygon& lamp : lamps_) {
    cancellation.throw_if_canceled();
    if (std::optional<PointView> view = finder_.view_of(lamp, patch)) {
      if (view->blocker_count() > most_blockers) {
        view.reset();
      }
      of_patch.push_back({&lamp, std::move(view)});
    }
  }
  return views[patch] = std::move(of_patch);
}

Rgb LampLight::at_point(PatchId patch, const Vec3& x, const Cancellation& cancellation) const {
  const std::function<void()> tick = [&] { cancellation.throw_if_canceled(); };
  const Vec3 scaled = finder_.scale() * x;
  const Vec3& normal = scene_->patch(patch).normal;
  Rgb sum;
  for (View& view : views_of(patch, cancellation)) {
    cancellation.throw_if_canceled();
    if (view.shared) {
      sum += view.shared->form_factor(scaled, normal, tick) * view.lamp->exitance;
    } else if (auto own = finder_.view_from(scaled, *view.lamp)) {
      sum += own->form_factor(scaled, normal, tick) * view.lamp->exitance;
    }
  }
  visit_sun(patch, x, [&sum](const Vec3&, const Rgb& irradiance) { sum += irradiance; });
  return sum;
}

void LampLight::visit_sun(PatchId patch, const Vec3& x, const SunVisit& visit) const {
  if (sun_rays_.empty()) {
    return;
  }
  const Vec3& normal = scene_->patch(patch).normal;
  const Vec3 start = start_of_rays(embree_, x, normal);
  for (const SunRay& ray : sun_rays_) {
    const double cosine = dot(normal, ray.direction);
    if (cosine > 0 && met_by(embree_, start, ray.direction).patch == no_patch) {
      visit(ray.direction, ray.weight * cosine * sun_irradiance_);
    }
  }
}

}  // namespace transillum
