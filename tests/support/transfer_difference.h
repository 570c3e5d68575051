// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <map>
#include <string>
#include <utility>

#include "transillum/scene.h"
#include "transillum/transfers.h"

namespace transillum::testing {

/// The largest difference found. The uncertainty of a needle's area due to the rounding of its
/// coordinates is subtracted.
struct TransferDifference {
  double fraction = 0;  ///< over the area of the patch; for an exchange, of the smaller patch
  std::string where;    ///< quantity, patches and values, for the message
};

/// Compares exchanges and coverages of one direction, for omega and -omega, by two engines.
TransferDifference difference(const Scene& scene, const Transfers& a, const Transfers& b);

/// Compares the transfers of omega with the transfers of -omega: receiver and source are exchanged.
TransferDifference difference_from_both_ends(const Scene& scene, const Transfers& there,
                                             const Transfers& back);

/// Moments by receiver and source.
using PairMoments = std::map<std::pair<PatchId, PatchId>, TransferMoments>;
PairMoments moments_of(const Transfers& transfers);
/// The largest difference of moments, over the area of the smaller patch. Missing pairs are 0.
double largest_difference(const Scene& scene, const PairMoments& one, const PairMoments& other);

}  // namespace transillum::testing
