// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <string>

#include "transillum/scene.h"
#include "transillum/transfers.h"

namespace transillum::testing {

/// The largest difference met, as a share of the patch's area; of an exchange, of the smaller
/// patch's. What a needle's own coordinates leave open of its area is let go.
struct TransferDifference {
  double share = 0;
  std::string where;  ///< it was met
};

/// Compares exchanges and coverages, both ways, of one direction by two engines.
TransferDifference difference(const Scene& scene, const Transfers& a, const Transfers& b);

/// Compares what omega gives with what -omega gives: receiver and source change places.
TransferDifference difference_from_both_ends(const Scene& scene, const Transfers& there,
                                             const Transfers& back);

}  // namespace transillum::testing
