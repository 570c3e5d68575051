// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Sums of transfers, shared by the engines that process fragments one by one (local, exact, global
// and corrected). Input: projected and visible areas in the engine's number type.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <numeric>
#include <utility>
#include <vector>

#include "transillum/at.h"
#include "transillum/cancellation.h"
#include "transillum/transfers.h"
#include "visibility/plane/map_number.h"

namespace transillum {

/// Sums the transfers of one direction, for omega and -omega, from the areas in which fragments see
/// each other.
template <class Area>
class TransferSums {
 public:
  /// @param moments whether add_moments() and accumulate_moments() will be called, each after its
  /// counterpart
  explicit TransferSums(PatchId patch_count, bool moments = false)
      : patches_(static_cast<std::size_t>(patch_count)),
        forward_moments_(moments ? patches_.size() : 0),
        backward_moments_(forward_moments_.size()) {}

  /// Adds a part of patch i's projected area.
  void project(PatchId i, bool front_facing, const Area& area) {
    at(patches_, i).sides[front_facing ? 0 : 1].projected += area;
  }

  /// Adds `area` in which a part of patch `below` sees a part of patch `above`, which is nearer to
  /// omega.
  void accumulate(PatchId below, bool below_front_facing, PatchId above, bool above_front_facing,
                  const Area& area) {
    if (below_front_facing) {
      at(patches_, below).sides[0].covered += area;
      if (above_front_facing) {
        at(patches_, above).back_seen += area;
      } else {
        at(patches_, above).sides[1].covered += area;
        exchanges_.push_back({below, above, area});
      }
    } else if (!above_front_facing) {
      at(patches_, above).sides[1].covered += area;
      at(patches_, below).back_seen += area;
    }
  }

  /// Adds the integrals of phi_1 and phi_2 over the part of patch i's projection that project()
  /// was called with.
  void project_moments(PatchId i, bool front_facing, const std::array<double, 2>& moments) {
    CoverageMoments& sums = at(front_facing ? forward_moments_ : backward_moments_, i);
    for (std::size_t a = 0; a < 2; ++a) {
      sums.projected[a] += moments[a];
    }
  }

  /// Adds the moments of what accumulate() was called with.
  void accumulate_moments(PatchId below, bool below_front_facing, PatchId above,
                          bool above_front_facing, const TransferMoments& moments) {
    for (std::size_t a = 0; a < 2; ++a) {
      if (below_front_facing) {
        at(forward_moments_, below).covered[a] += moments.of(a + 1, 0);
      }
      if (!above_front_facing) {
        at(backward_moments_, above).covered[a] += moments.of(0, a + 1);
      }
    }
    if (below_front_facing && !above_front_facing) {
      moments_.push_back(moments);
    }
  }

  /// Returns the sums, each rounded once. The object must not be used afterwards.
  /// @throws Canceled
  Transfers finish(const Vec3& omega, const Cancellation& cancellation) {
    Transfers transfers;
    transfers.direction = omega;
    for (std::size_t i = 0; i < patches_.size(); ++i) {
      if (i % 4096 == 0) {
        cancellation.throw_if_canceled();
      }
      const OfPatch& patch = patches_[i];
      transfers.forward.push_back(rounded(patch.sides[0]));
      transfers.backward.push_back(rounded(patch.sides[1]));
      transfers.back_seen.push_back(nearest_double(patch.back_seen));
    }
    add_exchanges(transfers, cancellation);
    exchanges_.clear();
    transfers.forward_moments = std::move(forward_moments_);
    transfers.backward_moments = std::move(backward_moments_);
    return transfers;
  }

 private:
  struct SideSums {
    Area projected{}, covered{};
  };
  struct OfPatch {
    SideSums sides[2];  ///< sums as receiver for omega, and for -omega
    Area back_seen{};
  };
  struct Exchange {
    PatchId receiver, source;
    Area area;
  };

  static Coverage rounded(const SideSums& sums) {
    return {nearest_double(sums.projected), nearest_double(sums.covered)};
  }

  /// One entry per pair, by receiver and source; parts are summed in the order in which they were
  /// added.
  void add_exchanges(Transfers& transfers, const Cancellation& cancellation) const {
    // Counting sort by receiver, then each row by source.
    std::vector<std::size_t> end(patches_.size() + 1, 0);
    for (const Exchange& e : exchanges_) {
      ++end[static_cast<std::size_t>(e.receiver) + 1];
    }
    std::partial_sum(end.begin(), end.end(), end.begin());
    std::vector<const Exchange*> by_receiver(exchanges_.size());
    for (const Exchange& e : exchanges_) {
      by_receiver[at(end, e.receiver)++] = &e;
    }
    auto begin = by_receiver.begin();
    for (std::size_t i = 0; i < patches_.size(); ++i) {
      if (i % 256 == 0) {
        cancellation.throw_if_canceled();
      }
      const auto row_end = by_receiver.begin() + static_cast<std::ptrdiff_t>(end[i]);
      std::stable_sort(begin, row_end,
                       [](const Exchange* a, const Exchange* b) { return a->source < b->source; });
      while (begin != row_end) {
        const PatchId source = (*begin)->source;
        Area area{};
        const auto first = begin;
        for (; begin != row_end && (*begin)->source == source; ++begin) {
          area += (*begin)->area;
        }
        transfers.exchanges.push_back({static_cast<PatchId>(i), source, nearest_double(area)});
        if (!moments_.empty()) {
          transfers.moments.push_back(sum_of_moments(first, begin, nearest_double(area)));
        }
      }
    }
  }

  template <class Iterator>
  TransferMoments sum_of_moments(Iterator first, Iterator last, double area) const {
    TransferMoments sum;
    for (; first != last; ++first) {
      const TransferMoments& part = at(moments_, *first - exchanges_.data());
      for (std::size_t k = 0; k < sum.value.size(); ++k) {
        sum.value[k] += part.value[k];
      }
    }
    sum.of(0, 0) = area;
    return sum;
  }

  std::vector<OfPatch> patches_;
  std::vector<Exchange> exchanges_;
  std::vector<TransferMoments> moments_;  ///< moments of exchanges_; empty without moments
  std::vector<CoverageMoments> forward_moments_, backward_moments_;
};

}  // namespace transillum
