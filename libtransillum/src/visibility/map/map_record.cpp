// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include <cmath>
#include <vector>

#include "geometry/polygon_area.h"
#include "transillum/at.h"
#include "transillum/visibility_map.h"

namespace transillum {

std::optional<Vec3> PlaneFrame::point_on(const Patch& patch, const Vec2& p) const {
  const double cosine = dot(patch.normal, omega);
  if (std::abs(cosine) < 1e-9) {
    return std::nullopt;
  }
  const Vec3 on_plane = origin + p.x * u + p.y * v;
  return on_plane + (dot(patch.normal, patch.center - on_plane) / cosine) * omega;
}

double MapRecord::area(const Row& row) const {
  const auto corner = outline(row);
  return polygon_area(corner.size(), [&](std::size_t k) -> const Vec2& { return corner[k]; });
}

bool MapRecord::covers(const Row& row, const Vec2& p) const {
  // The outline is convex, but rounding may have reversed a needle: p lies on the same side of all
  // edges, left or right.
  const auto corner = outline(row);
  bool left = true, right = true;
  for (std::size_t k = 0; k < corner.size() && (left || right); ++k) {
    const Vec2 &a = corner[k], &b = corner[(k + 1) % corner.size()];
    const double side = (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x);
    left = left && side >= 0;
    right = right && side <= 0;
  }
  return left != right;
}

std::vector<std::int32_t> MapRecord::map_after(std::int32_t step) const {
  std::vector<std::int32_t> map;
  // Rows are sorted by `made`.
  for (std::size_t r = 0; r < rows.size() && rows[r].made <= step; ++r) {
    if (step < rows[r].consumed) {
      map.push_back(static_cast<std::int32_t>(r));
    }
  }
  return map;
}

std::int32_t MapRecord::fullest_step() const {
  struct Change {
    double rows = 0, area = 0;
  };
  std::vector<Change> changes(static_cast<std::size_t>(step_count()) + 1);
  for (const Row& row : rows) {
    if (row.front_facing) {
      continue;
    }
    const double area = this->area(row);
    Change& made = at(changes, row.made);
    made.rows += 1;
    made.area += area;
    if (row.consumed == never) {
      continue;
    }
    Change& consumed = at(changes, row.consumed);
    consumed.rows -= 1;
    consumed.area -= area;
  }
  std::int32_t fullest = -1;
  double row_count = 0, area = 0, most = 0;
  for (std::int32_t step = 0; step < step_count(); ++step) {
    row_count += at(changes, step).rows;
    area += at(changes, step).area;
    if (row_count * area > most) {
      most = row_count * area;
      fullest = step;
    }
  }
  return fullest;
}

}  // namespace transillum
