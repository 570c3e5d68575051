// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "visibility/plane_index.h"

#include <algorithm>
#include <cmath>

namespace transillum {
namespace {

constexpr int most_levels = 12;

bool overlap(const PlaneBox& a, const PlaneBox& b) {
  return a.x0 < b.x1 && b.x0 < a.x1 && a.y0 < b.y1 && b.y0 < a.y1;
}

}  // namespace

PlaneBox box_of(const MapPolygon& polygon) {
  Real x0 = polygon[0].at.x, x1 = x0, y0 = polygon[0].at.y, y1 = y0;
  for (const MapCorner& corner : polygon) {
    x0 = std::min(x0, corner.at.x);
    x1 = std::max(x1, corner.at.x);
    y0 = std::min(y0, corner.at.y);
    y1 = std::max(y1, corner.at.y);
  }
  // Rounded outward: a needle thinner than a double's last place still has a box.
  const auto down = [](Real r) { return std::nextafter(static_cast<double>(r), -HUGE_VAL); };
  const auto up = [](Real r) { return std::nextafter(static_cast<double>(r), HUGE_VAL); };
  return {down(x0), down(y0), up(x1), up(y1)};
}

PlaneIndex::PlaneIndex(const PlaneBox& all, std::size_t expected)
    : x0_(all.x0), y0_(all.y0), size_(std::max(all.x1 - all.x0, all.y1 - all.y0)) {
  levels_ = 1;
  std::size_t begin = 0;
  while (levels_ < most_levels && (std::size_t{1} << (2 * (levels_ - 1))) < expected) ++levels_;
  for (int level = 0; level < levels_; ++level) {
    level_begin_.push_back(begin);
    cell_size_.push_back(std::ldexp(size_, -level));
    begin += std::size_t{1} << (2 * level);
  }
  cells_.resize(begin);
}

PlaneIndex::Cell& PlaneIndex::cell(int level, int x, int y) {
  return cells_[level_begin_[static_cast<std::size_t>(level)] +
                (static_cast<std::size_t>(y) << level) + static_cast<std::size_t>(x)];
}

const PlaneIndex::Cell& PlaneIndex::cell(int level, int x, int y) const {
  return const_cast<PlaneIndex*>(this)->cell(level, x, y);
}

void PlaneIndex::count(const Entry& entry, std::int32_t change) {
  int x = entry.x, y = entry.y;
  for (int level = entry.level; level >= 0; --level, x /= 2, y /= 2) {
    cell(level, x, y).below += change;
  }
}

void PlaneIndex::insert(std::int32_t id, const PlaneBox& box) {
  if (entries_.size() <= static_cast<std::size_t>(id)) {
    entries_.resize(static_cast<std::size_t>(id) + 1);
  }
  Entry& entry = entries_[static_cast<std::size_t>(id)];
  entry.box = box;
  const double extent = std::max(box.x1 - box.x0, box.y1 - box.y0);
  int level = 0;
  while (level + 1 < levels_ && extent <= cell_size_[static_cast<std::size_t>(level) + 1]) ++level;
  const double cell_size = cell_size_[static_cast<std::size_t>(level)];
  const int last = (1 << level) - 1;
  entry.level = level;
  entry.x = std::clamp(static_cast<int>((0.5 * (box.x0 + box.x1) - x0_) / cell_size), 0, last);
  entry.y = std::clamp(static_cast<int>((0.5 * (box.y0 + box.y1) - y0_) / cell_size), 0, last);

  Cell& home = cell(level, entry.x, entry.y);
  entry.previous = -1;
  entry.next = home.head;
  if (home.head >= 0) entries_[static_cast<std::size_t>(home.head)].previous = id;
  home.head = id;
  count(entry, +1);
}

void PlaneIndex::erase(std::int32_t id) {
  const Entry& entry = entries_[static_cast<std::size_t>(id)];
  if (entry.next >= 0) entries_[static_cast<std::size_t>(entry.next)].previous = entry.previous;
  if (entry.previous >= 0) {
    entries_[static_cast<std::size_t>(entry.previous)].next = entry.next;
  } else {
    cell(entry.level, entry.x, entry.y).head = entry.next;
  }
  count(entry, -1);
}

void PlaneIndex::query(const PlaneBox& box, std::vector<std::int32_t>& found) const {
  struct Visit {
    int level, x, y;
  };
  std::array<Visit, 4 * most_levels> stack;
  std::size_t height = 0;
  stack[height++] = {0, 0, 0};
  while (height > 0) {
    const Visit visit = stack[--height];
    const Cell& here = cell(visit.level, visit.x, visit.y);
    if (here.below == 0) continue;
    const double cell_size = cell_size_[static_cast<std::size_t>(visit.level)];
    const double x = x0_ + visit.x * cell_size, y = y0_ + visit.y * cell_size;
    const PlaneBox loose{x - 0.5 * cell_size, y - 0.5 * cell_size, x + 1.5 * cell_size,
                         y + 1.5 * cell_size};
    if (visit.level > 0 && !overlap(loose, box)) continue;
    for (std::int32_t id = here.head; id >= 0; id = entries_[static_cast<std::size_t>(id)].next) {
      if (overlap(entries_[static_cast<std::size_t>(id)].box, box)) found.push_back(id);
    }
    if (visit.level + 1 == levels_) continue;
    for (int child = 0; child < 4; ++child) {
      stack[height++] = {visit.level + 1, 2 * visit.x + (child & 1), 2 * visit.y + (child >> 1)};
    }
  }
}

}  // namespace transillum
