// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "radiosity/exchange/owned_patches.h"
#include "radiosity/state_archive.h"
#include "transillum/cancellation.h"
#include "transillum/transfers.h"

namespace transillum {

/// Exchanged areas summed over all passes, a sparse matrix: form factors up to one factor per row,
/// F_ij = 4 / (M A_i) * (entry i,j) for M directions (ALGORITHM.md, estimator).
///
/// Two-way sums are symmetric, so each pair is kept once, the lower patch first. The areas of a
/// pair are added in the order of the passes, whenever they are merged, so the bits do not depend
/// on the budget. Functions that can take long throw Canceled.
class ExchangeSums {
 public:
  /// Exchanges of one pass by rising receiver; sources in any order.
  using Sorted = std::vector<Transfer>;

  /// @param budget limit of the sums, bytes, also while passes are merged into them. Passes under
  /// way, two per thread, and a few numbers per patch come on top.
  /// @param share rows that are summed; rows of other patches are incomplete
  ExchangeSums(const OwnedPatches& owned, bool two_way, std::uint64_t budget,
               const Cancellation& cancellation);

  /// Sorts the exchanges of a pass by the rows of the sums. Any thread may call it at any time.
  Sorted sort(const std::vector<Transfer>& exchanges) const;

  /// Adds a pass. Once the budget is exceeded, everything is dropped and overrun() stays true.
  void add(Sorted sorted);
  bool overrun() const { return overrun_; }
  /// Drops everything, as if the budget were exceeded.
  void drop();
  /// Merges the waiting passes into the sums, row by row: first the sums, then each pass.
  void merge();
  /// Merges all passes and sorts the rows; to be called after the last pass.
  void finish();
  /// Number of entries, unmerged passes included.
  std::size_t size() const { return sums_.source.size() + waiting_size_; }

  /// The part of size() that is in rows of the share.
  std::size_t size_of_owned() const;
  /// To be called before saving: merges passes whose sums are to be gathered.
  void prepare_to_save();

  /// gathered_i += sum_j entry_ij b_j for all i; `gathered` is as long as `b`. After finish().
  void gather(const std::vector<Rgb>& b, std::vector<Rgb>& gathered) const;
  /// Calls visit(i, j, entry) by rising pairs; for a two-way pair once, i < j. After finish().
  template <class Visit>
  void for_each(Visit&& visit) const {
    for (std::size_t i = 0; i < patches_; ++i) {
      for (std::size_t k = sums_.begin[i]; k < sums_.begin[i + 1]; ++k) {
        visit(static_cast<PatchId>(i), sums_.source[k], sums_.area[k]);
      }
    }
  }

  /// For StateOutput and StateInput. The state has all rows, whoever sums them; each share
  /// gives its own, one at a time in memory, and takes what it needs. Passes that wait stay so,
  /// since what is dropped and when depends on them.
  static void visit_state(StateOutput& archive, const ExchangeSums& self) { self.save(archive); }
  static void visit_state(StateInput& archive, ExchangeSums& self) { self.restore(archive); }

 private:
  void save(StateOutput& archive) const;
  void restore(StateInput& archive);
  /// Compressed rows: row i is [begin[i], begin[i + 1]).
  struct Rows {
    std::vector<std::size_t> begin;
    std::vector<PatchId> source;
    std::vector<double> area;
  };
  /// Whether all rows and patches that a state names exist.
  bool is_valid() const;
  Rows empty_rows() const { return {std::vector<std::size_t>(patches_ + 1, 0), {}, {}}; }
  void transpose();

  OwnedPatches owned_;
  std::size_t patches_;
  bool two_way_;
  std::uint64_t budget_;
  Cancellation cancellation_;
  bool overrun_ = false;
  Rows sums_;
  /// Passes not yet merged, in order.
  std::vector<Sorted> waiting_;
  std::size_t waiting_size_ = 0;
  /// Receives the next sums; kept because allocating it costs as much as merging.
  Rows spare_;
  /// Per source: its last position in a row, while merging.
  std::vector<std::uint32_t> place_;
};

}  // namespace transillum
