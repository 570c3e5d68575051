// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// From counts of sample lines, reported by the engines zbuffer, painter and rays, to Transfers.
#include "visibility/pixels/counted_transfers.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "transillum/at.h"

namespace transillum {

CountedTransfers::CountedTransfers(const Scene& scene, const PatchHeights& heights,
                                   const Cancellation& cancellation)
    : scene_(scene),
      heights_(heights),
      cancellation_(cancellation),
      forward_(static_cast<std::size_t>(scene.patch_count())),
      backward_(forward_.size()),
      back_seen_(forward_.size()) {}

void CountedTransfers::count(PatchId below, PatchId above, std::int64_t count) {
  side(below).projected += count;
  if (above == no_patch) {
    return;
  }
  const bool receives = heights_.front_facing(below), emits = !heights_.front_facing(above);
  if (receives) {
    side(below).covered += count;
  }
  if (emits) {
    side(above).covered += count;
  }
  if (receives && emits) {
    exchanges_.push_back({below, above, count});
    if (exchanges_.size() >= merge_at_) {
      merge_exchanges();
    }
  } else if (receives) {
    at(back_seen_, above) += count;
  } else if (emits) {
    at(back_seen_, below) += count;
  }
}

/// Leaves one entry per pair, sorted by receiver and source.
void CountedTransfers::merge_exchanges() {
  cancellation_.throw_if_canceled();
  // A counting sort by receiver, then a sort of each row.
  std::vector<std::size_t> end(forward_.size() + 1, 0);
  for (const Exchange& e : exchanges_) {
    ++at(end, e.receiver + 1);
  }
  std::partial_sum(end.begin(), end.end(), end.begin());
  by_receiver_.resize(exchanges_.size());
  for (const Exchange& e : exchanges_) {
    by_receiver_[at(end, e.receiver)++] = e;
  }
  exchanges_.clear();
  auto begin = by_receiver_.begin();
  for (std::size_t i = 0; i < forward_.size(); ++i) {
    if (i % 256 == 0) {
      cancellation_.throw_if_canceled();
    }
    const auto row_end = by_receiver_.begin() + static_cast<std::ptrdiff_t>(end[i]);
    std::sort(begin, row_end,
              [](const Exchange& a, const Exchange& b) { return a.source < b.source; });
    for (; begin != row_end; ++begin) {
      if (!exchanges_.empty() && exchanges_.back().receiver == begin->receiver &&
          exchanges_.back().source == begin->source) {
        exchanges_.back().count += begin->count;
      } else {
        exchanges_.push_back(*begin);
      }
    }
  }
  merge_at_ = std::max(merge_at_, 2 * exchanges_.size());
}

Transfers CountedTransfers::finish(const Vec3& omega, double area) {
  merge_exchanges();
  Transfers transfers;
  transfers.direction = omega;
  const auto as_area = [area](std::int64_t count) { return static_cast<double>(count) * area; };
  for (const Exchange& e : std::exchange(exchanges_, {})) {
    transfers.exchanges.push_back({e.receiver, e.source, as_area(e.count)});
  }
  for (PatchId i = 0; i < scene_.patch_count(); ++i) {
    const Side &forward = at(forward_, i), &backward = at(backward_, i);
    const std::int64_t lines = forward.projected + backward.projected;
    transfers.counts.pixels += lines;
    if (lines == 0 && !heights_.edge_on(i)) {
      ++transfers.counts.missed;
    }
    transfers.forward.push_back({as_area(forward.projected), as_area(forward.covered)});
    transfers.backward.push_back({as_area(backward.projected), as_area(backward.covered)});
    transfers.back_seen.push_back(as_area(at(back_seen_, i)));
  }
  return transfers;
}

}  // namespace transillum
