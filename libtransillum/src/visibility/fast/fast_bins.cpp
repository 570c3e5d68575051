// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "visibility/fast/fast_bins.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "transillum/at.h"

namespace transillum {
namespace {

/// Lists no longer than this are not worth dividing.
constexpr std::size_t short_list = 12;
/// A bin is about so many times as wide as its faces.
constexpr double faces_across = 1.5;
/// From so many cells on a face is tested against each cell and not by its box alone.
constexpr int many_cells = 12;
constexpr int top_shift = 62;
constexpr float infinity = std::numeric_limits<float>::infinity();
constexpr FaceBox nowhere{
    {infinity, infinity, infinity, infinity, infinity, infinity, infinity, infinity}};
constexpr FaceBox everywhere{
    {-infinity, -infinity, -infinity, -infinity, -infinity, -infinity, -infinity, -infinity}};

double low(const FaceBox& box, std::size_t axis) { return box.ends[axis]; }
double high(const FaceBox& box, std::size_t axis) { return -box.ends[axis + 4]; }

}  // namespace

void FastBins::fill(const Cancellation& cancellation) {
  const std::size_t count = input_.faces.size();
  bins_.clear();
  faces_of_.clear();
  boxes_.clear();
  before_.clear();
  open_.clear();
  last_.assign(count, none);
  counts_.assign(count, 0);
  faces_of_.reserve(4 * count);
  boxes_.reserve(4 * count);
  before_.reserve(4 * count);
  lists_.resize(count);
  for (std::size_t k = 0; k < count; ++k) {
    lists_[k] = static_cast<std::int32_t>(k);
  }
  constexpr std::int64_t corner = -(std::int64_t{1} << (top_shift - 1));
  open_.push_back({corner, corner, top_shift, 0, count});
  add_end();
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
    // Regions are taken off in the reverse order of their lists.
    lists_.resize(open_.empty() ? 0 : open_.back().end);
  }
}

/// How wide the cells of a region shall be: 2^shift steps.
int FastBins::cell_shift(const Region& region) const {
  const std::size_t count = region.end - region.begin;
  if (count <= short_list) {
    return region.shift;
  }
  const double width = std::ldexp(1.0, region.shift);
  double sum = 0;
  for (std::size_t k = region.begin; k < region.end; ++k) {
    const FaceBox& box = at(input_.boxes, lists_[k]);
    const double extent = std::max(high(box, 0) - low(box, 0), high(box, 1) - low(box, 1));
    sum += std::min(extent, width);
  }
  const double wanted = faces_across * sum / static_cast<double>(count);
  int exponent = 0;
  std::frexp(wanted, &exponent);
  // No more cells than faces, or empty ones would outnumber them.
  const int finest = region.shift - static_cast<int>(std::log2(static_cast<double>(count)) / 2);
  return std::clamp(exponent, finest, region.shift);
}

FastBins::Cells FastBins::cells_of(std::int32_t face, const Region& region, int shift) const {
  const FaceBox& box = at(input_.boxes, face);
  const int last = (1 << (region.shift - shift)) - 1;
  const auto cell = [&](double at, std::int64_t from) {
    const auto steps = static_cast<std::int64_t>(at) - from;
    return static_cast<std::int32_t>(std::clamp<std::int64_t>(steps >> shift, 0, last));
  };
  return {cell(low(box, 0), region.x), cell(low(box, 1), region.y), cell(high(box, 0), region.x),
          cell(high(box, 1), region.y)};
}

/// Whether the face may have area in a square. A no is certain.
bool FastBins::reaches(std::int32_t face, std::int64_t x, std::int64_t y, std::int64_t size) const {
  const ProjectedFragments::Face& f = at(input_.faces, face);
  const GridPoint* const corners = input_.corners.data();
  for (std::uint32_t k = f.begin; k < f.end; ++k) {
    const GridPoint& a = corners[k];
    const GridPoint& b = corners[k + 1 < f.end ? k + 1 : f.begin];
    const auto dx = static_cast<double>(b.x - a.x), dy = static_cast<double>(b.y - a.y);
    // The corner of the square that lies farthest to the left of the edge.
    const auto px = static_cast<double>((dy < 0 ? x + size : x) - a.x);
    const auto py = static_cast<double>((dx > 0 ? y + size : y) - a.y);
    const double side = dx * py - dy * px;
    if (side < -0x1p-48 * (std::abs(dx * py) + std::abs(dy * px))) {
      return false;
    }
  }
  return true;
}

void FastBins::divide(const Region& region, int shift) {
  const int across = 1 << (region.shift - shift);
  const auto cell_count = static_cast<std::size_t>(across) * static_cast<std::size_t>(across);
  const std::int64_t size = std::int64_t{1} << shift;
  fill_.assign(cell_count + 1, 0);
  cells_.clear();
  const auto visit = [&](std::int32_t face, const Cells& c, auto&& act) {
    const bool by_cell = (c.x1 - c.x0 + 1) * (c.y1 - c.y0 + 1) >= many_cells;
    for (std::int32_t y = c.y0; y <= c.y1; ++y) {
      for (std::int32_t x = c.x0; x <= c.x1; ++x) {
        if (by_cell && !reaches(face, region.x + x * size, region.y + y * size, size)) {
          continue;
        }
        act(static_cast<std::size_t>(y) * static_cast<std::size_t>(across) +
            static_cast<std::size_t>(x));
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
    const auto x = static_cast<std::int64_t>(cell % static_cast<std::size_t>(across));
    const auto y = static_cast<std::int64_t>(cell / static_cast<std::size_t>(across));
    open_.push_back({region.x + x * size, region.y + y * size, shift, base + fill_[cell],
                     base + fill_[cell + 1]});
  }
  for (std::size_t k = region.begin; k < region.end; ++k) {
    visit(lists_[k], cells_[k - region.begin],
          [&](std::size_t cell) { lists_[base + fill_[cell]++] = lists_[k]; });
  }
}

void FastBins::add_end() {
  boxes_.push_back(everywhere);
  faces_of_.push_back(none);
  before_.push_back(none);
}

void FastBins::add_bin(const Region& region) {
  const auto begin = static_cast<Entry>(faces_of_.size());
  for (std::size_t k = region.begin; k < region.end; ++k) {
    const auto face = static_cast<std::size_t>(lists_[k]);
    before_.push_back(last_[face]);
    last_[face] = static_cast<Entry>(faces_of_.size());
    ++counts_[face];
    faces_of_.push_back(lists_[k]);
    boxes_.push_back(backs_only_ && input_.faces[face].front ? nowhere : input_.boxes[face]);
  }
  bins_.push_back({region.x, region.y, std::int64_t{1} << region.shift, begin,
                   static_cast<Entry>(faces_of_.size())});
  add_end();
}

}  // namespace transillum
