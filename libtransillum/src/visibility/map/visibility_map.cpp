// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "transillum/visibility_map.h"

#include <algorithm>
#include <iterator>
#include <map>

#include "transillum/at.h"

namespace transillum {
namespace {

/// Copies rows of a record, with their corners, into a map.
class MapMaker {
 public:
  explicit MapMaker(const MapRecord& record, PatchId receiver = no_patch) : record_(record) {
    map_.frame = record_.frame;
    map_.receiver = receiver;
  }

  void add(std::vector<VisibilityMap::Polygon> VisibilityMap::*list, const MapRecord::Row& row) {
    const auto outline = record_.outline(row);
    const auto begin = static_cast<std::uint32_t>(map_.corners.size());
    map_.corners.insert(map_.corners.end(), outline.begin(), outline.end());
    // Rounding corners to double may reverse a needle.
    (map_.*list)
        .push_back({row.patch, row.front_facing, std::max(record_.area(row), 0.0), begin,
                    static_cast<std::uint32_t>(map_.corners.size())});
  }

  VisibilityMap finish() {
    std::stable_sort(map_.polygons.begin(), map_.polygons.end(),
                     [](const auto& a, const auto& b) { return a.patch < b.patch; });
    return std::move(map_);
  }

 private:
  const MapRecord& record_;
  VisibilityMap map_;
};

}  // namespace

VisibilityMap map_after(const MapRecord& record, std::int32_t step) {
  MapMaker maker(record);
  for (const std::int32_t row : record.map_after(step)) {
    maker.add(&VisibilityMap::polygons, at(record.rows, row));
  }
  return maker.finish();
}

namespace {

/// Sums over the inside lists of the steps up to `step`.
std::vector<Transfer> exchanges_until(const MapRecord& record, std::int32_t step) {
  std::map<std::pair<PatchId, PatchId>, double> areas;  // by receiver and source
  auto first = record.rows.begin();
  while (first != record.rows.end() && first->made <= step) {
    const auto end = std::find_if(first, record.rows.end(), [first](const MapRecord::Row& row) {
      return row.made != first->made;
    });
    const MapRecord::Row& below = *std::prev(end);  // the step's own polygon comes last
    for (; first != end; ++first) {
      if (first->made == first->consumed && below.front_facing && !first->front_facing) {
        areas[{below.patch, first->patch}] += record.area(*first);
      }
    }
  }
  std::vector<Transfer> exchanges;
  for (const auto& [pair, area] : areas) {
    exchanges.push_back({pair.first, pair.second, area});
  }
  return exchanges;
}

}  // namespace

VisibilityMap map_after(const RecordedDirection& direction, std::int32_t step) {
  VisibilityMap map = map_after(direction.record, step);
  map.exchanges = step + 1 < direction.record.step_count() ? exchanges_until(direction.record, step)
                                                           : direction.transfers.exchanges;
  return map;
}

VisibilityMap map_from_below(const RecordedDirection& direction) {
  return map_after(direction, direction.record.step_count() - 1);
}

VisibilityMap map_of_receiver(const RecordedDirection& direction, PatchId receiver) {
  const MapRecord& record = direction.record;
  // The receiver's own polygon has its facing, but its row comes after the rows of what it sees.
  std::vector<bool> receives_at(record.order.size(), false);  // by step
  MapMaker maker(record, receiver);
  for (const MapRecord::Row& row : record.rows) {
    if (row.parent != MapRecord::no_row || row.patch != receiver || !row.front_facing) {
      continue;
    }
    at(receives_at, row.made) = true;
    maker.add(&VisibilityMap::window, row);
  }
  for (const MapRecord::Row& row : record.rows) {
    if (row.made != row.consumed || !at(receives_at, row.made)) {
      continue;
    }
    maker.add(&VisibilityMap::polygons, row);
  }
  VisibilityMap map = maker.finish();
  map.exchanges = direction.transfers.exchanges;
  return map;
}

}  // namespace transillum
