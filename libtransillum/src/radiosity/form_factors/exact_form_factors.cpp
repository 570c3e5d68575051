// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "transillum/pair_form_factors.h"

#include "transillum/at.h"
#include "visibility/pairs/patch_exchange.h"

namespace transillum {

std::vector<double> exact_form_factors(const Scene& scene, PatchId i,
                                       const Cancellation& cancellation,
                                       const std::function<void(double)>& progress) {
  const ExchangeFinder exchange(scene, cancellation);
  const double area = scene.patch(i).area;
  std::vector<double> factors(scene.patches().size());
  const std::function<void()> check = [&] { cancellation.throw_if_canceled(); };
  for (PatchId j = 0; j < scene.patch_count(); ++j) {
    check();
    if (j != i) {
      at(factors, j) = exchange(i, j, check).area / area;
    }
    if (progress && j % 64 == 0) {
      progress(static_cast<double>(j) / scene.patch_count());
    }
  }
  return factors;
}

}  // namespace transillum
