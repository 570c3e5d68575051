// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "pictures/lamp_light.h"

#include <algorithm>
#include <map>
#include <set>
#include <utility>

#include "transillum/at.h"

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

/// The first patches of the faces that are treated as lamps: as many as a picture can afford, the
/// most powerful first, and none that only the last 1/10,000 of the power comes from.
std::set<PatchId> brightest(const std::map<PatchId, double>& power_of) {
  constexpr std::size_t most = 512;
  constexpr double least = 1e-4;
  double left = 0;
  std::vector<std::pair<double, PatchId>> by_power;
  for (const auto& [patch, power] : power_of) {
    by_power.emplace_back(-power, patch);
    left += power;
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

LampLight::LampLight(std::shared_ptr<const Scene> scene, const Cancellation& cancellation)
    : scene_(std::move(scene)),
      finder_(*scene_, cancellation),
      lamps_(finder_.lamps(emitting_patches(*scene_))) {
  // Parts of one patch stay together.
  std::map<PatchId, double> power_of;
  for (const LampPolygon& lamp : lamps_) {
    power_of[lamp.patches.front()] += norm(area_vector(lamp.outline)) * max_abs(lamp.exitance);
  }
  const std::set<PatchId> chosen = brightest(power_of);
  gathered_count_ = static_cast<int>(power_of.size() - chosen.size());
  std::erase_if(lamps_,
                [&](const LampPolygon& lamp) { return !chosen.contains(lamp.patches.front()); });
  for (const LampPolygon& lamp : lamps_) {
    patches_.insert(patches_.end(), lamp.patches.begin(), lamp.patches.end());
  }
  std::sort(patches_.begin(), patches_.end());
  patches_.erase(std::unique(patches_.begin(), patches_.end()), patches_.end());
}

LampLight::Views& LampLight::views_of(PatchId patch) const {
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
  Views& of_patch = views[patch];
  for (const LampPolygon& lamp : lamps_) {
    if (std::optional<PointView> view = finder_.view_of(lamp, patch)) {
      if (view->blocker_count() > most_blockers) {
        view.reset();
      }
      of_patch.push_back({&lamp, std::move(view)});
    }
  }
  return of_patch;
}

Rgb LampLight::at_point(PatchId patch, const Vec3& x) const {
  const Vec3 scaled = finder_.scale() * x;
  const Vec3& normal = scene_->patch(patch).normal;
  Rgb sum;
  for (View& view : views_of(patch)) {
    if (view.shared) {
      sum += view.shared->form_factor(scaled, normal) * view.lamp->exitance;
    } else if (auto own = finder_.view_from(scaled, *view.lamp)) {
      sum += own->form_factor(scaled, normal) * view.lamp->exitance;
    }
  }
  return sum;
}

}  // namespace transillum
