// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <cstddef>
#include <vector>

#include "radiosity/exchange/owned_patches.h"
#include "radiosity/exchange/unknowns.h"
#include "transillum/at.h"
#include "transillum/transfers.h"

namespace transillum {

/// Areas summed over passes, m², one per patch. T^00(i,j,omega) is the area of patch j that patch i
/// sees along omega, on the transillumination plane.
struct VisibleAreaSums {
  /// sum_d sum_j T^a0(i,j,omega_d), one per unknown
  std::vector<double> rows;
  /// sum_d sum_i T^0b(i,j,omega_d), one per unknown; two-way: 0, `rows` is the same
  std::vector<double> columns;
  std::vector<double> projected;  ///< sum_d A_i max(n_i·omega_d, 0)
  std::vector<double> uncovered;  ///< the part of `projected` with no patch above
  int passes = 0;                 ///< number of passes summed
  std::size_t per_patch;          ///< unknowns per patch

  VisibleAreaSums(std::size_t patches, std::size_t unknowns_per_patch)
      : rows(unknowns_per_patch * patches),
        columns(rows.size()),
        projected(patches),
        uncovered(patches),
        per_patch(unknowns_per_patch) {}
  /// @param share the patches of the coverages; the sums of others are right after complete()
  void add(const Transfers& transfers, bool two_way, const OwnedPatches& owned) {
    for (std::size_t i = owned.first(); i < owned.last(); ++i) {
      const Coverage& forward = transfers.forward[i - owned.first()];
      const Coverage& backward = transfers.backward[i - owned.first()];
      projected[i] += forward.projected;
      uncovered[i] += forward.uncovered();
      if (two_way) {
        projected[i] += backward.projected;
        uncovered[i] += backward.uncovered();
      }
    }
    ++passes;
    std::vector<double>& sent = two_way ? rows : columns;
    for_each_exchange(transfers, per_patch, [&](const Transfer& t, PatchId a, PatchId b) {
      if (b == 0) {
        at(rows, t.receiver) += t.area;
      }
      if (a == 0) {
        at(sent, t.source) += t.area;
      }
    });
  }
  void complete(const OwnedPatches& owned) {
    for (std::vector<double>* areas : {&rows, &columns, &projected, &uncovered}) {
      owned.complete(*areas);
    }
  }
  /// For StateOutput and StateInput.
  template <class Archive, class Self>
  static void visit_state(Archive& archive, Self& self) {
    archive.fixed(self.rows, self.columns, self.projected, self.uncovered);
    archive(self.passes);
    archive.require(self.passes >= 0);
  }
};

}  // namespace transillum
