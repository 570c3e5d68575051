// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
// The queries of a direction's history, against slow, independent computations.
#include "visibility/map/map_history.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "support/scenes.h"
#include "transillum/at.h"

namespace transillum::map_history_test {
namespace {

using ::testing::ElementsAreArray;

std::vector<std::shared_ptr<const Scene>> scenes() {
  testing::Sketch soup;
  soup.box({0, 0, 0}, {1, 1, 1}, true, soup.material(0.5, 1));
  soup.triangles(8, 0.5, 7, soup.material(0.5, 0));
  return {load_scene("boards"), load_scene("cornell-box"), soup.scene()};
}

/// The recorded directions of one scene, with their transfers.
struct Recorded {
  std::shared_ptr<const Scene> scene;
  BspTree tree;
  std::vector<MapHistory> histories;
  std::vector<Transfers> transfers;

  Recorded(std::shared_ptr<const Scene> of, int directions) : scene(std::move(of)), tree(*scene) {
    for (const Vec3& omega : testing::test_directions(directions, 5)) {
      RecordedDirection recorded = record_local_map(*scene, tree, omega);
      transfers.push_back(std::move(recorded.transfers));
      histories.emplace_back(std::move(recorded.record));
    }
  }
};

/// Area of a union of convex polygons. Between two successive x of corners and crossings, no edges
/// cross, so the union's height is linear and the area is its middle value times the width.
class UnionArea {
 public:
  void add(const std::vector<Vec2>& polygon) {
    for (std::size_t k = 0; k < polygon.size(); ++k) {
      const Edge edge{polygon[k], polygon[(k + 1) % polygon.size()]};
      cuts_.push_back(edge.a.x);
      for (const Edge& other : edges_) {
        add_crossing(edge, other);
      }
      edges_.push_back(edge);
    }
    polygons_.push_back(polygon);
  }

  double area() const {
    std::vector<double> cuts = cuts_;
    std::sort(cuts.begin(), cuts.end());
    double sum = 0;
    for (std::size_t k = 1; k < cuts.size(); ++k) {
      if (cuts[k] > cuts[k - 1]) {
        sum += (cuts[k] - cuts[k - 1]) * height((cuts[k - 1] + cuts[k]) / 2);
      }
    }
    return sum;
  }

 private:
  struct Edge {
    Vec2 a, b;
    double y(double x) const { return a.y + (x - a.x) / (b.x - a.x) * (b.y - a.y); }
    bool spans(double x) const { return std::min(a.x, b.x) < x && x < std::max(a.x, b.x); }
  };

  void add_crossing(const Edge& e, const Edge& f) {
    const double ex = e.b.x - e.a.x, ey = e.b.y - e.a.y, fx = f.b.x - f.a.x, fy = f.b.y - f.a.y;
    const double turn = ex * fy - ey * fx;
    if (turn == 0) {
      return;
    }
    const double t = ((f.a.x - e.a.x) * fy - (f.a.y - e.a.y) * fx) / turn;
    if (t > 0 && t < 1) {
      cuts_.push_back(e.a.x + t * ex);
    }
  }

  double height(double x) const {
    std::vector<std::pair<double, double>> spans;
    for (const auto& polygon : polygons_) {
      double low = HUGE_VAL, high = -HUGE_VAL;
      for (std::size_t k = 0; k < polygon.size(); ++k) {
        const Edge edge{polygon[k], polygon[(k + 1) % polygon.size()]};
        if (!edge.spans(x)) {
          continue;
        }
        low = std::min(low, edge.y(x));
        high = std::max(high, edge.y(x));
      }
      if (low < high) {
        spans.emplace_back(low, high);
      }
    }
    std::sort(spans.begin(), spans.end());
    double sum = 0, done = -HUGE_VAL;
    for (const auto& [low, high] : spans) {
      sum += std::max(high - std::max(low, done), 0.0);
      done = std::max(done, high);
    }
    return sum;
  }

  std::vector<double> cuts_;
  std::vector<Edge> edges_;
  std::vector<std::vector<Vec2>> polygons_;
};

TEST(MapHistory, MapHasTheAreaOfTheUnionOfProcessedFragments) {
  for (const auto& scene : scenes()) {
    const Recorded recorded(scene, 9);
    for (const MapHistory& history : recorded.histories) {
      const MapRecord& record = history.record();
      const double scale = std::pow(scene->bounds().diagonal(), 2);
      UnionArea expected;
      for (std::int32_t k = 0; k < history.step_count(); ++k) {
        if (history.step(k).row != MapRecord::no_row) {
          std::vector<Vec2> polygon;
          const auto& fragment = recorded.tree.fragment(at(record.order, k));
          for (const BspTree::Corner& corner : recorded.tree.corners(fragment)) {
            polygon.push_back(record.frame.project(at(recorded.tree.points(), corner.point)));
          }
          expected.add(polygon);
        }
        double area = 0;
        for (const std::int32_t r : record.map_after(k)) {
          area += record.area(history.row(r));
        }
        ASSERT_NEAR(area, expected.area(), 1e-12 * scale) << scene->name() << " step " << k;
      }
    }
  }
}

TEST(MapHistory, StepsAgreeWithTheRows) {
  for (const auto& scene : scenes()) {
    for (const MapHistory& history : Recorded(scene, 9).histories) {
      const MapRecord& record = history.record();
      for (std::int32_t k = 0; k < history.step_count(); ++k) {
        std::vector<std::int32_t> cut, inside, outside;
        for (std::int32_t r = 0; r < static_cast<std::int32_t>(record.rows.size()); ++r) {
          const MapRecord::Row& row = history.row(r);
          const bool part = row.parent != MapRecord::no_row;
          if (row.consumed == k && row.made < k) {
            cut.push_back(r);
          }
          if (row.made == k && row.consumed == k) {
            inside.push_back(r);
          }
          if (row.made == k && row.consumed > k && part) {
            outside.push_back(r);
          }
          EXPECT_EQ(history.cut_by(r), part ? at(record.step_patch, row.made) : no_patch);
        }
        EXPECT_THAT(history.inside_at(k), ElementsAreArray(inside));
        EXPECT_THAT(history.outside_at(k), ElementsAreArray(outside));
        std::vector<std::int32_t> found = history.cut_at(k);
        std::sort(found.begin(), found.end());
        EXPECT_THAT(found, ElementsAreArray(cut));
        const MapHistory::Step& step = history.step(k);
        EXPECT_EQ(step.cut, static_cast<std::int32_t>(cut.size()));
        EXPECT_EQ(step.map_size, static_cast<std::int32_t>(record.map_after(k).size()));
        if (step.row == MapRecord::no_row) {
          continue;
        }
        double covered = 0;
        for (const std::int32_t r : inside) {
          covered += record.area(history.row(r));
        }
        EXPECT_DOUBLE_EQ(step.covered, covered);
        EXPECT_DOUBLE_EQ(step.area, record.area(history.row(step.row)));
        EXPECT_LE(step.smallest, step.area);
      }
    }
  }
}

TEST(MapHistory, ExchangesOfAllStepsAddUpToTheTransfers) {
  for (const auto& scene : scenes()) {
    const Recorded recorded(scene, 9);
    for (std::size_t d = 0; d < recorded.histories.size(); ++d) {
      const MapHistory& history = recorded.histories[d];
      std::map<std::pair<PatchId, PatchId>, double> sums;
      for (std::int32_t k = 0; k < history.step_count(); ++k) {
        int exchanges = 0;
        for (const std::int32_t r : history.inside_at(k)) {
          if (!history.exchanges(r)) {
            continue;
          }
          ++exchanges;
          sums[{history.step(k).patch, history.row(r).patch}] +=
              history.record().area(history.row(r));
        }
        EXPECT_EQ(exchanges, history.step(k).exchanges);
      }
      const auto& expected = recorded.transfers[d].exchanges;
      ASSERT_EQ(sums.size(), expected.size());
      for (const Transfer& transfer : expected) {
        EXPECT_NEAR((sums[{transfer.receiver, transfer.source}]), transfer.area, 1e-12);
      }
    }
  }
}

TEST(MapHistory, ClosedScenesLeaveNothingOpenAboveAReceiver) {
  const auto closed = load_scene("furnace");
  int receivers = 0;
  for (const MapHistory& history : Recorded(closed, 12).histories) {
    for (std::int32_t k = 0; k < history.step_count(); ++k) {
      if (!history.step(k).front_facing || history.step(k).area < 1e-6) {
        continue;
      }
      ++receivers;
      EXPECT_LT(history.step(k).open_fraction(), 1e-10);
    }
  }
  EXPECT_GT(receivers, 0);
}

TEST(MapHistory, FindsTheEventsOfAPatch) {
  for (const auto& scene : scenes()) {
    for (const MapHistory& history : Recorded(scene, 9).histories) {
      for (PatchId patch = 0; patch < scene->patch_count(); ++patch) {
        std::set<std::int32_t> expected;
        for (std::int32_t k = 0; k < history.step_count(); ++k) {
          if (history.step(k).patch == patch) {
            expected.insert(k);
          }
        }
        for (const MapRecord::Row& row : history.record().rows) {
          if (row.patch == patch && row.consumed != MapRecord::never) {
            expected.insert(row.consumed);
          }
        }
        ASSERT_THAT(history.steps_of(patch), ElementsAreArray(expected));

        for (std::int32_t k = -1; k <= history.step_count(); ++k) {
          const auto next = expected.upper_bound(k);
          EXPECT_EQ(history.next_step_of(patch, k),
                    next == expected.end() ? MapHistory::none : *next);
          const auto from = expected.lower_bound(k);
          EXPECT_EQ(history.previous_step_of(patch, k),
                    from == expected.begin() ? MapHistory::none : *std::prev(from));
        }
      }
      EXPECT_TRUE(history.steps_of(scene->patch_count() + 5).empty());
      EXPECT_TRUE(history.steps_of(no_patch).empty());
    }
  }
}

TEST(MapHistory, OfAnEmptyRecordIsEmpty) {
  const MapHistory history{MapRecord{}};
  EXPECT_EQ(history.step_count(), 0);
  EXPECT_EQ(history.next_step_of(0, -1), MapHistory::none);
}

}  // namespace
}  // namespace transillum::map_history_test
