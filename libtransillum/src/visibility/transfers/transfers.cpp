// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "transillum/transfers.h"

#include <algorithm>
#include <cmath>

#include "transillum/at.h"

namespace transillum {

PassCounts& PassCounts::operator+=(const PassCounts& other) {
  pairs += other.pairs;
  cuts += other.cuts;
  decisions += other.decisions;
  exact_decisions += other.exact_decisions;
  exact_queries += other.exact_queries;
  pixels += other.pixels;
  missed += other.missed;
  seconds_order += other.seconds_order;
  seconds_bins += other.seconds_bins;
  seconds_clip += other.seconds_clip;
  return *this;
}

ClosureDefect closure_defect(const Transfers& transfers, const Scene& scene) {
  // Below this share of its area a patch is treated as grazing (ALGORITHM.md, oracle 1).
  constexpr double grazing_share = 1e-6;
  ClosureDefect defect;
  for (const auto* side : {&transfers.forward, &transfers.backward}) {
    for (PatchId i = 0; i < scene.patch_count(); ++i) {
      const Coverage& coverage = at((*side), i);
      if (coverage.projected == 0) {
        continue;
      }
      const double open = std::abs(coverage.projected - coverage.covered);
      const double area = scene.patch(i).area;
      if (coverage.projected < grazing_share * area) {
        defect.grazing = std::max(defect.grazing, open / area);
      } else if (open / coverage.projected > defect.relative) {
        defect.relative = open / coverage.projected;
        defect.worst = i;
      }
    }
  }
  return defect;
}

}  // namespace transillum
