// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "transillum/relight.h"

#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/info.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "scene/description_check.h"

namespace transillum {
namespace {

void check(const Scene& scene, const FormFactors& form_factors,
           const std::vector<Material>& materials, std::span<const Rgb> start) {
  const auto patches = static_cast<std::size_t>(scene.patch_count());
  if (form_factors.row_begin.size() != patches + 1) {
    throw InputError("the form factors are of another scene: they have other patches");
  }
  if (materials.size() != scene.materials().size()) {
    throw InputError("the materials are of another scene: there are more or fewer");
  }
  if (!start.empty() && start.size() != patches) {
    throw InputError("the radiosity to start from is of another scene: it has other patches");
  }
  for (const Material& material : materials) check_material(material, "");
}

/// sum_j F_ij B_j
Rgb gather(const FormFactors& form_factors, std::size_t row, const std::vector<Rgb>& b) {
  Rgb gathered;
  for (std::size_t k = form_factors.row_begin[row]; k < form_factors.row_begin[row + 1]; ++k) {
    gathered += form_factors.value[k] * b[static_cast<std::size_t>(form_factors.source[k])];
  }
  return gathered;
}

}  // namespace

Relit relight(const Scene& scene, const FormFactors& form_factors,
              const std::vector<Material>& materials, const RelightOptions& options,
              const Cancellation& cancellation) {
  constexpr int most_steps = 10'000;
  check(scene, form_factors, materials, options.start);
  const auto material_of = [&](PatchId i) -> const Material& {
    return materials[static_cast<std::size_t>(scene.patch(i).material)];
  };
  std::vector<Rgb> b(options.start.begin(), options.start.end());
  if (b.empty()) {
    for (PatchId i = 0; i < scene.patch_count(); ++i) b.push_back(material_of(i).exitance);
  }
  Relit relit{std::vector<Rgb>(b.size()), std::vector<Rgb>(b.size()), 0};
  const int threads = options.threads > 0 ? options.threads : tbb::info::default_concurrency();
  const tbb::global_control permission(tbb::global_control::max_allowed_parallelism,
                                       static_cast<std::size_t>(threads));
  tbb::task_arena arena(threads);
  while (relit.steps < most_steps) {
    cancellation.throw_if_cancelled();
    ++relit.steps;
    arena.execute([&] {
      tbb::parallel_for(PatchId{0}, scene.patch_count(), [&](PatchId i) {
        const auto row = static_cast<std::size_t>(i);
        const Material& material = material_of(i);
        relit.irradiance[row] = gather(form_factors, row, b);
        relit.radiosity[row] = material.exitance + material.reflectance * relit.irradiance[row];
      });
    });
    double change = 0, largest = 0;
    for (std::size_t i = 0; i < b.size(); ++i) {
      change = std::max(change, max_abs(relit.radiosity[i] - b[i]));
      largest = std::max(largest, max_abs(relit.radiosity[i]));
    }
    if (!std::isfinite(largest)) break;
    if (change <= options.tolerance * largest) return relit;
    b.swap(relit.radiosity);
  }
  throw std::runtime_error("the iteration does not converge: rows of form factors sum to too much");
}

}  // namespace transillum
