// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "transillum/cancellation.h"
#include "transillum/transfers.h"

namespace transillum {

/// The sums over all passes of the exchanged areas: form factors but for a factor a row.
/// F_ij = 4 / (M A_i) * (entry i,j), as in method.md's estimator.
///
/// Two-way sums are symmetric, so a pair is kept once, the lower number first. A pair's areas are
/// added in the order of the passes, whenever that happens. All that may take long throws
/// Canceled.
class ExchangeSums {
 public:
  /// Exchanges by rising receiver, sources in any order.
  using Run = std::vector<Transfer>;

  /// @param budget bytes that the sums may take, also while passes are merged into them; passes
  /// under way, two a thread, and a few numbers a patch come on top.
  ExchangeSums(PatchId patches, bool two_way, std::uint64_t budget,
               const Cancellation& cancellation);

  /// Puts a pass's exchanges into the rows of the sums. Any thread may, at any time.
  Run make_run(const std::vector<Transfer>& exchanges) const;

  /// Adds a pass. Once the budget is overrun everything is let go, and overrun() stays true.
  void add(Run run);
  bool overrun() const { return overrun_; }
  /// Lets everything go, as where the budget is overrun.
  void drop();
  /// After the last pass.
  void finish();
  std::size_t size() const { return sums_.source.size() + waiting_size_; }

  /// gathered_i += sum_j entry_ij b_j for all i; `gathered` has the size of `b`. After finish().
  void gather(const std::vector<Rgb>& b, std::vector<Rgb>& gathered) const;
  /// visit(i, j, entry) by rising pairs; a two-way pair comes once, i < j. After finish().
  template <class Visit>
  void for_each(Visit&& visit) const {
    for (std::size_t i = 0; i < patches_; ++i) {
      for (std::size_t k = sums_.begin[i]; k < sums_.begin[i + 1]; ++k) {
        visit(static_cast<PatchId>(i), sums_.source[k], sums_.area[k]);
      }
    }
  }

 private:
  /// Row i: from begin[i] to before begin[i + 1].
  struct Rows {
    std::vector<std::size_t> begin;
    std::vector<PatchId> source;
    std::vector<double> area;
  };
  Rows empty_rows() const { return {std::vector<std::size_t>(patches_ + 1, 0), {}, {}}; }
  /// What waits, into the sums: row by row, of each first the sums and then the passes.
  void merge();
  void transpose();

  std::size_t patches_;
  bool two_way_;
  std::uint64_t budget_;
  Cancellation cancellation_;
  bool overrun_ = false;
  Rows sums_;
  /// Passes still to be merged into the sums, in their order.
  std::vector<Run> waiting_;
  std::size_t waiting_size_ = 0;
  /// Where the next sums are made; kept, for fresh memory costs as much as the merging.
  Rows spare_;
  /// A source: where in its row the merge has put it last.
  std::vector<std::uint32_t> place_;
};

}  // namespace transillum
