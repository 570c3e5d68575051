// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "radiosity/error/light_directions.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "radiosity/channel_sums.h"
#include "radiosity/light_sources.h"
#include "radiosity/ratio.h"
#include "transillum/at.h"
#include "transillum/glossy.h"
#include "transillum/solution.h"

namespace transillum {
namespace {

constexpr std::size_t most_pairs = std::size_t{1} << 22;

/// Whether any patch that does not emit reflects: then errors are measured on such patches only
/// (ReflectedLight).
bool reflects_without_emission(const Scene& scene, const std::vector<Rgb>& reflectance) {
  for (PatchId i = 0; i < scene.patch_count(); ++i) {
    if (max_abs(scene.exitance(i)) == 0 && max_abs(at(reflectance, i)) > 0) {
      return true;
    }
  }
  return false;
}

/// Light that a source brings to a patch where nothing is between them.
struct UnmetLight {
  Rgb light;               ///< B of the patch, W/m²
  double solid_angle = 0;  ///< solid angle of the directions along which both overlap, sr
};

/// @param reflectance of the receiver
UnmetLight light_between(const Scene& scene, PatchId receiver, const Rgb& reflectance,
                         const LightSource& source) {
  const Patch& i = scene.patch(receiver);
  UnmetLight between;
  double facing = 0, seen = 0, nearest = HUGE_VAL;
  for (const PatchId k : source.patches) {
    const Patch& j = scene.patch(k);
    const Vec3 way = j.center - i.center;
    const double square = dot(way, way), toward = dot(way, i.normal), from = -dot(way, j.normal);
    if (k == receiver || !(toward > 0 && from > 0)) {
      continue;
    }
    const double distance = std::sqrt(square);
    const double owned = j.area * toward * from / (std::numbers::pi * square * square);
    between.light += std::min(owned, 1.0) * reflectance * scene.exitance(k);
    facing = std::max(facing, i.area * toward / distance);
    seen += j.area * from / distance;
    nearest = std::min(nearest, square);
  }
  between.solid_angle = std::pow(std::sqrt(facing) + std::sqrt(seen), 2) / nearest;
  return between;
}

}  // namespace

std::vector<PatchId> uncertain_patches(const Solution& solution) {
  const Scene& scene = *solution.scene;
  const ErrorEstimate& error = solution.error;
  const SolveStatistics& statistics = solution.statistics;
  const std::vector<LightSource> sources = light_sources(scene);
  std::vector<PatchId> uncertain;
  constexpr double all_shot = 0.999;
  if (error.replicas == 0 || statistics.shot_power_fraction > all_shot ||
      sources.size() * scene.patches().size() > most_pairs) {
    return uncertain;
  }
  const double per_steradian = statistics.directions / (error.replicas * 4 * std::numbers::pi);
  for (PatchId i = 0; i < scene.patch_count(); ++i) {
    const Rgb reflectance = solution.glossy == nullptr
                                ? scene.reflectance(i)
                                : scene.reflectance(i) + used_lobe(scene.material(i)).reflectance;
    Rgb unmet;
    for (const LightSource& source : sources) {
      const UnmetLight between = light_between(scene, i, reflectance, source);
      if (between.solid_angle * per_steradian < least_light_directions) {
        unmet += between.light;
      }
    }
    const Rgb& standard_error = at(error.standard_error, i);
    if (largest_ratio(unmet, channel_units(standard_error)) > 0.5 * error.quantile ||
        (max_abs(standard_error) == 0 && max_abs(unmet) > 0)) {
      uncertain.push_back(i);
    }
  }
  return uncertain;
}

LightDirections::LightDirections(const Scene& scene, bool two_way, const DirectLight& shot,
                                 const std::vector<Rgb>& reflectance)
    : two_way_(two_way),
      weight_(scene.patches().size()),
      exitance_(scene.patches().size()),
      emits_(scene.patches().size()),
      column_(scene.patches().size()) {
  const bool others_reflect = reflects_without_emission(scene, reflectance);
  for (PatchId i = 0; i < scene.patch_count(); ++i) {
    const Rgb unshot = scene.exitance(i) - at(shot.exitance, i);
    const bool measured = !others_reflect || !(max_abs(scene.exitance(i)) > 0);
    const Rgb per_area = (1 / scene.patch(i).area) * at(reflectance, i);
    at(weight_, i) = measured ? per_area * per_area : Rgb{};
    at(exitance_, i) = sum(unshot);
    at(emits_, i) = at(exitance_, i) > 0 ? 1 : 0;
  }
  const std::vector<LightSource> sources = light_sources(scene);
  columns_ = std::clamp(most_pairs / exitance_.size(), std::size_t{1},
                        std::max(sources.size(), std::size_t{1}));
  for (std::size_t s = 0; s < sources.size(); ++s) {
    for (const PatchId j : sources[s].patches) {
      at(column_, j) = s % columns_;
    }
  }
  lights_.resize(exitance_.size() * columns_);
  color_.resize(columns_);
  for (PatchId i = 0; i < scene.patch_count(); ++i) {
    at(color_, at(column_, i)) += scene.patch(i).area * (scene.exitance(i) - at(shot.exitance, i));
  }
  for (Rgb& color : color_) {
    color = ratio_or_zero(3, sum(color)) * color;
  }
}

void LightDirections::receive(PatchId receiver, PatchId source, double area) {
  const double light = area * at(exitance_, source);
  if (light > 0) {
    const std::size_t k = static_cast<std::size_t>(receiver) * columns_ + at(column_, source);
    if (lights_[k].along == 0) {
      lit_.push_back(k);
    }
    lights_[k].along += light;
  }
}

/// A patch faces one of the two directions of a pass only, so its light along a pass is that along
/// one direction.
void LightDirections::add(const std::vector<Transfer>& exchanges) {
  for (const Transfer& t : exchanges) {
    if (at(emits_, t.source) != 0) {
      receive(t.receiver, t.source, t.area);
    }
    if (two_way_ && at(emits_, t.receiver) != 0) {
      receive(t.source, t.receiver, t.area);
    }
  }
  for (const std::size_t k : lit_) {
    Light& light = lights_[k];
    light.sum += light.along;
    light.squares += light.along * light.along;
    light.along = 0;
  }
  lit_.clear();
}

void LightDirections::complete(const OwnedPatches& owned) { owned.complete(lights_); }

/// The variance of what a pair contributes to B is proportional to w squares = w sum² / n.
double LightDirections::mean_of(double Rgb::*channel) const {
  double sums = 0, squares = 0;
  for (std::size_t k = 0; k < lights_.size(); ++k) {
    const double color = color_[k % columns_].*channel;
    const double weight = weight_[k / columns_].*channel * color * color;
    sums += weight * lights_[k].sum * lights_[k].sum;
    squares += weight * lights_[k].squares;
  }
  return ratio_or_zero(sums, squares);
}

double LightDirections::mean() const {
  double fewest = HUGE_VAL;
  for (const auto channel : channels_of_rgb) {
    if (const double mean = mean_of(channel); mean > 0) {
      fewest = std::min(fewest, mean);
    }
  }
  return std::isfinite(fewest) ? fewest : 0;
}

}  // namespace transillum
