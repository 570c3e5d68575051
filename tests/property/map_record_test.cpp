// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
// The recorded history of a direction.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <vector>

#include "support/scenes.h"
#include "transillum/at.h"
#include "transillum/errors.h"
#include "transillum/visibility_map.h"
#include "visibility/map/map_history.h"

namespace transillum::map_record_test {
namespace {

double area_of(std::span<const Vec2> outline) {
  double twice = 0;
  for (std::size_t k = 2; k < outline.size(); ++k) {
    twice += (outline[k - 1].x - outline[0].x) * (outline[k].y - outline[0].y) -
             (outline[k - 1].y - outline[0].y) * (outline[k].x - outline[0].x);
  }
  return twice / 2;
}

TEST(MapRecord, GivesTheSameBitsAsTheUnrecordedRun) {
  const auto scene = load_scene("rooms");
  const auto tree = std::make_shared<const BspTree>(*scene);
  const TransferEngine engine = make_engine(Engine::local, scene, tree);
  for (const Vec3& omega : testing::test_directions(12, 2)) {
    const Transfers plain = engine(omega, {});
    const Transfers recorded = record_local_map(*scene, *tree, omega).transfers;
    ASSERT_EQ(plain.exchanges.size(), recorded.exchanges.size());
    for (std::size_t k = 0; k < plain.exchanges.size(); ++k) {
      EXPECT_EQ(plain.exchanges[k].receiver, recorded.exchanges[k].receiver);
      EXPECT_EQ(plain.exchanges[k].source, recorded.exchanges[k].source);
      EXPECT_EQ(plain.exchanges[k].area, recorded.exchanges[k].area);
    }
  }
}

template <class T>
std::uint64_t bytes_of(const std::vector<T>& list) {
  return list.capacity() * sizeof(T);
}

TEST(MapRecord, TakesNoMoreMemoryThanItMay) {
  const auto scene = load_scene("rooms");
  const BspTree tree(*scene);
  const Vec3 omega = testing::test_directions(9, 4).back();
  const MapRecord whole = record_local_map(*scene, tree, omega).record;
  const auto lists = [](const MapRecord& r) {
    return bytes_of(r.order) + bytes_of(r.step_patch) + bytes_of(r.rows) + bytes_of(r.corners) +
           bytes_of(r.lines);
  };
  const auto record_in = [&](std::uint64_t memory) -> std::optional<MapRecord> {
    try {
      return record_local_map(*scene, tree, omega, {}, memory).record;
    } catch (const MemoryLimitExceeded&) {
      return {};
    }
  };
  std::uint64_t fails = 1, succeeds = 4 * lists(whole);
  ASSERT_FALSE(record_in(fails));
  while (succeeds - fails > 1) {
    const std::uint64_t middle = (fails + succeeds) / 2;
    (record_in(middle) ? succeeds : fails) = middle;
  }
  const auto record = record_in(succeeds);
  ASSERT_TRUE(record);
  EXPECT_EQ(record->rows.size(), whole.rows.size());
  EXPECT_EQ(record->corners.size(), whole.corners.size());
  EXPECT_LE(lists(*record), succeeds);
  // Growing by a quarter leaves a quarter unused, and the longest list exists twice while it grows.
  EXPECT_LE(succeeds, 2 * lists(whole));
}

/// Area of V after step k = area before - area of the inside list + area of the step's polygon.
TEST(MapRecord, AreaIsKeptAtEveryStep) {
  const auto scene = load_scene("boards");
  const BspTree tree(*scene);
  for (const Vec3& omega : testing::test_directions(10, 4)) {
    const MapRecord record = record_local_map(*scene, tree, omega).record;
    double area_before = 0;
    for (std::int32_t step = 0; step < record.step_count(); ++step) {
      double area = 0;
      for (const std::int32_t row : record.map_after(step)) {
        area += area_of(record.outline(at(record.rows, row)));
      }
      double inside = 0, inserted = 0;
      for (const MapRecord::Row& row : record.rows) {
        if (row.made != step) {
          continue;
        }
        const double part = area_of(record.outline(row));
        if (row.consumed == step) {
          inside += part;
        }
        if (row.parent == MapRecord::no_row) {
          inserted += part;
        }
      }
      ASSERT_NEAR(area, area_before - inside + inserted, 1e-12) << "step " << step;
      ASSERT_LE(inside, inserted + 1e-12) << "step " << step;
      area_before = area;
    }
  }
}

TEST(MapRecord, EdgesLieOnTheLinesOfTheFragmentsTheyComeFrom) {
  const auto scene = load_scene("cornell-box");
  const BspTree tree(*scene);
  const MapHistory history(
      record_local_map(*scene, tree, testing::test_directions(9, 4).back()).record);
  const MapRecord& record = history.record();
  ASSERT_EQ(record.lines.size(), record.corners.size());
  const auto point = [&](PointId p) { return record.frame.project(at(tree.points(), p)); };
  int of_parent = 0, of_cutter = 0, of_older_cut = 0;
  for (std::size_t r = 0; r < record.rows.size(); ++r) {
    const MapRecord::Row& row = record.rows[r];
    const auto outline = record.outline(row);
    const auto lines = record.edge_lines(row);
    const auto origins = history.edge_origins(static_cast<std::int32_t>(r));
    ASSERT_EQ(origins.size(), outline.size());
    const MapRecord::Row& whole = at(record.rows, history.whole_of(static_cast<std::int32_t>(r)));
    ASSERT_EQ(whole.patch, row.patch);
    ASSERT_EQ(whole.parent, MapRecord::no_row);
    for (std::size_t k = 0; k < outline.size(); ++k) {
      // Both ends are on the line, up to rounding.
      const BspTree::Line& line = at(tree.lines(), lines[k]);
      const Vec2 a = point(line.a), b = point(line.b);
      const double length = std::hypot(b.x - a.x, b.y - a.y);
      for (const Vec2& end : {outline[k], outline[(k + 1) % outline.size()]}) {
        const double twice = (b.x - a.x) * (end.y - a.y) - (b.y - a.y) * (end.x - a.x);
        ASSERT_LE(std::abs(twice), 1e-13 * length) << "row " << r << ", edge " << k;
      }
      // The edge comes from a whole fragment that has the line.
      const MapRecord::Row& origin = at(record.rows, origins[k]);
      ASSERT_EQ(origin.parent, MapRecord::no_row);
      const auto known = record.edge_lines(origin);
      ASSERT_NE(std::find(known.begin(), known.end(), lines[k]), known.end());
      ASSERT_LE(origin.made, row.made);
      of_parent += origin.patch == row.patch;
      of_cutter += origin.made == row.made && row.parent != MapRecord::no_row;
      of_older_cut += origin.patch != row.patch && origin.made < row.made;
    }
  }
  EXPECT_GT(of_parent, 0);
  EXPECT_GT(of_cutter, 0);
  EXPECT_GT(of_older_cut, 0);
}

TEST(MapRecord, RowsReferToTheirParents) {
  const auto scene = load_scene("cornell-box");
  const BspTree tree(*scene);
  const MapRecord record =
      record_local_map(*scene, tree, testing::test_directions(9, 4).back()).record;
  ASSERT_EQ(record.step_patch.size(), record.order.size());
  int cut = 0;
  for (const MapRecord::Row& row : record.rows) {
    EXPECT_LE(row.made, row.consumed);
    if (row.parent == MapRecord::no_row) {
      EXPECT_EQ(row.patch, at(record.step_patch, row.made));
    } else {
      const MapRecord::Row& parent = at(record.rows, row.parent);
      EXPECT_EQ(row.patch, parent.patch);
      EXPECT_EQ(row.made, parent.consumed);
      ++cut;
    }
  }
  EXPECT_GT(cut, 0);
  // Number times area of the back-facing rows of V after a step.
  const auto fullness = [&](std::int32_t step) {
    double rows = 0, area = 0;
    for (const std::int32_t number : record.map_after(step)) {
      const MapRecord::Row& row = at(record.rows, number);
      if (row.front_facing) {
        continue;
      }
      rows += 1;
      area += area_of(record.outline(row));
    }
    return rows * area;
  };
  const auto most = fullness(record.fullest_step());
  EXPECT_GT(most, 0);
  for (std::int32_t step = 0; step < record.step_count(); ++step) {
    EXPECT_LE(fullness(step), most * (1 + 1e-12));
  }
}

}  // namespace
}  // namespace transillum::map_record_test
