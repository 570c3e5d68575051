// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Sums of exchanged areas in compressed rows. Passes wait in lists and are merged when as many
// exchanges wait as there are sums. Input: the exchanges of each pass, from sort().
#include "radiosity/exchange/exchange_sums.h"

#include <algorithm>
#include <iterator>
#include <numeric>
#include <span>
#include <utility>

#include "transillum/at.h"

namespace transillum {

ExchangeSums::ExchangeSums(const OwnedPatches& owned, bool two_way, std::uint64_t budget,
                           const Cancellation& cancellation)
    : owned_(owned),
      patches_(static_cast<std::size_t>(owned.patches)),
      two_way_(two_way),
      budget_(budget),
      cancellation_(cancellation),
      sums_(empty_rows()),
      place_(patches_, 0) {}

std::size_t ExchangeSums::size_of_owned() const {
  if (owned_.is_all()) {
    return size();
  }
  std::size_t size = sums_.begin[owned_.last()] - sums_.begin[owned_.first()];
  for (const Sorted& sorted : waiting_) {
    size += static_cast<std::size_t>(
        std::count_if(sorted.begin(), sorted.end(),
                      [this](const Transfer& t) { return owned_.range.contains(t.receiver); }));
  }
  return size;
}

void ExchangeSums::prepare_to_save() {
  if (!owned_.is_all()) {
    merge();
  }
}

ExchangeSums::Sorted ExchangeSums::sort(const std::vector<Transfer>& exchanges) const {
  if (!two_way_) {
    Sorted sorted;
    sorted.reserve(exchanges.size());
    std::copy_if(exchanges.begin(), exchanges.end(), std::back_inserter(sorted),
                 [this](const Transfer& t) { return owned_.range.contains(t.receiver); });
    return sorted;
  }
  if (exchanges.size() < patches_ / 16) {
    Sorted sorted;
    sorted.reserve(exchanges.size());
    for (const Transfer& t : exchanges) {
      sorted.push_back({std::min(t.receiver, t.source), std::max(t.receiver, t.source), t.area});
    }
    std::stable_sort(sorted.begin(), sorted.end(),
                     [](const Transfer& a, const Transfer& b) { return a.receiver < b.receiver; });
    return sorted;
  }
  // Counting sort by the lower patch.
  std::vector<std::uint32_t> next(patches_ + 1, 0);
  for (const Transfer& t : exchanges) {
    ++next[static_cast<std::size_t>(std::min(t.receiver, t.source)) + 1];
  }
  std::partial_sum(next.begin(), next.end(), next.begin());
  Sorted sorted(exchanges.size());
  for (const Transfer& t : exchanges) {
    const auto [low, high] = std::minmax(t.receiver, t.source);
    sorted[at(next, low)++] = {low, high, t.area};
  }
  return sorted;
}

void ExchangeSums::add(Sorted sorted) {
  if (overrun_) {
    return;
  }
  waiting_size_ += sorted.size();
  waiting_.push_back(std::move(sorted));
  // While passes are merged, the new sums and their inputs exist at the same time.
  const bool crowded = 2 * size() * sizeof(Transfer) > budget_;
  // A merge traverses all sums, so it is deferred until as many exchanges are waiting.
  if (!crowded && waiting_size_ < sums_.source.size()) {
    return;
  }
  merge();
  // Sums that leave little room for passes would have to be merged too often.
  if (3 * size() * sizeof(Transfer) > budget_) {
    drop();
  }
}

void ExchangeSums::drop() {
  if (overrun_) {
    return;
  }
  overrun_ = true;
  sums_ = empty_rows();
  spare_ = {};
  waiting_ = {};
  waiting_size_ = 0;
}

void ExchangeSums::merge() {
  std::vector<std::span<const Transfer>> rest(waiting_.begin(), waiting_.end());
  if (spare_.source.capacity() < size()) {
    spare_ = {};
  }
  auto& [begin, source, area] = spare_;
  begin.clear();
  source.clear();
  area.clear();
  source.reserve(size());
  area.reserve(size());
  for (std::size_t row = 0; row < patches_; ++row) {
    cancellation_.throw_if_canceled();
    const std::size_t first = source.size();
    begin.push_back(first);
    const auto old_first = static_cast<std::ptrdiff_t>(sums_.begin[row]);
    const auto old_last = static_cast<std::ptrdiff_t>(sums_.begin[row + 1]);
    source.insert(source.end(), sums_.source.begin() + old_first, sums_.source.begin() + old_last);
    area.insert(area.end(), sums_.area.begin() + old_first, sums_.area.begin() + old_last);
    for (std::size_t k = first; k < source.size(); ++k) {
      at(place_, source[k]) = static_cast<std::uint32_t>(k - first);
    }
    for (auto& sorted : rest) {
      std::size_t taken = 0;
      for (; taken < sorted.size() && static_cast<std::size_t>(sorted[taken].receiver) == row;
           ++taken) {
        const Transfer& t = sorted[taken];
        // A place left by an earlier row points beyond this one, or to another source in it.
        std::uint32_t& place = at(place_, t.source);
        const std::size_t k = first + place;
        if (k < source.size() && source[k] == t.source) {
          area[k] += t.area;
        } else {
          place = static_cast<std::uint32_t>(source.size() - first);
          source.push_back(t.source);
          area.push_back(t.area);
        }
      }
      sorted = sorted.subspan(taken);
    }
  }
  begin.push_back(source.size());
  std::swap(sums_, spare_);
  waiting_.clear();
  waiting_size_ = 0;
}

bool ExchangeSums::is_valid() const {
  const auto exists = [this](PatchId patch) {
    return patch >= 0 && static_cast<std::size_t>(patch) < patches_;
  };
  const auto& [begin, source, area] = sums_;
  return begin.size() == patches_ + 1 && begin.front() == 0 &&
         std::is_sorted(begin.begin(), begin.end()) && begin.back() == source.size() &&
         source.size() == area.size() && std::all_of(source.begin(), source.end(), exists) &&
         std::all_of(waiting_.begin(), waiting_.end(), [&](const Sorted& sorted) {
           return std::all_of(sorted.begin(), sorted.end(), [&](const Transfer& t) {
             return exists(t.receiver) && exists(t.source);
           });
         });
}

void ExchangeSums::finish() {
  if (overrun_) {
    return;
  }
  merge();
  // Sorting by source, then by receiver again, sorts each row.
  transpose();
  transpose();
  spare_ = {};
}

void ExchangeSums::transpose() {
  const std::size_t count = sums_.source.size();
  std::vector<std::size_t> next(patches_ + 1, 0);
  for (std::size_t i = 0; i < patches_; ++i) {
    cancellation_.throw_if_canceled();
    for (std::size_t k = sums_.begin[i]; k < sums_.begin[i + 1]; ++k) {
      ++next[static_cast<std::size_t>(sums_.source[k]) + 1];
    }
  }
  std::partial_sum(next.begin(), next.end(), next.begin());
  spare_.begin = next;
  spare_.source.resize(count);
  spare_.area.resize(count);
  for (std::size_t i = 0; i < patches_; ++i) {
    cancellation_.throw_if_canceled();
    for (std::size_t k = sums_.begin[i]; k < sums_.begin[i + 1]; ++k) {
      const std::size_t to = at(next, sums_.source[k])++;
      spare_.source[to] = static_cast<PatchId>(i);
      spare_.area[to] = sums_.area[k];
    }
  }
  std::swap(sums_, spare_);
}

void ExchangeSums::gather(const std::vector<Rgb>& b, std::vector<Rgb>& gathered) const {
  for (std::size_t i = 0; i < patches_; ++i) {
    cancellation_.throw_if_canceled();
    const Rgb b_i = b[i];
    Rgb row;
    for (std::size_t k = sums_.begin[i]; k < sums_.begin[i + 1]; ++k) {
      const auto j = static_cast<std::size_t>(sums_.source[k]);
      row += sums_.area[k] * b[j];
      if (two_way_) {
        gathered[j] += sums_.area[k] * b_i;
      }
    }
    gathered[i] += row;
  }
}

}  // namespace transillum
