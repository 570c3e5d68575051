// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "radiosity/form_factors/jacobi.h"

#include <fmt/format.h>

#include "radiosity/linear_solution.h"
#include "scene/build/description_check.h"
#include "transillum/at.h"
#include "transillum/errors.h"

namespace transillum {

void check_form_factor_input(const Scene& scene, const FormFactors& form_factors,
                             const std::vector<Material>& materials,
                             std::span<const std::int32_t> patch_materials) {
  const auto patches = scene.patches().size();
  if (form_factors.row_begin.size() != patches + 1) {
    throw InputError("the form factors belong to another scene: the number of patches differs");
  }
  if (!form_factors.moments.empty() && form_factors.moments.size() != form_factors.size()) {
    throw InputError(fmt::format("{} moments for {} form factors", form_factors.moments.size(),
                                 form_factors.size()));
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
  for (const Material& material : materials) {
    check_material(material, "");
  }
}

std::size_t unknowns_of_patch(const FormFactors& form_factors, Basis basis) {
  if (basis == Basis::constant) {
    return 1;
  }
  if (form_factors.moments.size() != form_factors.size()) {
    throw InputError("the form factors have no moments for linear functions");
  }
  return linear_unknowns;
}

void check_receiver(const Scene& scene, PatchId patch) {
  if (patch < 0 || patch >= scene.patch_count()) {
    throw InputError(
        fmt::format("patch {} does not exist: the scene has {}", patch, scene.patch_count()));
  }
}

const Material& material_of_patch(const Scene& scene, const std::vector<Material>& materials,
                                  std::span<const std::int32_t> patch_materials, PatchId patch) {
  return at(materials,
            patch_materials.empty() ? scene.patch(patch).material : at(patch_materials, patch));
}

}  // namespace transillum
