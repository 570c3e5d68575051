// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <cstddef>
#include <vector>

#include "transillum/transfers.h"

namespace transillum {

/// Areas summed over passes, m², one per patch. A(i,j,omega) is the area of patch j that patch i
/// sees along omega, on the transillumination plane.
struct VisibleAreaSums {
  std::vector<double> rows;       ///< sum_d sum_j A(i,j,omega_d)
  std::vector<double> columns;    ///< sum_d sum_i A(i,j,omega_d); two-way: 0, `rows` is the same
  std::vector<double> projected;  ///< sum_d A_i max(n_i·omega_d, 0)
  std::vector<double> uncovered;  ///< the part of `projected` with no patch above
  int passes = 0;                 ///< number of passes summed

  explicit VisibleAreaSums(std::size_t patches)
      : rows(patches), columns(patches), projected(patches), uncovered(patches) {}
  void add(const Transfers& transfers, bool two_way) {
    for (std::size_t i = 0; i < projected.size(); ++i) {
      projected[i] += transfers.forward[i].projected;
      uncovered[i] += transfers.forward[i].uncovered();
      if (two_way) {
        projected[i] += transfers.backward[i].projected;
        uncovered[i] += transfers.backward[i].uncovered();
      }
    }
    for (const Transfer& t : transfers.exchanges) {
      const auto i = static_cast<std::size_t>(t.receiver);
      const auto j = static_cast<std::size_t>(t.source);
      rows[i] += t.area;
      (two_way ? rows : columns)[j] += t.area;
    }
    ++passes;
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
