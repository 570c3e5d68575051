// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <vector>

#include "transillum/transfers.h"

namespace transillum {

/// How two engines' transfers along one direction differ.
struct TransferComparison {
  double exchanged = 0, other_exchanged = 0;  ///< m², of all pairs
  /// Share of what the first exchanges that the other has between the wrong patches or not at all:
  /// half of all pairs' differences.
  double misplaced = 0;
  /// A patch: what the engines differ in over all its pairs, m², as receiver or source.
  std::vector<double> differences;
  Transfer largest{no_patch, no_patch,
                   0};  ///< the pair that differs most; first's less the other's
};

/// `other` against `first`; both of the same direction and scene.
TransferComparison compare(const Transfers& first, const Transfers& other);

}  // namespace transillum
