// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
// The engines zbuffer and painter: exact properties of counted pixels, and convergence to the areas
// of the local map.
#include <gmock/gmock.h>

#include <cmath>

#include "support/canceled.h"
#include "support/pair_areas.h"
#include "support/scenes.h"
#include "transillum/at.h"
#include "transillum/engine.h"
#include "transillum/errors.h"
#include "transillum/solution.h"
#include "transillum/solve_options.h"
#include "transillum/solve_session.h"

namespace transillum::discrete_engines_test {
namespace {

using testing::areas_of;
using testing::PairAreas;
using testing::Sketch;

TransferEngine engine_of(Engine engine, const std::shared_ptr<const Scene>& scene,
                         const EngineOptions& options = {}) {
  return make_engine(engine, scene, std::make_shared<const BspTree>(*scene), options);
}

std::shared_ptr<const Scene> random_triangles() {
  Sketch sketch;
  return sketch.triangles(100, 1, 5, sketch.material(0.5, 1)).scene();
}

class DiscreteEngines : public ::testing::TestWithParam<Engine> {};
INSTANTIATE_TEST_SUITE_P(Engines, DiscreteEngines,
                         ::testing::Values(Engine::zbuffer, Engine::painter),
                         [](const auto& engine) { return name_of(engine.param); });

/// Pixels are counted: in a closed scene, the areas that a patch exchanges sum exactly to its
/// projected area, as receiver for omega and for -omega.
TEST_P(DiscreteEngines, AreasOfAPatchSumToItsPixels) {
  for (const char* spec : {"cornell-box", "rooms", "stars", "furnace", "sphere-flake:levels=1"}) {
    const auto scene = load_scene(spec);
    const TransferEngine engine = engine_of(GetParam(), scene, {.resolution = 77});
    for (const Vec3& omega : testing::test_directions(30, 9)) {
      const Transfers transfers = engine(omega, {});
      std::vector<double> received(transfers.forward.size()), sent(received.size());
      for (const Transfer& t : transfers.exchanges) {
        at(received, t.receiver) += t.area;
        at(sent, t.source) += t.area;
      }
      for (std::size_t i = 0; i < received.size(); ++i) {
        ASSERT_EQ(received[i], transfers.forward[i].projected) << spec << " patch " << i;
        ASSERT_EQ(received[i], transfers.forward[i].covered) << spec << " patch " << i;
        ASSERT_EQ(sent[i], transfers.backward[i].projected) << spec << " patch " << i;
        ASSERT_EQ(transfers.back_seen[i], 0) << spec << " patch " << i;
      }
    }
  }
}

double total_difference(const PairAreas& exact, PairAreas found) {
  double sum = 0;
  for (const auto& [pair, area] : exact) {
    found[pair] -= area;
  }
  for (const auto& [pair, area] : found) {
    sum += std::abs(area);
  }
  return sum;
}

/// The fraction of wrongly exchanged area falls in proportion to the pixel's side, or faster.
TEST_P(DiscreteEngines, ErrorDecreasesWithPixelSize) {
  for (const auto& scene : {load_scene("cornell-box"), load_scene("rooms"), random_triangles(),
                            load_scene("boards", {.two_sided = true})}) {
    const auto directions = testing::test_directions(20, 5);
    const TransferEngine exact = engine_of(Engine::local, scene);
    const auto error = [&](int resolution) {
      const TransferEngine engine = engine_of(GetParam(), scene, {.resolution = resolution});
      double sum = 0, total = 0;
      // The first directions are axes and diagonals, along which pixels may fit the scene.
      for (auto omega = directions.begin() + 14; omega != directions.end(); ++omega) {
        const PairAreas areas = areas_of(exact(*omega, {}));
        for (const auto& [pair, area] : areas) {
          total += area;
        }
        sum += total_difference(areas, areas_of(engine(*omega, {})));
      }
      return sum / total;
    };
    const double coarse = error(32), fine = error(512);
    const double slope = std::log(coarse / fine) / std::log(16);
    EXPECT_GT(slope, 0.9) << scene->name() << ": " << coarse << " " << fine;
    EXPECT_LT(slope, 1.8) << scene->name() << ": " << coarse << " " << fine;
    EXPECT_LT(fine, 0.02) << scene->name();
  }
}

/// Along -omega the sample points are the same, mirrored. Only points on an edge may be counted for
/// the other side; where edges are aligned with the grid, these are whole rows of pixels.
TEST_P(DiscreteEngines, TheOppositeDirectionGivesTheSame) {
  constexpr int resolution = 64;
  int equal = 0, directions = 0;
  for (const auto& scene : {load_scene("cornell-box"), load_scene("rooms"), random_triangles(),
                            load_scene("sphere-flake:levels=1")}) {
    const TransferEngine engine = engine_of(GetParam(), scene, {.resolution = resolution});
    for (const Vec3& omega : testing::test_directions(20, 8)) {
      PairAreas forward = areas_of(engine(omega, {})), backward;
      for (const Transfer& t : engine(-1 * omega, {}).exchanges) {
        backward[{t.source, t.receiver}] = t.area;
      }
      double all = 0;
      for (const auto& [pair, area] : forward) {
        all += area;
      }
      const double differ = total_difference(forward, backward);
      EXPECT_LE(differ, 8.0 / resolution * all)
          << scene->name() << " " << omega.x << " " << omega.y;
      equal += differ <= 1e-3 * all ? 1 : 0;
      ++directions;
    }
  }
  EXPECT_GE(equal, 0.75 * directions);
}

/// Both sample the same points; one compares heights, the other paints in order.
TEST(DiscreteEngines, ZBufferAndPainterAgree) {
  for (const auto& scene :
       {load_scene("cornell-box"), load_scene("sphere-flake:levels=1"), random_triangles(),
        load_scene("boards", {.two_sided = true}), load_scene("rooms", {.two_sided = true})}) {
    const TransferEngine zbuffer = engine_of(Engine::zbuffer, scene, {.resolution = 100});
    const TransferEngine painter = engine_of(Engine::painter, scene, {.resolution = 100});
    for (const Vec3& omega : testing::test_directions(20, 3)) {
      const Transfers a = zbuffer(omega, {}), b = painter(omega, {});
      EXPECT_EQ(areas_of(a), areas_of(b)) << scene->name();
      EXPECT_EQ(a.back_seen, b.back_seen) << scene->name();
      EXPECT_EQ(a.counts.pixels, b.counts.pixels) << scene->name();
      EXPECT_EQ(a.counts.missed, b.counts.missed) << scene->name();
    }
  }
}

/// A unit square faces two half squares; pixels of 1/64 fit all edges.
TEST_P(DiscreteEngines, PixelsThatFitAreExact) {
  Sketch sketch;
  const int gray = sketch.material(0.5, 1);
  sketch.face({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, gray);
  sketch.face({{0, 0, 1}, {0, 1, 1}, {0.5, 1, 1}, {0.5, 0, 1}}, gray);
  sketch.face({{0.5, 0, 2}, {0.5, 1, 2}, {1, 1, 2}, {1, 0, 2}}, gray);
  const Transfers transfers =
      engine_of(GetParam(), sketch.scene(), {.resolution = 64})({0, 0, 1}, {});
  EXPECT_EQ(areas_of(transfers), (PairAreas{{{0, 1}, 0.5}, {{0, 2}, 0.5}}));
  EXPECT_EQ(transfers.forward[0].covered, 1);
  EXPECT_EQ(transfers.counts.pixels, 2 * 64 * 64);
}

/// Patches that contain no center of a pixel are lost, and counted as missed.
TEST_P(DiscreteEngines, SmallPatchesAreMissedAndCounted) {
  Sketch sketch;
  const int gray = sketch.material(0.5, 1);
  sketch.face({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, gray);
  sketch.face({{0.001, 0.001, 1}, {0.001, 0.002, 1}, {0.002, 0.002, 1}, {0.002, 0.001, 1}}, gray);
  const auto scene = sketch.scene();
  const auto at = [&](int resolution) {
    return engine_of(GetParam(), scene, {.resolution = resolution})({0, 0, 1}, {});
  };
  EXPECT_EQ(at(100).counts.missed, 1);
  EXPECT_THAT(at(100).exchanges, ::testing::IsEmpty());
  EXPECT_EQ(at(2048).counts.missed, 0);
  ASSERT_EQ(at(2048).exchanges.size(), 1U);
  EXPECT_NEAR(at(2048).exchanges[0].area, 1e-6, 2e-7);
}

TEST_P(DiscreteEngines, FurnaceHasRadiosityTwoForAnyNumberOfThreads) {
  SolveOptions options{.directions = 32,
                       .engine = GetParam(),
                       .engine_options = {.resolution = 60},
                       .normalize = Normalization::rows,
                       .tolerance = 1e-13,
                       .threads = 1};
  const Solution one = solve(load_scene("furnace"), options);
  for (const Rgb& b : one.radiosity) {
    EXPECT_NEAR(b.r, 2, 1e-10);
  }
  EXPECT_EQ(one.statistics.closure_defect_max, 0);
  EXPECT_GT(one.statistics.counts.pixels, 32 * 60 * 60);
  options.threads = 4;
  const Solution four = solve(load_scene("furnace"), options);
  for (std::size_t i = 0; i < one.radiosity.size(); ++i) {
    EXPECT_EQ(one.radiosity[i].r, four.radiosity[i].r);
  }
}

/// Where Newell's tests find an order, the transfers equal those in BSP order.
TEST(NewellOrder, GivesTheTransfersOfTheBspOrder) {
  Sketch light_in_ceiling;
  const int gray = light_in_ceiling.material(0.5, 0), bright = light_in_ceiling.material(0.5, 9);
  light_in_ceiling.box({0, 0, 0}, {3, 2, 1}, true, gray);
  light_in_ceiling.face({{1, 1, 1}, {1, 1.5, 1}, {2, 1.5, 1}, {2, 1, 1}}, bright);
  for (const auto& scene :
       {load_scene("cornell-box"), load_scene("sphere-flake:levels=1"), load_scene("furnace"),
        load_scene("rooms", {.two_sided = true}), light_in_ceiling.scene({.two_sided = true})}) {
    const TransferEngine bsp = engine_of(Engine::painter, scene, {.resolution = 90});
    const TransferEngine newell =
        engine_of(Engine::painter, scene, {.resolution = 90, .order = PaintersOrder::newell});
    for (const Vec3& omega : testing::test_directions(20, 6)) {
      const Transfers a = bsp(omega, {}), b = newell(omega, {});
      EXPECT_EQ(areas_of(a), areas_of(b)) << scene->name();
      EXPECT_EQ(a.back_seen, b.back_seen) << scene->name();
    }
  }
}

std::string error_of(const std::shared_ptr<const Scene>& scene, const Vec3& omega) {
  try {
    engine_of(Engine::painter, scene, {.resolution = 90, .order = PaintersOrder::newell})(omega,
                                                                                          {});
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

TEST(NewellOrder, FailsOnCyclesAndIntersections) {
  EXPECT_THAT(error_of(load_scene("boards"), {0, 0, 1}),
              ::testing::MatchesRegex("boards: direction 0, 0, 1: patches [0-9, ]+ overlap in a "
                                      "cycle; .*newell.*bsp.*"));
  Sketch crossed;
  const int gray = crossed.material(0.5, 1);
  crossed.face({{0, 0, 0}, {2, 0, 1}, {2, 1, 1}, {0, 1, 0}}, gray);
  crossed.face({{0, 0, 1}, {2, 0, 0}, {2, 1, 0}, {0, 1, 1}}, gray);
  EXPECT_THAT(error_of(crossed.scene(), {0, 0, 1}),
              ::testing::HasSubstr("patches 0 and 1 intersect"));
  // Each polygon is on both sides of the other's plane, but not where their projections overlap.
  Sketch skew;
  ASSERT_EQ(skew.material(0.5, 1), gray);
  skew.face({{0, 0, 0}, {4, 0, 2}, {4, 1, 2}, {0, 1, 0}}, gray);
  skew.face({{0, -1, 1}, {1, -1, 1}, {1, 5, 0}, {0, 5, 0}}, gray);
  EXPECT_EQ(error_of(skew.scene(), {0, 0, 1}), "no error");
}

/// One line per pixel, at a random point of it.
TEST(RayLines, UseAGridOfPixels) {
  const auto scene = load_scene("cornell-box");
  const Vec3 omega = normalized({1, -2, 3});
  const Transfers pixels = engine_of(Engine::zbuffer, scene, {.resolution = 200})(omega, {});
  const Transfers lines = engine_of(Engine::rays, scene, {.resolution = 200})(omega, {});
  EXPECT_NEAR(static_cast<double>(lines.counts.pixels), static_cast<double>(pixels.counts.pixels),
              0.005 * static_cast<double>(pixels.counts.pixels));
  EXPECT_LT(total_difference(areas_of(pixels), areas_of(lines)), 0.05);
  EXPECT_NE(areas_of(pixels), areas_of(lines));
}

TEST_P(DiscreteEngines, CanBeCanceledAndCheckTheResolution) {
  const auto scene = load_scene("furnace");
  for (const int resolution : {-1, EngineOptions::largest_resolution + 1}) {
    EXPECT_THROW(engine_of(GetParam(), scene, {.resolution = resolution}), InputError);
  }
  EXPECT_THROW(engine_of(GetParam(), scene)({0, 0, 1}, testing::canceled()), Canceled);
}

}  // namespace
}  // namespace transillum::discrete_engines_test
