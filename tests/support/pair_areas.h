// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <map>
#include <utility>

#include "transillum/transfers.h"

namespace transillum::testing {

/// A(i,j,omega) by receiver i and source j, m².
using PairAreas = std::map<std::pair<PatchId, PatchId>, double>;

/// The exchanges of one direction.
inline PairAreas areas_of(const Transfers& transfers) {
  PairAreas areas;
  for (const Transfer& t : transfers.exchanges) {
    areas[{t.receiver, t.source}] = t.area;
  }
  return areas;
}

}  // namespace transillum::testing
