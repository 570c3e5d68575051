// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "transillum/visibility_map.h"

#include <algorithm>

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

VisibilityMap map_from_below(const RecordedDirection& direction) {
  VisibilityMap map = map_after(direction.record, direction.record.step_count() - 1);
  map.exchanges = direction.transfers.exchanges;
  return map;
}

VisibilityMap map_of_receiver(const RecordedDirection& direction, PatchId receiver) {
  const MapRecord& record = direction.record;
  // The receiver's own polygon has its facing, but its row comes after those of what it sees.
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
