// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "transillum/at.h"
#include "transillum/cancellation.h"
#include "transillum/transfers.h"

namespace transillum {

/// Sorts what a pass has found by receiver, then source, into one exchange per pair; parts are
/// summed in the order in which they were found.
class ExchangeRows {
 public:
  /// @tparam Entry Transfer, or derived from it
  /// @param put called with each entry in order, and whether it was added to the entry before
  template <class Entry, class Put>
  void sort(const std::vector<Entry>& found, std::size_t patches, std::vector<Entry>& sorted,
            std::vector<Transfer>& exchanges, const Cancellation& cancellation, Put put) {
    row_ends_.assign(patches + 1, 0);
    for (const Transfer& t : found) {
      ++row_ends_[static_cast<std::size_t>(t.receiver) + 1];
    }
    for (std::size_t i = 0; i < patches; ++i) {
      row_ends_[i + 1] += row_ends_[i];
    }
    sorted.resize(found.size());
    for (const Entry& t : found) {
      sorted[at(row_ends_, t.receiver)++] = t;
    }
    exchanges.reserve(found.size());
    std::size_t begin = 0;
    for (std::size_t i = 0; i < patches; ++i) {
      if (i % 4096 == 0) {
        cancellation.throw_if_canceled();
      }
      sort_by_source(sorted.data() + begin, sorted.data() + row_ends_[i]);
      const std::size_t row = exchanges.size();
      for (; begin < row_ends_[i]; ++begin) {
        const Entry& t = sorted[begin];
        const bool added = exchanges.size() > row && exchanges.back().source == t.source;
        if (added) {
          exchanges.back().area += t.area;
        } else {
          exchanges.push_back(t);
        }
        put(t, added);
      }
    }
  }

 private:
  /// Stable.
  template <class Entry>
  static void sort_by_source(Entry* first, Entry* last) {
    constexpr std::ptrdiff_t few = 24;
    if (last - first > few) {
      std::stable_sort(first, last,
                       [](const Transfer& a, const Transfer& b) { return a.source < b.source; });
      return;
    }
    for (Entry* next = first; next < last; ++next) {
      const Entry moved = *next;
      Entry* to = next;
      for (; to > first && to[-1].source > moved.source; --to) {
        *to = to[-1];
      }
      *to = moved;
    }
  }

  std::vector<std::uint32_t> row_ends_;
};

}  // namespace transillum
