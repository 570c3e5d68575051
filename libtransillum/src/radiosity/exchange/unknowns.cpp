// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "radiosity/exchange/unknowns.h"

#include "transillum/at.h"
#include "transillum/errors.h"

namespace transillum {

Unknowns::Unknowns(const Scene& scene, Basis basis, const DirectLight& shot, const SunLight& sun)
    : per_patch(basis == Basis::linear ? 3 : 1) {
  const bool is_shot = !shot.sources.empty();
  if (per_patch > 1 && is_shot && shot.linear_terms.empty()) {
    throw InputError("the first shot was made for constant functions: it has no linear parts");
  }
  const std::size_t all = per_patch * scene.patches().size();
  area.reserve(all);
  exitance.reserve(all);
  reflectance.reserve(all);
  shot_exitance.reserve(all);
  given_irradiance.reserve(all);
  for (PatchId i = 0; i < scene.patch_count(); ++i) {
    for (std::size_t a = 0; a < per_patch; ++a) {
      area.push_back(scene.patch(i).area);
      exitance.push_back(a == 0 ? scene.exitance(i) : Rgb{});
      reflectance.push_back(scene.reflectance(i));
      shot_exitance.push_back(a == 0 ? at(shot.exitance, i) : Rgb{});
    }
    given_irradiance.push_back(at(shot.irradiance, i));
    if (per_patch > 1) {
      const LinearTerm part = is_shot ? at(shot.linear_terms, i) : LinearTerm();
      given_irradiance.insert(given_irradiance.end(), {part.first, part.second});
    }
  }
  for (std::size_t i = 0; i < sun.irradiance.size(); ++i) {
    sun_irradiance.push_back(sun.irradiance[i]);
    if (per_patch > 1) {
      const LinearTerm& part = sun.linear_terms[i];
      sun_irradiance.insert(sun_irradiance.end(), {part.first, part.second});
    }
  }
  for (std::size_t u = 0; u < sun_irradiance.size(); ++u) {
    given_irradiance[u] += sun_irradiance[u];
  }
}

std::vector<Rgb> Unknowns::means(const std::vector<Rgb>& values) const {
  if (per_patch == 1) {
    return values;
  }
  std::vector<Rgb> means;
  means.reserve(values.size() / per_patch);
  for (std::size_t u = 0; u < values.size(); u += per_patch) {
    means.push_back(values[u]);
  }
  return means;
}

}  // namespace transillum
