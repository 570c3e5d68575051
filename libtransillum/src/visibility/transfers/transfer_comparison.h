// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <vector>

#include "transillum/transfers.h"

namespace transillum {

/// Findings of two engines on one pair of patches.
struct PairDifference {
  PatchId receiver;  ///< the patch that sees the source along omega
  PatchId source;    ///< the patch that is seen
  double first;      ///< A(receiver, source, omega), m², by the first; 0 if not found
  double other;      ///< by the other
};

/// The differences between two engines' transfers along one direction.
struct TransferComparison {
  double exchanged = 0;        ///< m², sum over all pairs of the first
  double other_exchanged = 0;  ///< m², sum over all pairs of the other
  /// Half the sum of all pairs' absolute differences, over `exchanged`: the fraction that the other
  /// engine assigns to the wrong patches or misses.
  double misplaced = 0;
  /// Per patch: sum of the absolute differences of all pairs in which it is the receiver or the
  /// source, m².
  std::vector<double> differences;
  /// The pair with the largest absolute difference, and the difference: first minus other, m².
  Transfer largest{no_patch, no_patch, 0};
  /// All pairs that differ, by decreasing absolute difference, then by receiver and source.
  std::vector<PairDifference> pairs;
};

/// Compares `other` with `first`; both of the same direction and scene.
TransferComparison compare(const Transfers& first, const Transfers& other);

}  // namespace transillum
