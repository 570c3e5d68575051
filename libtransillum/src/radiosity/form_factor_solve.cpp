// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "transillum/form_factors.h"

namespace transillum {

std::vector<Rgb> solve_radiosity(const Scene& scene, const FormFactors& form_factors,
                                 double tolerance) {
  constexpr int most_steps = 10'000;
  std::vector<Rgb> b;
  for (PatchId i = 0; i < scene.patch_count(); ++i) b.push_back(scene.exitance(i));
  std::vector<Rgb> next(b.size());
  for (int step = 0; step < most_steps; ++step) {
    double change = 0, largest = 0;
    for (PatchId i = 0; i < scene.patch_count(); ++i) {
      const auto row = static_cast<std::size_t>(i);
      Rgb gathered;
      for (std::size_t k = form_factors.row_begin[row]; k < form_factors.row_begin[row + 1]; ++k) {
        gathered += form_factors.value[k] * b[static_cast<std::size_t>(form_factors.source[k])];
      }
      next[row] = scene.exitance(i) + scene.reflectance(i) * gathered;
      change = std::max(change, max_abs(next[row] - b[row]));
      largest = std::max(largest, max_abs(next[row]));
    }
    b.swap(next);
    if (!std::isfinite(largest)) break;
    if (change <= tolerance * largest) return b;
  }
  throw std::runtime_error("the iteration does not converge: rows of form factors sum to too much");
}

}  // namespace transillum
