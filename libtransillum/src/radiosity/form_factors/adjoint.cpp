// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Jacobi iteration of the adjoint equation. With g_j = dB_i/dE_j and x_j = g_j / A_j, the change
// of B_i per watt,
//   x_j = [i = j] / A_i + 1/A_j sum_k F_kj rho_k A_k x_k.
// Where A_k F_kj = A_j F_jk, this is the radiosity equation, so the iteration contracts as that
// does.
#include "transillum/adjoint.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/for_each_index.h"
#include "radiosity/form_factors/jacobi.h"
#include "transillum/at.h"
#include "transillum/errors.h"

namespace transillum {
namespace {

constexpr int max_iterations = 10'000;

/// F_kj by rising k in row j.
FormFactors transposed(const FormFactors& f) {
  const std::size_t patches = f.row_begin.size() - 1;
  FormFactors result;
  result.row_begin.assign(patches + 1, 0);
  for (const PatchId j : f.source) {
    ++at(result.row_begin, j + 1);
  }
  for (std::size_t j = 0; j < patches; ++j) {
    result.row_begin[j + 1] += result.row_begin[j];
  }
  result.source.resize(f.size());
  result.value.resize(f.size());
  std::vector<std::size_t> next(result.row_begin.begin(), result.row_begin.end() - 1);
  for (std::size_t k = 0; k < patches; ++k) {
    for (std::size_t entry = f.row_begin[k]; entry < f.row_begin[k + 1]; ++entry) {
      const std::size_t place = at(next, f.source[entry])++;
      result.source[place] = static_cast<PatchId>(k);
      result.value[place] = f.value[entry];
    }
  }
  return result;
}

/// The largest change of x, and the largest x apart from the emission of the receiver itself.
struct Sizes {
  double change = 0, largest = 0;
};

}  // namespace

Adjoint solve_adjoint(const Scene& scene, const FormFactors& form_factors, PatchId receiver,
                      const std::vector<Material>& materials, const AdjointOptions& options,
                      const Cancellation& cancellation) {
  check_form_factor_input(scene, form_factors, materials, options.patch_materials);
  check_receiver(scene, receiver);
  const FormFactors columns = transposed(form_factors);
  const auto patches = static_cast<std::size_t>(scene.patch_count());
  const double own = 1 / scene.patch(receiver).area;
  std::vector<Rgb> x(patches), next(patches), reflected(patches);
  at(x, receiver) = {own, own, own};
  WorkerThreads workers(thread_count(options.threads));
  for (int iteration = 1; iteration <= max_iterations; ++iteration) {
    for (PatchId k = 0; k < scene.patch_count(); ++k) {
      at(reflected, k) =
          scene.patch(k).area *
          (material_of_patch(scene, materials, options.patch_materials, k).reflectance * at(x, k));
    }
    for_each_index(workers, std::size_t{0}, patches, [&](std::size_t j) {
      cancellation.throw_if_canceled();
      Rgb sum;
      for (std::size_t entry = columns.row_begin[j]; entry < columns.row_begin[j + 1]; ++entry) {
        sum += columns.value[entry] * at(reflected, columns.source[entry]);
      }
      next[j] = (1 / scene.patches()[j].area) * sum;
    });
    Sizes sizes;
    for (std::size_t j = 0; j < patches; ++j) {
      sizes.largest = std::max(sizes.largest, max_abs(next[j]));
      if (static_cast<PatchId>(j) == receiver) {
        next[j] += Rgb{own, own, own};
      }
      sizes.change = std::max(sizes.change, max_abs(next[j] - x[j]));
    }
    x.swap(next);
    if (!std::isfinite(sizes.largest)) {
      break;
    }
    if (sizes.change <= options.tolerance * sizes.largest) {
      return {std::move(x), iteration};
    }
  }
  throw NotConvergent(
      "the adjoint iteration does not converge: the row sums of the form factors are too large",
      Remedy::none);
}

}  // namespace transillum
