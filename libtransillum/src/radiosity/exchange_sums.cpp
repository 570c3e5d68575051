// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "radiosity/exchange_sums.h"

#include <algorithm>
#include <utility>

namespace transillum {
namespace {

std::pair<PatchId, PatchId> pair_of(const Transfer& t) { return {t.receiver, t.source}; }

/// Appends `t`, or adds it to the last entry where that is the same pair.
void accumulate(ExchangeSums::Run& run, const Transfer& t) {
  if (!run.empty() && pair_of(run.back()) == pair_of(t)) {
    run.back().area += t.area;
  } else {
    run.push_back(t);
  }
}

ExchangeSums::Run merged(const ExchangeSums::Run& a, const ExchangeSums::Run& b) {
  // Two walks: count first, so that no memory is taken beyond what is kept.
  const auto walk = [&](auto&& visit) {
    std::size_t i = 0, j = 0;
    while (i < a.size() || j < b.size()) {
      const bool take_a = j == b.size() || (i < a.size() && pair_of(a[i]) <= pair_of(b[j]));
      const bool take_b = i == a.size() || (j < b.size() && pair_of(b[j]) <= pair_of(a[i]));
      visit(take_a ? &a[i] : nullptr, take_b ? &b[j] : nullptr);
      i += take_a;
      j += take_b;
    }
  };
  std::size_t count = 0;
  walk([&](const Transfer*, const Transfer*) { ++count; });
  ExchangeSums::Run sum;
  sum.reserve(count);
  walk([&](const Transfer* from_a, const Transfer* from_b) {
    sum.push_back(from_a ? *from_a : *from_b);
    if (from_a && from_b) sum.back().area += from_b->area;
  });
  return sum;
}

}  // namespace

ExchangeSums::Run ExchangeSums::make_run(const std::vector<Transfer>& exchanges, bool two_way) {
  if (!two_way) return exchanges;
  Run sorted = exchanges;
  for (Transfer& t : sorted) {
    if (t.receiver > t.source) std::swap(t.receiver, t.source);
  }
  std::stable_sort(sorted.begin(), sorted.end(),
                   [](const Transfer& a, const Transfer& b) { return pair_of(a) < pair_of(b); });
  Run run;
  run.reserve(sorted.size());
  for (const Transfer& t : sorted) accumulate(run, t);
  return run;
}

void ExchangeSums::add(Run run) {
  if (overrun_) return;
  // While two runs merge, their sum exists beside them.
  if (2 * (size() + run.size()) * sizeof(Transfer) > budget_) {
    overrun_ = true;
    levels_.clear();
    levels_.shrink_to_fit();
    return;
  }
  levels_.push_back({std::move(run), 0});
  while (levels_.size() >= 2 && levels_.back().rank == levels_[levels_.size() - 2].rank) {
    merge_last_two();
  }
}

void ExchangeSums::finish() {
  while (levels_.size() >= 2) merge_last_two();
}

void ExchangeSums::merge_last_two() {
  Level last = std::move(levels_.back());
  levels_.pop_back();
  Level& before = levels_.back();
  before.run = merged(before.run, last.run);
  ++before.rank;
}

std::size_t ExchangeSums::size() const {
  std::size_t total = 0;
  for (const Level& level : levels_) total += level.run.size();
  return total;
}

void ExchangeSums::gather(const std::vector<Rgb>& b, std::vector<Rgb>& gathered) const {
  std::fill(gathered.begin(), gathered.end(), Rgb{});
  if (levels_.empty()) return;
  for (const Transfer& t : levels_.front().run) {
    const auto i = static_cast<std::size_t>(t.receiver);
    const auto j = static_cast<std::size_t>(t.source);
    gathered[i] += t.area * b[j];
    if (two_way_) gathered[j] += t.area * b[i];
  }
}

}  // namespace transillum
