// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "transillum/transfers.h"

namespace transillum {

/// The sums over all passes of the exchanged areas: form factors but for a factor a row.
/// F_ij = 4 / (M A_i) * (entry i,j), as in method.md's estimator.
///
/// Two-way sums are symmetric, so a pair is kept once, the lower number first.
class ExchangeSums {
 public:
  /// Exchanges of one pass, sorted by pair.
  using Run = std::vector<Transfer>;
  /// Puts a pass's exchanges into the order of the sums. Pure: any thread may.
  static Run make_run(const std::vector<Transfer>& exchanges, bool two_way);

  /// @param budget bytes that the sums may take, also while they are merged; passes under way,
  /// two a thread, come on top.
  ExchangeSums(bool two_way, std::uint64_t budget) : two_way_(two_way), budget_(budget) {}

  /// Adds a pass. The bits of the sums depend on the order of the passes only. Once the budget is
  /// overrun everything is let go, and overrun() stays true.
  void add(Run run);
  bool overrun() const { return overrun_; }
  /// After the last pass: one list.
  void finish();
  std::size_t size() const;

  /// gathered_i = sum_j entry_ij b_j for all i; `gathered` has the size of `b`. After finish().
  void gather(const std::vector<Rgb>& b, std::vector<Rgb>& gathered) const;
  /// visit(i, j, entry) by rising pairs; a two-way pair comes once, i < j. After finish().
  template <class Visit>
  void for_each(Visit&& visit) const {
    if (levels_.empty()) return;
    for (const Transfer& t : levels_.front().run) visit(t.receiver, t.source, t.area);
  }

 private:
  struct Level {
    Run run;
    int rank;
  };
  void merge_last_two();

  bool two_way_;
  std::uint64_t budget_;
  bool overrun_ = false;
  /// Like the digits of a binary counter: runs of falling rank, two of one rank merged at once.
  std::vector<Level> levels_;
};

}  // namespace transillum
