// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Indexes of a MapRecord, the table of rows that record_local_map() writes for one direction: the
// rows and sums of each step, and the steps of each patch. Rows are sorted by `made`, the step that
// made them.
#include "visibility/map/map_history.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "transillum/at.h"

namespace transillum {

namespace {

bool is_inside_part(const MapRecord::Row& row) { return row.made == row.consumed; }

bool is_outside_part(const MapRecord::Row& row) {
  return row.parent != MapRecord::no_row && row.made != row.consumed;
}

template <class T>
std::size_t bytes_of(const std::vector<T>& list) {
  return list.capacity() * sizeof(T);
}

}  // namespace

double MapHistory::Step::open_fraction() const {
  return area > 0 ? std::abs(area - covered) / area : 0;
}

MapHistory::MapHistory(MapRecord record) : record_(std::move(record)) {
  find_steps();
  find_patches();
}

void MapHistory::find_steps() {
  const std::int32_t steps = record_.step_count();
  const auto rows = static_cast<std::int32_t>(record_.rows.size());
  steps_.resize(static_cast<std::size_t>(steps));
  first_row_.resize(static_cast<std::size_t>(steps) + 1);
  std::int32_t r = 0, map_size = 0;
  for (std::int32_t k = 0; k < steps; ++k) {
    Step& step = at(steps_, k);
    step.patch = at(record_.step_patch, k);
    at(first_row_, k) = r;
    const std::int32_t first = r;
    // The last row of a step is the step's own polygon.
    while (r < rows && row(r).made == k) {
      ++r;
    }
    if (r > first) {
      step.row = r - 1;
      step.front_facing = row(step.row).front_facing;
    }
    for (std::int32_t made = first; made < r; ++made) {
      const double area = record_.area(row(made));
      step.smallest = made == first ? area : std::min(step.smallest, area);
      if (!is_inside_part(row(made))) {
        ++map_size;
        if (made == step.row) {
          step.area = area;
        }
        continue;
      }
      --map_size;  // the parent is consumed
      ++step.cut;
      step.covered += area;
      if (!exchanges(made)) {
        continue;
      }
      ++step.exchanges;
      step.exchanged += area;
    }
    step.map_size = map_size;
  }
  at(first_row_, steps) = r;
}

void MapHistory::find_patches() {
  PatchId patches = 0;
  for (const PatchId patch : record_.step_patch) {
    patches = std::max(patches, patch + 1);
  }
  // Steps are visited in order, so a step is new for a patch if it is not the patch's last one.
  std::vector<std::int32_t> last(static_cast<std::size_t>(patches), none);
  const auto for_each_event = [&](const auto& visit) {
    std::fill(last.begin(), last.end(), none);
    for (std::int32_t k = 0; k < step_count(); ++k) {
      const auto visit_once = [&](PatchId patch) {
        if (std::exchange(at(last, patch), k) != k) {
          visit(patch, k);
        }
      };
      visit_once(step(k).patch);
      for (std::int32_t r = first_row(k); r < first_row(k + 1); ++r) {
        visit_once(row(r).patch);
      }
    }
  };
  patch_begin_.assign(static_cast<std::size_t>(patches) + 1, 0);
  for_each_event([&](PatchId patch, std::int32_t) { ++at(patch_begin_, patch + 1); });
  for (std::size_t p = 1; p < patch_begin_.size(); ++p) {
    patch_begin_[p] += patch_begin_[p - 1];
  }
  patch_steps_.resize(patch_begin_.back());
  std::vector<std::uint32_t> end(patch_begin_.begin(), patch_begin_.end() - 1);
  for_each_event([&](PatchId patch, std::int32_t k) { patch_steps_[at(end, patch)++] = k; });
}

std::vector<std::int32_t> MapHistory::cut_at(std::int32_t k) const {
  std::vector<std::int32_t> rows = inside_at(k);
  for (std::int32_t& r : rows) {
    r = row(r).parent;
  }
  return rows;
}

std::vector<std::int32_t> MapHistory::inside_at(std::int32_t k) const {
  std::vector<std::int32_t> rows;
  for (std::int32_t r = first_row(k); r < first_row(k + 1); ++r) {
    if (is_inside_part(row(r))) {
      rows.push_back(r);
    }
  }
  return rows;
}

std::vector<std::int32_t> MapHistory::outside_at(std::int32_t k) const {
  std::vector<std::int32_t> rows;
  for (std::int32_t r = first_row(k); r < first_row(k + 1); ++r) {
    if (is_outside_part(row(r))) {
      rows.push_back(r);
    }
  }
  return rows;
}

bool MapHistory::exchanges(std::int32_t r) const {
  // The polygon above emits (is back-facing) and the one below receives: see TransferSums.
  const std::int32_t below = at(steps_, row(r).made).row;
  return row(below).front_facing && !row(r).front_facing;
}

PatchId MapHistory::cut_by(std::int32_t r) const {
  return row(r).parent == MapRecord::no_row ? no_patch : step(row(r).made).patch;
}

std::int32_t MapHistory::whole_of(std::int32_t r) const {
  while (row(r).parent != MapRecord::no_row) {
    r = row(r).parent;
  }
  return r;
}

std::vector<std::int32_t> MapHistory::edge_origins(std::int32_t r) const {
  const auto has = [this](std::int32_t number, LineId line) {
    const auto lines = record_.edge_lines(row(number));
    return std::find(lines.begin(), lines.end(), line) != lines.end();
  };
  std::vector<std::int32_t> origins;
  for (const LineId line : record_.edge_lines(row(r))) {
    std::int32_t origin = r;
    while (row(origin).parent != MapRecord::no_row) {
      const std::int32_t cutter = step(row(origin).made).row;
      origin = has(row(origin).parent, line) ? row(origin).parent : cutter;
    }
    origins.push_back(origin);
  }
  return origins;
}

std::span<const std::int32_t> MapHistory::steps_of(PatchId patch) const {
  const auto p = static_cast<std::size_t>(patch);
  if (patch < 0 || p + 1 >= patch_begin_.size()) {
    return {};
  }
  return {patch_steps_.data() + patch_begin_[p], patch_begin_[p + 1] - patch_begin_[p]};
}

std::int32_t MapHistory::next_step_of(PatchId patch, std::int32_t k) const {
  const auto steps = steps_of(patch);
  const auto after = std::upper_bound(steps.begin(), steps.end(), k);
  return after == steps.end() ? none : *after;
}

std::int32_t MapHistory::previous_step_of(PatchId patch, std::int32_t k) const {
  const auto steps = steps_of(patch);
  const auto from = std::lower_bound(steps.begin(), steps.end(), k);
  return from == steps.begin() ? none : *(from - 1);
}

std::size_t MapHistory::memory() const {
  return bytes_of(record_.order) + bytes_of(record_.step_patch) + bytes_of(record_.rows) +
         bytes_of(record_.corners) + bytes_of(record_.lines) + bytes_of(steps_) +
         bytes_of(first_row_) + bytes_of(patch_steps_) + bytes_of(patch_begin_);
}

}  // namespace transillum
