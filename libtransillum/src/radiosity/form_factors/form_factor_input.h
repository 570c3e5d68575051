// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "transillum/form_factors.h"
#include "transillum/scene.h"

namespace transillum {

/// Checks what is solved with given form factors.
/// @param patch_materials index into `materials` for each patch; empty: Patch::material
/// @throws InputError where a list does not fit the scene or a material is out of range
void check_form_factor_input(const Scene& scene, const FormFactors& form_factors,
                             const std::vector<Material>& materials,
                             std::span<const std::int32_t> patch_materials);

/// @throws InputError unless `patch` is one of the scene's.
void check_receiver(const Scene& scene, PatchId patch);

/// The material of a patch, from lists that check_form_factor_input() has accepted.
const Material& material_of_patch(const Scene& scene, const std::vector<Material>& materials,
                                  std::span<const std::int32_t> patch_materials, PatchId patch);

}  // namespace transillum
