// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
// Visibility queries of needles in their own frame, against queries with exact signs.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "support/scenes.h"
#include "transillum/at.h"
#include "visibility/queries/boundary_view.h"
#include "visibility/queries/convex_overlap.h"
#include "visibility/queries/exact_view.h"
#include "visibility/queries/needle_lines.h"

namespace transillum::needle_view_test {
namespace {

using testing::Sketch;

/// Long thin triangles, many of which cross, between triangles of usual shapes.
std::shared_ptr<const Scene> random_needles(std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> uniform(-1, 1);
  const auto vector = [&] { return Vec3{uniform(random), uniform(random), uniform(random)}; };
  Sketch sketch;
  const int gray = sketch.material(0.5, 1);
  for (int k = 0; k < 24; ++k) {
    const Vec3 from = vector(), along = vector();
    const double width = k % 4 == 0 ? 1 : std::pow(10, -6.5 + 2.5 * uniform(random));
    sketch.face(
        {from, from + along, from + (0.5 + 0.4 * uniform(random)) * along + width * vector()},
        gray);
  }
  return sketch.scene();
}

/// All that queries need, for one direction.
struct Projected {
  std::shared_ptr<const Scene> scene;
  BspTree tree;
  FragmentOutlines outlines;
  ProjectedFragments fragments;
  CutCorners cut_corners;
  PassCounts counts;

  Projected(const std::shared_ptr<const Scene>& of_scene, const Vec3& omega)
      : scene(of_scene), tree(*scene), outlines(*scene, tree), cut_corners(outlines, fragments) {
    fragments.project(*scene, tree, outlines, omega, {});
    cut_corners.begin();
  }
};

struct Found {
  bool failed = false;
  std::vector<double> areas;    ///< per candidate, nearest first
  std::vector<bool> too_small;  ///< whether that area is not accurate enough
};

/// The areas that a fragment sees of those before it in BSP order.
template <class View>
Found query(View& view, std::int32_t fragment) {
  Found found;
  view.begin_query(fragment);
  for (std::int32_t candidate = fragment - 1; candidate >= 0; --candidate) {
    found.areas.push_back(view.subtract(candidate));
    found.too_small.push_back(view.is_too_small());
    if (view.failed() || view.is_crowded()) {
      found.failed = true;
      return found;
    }
    if (candidate > 0 && view.done()) {
      found.areas.resize(static_cast<std::size_t>(fragment), 0.0);
      found.too_small.resize(static_cast<std::size_t>(fragment), false);
      return found;
    }
  }
  return found;
}

bool is_needle(const ProjectedFragments& fragments, const ProjectedFragments::Fragment& f) {
  double diameter = 0;
  for (std::uint32_t k = f.begin; k < f.end; ++k) {
    const GridPoint &a = fragments.corners[f.begin], &b = fragments.corners[k];
    diameter = std::max(diameter,
                        std::hypot(static_cast<double>(b.x - a.x), static_cast<double>(b.y - a.y)));
  }
  return f.area < 1e-4 * diameter * diameter;
}

struct Tally {
  int needles = 0, failed = 0, areas = 0, too_small = 0;
  double worst = 0;  ///< largest error over the allowed one
};

/// The error of an area counts relative to either patch.
void compare(const Projected& projected, std::int32_t fragment, const Found& found,
             const Found& exact, Tally& tally) {
  const ProjectedFragments& all = projected.fragments;
  const auto patch_area = [&](std::int32_t f) {
    const ProjectedFragments::Fragment& of = at(all.fragments, f);
    return std::max(of.area, all.patch_area(of.patch));
  };
  for (std::size_t k = 0; k < exact.areas.size(); ++k) {
    if (found.too_small[k]) {
      ++tally.too_small;
      continue;
    }
    tally.areas += exact.areas[k] > 0 ? 1 : 0;
    const auto candidate = fragment - 1 - static_cast<std::int32_t>(k);
    const double allowed =
        ProjectedFragments::accuracy * std::max(patch_area(fragment), patch_area(candidate));
    tally.worst = std::max(tally.worst, std::abs(found.areas[k] - exact.areas[k]) / allowed);
  }
}

TEST(NeedleView, AgreesWithExactSignsOn10000RandomNeedles) {
  Tally tally;
  const auto directions = testing::test_directions(20, 88);
  for (std::uint64_t seed = 1; tally.needles < 10'000; ++seed) {
    Projected projected(random_needles(seed), directions[13 + seed % 7]);
    BoundaryView view(projected.fragments, projected.cut_corners, projected.counts, false,
                      BoundaryView::Frame::needle);
    ExactView exact(projected.outlines, projected.fragments, projected.counts, false);
    const auto count = static_cast<std::int32_t>(projected.fragments.fragments.size());
    for (std::int32_t f = 1; f < count; ++f) {
      if (!is_needle(projected.fragments, at(projected.fragments.fragments, f))) {
        continue;
      }
      ++tally.needles;
      const Found found = query(view, f);
      if (found.failed) {
        ++tally.failed;
        continue;
      }
      compare(projected, f, found, query(exact, f), tally);
    }
  }
  EXPECT_GT(tally.areas, 5'000);
  EXPECT_LT(tally.failed, tally.needles / 100);
  EXPECT_LT(tally.too_small, tally.areas / 10);
  EXPECT_LT(tally.worst, 1);
  RecordProperty("failed", tally.failed);
  RecordProperty("too_small", tally.too_small);
  RecordProperty("worst", std::to_string(tally.worst));
}

TEST(NeedleFrame, KeepsOrientationAndMapsBack) {
  std::mt19937_64 random(3);
  std::uniform_int_distribution<std::int64_t> coordinate(-(std::int64_t{1} << 59),
                                                         std::int64_t{1} << 59);
  const auto point = [&] { return GridPoint{coordinate(random), coordinate(random)}; };
  for (int k = 0; k < 1000; ++k) {
    NeedleFrame frame;
    frame.origin = point();
    frame.set_along(point());
    frame.set_scale(std::ldexp(1.0, k % 80 - 60));
    EXPECT_GT(frame.determinant, 0);
    const GridPoint p = point();
    const NeedleFrame::Point mapped = frame.map(FinePoint{p});
    const NeedleFrame::Point back = frame.unmap(mapped.x, mapped.y);
    const auto x = static_cast<double>(p.x - frame.origin.x);
    const auto y = static_cast<double>(p.y - frame.origin.y);
    const double rounding = 1e-15 * 0x1p62;
    EXPECT_NEAR(back.x, x, rounding);
    EXPECT_NEAR(back.y, y, rounding);
    // A point is on the same side of the image of a line.
    const GridPoint a = point(), b = point();
    const NeedleFrame::Line line = frame.map(FinePoint{a}, FinePoint{b});
    const double side = line.dx * mapped.y - line.dy * mapped.x + line.c;
    const auto turn = static_cast<double>(exact_turn(a, b, p));
    const double size =
        std::abs(line.dx * mapped.y) + std::abs(line.dy * mapped.x) + std::abs(line.c);
    EXPECT_NEAR(side, frame.determinant * turn, 1e-14 * size);
  }
}

/// A fan of needles, which share a corner.
std::shared_ptr<const Scene> fan_of_needles(int count) {
  Sketch sketch;
  const int gray = sketch.material(0.5, 1);
  const auto on_rim = [&](int k) {
    const double angle = 1e-4 * k + 0.4;
    return Vec3{std::cos(angle), std::sin(angle), 1e-5 * (k % 2)};
  };
  for (int k = 0; k < count; ++k) {
    sketch.face({{0, 0, 0}, on_rim(k), on_rim(k + 1)}, gray);
  }
  return sketch.scene();
}

/// No fragments that overlap are apart, and most others are.
TEST(NeedleLines, AreBetweenFragmentsWithoutCommonArea) {
  std::int64_t scenes = 0, apart = 0, near_but_apart = 0, missed = 0;
  const auto count = [&](const std::shared_ptr<const Scene>& scene, const Vec3& omega) {
    const Projected projected(scene, omega);
    NeedleLines lines(*scene, projected.fragments);
    lines.fill();
    if (!lines.exist()) {
      return;
    }
    ++scenes;
    ConvexOverlap overlap(projected.fragments);
    const auto size = static_cast<std::int32_t>(projected.fragments.fragments.size());
    for (std::int32_t i = 0; i < size; ++i) {
      overlap.set_subject(at(projected.fragments.fragments, i));
      lines.begin(i);
      for (std::int32_t j = 0; j < size; ++j) {
        const auto &one = at(projected.fragments.fragments, i),
                   &other = at(projected.fragments.fragments, j);
        const double area = overlap.area_with(other), least = std::min(one.area, other.area);
        const bool are_apart = i != j && lines.are_apart(j);
        EXPECT_FALSE(are_apart && area > 1e-6 * least) << i << ' ' << j << ' ' << area / least;
        apart += are_apart ? 1 : 0;
        const bool near =
            window_of(at(projected.fragments.boxes, i)).overlaps(at(projected.fragments.boxes, j));
        near_but_apart += are_apart && near ? 1 : 0;
        missed += i != j && near && !are_apart && area <= 1e-6 * least ? 1 : 0;
      }
    }
  };
  std::mt19937_64 random(5);
  std::normal_distribution<double> normal;
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const Vec3 omega = normalized(Vec3{normal(random), normal(random), normal(random)});
    count(random_needles(seed), omega);
    count(fan_of_needles(60), omega);
  }
  EXPECT_GE(scenes, 10);
  EXPECT_GT(apart, 20000);
  EXPECT_GT(near_but_apart, 5000);
  EXPECT_LT(missed, near_but_apart / 4);
}

}  // namespace
}  // namespace transillum::needle_view_test
