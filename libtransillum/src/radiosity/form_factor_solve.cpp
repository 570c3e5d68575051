// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "radiosity/jacobi.h"

namespace transillum {
namespace {

constexpr const char* divergent =
    "the iteration does not converge: rows of form factors sum to too much";

}  // namespace

void JacobiIteration::run(const Scene& scene, const FormFactors& form_factors, int most,
                          double tolerance, const Cancellation& cancellation) {
  using Clock = std::chrono::steady_clock;
  b.clear();
  for (PatchId i = 0; i < scene.patch_count(); ++i) b.push_back(scene.exitance(i));
  h.assign(b.size(), {});
  std::vector<Rgb> next(b.size());
  double last_change = 0;
  while (!converged && static_cast<int>(steps.size()) < most) {
    const auto start = Clock::now();
    double change = 0, largest = 0;
    for (PatchId i = 0; i < scene.patch_count(); ++i) {
      if (i % 64 == 0) cancellation.throw_if_cancelled();
      const auto row = static_cast<std::size_t>(i);
      Rgb gathered;
      for (std::size_t k = form_factors.row_begin[row]; k < form_factors.row_begin[row + 1]; ++k) {
        gathered += form_factors.value[k] * b[static_cast<std::size_t>(form_factors.source[k])];
      }
      h[row] = gathered;
      next[row] = scene.exitance(i) + scene.reflectance(i) * gathered;
      change = std::max(change, max_abs(next[row] - b[row]));
      largest = std::max(largest, max_abs(next[row]));
    }
    b.swap(next);
    if (!std::isfinite(largest)) throw std::runtime_error(divergent);
    IterationRecord record;
    record.change = largest > 0 ? change / largest : 0;
    record.contraction = steps.empty() || last_change == 0 ? 0 : change / last_change;
    record.seconds = std::chrono::duration<double>(Clock::now() - start).count();
    steps.push_back(record);
    last_change = change;
    converged = change <= tolerance * largest;
  }
}

std::vector<Rgb> solve_radiosity(const Scene& scene, const FormFactors& form_factors,
                                 double tolerance) {
  constexpr int most_steps = 10'000;
  JacobiIteration iteration;
  iteration.run(scene, form_factors, most_steps, tolerance, {});
  if (!iteration.converged) throw std::runtime_error(divergent);
  return std::move(iteration.b);
}

}  // namespace transillum
