// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "radiosity/exchange_sums.h"

#include <algorithm>
#include <utility>

namespace transillum {
namespace {

/// Rises with the receiver, then with the source.
std::uint64_t key_of(const Transfer& t) {
  return static_cast<std::uint64_t>(static_cast<std::uint32_t>(t.receiver)) << 32 |
         static_cast<std::uint32_t>(t.source);
}

/// Walks two runs in one order: `visit` gets an entry of either, or the two of a pair that both
/// have. Which of the runs comes next is a toss-up, so nothing is left to branches.
template <class Visit>
void walk(const ExchangeSums::Run& a, const ExchangeSums::Run& b, Visit visit) {
  std::size_t i = 0, j = 0;
  while (i < a.size() && j < b.size()) {
    const std::uint64_t key_a = key_of(a[i]), key_b = key_of(b[j]);
    const bool take_a = key_a <= key_b, take_b = key_b <= key_a;
    const Transfer& first = *(take_a ? &a[i] : &b[j]);
    visit(first, take_a && take_b ? b[j].area : 0.0);
    i += take_a;
    j += take_b;
  }
  for (; i < a.size(); ++i) visit(a[i], 0.0);
  for (; j < b.size(); ++j) visit(b[j], 0.0);
}

ExchangeSums::Run merged(const ExchangeSums::Run& a, const ExchangeSums::Run& b) {
  // Counted first, so that no memory is taken beyond what is kept.
  std::size_t count = 0;
  walk(a, b, [&](const Transfer&, double) { ++count; });
  ExchangeSums::Run sum(count);
  Transfer* next = sum.data();
  walk(a, b, [&](const Transfer& t, double more) {
    *next++ = {t.receiver, t.source, t.area + more};
  });
  return sum;
}

}  // namespace

ExchangeSums::Run ExchangeSums::make_run(const std::vector<Transfer>& exchanges, bool two_way) {
  if (!two_way) return exchanges;
  // By the lower number: counted, then dealt out.
  PatchId last = -1;
  for (const Transfer& t : exchanges) last = std::max({last, t.receiver, t.source});
  std::vector<std::uint32_t> place(static_cast<std::size_t>(last) + 2, 0);
  const auto lower = [](const Transfer& t) {
    return static_cast<std::size_t>(std::min(t.receiver, t.source));
  };
  for (const Transfer& t : exchanges) ++place[lower(t) + 1];
  for (std::size_t i = 1; i < place.size(); ++i) place[i] += place[i - 1];
  Run run(exchanges.size());
  for (const Transfer& t : exchanges) {
    run[place[lower(t)]++] = {std::min(t.receiver, t.source), std::max(t.receiver, t.source),
                              t.area};
  }
  // Each row by the other number; rows are short, and the two ways of a pair stay in their order.
  std::size_t kept = 0;
  for (std::size_t begin = 0, end = 0; begin < run.size(); begin = end) {
    while (end < run.size() && run[end].receiver == run[begin].receiver) ++end;
    std::stable_sort(run.begin() + static_cast<std::ptrdiff_t>(begin),
                     run.begin() + static_cast<std::ptrdiff_t>(end),
                     [](const Transfer& a, const Transfer& b) { return a.source < b.source; });
    for (std::size_t k = begin; k < end; ++k) {
      if (kept > 0 && key_of(run[kept - 1]) == key_of(run[k])) {
        run[kept - 1].area += run[k].area;
      } else {
        run[kept++] = run[k];
      }
    }
  }
  run.resize(kept);
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
