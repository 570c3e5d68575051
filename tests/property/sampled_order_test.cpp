// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
// The local map against lines through random scenes: an independent, statistical computation.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <random>

#include "support/scenes.h"
#include "transillum/visibility_map.h"

namespace transillum::sampled_order_test {
namespace {

using testing::Sketch;
using testing::test_directions;

/// Where the line through the plane point `at` meets patch i: the height along omega, or NaN.
double height_on_line(const Scene& scene, PatchId i, const PlaneFrame& frame, const Vec2& at) {
  const auto outline = scene.outline(i);
  bool inside = false;  // even-odd rule, valid for concave outlines too
  for (std::size_t k = 0; k < outline.size(); ++k) {
    const Vec2 a = frame.project(scene.point(outline[k]));
    const Vec2 b = frame.project(scene.point(outline[(k + 1) % outline.size()]));
    if ((a.y > at.y) == (b.y > at.y)) {
      continue;
    }
    if (at.x < a.x + (at.y - a.y) / (b.y - a.y) * (b.x - a.x)) {
      inside = !inside;
    }
  }
  const Vec3& normal = scene.patch(i).normal;
  const double cosine = dot(normal, frame.omega);
  if (!inside || std::abs(cosine) < 1e-9) {
    return std::nan("");
  }
  const Vec3 start = frame.origin + at.x * frame.u + at.y * frame.v;
  return dot(normal, scene.patch(i).center - start) / cosine;
}

struct Hit {
  double height;
  PatchId patch;
};

std::vector<Hit> hits_on_line(const Scene& scene, const PlaneFrame& frame, const Vec2& at) {
  std::vector<Hit> hits;
  for (PatchId i = 0; i < scene.patch_count(); ++i) {
    const double height = height_on_line(scene, i, frame, at);
    if (!std::isnan(height)) {
      hits.push_back({height, i});
    }
  }
  // The line is followed from above, along -omega.
  std::sort(hits.begin(), hits.end(),
            [](const Hit& a, const Hit& b) { return a.height > b.height; });
  return hits;
}

/// A(i,j,omega) from a fine grid of lines.
std::map<std::pair<PatchId, PatchId>, double> sampled_transfers(const Scene& scene,
                                                                const PlaneFrame& frame,
                                                                double radius, int resolution) {
  std::map<std::pair<PatchId, PatchId>, double> areas;
  const double cell = 2 * radius / resolution;
  for (int y = 0; y < resolution; ++y) {
    for (int x = 0; x < resolution; ++x) {
      const Vec2 at{(x + 0.5) * cell - radius, (y + 0.5) * cell - radius};
      const auto hits = hits_on_line(scene, frame, at);
      for (std::size_t k = 1; k < hits.size(); ++k) {
        const PatchId above = hits[k - 1].patch, below = hits[k].patch;
        if (dot(scene.patch(below).normal, frame.omega) > 0 &&
            dot(scene.patch(above).normal, frame.omega) < 0) {
          areas[{below, above}] += cell * cell;
        }
      }
    }
  }
  return areas;
}

TEST(SampledOrder, TransfersAgreeWithLinesThroughInterpenetratingTriangles) {
  constexpr int resolution = 300;
  double total = 0;
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    Sketch sketch;
    const auto scene = sketch.triangles(14, 1.2, seed, sketch.material(0.5, 1)).scene();
    const auto tree = std::make_shared<const BspTree>(*scene);
    const TransferEngine engine = make_engine(Engine::local, scene, tree);
    const Vec3 omega = test_directions(8, seed).back();
    const double radius = 0.51 * scene->bounds().diagonal();
    const auto sampled = sampled_transfers(*scene, plane_frame(*scene, omega), radius, resolution);
    std::map<std::pair<PatchId, PatchId>, double> exact;
    for (const Transfer& t : engine(omega, {}).exchanges) {
      exact[{t.receiver, t.source}] = t.area;
    }

    const double cell = 2 * radius / resolution;
    auto pairs = exact;
    pairs.insert(sampled.begin(), sampled.end());
    for (const auto& [pair, ignored] : pairs) {
      const double a = exact.contains(pair) ? exact.at(pair) : 0.0;
      const double b = sampled.contains(pair) ? sampled.at(pair) : 0.0;
      // The error of the grid comes from cells along the outline, which is a few meters at most;
      // the errors of its cells cancel.
      EXPECT_NEAR(a, b, 60 * cell * cell) << seed << ": " << pair.first << " sees " << pair.second;
      total += a;
    }
  }
  EXPECT_GT(total, 1);
}

TEST(SampledOrder, TreeOrderIsTheOrderOfHeights) {
  for (const char* spec : {"boards", "rooms", "cornell-box"}) {
    const auto scene = load_scene(spec);
    const BspTree tree(*scene);
    std::mt19937_64 generator(5);
    std::size_t compared = 0;
    for (const Vec3& omega : test_directions(12, 5)) {
      const RecordedDirection recorded = record_local_map(*scene, tree, omega);
      const MapRecord& record = recorded.record;
      const double radius = 0.5 * scene->bounds().diagonal();
      for (int line = 0; line < 60; ++line) {
        const auto random = [&] {
          return radius * (static_cast<double>(generator() >> 11) * 0x1p-52 - 1);
        };
        const Vec2 at{random(), random()};
        // The fragments that cover the point, in BSP order, must have descending heights.
        double last = HUGE_VAL;
        for (const MapRecord::Row& row : record.rows) {
          if (row.parent != MapRecord::no_row) {
            continue;
          }
          const auto outline = record.outline(row);
          bool inside = true;
          for (std::size_t k = 0; k < outline.size() && inside; ++k) {
            const Vec2& a = outline[k];
            const Vec2& b = outline[(k + 1) % outline.size()];
            inside = (b.x - a.x) * (at.y - a.y) - (b.y - a.y) * (at.x - a.x) > 0;
          }
          if (!inside) {
            continue;
          }
          const double height = height_on_line(*scene, row.patch, record.frame, at);
          if (std::isnan(height)) {
            continue;
          }
          EXPECT_LE(height, last + 1e-9) << spec;
          last = height;
          ++compared;
        }
      }
    }
    EXPECT_GT(compared, 500u) << spec;
  }
}

}  // namespace
}  // namespace transillum::sampled_order_test
