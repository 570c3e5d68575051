// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <cstddef>
#include <vector>

#include "radiosity/exchange/patch_share.h"
#include "transillum/transfers.h"

namespace transillum {

/// Areas summed over passes, m², one per patch. A(i,j,omega) is the area of patch j that patch i
/// sees along omega, on the transillumination plane.
struct VisibleAreaSums {
  /// sum_d sum_j A(i,j,omega_d); of a linear basis one per unknown, sum_d sum_j T^a0(i,j,omega_d)
  std::vector<double> rows;
  /// sum_d sum_i A(i,j,omega_d), or T^0b(i,j,omega_d); two-way: 0, `rows` is the same
  std::vector<double> columns;
  std::vector<double> projected;  ///< sum_d A_i max(n_i·omega_d, 0)
  std::vector<double> uncovered;  ///< the part of `projected` with no patch above
  int passes = 0;                 ///< number of passes summed

  /// @param per_patch unknowns per patch
  VisibleAreaSums(std::size_t patches, std::size_t per_patch)
      : rows(per_patch * patches),
        columns(per_patch * patches),
        projected(patches),
        uncovered(patches) {}
  /// @param share the patches of the coverages; the sums of others are right after complete()
  void add(const Transfers& transfers, bool two_way, const PatchShare& share) {
    for (std::size_t i = share.first(); i < share.last(); ++i) {
      const Coverage& forward = transfers.forward[i - share.first()];
      const Coverage& backward = transfers.backward[i - share.first()];
      projected[i] += forward.projected;
      uncovered[i] += forward.uncovered();
      if (two_way) {
        projected[i] += backward.projected;
        uncovered[i] += backward.uncovered();
      }
    }
    ++passes;
    if (rows.size() > projected.size()) {
      add_moments(transfers, two_way);
      return;
    }
    for (const Transfer& t : transfers.exchanges) {
      const auto i = static_cast<std::size_t>(t.receiver);
      const auto j = static_cast<std::size_t>(t.source);
      rows[i] += t.area;
      (two_way ? rows : columns)[j] += t.area;
    }
  }
  void complete(const PatchShare& share) {
    for (std::vector<double>* areas : {&rows, &columns, &projected, &uncovered}) {
      share.complete(*areas);
    }
  }
  /// For StateOutput and StateInput.
  template <class Archive, class Self>
  static void visit_state(Archive& archive, Self& self) {
    archive.fixed(self.rows, self.columns, self.projected, self.uncovered);
    archive(self.passes);
    archive.require(self.passes >= 0);
  }

 private:
  void add_moments(const Transfers& transfers, bool two_way) {
    const std::size_t per_patch = rows.size() / projected.size();
    for (std::size_t k = 0; k < transfers.exchanges.size(); ++k) {
      const Transfer& t = transfers.exchanges[k];
      const std::size_t u = per_patch * static_cast<std::size_t>(t.receiver);
      const std::size_t v = per_patch * static_cast<std::size_t>(t.source);
      for (std::size_t a = 0; a < per_patch; ++a) {
        rows[u + a] += transfers.moments[k].of(a, 0);
        (two_way ? rows : columns)[v + a] += transfers.moments[k].of(0, a);
      }
    }
  }
};

}  // namespace transillum
