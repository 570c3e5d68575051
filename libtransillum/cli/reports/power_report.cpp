// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
// The table that `transillum solve --by` prints.
#include "cli/reports/summaries.h"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "cli/reports/report_text.h"

namespace transillum::cli {
namespace {

constexpr std::size_t most_exchanges = 20;  ///< printed; the others are summed

bool is_gray(const Rgb& power) { return power.r == power.g && power.g == power.b; }

bool is_gray(const PowerTable& table) {
  return std::all_of(table.surfaces.begin(), table.surfaces.end(), [](const SurfacePower& surface) {
    return is_gray(surface.emitted) && is_gray(surface.received) && is_gray(surface.absorbed) &&
           is_gray(surface.escaped);
  });
}

std::string power_text(const Rgb& power, bool gray) {
  return gray ? fmt::format("{:.5g}", power.r) : rgb_text(power, 4);
}

using Row = std::vector<std::string>;

/// Columns as wide as their widest cell; the first is aligned to the left.
std::string aligned(const std::vector<Row>& rows) {
  std::vector<std::size_t> width(rows.front().size());
  for (const Row& row : rows) {
    for (std::size_t c = 0; c < row.size(); ++c) {
      width[c] = std::max(width[c], row[c].size());
    }
  }
  std::string text;
  for (const Row& row : rows) {
    for (std::size_t c = 0; c < row.size(); ++c) {
      text += c == 0 ? fmt::format("{:<{}}", row[c], width[c])
                     : fmt::format("  {:>{}}", row[c], width[c]);
    }
    text += '\n';
  }
  return text;
}

/// Stands for a part whose name is empty.
const char* unnamed(SurfaceKind by) {
  return by == SurfaceKind::group ? "(no group)" : "(no name)";
}

std::string name_of(const SurfacePower& surface, SurfaceKind by) {
  return surface.name.empty() ? unnamed(by) : surface.name;
}

struct SurfaceExchange {
  std::size_t from, to;
  Rgb power;
};

std::vector<SurfaceExchange> strongest_first(const PowerTable& table) {
  std::vector<SurfaceExchange> list;
  for (std::size_t to = 0; to < table.exchanged.size(); ++to) {
    for (std::size_t from = 0; from < table.exchanged.size(); ++from) {
      if (const Rgb& power = table.exchanged[to][from]; max_abs(power) > 0) {
        list.push_back({from, to, power});
      }
    }
  }
  std::stable_sort(list.begin(), list.end(), [](const auto& a, const auto& b) {
    return a.power.r + a.power.g + a.power.b > b.power.r + b.power.g + b.power.b;
  });
  return list;
}

std::string exchange_text(const PowerTable& table, SurfaceKind by, bool gray) {
  const std::vector<SurfaceExchange> list = strongest_first(table);
  std::vector<Row> rows{{"from", "to", "power, W"}};
  Rgb others;
  for (std::size_t k = 0; k < list.size(); ++k) {
    if (k < most_exchanges) {
      rows.push_back({name_of(table.surfaces[list[k].from], by),
                      name_of(table.surfaces[list[k].to], by), power_text(list[k].power, gray)});
    } else {
      others += list[k].power;
    }
  }
  if (list.size() > most_exchanges) {
    rows.push_back(
        {fmt::format("{} others", list.size() - most_exchanges), "", power_text(others, gray)});
  }
  return aligned(rows);
}

}  // namespace

std::string power_report(const PowerTable& table, SurfaceKind by) {
  const bool gray = is_gray(table);
  const bool sky = max_abs(table.total.from_sky) > 0, sun = max_abs(table.total.from_sun) > 0;
  std::vector<Row> rows{{names_of<SurfaceKind>().at(static_cast<std::size_t>(by)), "patches",
                         "area, m2", "emitted, W", "received, W", "absorbed, W"}};
  if (sky) {
    rows.front().emplace_back("from the sky, W");
  }
  if (sun) {
    rows.front().emplace_back("from the sun, W");
  }
  if (table.escape_known) {
    rows.front().emplace_back("escaped, W");
  }
  std::vector<SurfacePower> surfaces = table.surfaces;
  for (SurfacePower& surface : surfaces) {
    surface.name = name_of(surface, by);
  }
  surfaces.push_back(table.total);
  for (const SurfacePower& surface : surfaces) {
    rows.push_back({surface.name, fmt::to_string(surface.patches),
                    fmt::format("{:.5g}", surface.area), power_text(surface.emitted, gray),
                    power_text(surface.received, gray), power_text(surface.absorbed, gray)});
    if (sky) {
      rows.back().push_back(power_text(surface.from_sky, gray));
    }
    if (sun) {
      rows.back().push_back(power_text(surface.from_sun, gray));
    }
    if (table.escape_known) {
      rows.back().push_back(power_text(surface.escaped, gray));
    }
  }
  std::string text = aligned(rows);
  if (!table.exchanged.empty()) {
    text += "\n" + exchange_text(table, by, gray);
  }
  return text;
}

}  // namespace transillum::cli
