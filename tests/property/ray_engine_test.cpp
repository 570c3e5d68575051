// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
// The engine rays: counts of lines must agree with the areas of the local map within their
// statistical errors.

#include <gtest/gtest.h>

#include <cmath>
#include <thread>

#include "support/canceled.h"
#include "support/pair_areas.h"
#include "support/scenes.h"
#include "transillum/engine.h"
#include "transillum/errors.h"
#include "transillum/solution.h"
#include "transillum/solve_options.h"
#include "transillum/solve_session.h"
#include "transillum/visibility_map.h"

namespace transillum::ray_engine_test {
namespace {

using testing::areas_of;
using testing::PairAreas;
using testing::Sketch;

double total(const Transfers& transfers) {
  double sum = 0;
  for (const Transfer& t : transfers.exchanges) {
    sum += t.area;
  }
  return sum;
}

/// Area of the box on the plane in which random lines are placed.
double window_area(const Scene& scene, const Vec3& omega) {
  const PlaneFrame frame = plane_frame(scene, omega);
  Bounds box;
  for (const Vec3& p : scene.points()) {
    const Vec2 at = frame.project(p);
    box.add({at.x, at.y, 0});
  }
  return (box.high.x - box.low.x) * (box.high.y - box.low.y);
}

TransferEngine local_engine(const std::shared_ptr<const Scene>& scene) {
  return make_engine(Engine::local, scene, std::make_shared<const BspTree>(*scene));
}

/// Deviations of counts from their binomial expectations, in standard deviations.
struct Deviations {
  int pairs = 0, beyond_2 = 0;
  double largest = 0;

  void add(double count, double lines, double fraction) {
    // A pair that fills the window has no variance except rounding.
    const double variance = std::max(lines * fraction * (1 - fraction), 1.0);
    const double z = (count - lines * fraction) / std::sqrt(variance);
    ++pairs;
    beyond_2 += std::abs(z) > 2;
    largest = std::max(largest, std::abs(z));
  }
};

Sketch letters() {
  Sketch sketch;
  const int gray = sketch.material(0.5, 1);
  // A concave U above an L, facing each other.
  sketch.face({{0, 0, 0}, {4, 0, 0}, {4, 1, 0}, {1, 1, 0}, {1, 3, 0}, {0, 3, 0}}, gray);
  sketch.face(
      {{0, 0, 1}, {0, 3, 1}, {1, 3, 1}, {1, 1, 1}, {2, 1, 1}, {2, 3, 1}, {3, 3, 1}, {3, 0, 1}},
      gray);
  sketch.box({-1, -1, -1}, {5, 4, 2}, true, gray);
  return sketch;
}

std::vector<std::shared_ptr<const Scene>> many_scenes() {
  std::vector<std::shared_ptr<const Scene>> scenes;
  for (const char* spec : {"cornell-box", "rooms", "stars", "sphere-flake:levels=1"}) {
    scenes.push_back(load_scene(spec));
  }
  scenes.push_back(load_scene("boards", {.two_sided = true}));
  scenes.push_back(letters().scene());
  scenes.push_back(letters().scene({.two_sided = true}));
  Sketch interpenetrating;
  scenes.push_back(
      interpenetrating.triangles(200, 1, 5, interpenetrating.material(0.5, 1)).scene());
  return scenes;
}

TEST(RayEngine, CountsAreBinomial) {
  constexpr double fewest = 50;  // the Poisson tail of fewer is not normal
  Deviations all;
  for (const auto& scene : many_scenes()) {
    const TransferEngine exact = local_engine(scene);
    const EngineOptions options{.lines_per_patch = 1e5 / scene->patch_count(), .gridded = false};
    const TransferEngine rays = make_engine(Engine::rays, scene, nullptr, options);
    const double lines = std::ceil(options.lines_per_patch * scene->patch_count());
    for (const Vec3& omega : testing::test_directions(12, 4)) {
      const double window = window_area(*scene, omega);
      const PairAreas expected = areas_of(exact(omega, {}));
      PairAreas found = areas_of(rays(omega, {}));
      // Pairs of too small expectation are counted together.
      double rest = 0, rest_expected = 0;
      for (const auto& [pair, area] : expected) {
        const double fraction = area / window;
        if (lines * fraction < fewest) {
          rest_expected += area;
          rest += found[pair];
        } else {
          all.add(found[pair] / window * lines, lines, fraction);
        }
        found.erase(pair);
      }
      if (lines * rest_expected / window >= fewest) {
        all.add(rest / window * lines, lines, rest_expected / window);
      }
      double never = 0;
      for (const auto& [pair, area] : found) {
        never += area / window * lines;
      }
      EXPECT_LE(never, 1e-5 * lines) << scene->name();
    }
  }
  ASSERT_GT(all.pairs, 2000);
  // In a normal distribution, 4.55 % lie beyond 2, and one in 1.7 million beyond 5.
  EXPECT_NEAR(all.beyond_2, 0.0455 * all.pairs, 0.01 * all.pairs);
  EXPECT_LT(all.largest, 5);
}

TEST(RayEngine, LinesFindNoGaps) {
  for (const char* spec : {"cornell-box", "rooms", "stars", "furnace", "sphere-flake:levels=1"}) {
    const auto scene = load_scene(spec);
    const TransferEngine rays = make_engine(Engine::rays, scene, nullptr);
    for (const Vec3& omega : testing::test_directions(30, 9)) {
      const Transfers transfers = rays(omega, {});
      EXPECT_EQ(closure_defect(transfers, *scene).relative, 0) << spec;
      for (const double seen : transfers.back_seen) {
        ASSERT_EQ(seen, 0) << spec;
      }
      EXPECT_GT(total(transfers), 0);
    }
  }
}

double rms_error(const PairAreas& exact, PairAreas found) {
  double sum = 0;
  for (const auto& [pair, area] : exact) {
    sum += (found[pair] - area) * (found[pair] - area);
    found.erase(pair);
  }
  for (const auto& [pair, area] : found) {
    sum += area * area;
  }
  return std::sqrt(sum / static_cast<double>(exact.size()));
}

TEST(RayEngine, ErrorDecreasesWithTheNumberOfLines) {
  const auto scene = load_scene("rooms");
  const TransferEngine exact = local_engine(scene);
  const auto error = [&](double lines, bool gridded) {
    const TransferEngine rays =
        make_engine(Engine::rays, scene, nullptr, {.lines_per_patch = lines, .gridded = gridded});
    double sum = 0;
    for (const Vec3& omega : testing::test_directions(6, 5)) {
      sum += rms_error(areas_of(exact(omega, {})), areas_of(rays(omega, {})));
    }
    return sum / 6;
  };
  // Random lines: n^-1/2. On a jittered grid only cells at outlines have errors: n^-3/4.
  EXPECT_NEAR(error(50, false) / error(3200, false), 8, 2);
  EXPECT_NEAR(error(50, true) / error(3200, true), 22.6, 6);
  EXPECT_LT(error(50, true), error(50, false) / 2);
}

/// Two unit squares that fill the window: every line counts, and no other, also where the number of
/// lines is not a multiple of the packets that Embree traces.
TEST(RayEngine, CountsEveryLineOnce) {
  const auto scene = load_scene(std::string(TRANSILLUM_DATA_DIR) + "/scenes/parallel-squares.obj");
  const Vec3 toward_source = scene->patch(0).normal;
  for (const bool gridded : {false, true}) {
    for (int lines_per_patch = 1; lines_per_patch <= 40; ++lines_per_patch) {
      const EngineOptions options{
          .lines_per_patch = static_cast<double>(lines_per_patch), .gridded = gridded, .seed = 3};
      const Transfers transfers =
          make_engine(Engine::rays, scene, nullptr, options)(toward_source, {});
      EXPECT_NEAR(total(transfers), 1, 1e-12) << lines_per_patch << ' ' << gridded;
    }
  }
}

TEST(RayEngine, TheTotalIsUnbiased) {
  const auto scene = load_scene("cornell-box");
  const Vec3 omega = normalized({1, -2, 3});
  const double exact = total(local_engine(scene)(omega, {}));
  for (const bool gridded : {false, true}) {
    double sum = 0, squares = 0;
    constexpr int trials = 200;
    for (int k = 0; k < trials; ++k) {
      const EngineOptions options{
          .lines_per_patch = 20, .gridded = gridded, .seed = static_cast<std::uint64_t>(k)};
      const double error =
          total(make_engine(Engine::rays, scene, nullptr, options)(omega, {})) - exact;
      sum += error;
      squares += error * error;
    }
    const double mean = sum / trials;
    const double deviation = std::sqrt((squares / trials - mean * mean) / trials);
    ASSERT_GT(deviation, 0);
    ASSERT_LT(deviation, 0.01 * exact);
    EXPECT_LT(std::abs(mean), 3.5 * deviation) << gridded;
  }
}

bool same_bits(const Transfers& a, const Transfers& b) {
  const auto same_side = [](const std::vector<Coverage>& x, const std::vector<Coverage>& y) {
    return std::equal(x.begin(), x.end(), y.begin(), y.end(), [](const auto& p, const auto& q) {
      return p.projected == q.projected && p.covered == q.covered;
    });
  };
  return areas_of(a) == areas_of(b) && same_side(a.forward, b.forward) &&
         same_side(a.backward, b.backward) && a.back_seen == b.back_seen;
}

TEST(RayEngine, IsAFunctionOfTheDirectionInAnyThread) {
  const auto scene = load_scene("boards", {.two_sided = true});
  const TransferEngine rays = make_engine(Engine::rays, scene, nullptr);
  const Vec3 omega = normalized({3, 1, 2});
  const Transfers first = rays(omega, {});
  std::vector<Transfers> others(8);
  std::vector<std::thread> threads;
  for (Transfers& other : others) {
    threads.emplace_back([&] { other = rays(omega, {}); });
  }
  for (std::thread& thread : threads) {
    thread.join();
  }
  for (const Transfers& other : others) {
    EXPECT_TRUE(same_bits(first, other));
  }
  EXPECT_TRUE(same_bits(rays({0, 0, 1}, {}), rays({-0.0, 0, 1}, {})));
  const TransferEngine reseeded = make_engine(Engine::rays, scene, nullptr, {.seed = 2});
  EXPECT_FALSE(same_bits(first, reseeded(omega, {})));
}

/// Single precision must have no effect: the same scene tiny, huge, and far from the origin.
TEST(RayEngine, ResultDoesNotDependOnScaleAndPosition) {
  const SceneDescription flake = describe_scene("sphere-flake:levels=1");
  const Vec3 omega = normalized({1, 2, -1});
  const auto areas = [&](double size, const Vec3& shift) {
    const auto scene = std::make_shared<const Scene>(
        testing::moved(flake, [&](const Vec3& p) { return size * p + shift; }));
    Transfers transfers = make_engine(Engine::rays, scene, nullptr)(omega, {});
    for (Transfer& t : transfers.exchanges) {
      t.area /= size * size;
    }
    return transfers;
  };
  const Transfers as_is = areas(1, {});
  for (const auto& [size, shift] :
       {std::pair{1e-6, Vec3{}}, {1e6, Vec3{}}, {1.0, Vec3{1e6, -1e7, 1e5}}}) {
    const Transfers moved = areas(size, shift);
    PairAreas difference = areas_of(as_is);
    for (const auto& [pair, area] : areas_of(moved)) {
      difference[pair] -= area;
    }
    double sum = 0;
    for (const auto& [pair, area] : difference) {
      sum += std::abs(area);
    }
    EXPECT_LT(sum, 1e-4 * total(as_is)) << size;
  }
}

TEST(RayEngine, CanBeCanceledAndChecksTheNumberOfLines) {
  const auto scene = load_scene("furnace");
  for (const double lines : {0.0, -1.0, std::nan(""), 2e6}) {
    EXPECT_THROW(make_engine(Engine::rays, scene, nullptr, {.lines_per_patch = lines}), InputError);
  }
  const TransferEngine rays = make_engine(Engine::rays, scene, nullptr);
  EXPECT_THROW(rays({0, 0, 1}, testing::canceled()), Canceled);
}

/// Rows are normalized by the sums of the same lines, so the furnace is exact for any lines.
TEST(RayEngine, FurnaceHasRadiosityTwo) {
  const Solution solution = solve(load_scene("furnace"), {.directions = 32,
                                                          .engine = Engine::rays,
                                                          .normalize = Normalization::rows,
                                                          .tolerance = 1e-13});
  for (const Rgb& b : solution.radiosity) {
    EXPECT_NEAR(b.r, 2, 1e-10);
  }
  EXPECT_EQ(solution.statistics.closure_defect_max, 0);
  EXPECT_EQ(solution.statistics.escaped, 0);
}

}  // namespace
}  // namespace transillum::ray_engine_test
