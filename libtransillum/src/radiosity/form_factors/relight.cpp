// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "transillum/relight.h"

#include <fmt/format.h>

#include <iterator>
#include <utility>

#include "radiosity/form_factors/jacobi.h"
#include "scene/build/description_check.h"

namespace transillum {
namespace {

void check(const Scene& scene, const FormFactors& form_factors,
           const std::vector<Material>& materials, const RelightOptions& options) {
  const auto patches = scene.patches().size();
  const auto start = options.start;
  const auto patch_materials = options.patch_materials;
  if (form_factors.row_begin.size() != patches + 1) {
    throw InputError("the form factors belong to another scene: the number of patches differs");
  }
  if (patch_materials.empty() && materials.size() != scene.materials().size()) {
    throw InputError("the materials belong to another scene: their number differs");
  }
  if (!patch_materials.empty() && patch_materials.size() != patches) {
    throw InputError(
        "the materials of patches belong to another scene: the number of patches differs");
  }
  for (const std::int32_t m : patch_materials) {
    if (m < 0 || m >= std::ssize(materials)) {
      throw InputError(
          fmt::format("a patch has material {}, but there are {} materials", m, materials.size()));
    }
  }
  if (!start.empty() && start.size() != patches) {
    throw InputError(
        "the initial radiosity belongs to another scene: the number of patches differs");
  }
  for (const Material& material : materials) {
    check_material(material, "");
  }
}

}  // namespace

RelightResult relight(const Scene& scene, const FormFactors& form_factors,
                      const std::vector<Material>& materials, const RelightOptions& options,
                      const Cancellation& cancellation) {
  check(scene, form_factors, materials, options);
  JacobiIteration iteration(scene, form_factors, materials, options.threads,
                            options.patch_materials);
  if (options.shot && !options.shot->sources.empty()) {
    iteration.shoot_first(with_materials(*options.shot, scene, materials, options.patch_materials),
                          cancellation);
  }
  if (!options.start.empty()) {
    iteration.b.assign(options.start.begin(), options.start.end());
  }
  iteration.run_to(options.tolerance, cancellation);
  return {std::move(iteration.b), std::move(iteration.h),
          static_cast<int>(iteration.records.size())};
}

}  // namespace transillum
