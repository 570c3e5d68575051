// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// The bins are built top down from a square around the whole grid: a region with many fragments is
// divided into square cells, about as wide as its fragments, which are regions in turn; a region
// that is not worth dividing becomes a bin.
#include "visibility/queries/fragment_bins.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "transillum/at.h"

namespace transillum {
namespace {

/// Regions with at most this many fragments are not divided.
constexpr std::size_t short_list = 12;
/// Width of a cell relative to the mean extent of the region's fragments.
constexpr double relative_cell_width = 1.5;
/// A fragment whose box covers at least this many cells is tested against each cell.
constexpr int many_cells = 12;
/// The first region is 2^top_shift grid units wide.
constexpr int top_shift = 62;
constexpr float infinity = std::numeric_limits<float>::infinity();
constexpr FragmentBox nowhere{
    {infinity, infinity, infinity, infinity, infinity, infinity, infinity, infinity}};
constexpr FragmentBox everywhere{
    {-infinity, -infinity, -infinity, -infinity, -infinity, -infinity, -infinity, -infinity}};

double low(const FragmentBox& box, std::size_t axis) { return box.ends[axis]; }
double high(const FragmentBox& box, std::size_t axis) { return -box.ends[axis + 4]; }

}  // namespace

void FragmentBins::fill(const Cancellation& cancellation) {
  const std::size_t count = projected_.fragments.size();
  bins_.clear();
  entry_fragments_.clear();
  boxes_.clear();
  before_.clear();
  open_.clear();
  last_.assign(count, none);
  counts_.assign(count, 0);
  entry_fragments_.reserve(4 * count);
  boxes_.reserve(4 * count);
  before_.reserve(4 * count);
  lists_.resize(count);
  for (std::size_t k = 0; k < count; ++k) {
    lists_[k] = static_cast<std::int32_t>(k);
  }
  constexpr std::int64_t corner = -(std::int64_t{1} << (top_shift - 1));
  open_.push_back({corner, corner, top_shift, 0, count});
  add_sentinel();
  while (!open_.empty()) {
    cancellation.throw_if_canceled();
    const Region region = open_.back();
    open_.pop_back();
    const int shift = cell_shift(region);
    if (shift == region.shift) {
      add_bin(region);
    } else {
      divide(region, shift);
    }
    // Regions are popped in the reverse order of their lists.
    lists_.resize(open_.empty() ? 0 : open_.back().end);
  }
}

/// The shift of the cells into which to divide a region: they are 2^shift grid units wide.
int FragmentBins::cell_shift(const Region& region) const {
  const std::size_t count = region.end - region.begin;
  if (count <= short_list) {
    return region.shift;
  }
  const double width = std::ldexp(1.0, region.shift);
  double sum = 0;
  for (std::size_t k = region.begin; k < region.end; ++k) {
    const FragmentBox& box = at(projected_.boxes, lists_[k]);
    const double extent = std::max(high(box, 0) - low(box, 0), high(box, 1) - low(box, 1));
    sum += std::min(extent, width);
  }
  const double cell_width = relative_cell_width * sum / static_cast<double>(count);
  int exponent = 0;
  std::frexp(cell_width, &exponent);
  // At most about as many cells as fragments; otherwise most cells would be empty.
  const int finest = region.shift - static_cast<int>(std::log2(static_cast<double>(count)) / 2);
  return std::clamp(exponent, finest, region.shift);
}

FragmentBins::Cells FragmentBins::cells_of(std::int32_t fragment, const Region& region,
                                           int shift) const {
  const FragmentBox& box = at(projected_.boxes, fragment);
  const int last = (1 << (region.shift - shift)) - 1;
  const auto cell = [&](double coordinate, std::int64_t from) {
    const auto offset = static_cast<std::int64_t>(coordinate) - from;
    return static_cast<std::int32_t>(std::clamp<std::int64_t>(offset >> shift, 0, last));
  };
  return {cell(low(box, 0), region.x), cell(low(box, 1), region.y), cell(high(box, 0), region.x),
          cell(high(box, 1), region.y)};
}

/// Whether the fragment may have area in a square; never false if it does.
bool FragmentBins::reaches(std::int32_t fragment, std::int64_t x, std::int64_t y,
                           std::int64_t size) const {
  const ProjectedFragments::Fragment& f = at(projected_.fragments, fragment);
  const GridPoint* const corners = projected_.corners.data();
  for (std::uint32_t k = f.begin; k < f.end; ++k) {
    const GridPoint& a = corners[k];
    const GridPoint& b = corners[k + 1 < f.end ? k + 1 : f.begin];
    const auto dx = static_cast<double>(b.x - a.x), dy = static_cast<double>(b.y - a.y);
    // The corner of the square farthest to the left of the edge.
    const auto px = static_cast<double>((dy < 0 ? x + size : x) - a.x);
    const auto py = static_cast<double>((dx > 0 ? y + size : y) - a.y);
    const double side = dx * py - dy * px;
    if (side < -0x1p-48 * (std::abs(dx * py) + std::abs(dy * px))) {
      return false;
    }
  }
  return true;
}

/// Replaces a region by its nonempty cells, with a counting sort of its fragments.
void FragmentBins::divide(const Region& region, int shift) {
  const std::size_t across = std::size_t{1} << (region.shift - shift);
  const std::size_t cell_count = across * across;
  const std::int64_t size = std::int64_t{1} << shift;
  fill_.assign(cell_count + 1, 0);
  cells_.clear();
  const auto visit = [&](std::int32_t fragment, const Cells& c, auto&& act) {
    const bool by_cell = (c.x1 - c.x0 + 1) * (c.y1 - c.y0 + 1) >= many_cells;
    for (std::int32_t y = c.y0; y <= c.y1; ++y) {
      for (std::int32_t x = c.x0; x <= c.x1; ++x) {
        if (by_cell && !reaches(fragment, region.x + x * size, region.y + y * size, size)) {
          continue;
        }
        act(static_cast<std::size_t>(y) * across + static_cast<std::size_t>(x));
      }
    }
  };
  for (std::size_t k = region.begin; k < region.end; ++k) {
    cells_.push_back(cells_of(lists_[k], region, shift));
    visit(lists_[k], cells_.back(), [&](std::size_t cell) { ++fill_[cell + 1]; });
  }
  const std::size_t base = lists_.size();
  for (std::size_t cell = 0; cell < cell_count; ++cell) {
    fill_[cell + 1] += fill_[cell];
  }
  lists_.resize(base + fill_[cell_count]);
  for (std::size_t cell = 0; cell < cell_count; ++cell) {
    if (fill_[cell] == fill_[cell + 1]) {
      continue;
    }
    const auto x = static_cast<std::int64_t>(cell % across);
    const auto y = static_cast<std::int64_t>(cell / across);
    open_.push_back({region.x + x * size, region.y + y * size, shift, base + fill_[cell],
                     base + fill_[cell + 1]});
  }
  for (std::size_t k = region.begin; k < region.end; ++k) {
    visit(lists_[k], cells_[k - region.begin],
          [&](std::size_t cell) { lists_[base + fill_[cell]++] = lists_[k]; });
  }
}

void FragmentBins::add_sentinel() {
  boxes_.push_back(everywhere);
  entry_fragments_.push_back(none);
  before_.push_back(none);
}

void FragmentBins::add_bin(const Region& region) {
  const auto begin = static_cast<Entry>(entry_fragments_.size());
  for (std::size_t k = region.begin; k < region.end; ++k) {
    const auto fragment = static_cast<std::size_t>(lists_[k]);
    before_.push_back(last_[fragment]);
    last_[fragment] = static_cast<Entry>(entry_fragments_.size());
    ++counts_[fragment];
    entry_fragments_.push_back(lists_[k]);
    boxes_.push_back(
        backs_only_ && projected_.fragments[fragment].front ? nowhere : projected_.boxes[fragment]);
  }
  bins_.push_back({region.x, region.y, std::int64_t{1} << region.shift, begin,
                   static_cast<Entry>(entry_fragments_.size())});
  add_sentinel();
}

}  // namespace transillum
