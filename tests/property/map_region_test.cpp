// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
// Regions of the global visibility map, against a flood fill of a sampled picture.
#include "visibility/map/map_region.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "support/scenes.h"

namespace transillum::map_region_test {
namespace {

MapHistory history_of(const Scene& scene, const Vec3& omega) {
  return MapHistory(record_local_map(scene, BspTree(scene), omega).record);
}

/// The plane sampled on a grid: the fragments that cover each point, and connected points.
class Picture {
 public:
  static constexpr int side = 240;

  explicit Picture(const MapHistory& history) : history_(history) {
    for (const Vec2& p : history.record().corners) {
      low_ = {std::min(low_.x, p.x), std::min(low_.y, p.y)};
      high_ = {std::max(high_.x, p.x), std::max(high_.y, p.y)};
    }
    for (int y = 0; y < side; ++y) {
      for (int x = 0; x < side; ++x) {
        covers_.push_back(covers_at(point(x, y)));
      }
    }
  }

  Vec2 point(int x, int y) const {
    return {low_.x + (x + 0.5) / side * (high_.x - low_.x),
            low_.y + (y + 0.5) / side * (high_.y - low_.y)};
  }
  /// The steps whose fragments cover a point, nearest to the light first.
  const std::vector<std::int32_t>& list(int x, int y) const { return at(x, y); }
  bool covered(int x, int y) const { return !at(x, y).empty(); }
  double pixel() const { return (high_.x - low_.x) * (high_.y - low_.y) / (side * side); }

  struct Filled {
    double area = 0;
    int boundary = 0;  ///< pixels with a neighbor that is covered differently
  };
  /// The pixels connected to one through neighbors covered by the same fragments.
  Filled fill(int x, int y) const {
    std::vector<char> visited(covers_.size());
    std::vector<std::array<int, 2>> pending{{x, y}};
    visited[index(x, y)] = 1;
    Filled filled;
    while (!pending.empty()) {
      const auto [px, py] = pending.back();
      pending.pop_back();
      filled.area += pixel();
      bool boundary = false;
      for (const auto& [dx, dy] : {std::pair(1, 0), {-1, 0}, {0, 1}, {0, -1}}) {
        const int nx = px + dx, ny = py + dy;
        const bool same = nx >= 0 && ny >= 0 && nx < side && ny < side && at(nx, ny) == at(x, y);
        boundary = boundary || !same;
        if (!same || visited[index(nx, ny)]) {
          continue;
        }
        visited[index(nx, ny)] = 1;
        pending.push_back({nx, ny});
      }
      filled.boundary += boundary;
    }
    return filled;
  }

 private:
  static std::size_t index(int x, int y) { return static_cast<std::size_t>(y * side + x); }
  const std::vector<std::int32_t>& at(int x, int y) const { return covers_[index(x, y)]; }
  std::vector<std::int32_t> covers_at(const Vec2& p) const {
    std::vector<std::int32_t> steps;
    for (std::int32_t k = 0; k < history_.step_count(); ++k) {
      const std::int32_t row = history_.step(k).row;
      if (row != MapRecord::no_row && history_.record().covers(history_.row(row), p)) {
        steps.push_back(k);
      }
    }
    return steps;
  }

  const MapHistory& history_;
  Vec2 low_{1e9, 1e9}, high_{-1e9, -1e9};
  std::vector<std::vector<std::int32_t>> covers_;
};

TEST(MapRegion, SurroundsAHoleAndEndsAtAPoint) {
  testing::Sketch sketch;
  const int gray = sketch.material(0.5, 1);
  const auto plate = [&](double x, double y, double z, double size) {
    sketch.face({{x, y, z}, {x, y + size, z}, {x + size, y + size, z}, {x + size, y, z}}, gray);
  };
  plate(0, 0, 0, 4);
  plate(1, 1, 1, 1);
  // These two share a corner; the parts of the plate on either side of it are not connected.
  plate(5, 0, 0, 4);
  plate(5, 0, 1, 2);
  plate(7, 2, 1, 2);
  const MapHistory history = history_of(*sketch.scene(), {0, 0, 1});
  const auto area_at = [&](double x, double y) {
    const auto region = region_at(history, history.record().frame.project({x, y, 0}));
    return region ? region->area : 0;
  };
  EXPECT_NEAR(area_at(3, 3), 15, 1e-12);
  EXPECT_NEAR(area_at(0.5, 1.5), 15, 1e-12);
  EXPECT_NEAR(area_at(1.5, 1.5), 1, 1e-12);
  EXPECT_NEAR(area_at(8, 1), 4, 1e-12);
  EXPECT_NEAR(area_at(6, 3), 4, 1e-12);
  EXPECT_EQ(area_at(4.5, 3), 0);
  EXPECT_EQ(area_at(1.5, 1), 0);
}

TEST(MapRegion, HasTheAreaOfAFloodFill) {
  testing::Sketch soup;
  soup.box({0, 0, 0}, {1, 1, 1}, true, soup.material(0.5, 1));
  // With seed 7 a region has a neck narrower than a pixel.
  soup.triangles(8, 0.5, 8, soup.material(0.5, 0));
  int compared = 0, several = 0;
  for (const auto& scene : {load_scene("boards"), load_scene("cornell-box"), soup.scene()}) {
    for (const Vec3& omega : testing::test_directions(3, 5)) {
      const MapHistory history = history_of(*scene, omega);
      const Picture picture(history);
      for (int k = 0; k < 40; ++k) {
        const int x = 4 * (k * 37 % 53) + 11, y = 5 * (k * 29 % 41) + 13;
        const auto region = region_at(history, picture.point(x, y));
        ASSERT_EQ(region.has_value(), picture.covered(x, y));
        if (!region) {
          continue;
        }
        const Picture::Filled filled = picture.fill(x, y);
        // Skip regions with parts too narrow for the picture's resolution.
        if (filled.boundary * picture.pixel() > 0.2 * filled.area) {
          continue;
        }
        EXPECT_NEAR(region->area, filled.area, 0.5 * filled.boundary * picture.pixel())
            << scene->patch_count() << ' ' << x << ' ' << y;
        ++compared;
        several += region->parts.size() > 1;
        double sum = 0;
        for (const auto& part : region->parts) {
          for (std::size_t c = 2; c < part.size(); ++c) {
            sum += std::abs((part[c - 1].x - part[0].x) * (part[c].y - part[0].y) -
                            (part[c - 1].y - part[0].y) * (part[c].x - part[0].x)) /
                   2;
          }
        }
        EXPECT_NEAR(sum, region->area, 1e-12);
      }
    }
  }
  EXPECT_GT(compared, 80);
  EXPECT_GT(several, 20);
}

bool has(const MapRegion& region, const Vec2& p) {
  return std::any_of(region.parts.begin(), region.parts.end(), [&](const auto& part) {
    bool left = true, right = true;
    for (std::size_t k = 0; k < part.size(); ++k) {
      const Vec2 &a = part[k], &b = part[(k + 1) % part.size()];
      const double side = (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x);
      left = left && side >= 0;
      right = right && side <= 0;
    }
    return left || right;
  });
}

// Section 3.1 as printed: in each region, every front-facing patch of the list sees the next.
TEST(MapRegion, AddsUpToTheTransfersOfTheLocalMap) {
  testing::Sketch soup;
  soup.box({0, 0, 0}, {1, 1, 1}, true, soup.material(0.5, 1));
  soup.triangles(8, 0.5, 7, soup.material(0.5, 0));
  for (const auto& scene : {load_scene("boards"), load_scene("cornell-box"), soup.scene()}) {
    const auto direction =
        record_local_map(*scene, BspTree(*scene), testing::test_directions(30, 5).back());
    const MapHistory history(direction.record);
    const Picture picture(history);
    std::vector<MapRegion> found;
    std::map<std::pair<PatchId, PatchId>, double> sums;
    for (int y = 0; y < Picture::side; y += 2) {
      for (int x = 0; x < Picture::side; x += 2) {
        const Vec2 point = picture.point(x, y);
        const auto is_in = [&](const MapRegion& region) { return has(region, point); };
        if (!picture.covered(x, y) || std::any_of(found.begin(), found.end(), is_in)) {
          continue;
        }
        const auto region = region_at(history, point);
        if (!region) {
          continue;
        }
        found.push_back(*region);
        const std::vector<std::int32_t>& list = picture.list(x, y);
        for (std::size_t k = 1; k < list.size(); ++k) {
          const auto &i = history.step(list[k]), &j = history.step(list[k - 1]);
          if (i.front_facing && !j.front_facing) {
            sums[{i.patch, j.patch}] += region->area;
          }
        }
      }
    }
    double all = 0, by_regions = 0;
    for (const Transfer& t : direction.transfers.exchanges) {
      all += t.area;
      by_regions += sums[{t.receiver, t.source}];
      EXPECT_LE((sums[{t.receiver, t.source}]), t.area + 1e-9) << t.receiver << ' ' << t.source;
    }
    // Regions that contain no sample point are missed.
    EXPECT_GT(by_regions, 0.99 * all) << scene->name();
    EXPECT_GT(found.size(), 20U);
  }
}

TEST(MapRegion, IsTheSameFromAllItsPoints) {
  const auto scene = load_scene("cornell-box");
  const MapHistory history = history_of(*scene, testing::test_directions(1, 5).front());
  const Picture picture(history);
  for (int k = 0; k < 30; ++k) {
    const Vec2 point = picture.point(13 * k % Picture::side, 29 * k % Picture::side);
    const auto region = region_at(history, point);
    if (!region) {
      continue;
    }
    for (const auto& part : region->parts) {
      Vec2 center;
      for (const Vec2& p : part) {
        center.x += p.x / static_cast<double>(part.size());
        center.y += p.y / static_cast<double>(part.size());
      }
      const auto again = region_at(history, center);
      ASSERT_TRUE(again);
      EXPECT_NEAR(again->area, region->area, 1e-9 * region->area);
    }
  }
}

}  // namespace
}  // namespace transillum::map_region_test
