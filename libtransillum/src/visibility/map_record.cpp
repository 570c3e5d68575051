// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include <vector>

#include "transillum/visibility_map.h"

namespace transillum {

std::vector<std::int32_t> MapRecord::map_after(std::int32_t step) const {
  std::vector<std::int32_t> map;
  // Rows are in order of making.
  for (std::size_t r = 0; r < rows.size() && rows[r].made <= step; ++r) {
    if (step < rows[r].consumed) map.push_back(static_cast<std::int32_t>(r));
  }
  return map;
}

std::int32_t MapRecord::fullest_step() const {
  std::vector<std::int32_t> change(static_cast<std::size_t>(step_count()) + 1, 0);
  for (const Row& row : rows) {
    if (row.front_facing) continue;
    ++change[static_cast<std::size_t>(row.made)];
    if (row.consumed != never) --change[static_cast<std::size_t>(row.consumed)];
  }
  std::int32_t fullest = -1, size = 0, most = 0;
  for (std::int32_t step = 0; step < step_count(); ++step) {
    size += change[static_cast<std::size_t>(step)];
    if (size > most) {
      most = size;
      fullest = step;
    }
  }
  return fullest;
}

}  // namespace transillum
