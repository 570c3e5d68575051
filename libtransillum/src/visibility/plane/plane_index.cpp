// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// A loose quadtree over the plane: cells are stored in one array, the entries of a cell in a linked
// list.
#include "visibility/plane/plane_index.h"

#include <algorithm>

#include "transillum/at.h"

namespace transillum {
namespace {

constexpr int max_levels = 24;
/// Levels beyond those that an even distribution requires.
constexpr int spare_levels = 8;

bool overlap(const PlaneBox& a, const PlaneBox& b) {
  return a.x0 < b.x1 && b.x0 < a.x1 && a.y0 < b.y1 && b.y0 < a.y1;
}

}  // namespace

PlaneIndex::PlaneIndex(const PlaneBox& all, std::size_t expected) : levels_(spare_levels) {
  while (levels_ < max_levels && (std::size_t{1} << (2 * (levels_ - spare_levels))) < expected) {
    ++levels_;
  }
  cells_.reserve(2 * expected);
  cells_.push_back({all.x0, all.y0, std::max(all.x1 - all.x0, all.y1 - all.y0), none});
}

/// The child of `cell` that contains the point; created if missing.
std::int32_t PlaneIndex::child_toward(std::int32_t cell, double x, double y) {
  const Cell& parent = at(cells_, cell);
  const double size = 0.5 * parent.size;
  const bool right = x >= parent.x + size, upper = y >= parent.y + size;
  const std::size_t quadrant = (right ? 1u : 0u) + (upper ? 2u : 0u);
  if (parent.children[quadrant] != none) {
    return parent.children[quadrant];
  }
  const auto made = static_cast<std::int32_t>(cells_.size());
  const Cell child{parent.x + (right ? size : 0), parent.y + (upper ? size : 0), size, cell};
  cells_.push_back(child);
  at(cells_, cell).children[quadrant] = made;
  return made;
}

void PlaneIndex::count(std::int32_t cell, std::int32_t change) {
  for (; cell != none; cell = at(cells_, cell).parent) {
    at(cells_, cell).below += change;
  }
}

void PlaneIndex::insert(std::int32_t id, const PlaneBox& box) {
  if (entries_.size() <= static_cast<std::size_t>(id)) {
    entries_.resize(static_cast<std::size_t>(id) + 1);
  }
  const double extent = std::max(box.x1 - box.x0, box.y1 - box.y0);
  const double x = 0.5 * (box.x0 + box.x1), y = 0.5 * (box.y0 + box.y1);
  std::int32_t home = 0;
  for (int level = 1; level < levels_; ++level) {
    if (extent > 0.5 * at(cells_, home).size) {
      break;
    }
    home = child_toward(home, x, y);
  }
  Cell& cell = at(cells_, home);
  at(entries_, id) = {box, home, cell.head, none};
  if (cell.head != none) {
    at(entries_, cell.head).previous = id;
  }
  cell.head = id;
  count(home, +1);
}

void PlaneIndex::erase(std::int32_t id) {
  const Entry& entry = at(entries_, id);
  if (entry.next != none) {
    at(entries_, entry.next).previous = entry.previous;
  }
  if (entry.previous != none) {
    at(entries_, entry.previous).next = entry.next;
  } else {
    at(cells_, entry.cell).head = entry.next;
  }
  count(entry.cell, -1);
}

void PlaneIndex::query(const PlaneBox& box, std::vector<std::int32_t>& found) const {
  // Each cell popped pushes at most four.
  std::array<std::int32_t, 4 * max_levels> stack;
  std::size_t height = 0;
  stack[height++] = 0;
  while (height > 0) {
    const Cell& cell = at(cells_, stack[--height]);
    if (cell.below == 0) {
      continue;
    }
    const double half = 0.5 * cell.size;
    const PlaneBox loose{cell.x - half, cell.y - half, cell.x + cell.size + half,
                         cell.y + cell.size + half};
    if (cell.parent != none && !overlap(loose, box)) {
      continue;
    }
    for (std::int32_t id = cell.head; id != none; id = at(entries_, id).next) {
      if (overlap(at(entries_, id).box, box)) {
        found.push_back(id);
      }
    }
    for (const std::int32_t child : cell.children) {
      if (child != none) {
        stack[height++] = child;
      }
    }
  }
}

}  // namespace transillum
