// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "transillum/relight.h"

#include <utility>

#include "radiosity/form_factors/form_factor_input.h"
#include "radiosity/form_factors/jacobi.h"
#include "transillum/errors.h"

namespace transillum {
namespace {

void check_start(const Scene& scene, const RelightOptions& options) {
  if (!options.start.empty() && options.start.size() != scene.patches().size()) {
    throw InputError(
        "the initial radiosity belongs to another scene: the number of patches differs");
  }
}

}  // namespace

RelightResult relight(const Scene& scene, const FormFactors& form_factors,
                      const std::vector<Material>& materials, const RelightOptions& options,
                      const Cancellation& cancellation) {
  check_form_factor_input(scene, form_factors, materials, options.patch_materials);
  check_start(scene, options);
  JacobiIteration iteration(scene, form_factors, materials, options.threads,
                            options.patch_materials);
  if (options.shot && !options.shot->sources.empty()) {
    iteration.shoot_first(with_materials(*options.shot, scene, materials, options.patch_materials),
                          cancellation);
  }
  iteration.add_sky(options.sky_irradiance);
  if (!options.start.empty()) {
    iteration.b.assign(options.start.begin(), options.start.end());
  }
  iteration.run_to(options.tolerance, cancellation);
  return {std::move(iteration.b), std::move(iteration.h),
          static_cast<int>(iteration.records.size())};
}

}  // namespace transillum
