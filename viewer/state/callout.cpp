// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "state/callout.h"

#include <vector>

#include "transillum/at.h"

namespace transillum::viewer {

namespace {

Vec2 middle_of(std::span<const Vec2> corners) {
  Vec2 sum{0, 0};
  for (const Vec2& p : corners) {
    sum = {sum.x + p.x, sum.y + p.y};
  }
  const auto count = static_cast<double>(corners.size());
  return {sum.x / count, sum.y / count};
}

}  // namespace

std::optional<Vec2> place_in_map(const Callout& callout, const RecordedMap& map,
                                 std::span<const std::int32_t> rows, std::int32_t step) {
  using Anchor = Callout::Anchor;
  const MapRecord& record = map.record();
  if (callout.anchor == Anchor::point) {
    return record.frame.project(callout.point);
  }
  if (callout.anchor == Anchor::direction || callout.anchor == Anchor::map) {
    return std::nullopt;
  }
  const bool inside = callout.anchor == Anchor::inside && step >= 0;
  std::vector<std::int32_t> of_step;
  if (inside) {
    of_step = map.history.inside_at(step);
    rows = of_step;
  }
  double largest = 0;
  std::optional<Vec2> place;
  for (const std::int32_t r : rows) {
    const MapRecord::Row& row = at(record.rows, r);
    if ((inside || row.patch == callout.patch) && record.area(row) > largest) {
      largest = record.area(row);
      place = middle_of(record.outline(row));
    }
  }
  return place;
}

}  // namespace transillum::viewer
