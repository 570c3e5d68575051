// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <algorithm>
#include <utility>
#include <vector>

#include "transillum/transfers.h"
#include "visibility/map_number.h"

namespace transillum {

/// Adds up who looks at whom in one direction, both ways.
template <class Area>
class TransferSums {
 public:
  explicit TransferSums(PatchId patch_count) : patches_(static_cast<std::size_t>(patch_count)) {}

  /// Books a part of patch i's projection.
  void project(PatchId i, bool front_facing, const Area& area) {
    at(i).sides[front_facing ? 0 : 1].projected += area;
  }

  /// Books `area` between a part of patch `below` and one of `above` right above it.
  void see(PatchId below, bool below_front_facing, PatchId above, bool above_front_facing,
           const Area& area) {
    if (below_front_facing) {
      at(below).sides[0].covered += area;
      if (above_front_facing) {
        at(above).back_seen += area;
      } else {
        at(above).sides[1].covered += area;
        exchanges_.push_back({below, above, area});
      }
    } else if (!above_front_facing) {
      at(above).sides[1].covered += area;
      at(below).back_seen += area;
    }
  }

  /// The sums, rounded once; leaves nothing behind.
  Transfers finish(const Vec3& omega) {
    Transfers transfers;
    transfers.direction = omega;
    for (const OfPatch& patch : patches_) {
      transfers.forward.push_back(rounded(patch.sides[0]));
      transfers.backward.push_back(rounded(patch.sides[1]));
      transfers.back_seen.push_back(nearest_double(patch.back_seen));
    }
    merge_exchanges();
    for (const Exchange& e : exchanges_) {
      transfers.exchanges.push_back({e.receiver, e.source, nearest_double(e.area)});
    }
    exchanges_.clear();
    return transfers;
  }

 private:
  struct SideSums {
    Area projected{}, covered{};
  };
  struct OfPatch {
    SideSums sides[2];  ///< as receiver for omega, and for -omega
    Area back_seen{};
  };
  struct Exchange {
    PatchId receiver, source;
    Area area;
  };

  OfPatch& at(PatchId i) { return patches_[static_cast<std::size_t>(i)]; }
  static Coverage rounded(const SideSums& sums) {
    return {nearest_double(sums.projected), nearest_double(sums.covered)};
  }

  /// One entry a pair, by receiver and source; parts summed in the order they were found.
  void merge_exchanges() {
    auto& all = exchanges_;
    std::stable_sort(all.begin(), all.end(), [](const Exchange& a, const Exchange& b) {
      return std::pair(a.receiver, a.source) < std::pair(b.receiver, b.source);
    });
    std::size_t kept = 0;
    for (std::size_t k = 0; k < all.size(); ++k) {
      if (kept > 0 && all[kept - 1].receiver == all[k].receiver &&
          all[kept - 1].source == all[k].source) {
        all[kept - 1].area += all[k].area;
      } else {
        if (kept != k) all[kept] = std::move(all[k]);
        ++kept;
      }
    }
    all.erase(all.begin() + static_cast<std::ptrdiff_t>(kept), all.end());
  }

  std::vector<OfPatch> patches_;
  std::vector<Exchange> exchanges_;
};

}  // namespace transillum
