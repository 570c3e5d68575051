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

namespace {

/// The largest difference of projected and covered moments, over the projected area, of patches at
/// no grazing angle.
double moment_defect(const std::vector<Coverage>& coverages,
                     const std::vector<CoverageMoments>& moments, const Scene& scene,
                     double grazing_fraction) {
  double largest = 0;
  for (std::size_t i = 0; i < moments.size(); ++i) {
    const double projected = coverages[i].projected;
    if (projected < grazing_fraction * scene.patches()[i].area || projected == 0) {
      continue;
    }
    for (std::size_t a = 0; a < 2; ++a) {
      const double open = std::abs(moments[i].projected[a] - moments[i].covered[a]);
      largest = std::max(largest, open / projected);
    }
  }
  return largest;
}

}  // namespace

ClosureDefect closure_defect(const Transfers& transfers, const Scene& scene) {
  // Below this fraction of its area a patch is treated as grazing (ALGORITHM.md, oracle 1).
  constexpr double grazing_fraction = 1e-6;
  ClosureDefect defect;
  for (const auto* side : {&transfers.forward, &transfers.backward}) {
    for (PatchId i = 0; i < scene.patch_count(); ++i) {
      const Coverage& coverage = at((*side), i);
      if (coverage.projected == 0) {
        continue;
      }
      const double open = std::abs(coverage.projected - coverage.covered);
      const double area = scene.patch(i).area;
      if (coverage.projected < grazing_fraction * area) {
        defect.grazing = std::max(defect.grazing, open / area);
      } else if (open / coverage.projected > defect.relative) {
        defect.relative = open / coverage.projected;
        defect.worst = i;
      }
    }
  }
  defect.moments = std::max(
      moment_defect(transfers.forward, transfers.forward_moments, scene, grazing_fraction),
      moment_defect(transfers.backward, transfers.backward_moments, scene, grazing_fraction));
  return defect;
}

}  // namespace transillum
