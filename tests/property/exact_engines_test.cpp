// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
// The engines with exact numbers, against known answers, and all maps against each other
// (ALGORITHM.md, oracle 7).

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <random>
#include <thread>

#include "support/canceled.h"
#include "support/scenes.h"
#include "support/stopping.h"
#include "transillum/engine.h"

namespace transillum::exact_engines_test {
namespace {

using testing::Sketch;
using testing::test_directions;

Transfers transfers_of(Engine engine, const std::shared_ptr<const Scene>& scene,
                       const Vec3& omega) {
  const auto tree = std::make_shared<const BspTree>(*scene);
  return make_engine(engine, scene, tree)(omega, {});
}

class ExactEngines : public ::testing::TestWithParam<Engine> {
 protected:
  /// The area that the only pair exchanges.
  double only_area(const Sketch& sketch) {
    const Transfers transfers = transfers_of(GetParam(), sketch.scene(), {0, 0, 1});
    EXPECT_EQ(transfers.exchanges.size(), 1u);
    if (transfers.exchanges.size() != 1) {
      return 0;
    }
    EXPECT_EQ(transfers.exchanges[0].receiver, 0);
    EXPECT_EQ(transfers.exchanges[0].source, 1);
    return transfers.exchanges[0].area;
  }
};

/// The outline at height z, facing up or down.
std::vector<Vec3> up(std::vector<Vec3> outline, double z) {
  for (Vec3& p : outline) {
    p.z = z;
  }
  return outline;
}
std::vector<Vec3> down(std::vector<Vec3> outline, double z) {
  outline = up(std::move(outline), z);
  std::reverse(outline.begin(), outline.end());
  return outline;
}
std::vector<Vec3> rectangle(double x0, double y0, double x1, double y1) {
  return {{x0, y0, 0}, {x1, y0, 0}, {x1, y1, 0}, {x0, y1, 0}};
}

TEST_P(ExactEngines, AreaOfSquaresIsCorrectlyRounded) {
  Sketch sketch;
  const int gray = sketch.material(0.5, 1);
  // 1 - 0.1 is the exact result for the doubles' values, rounded once.
  sketch.face(up(rectangle(0, 0, 1, 1), 0), gray);
  sketch.face(down(rectangle(0.1, -1, 3, 2), 1), gray);
  EXPECT_EQ(only_area(sketch), 1 - 0.1);
}

TEST_P(ExactEngines, ThirdsAreRoundedOnce) {
  Sketch sketch;
  const int gray = sketch.material(0.5, 1);
  sketch.face(up(rectangle(0, 0, 1, 1), 0), gray);
  sketch.face(down({{0, 0, 0}, {3, 0, 0}, {3, 1, 0}}, 1), gray);
  EXPECT_EQ(only_area(sketch), 1.0 / 6);
}

TEST_P(ExactEngines, PartsAroundABlockerSumToTheCorrectlyRoundedArea) {
  Sketch sketch;
  const int gray = sketch.material(0.5, 1);
  sketch.face(up(rectangle(0, 0, 1, 1), 0), gray);
  sketch.face(down(rectangle(-1, -1, 2, 2), 2), gray);
  // A blocker with its back to the receiver: within the square it is 3/4 long and up to 9/28 high.
  sketch.face(up({{0.25, 0.25, 0}, {7.25, 0.25, 0}, {7.25, 3.25, 0}}, 1), gray);
  const Transfers transfers = transfers_of(GetParam(), sketch.scene(), {0, 0, 1});
  const double hidden = 27.0 / 224;
  EXPECT_EQ(transfers.forward[0].projected, 1);
  EXPECT_EQ(transfers.forward[0].covered, 1);
  EXPECT_EQ(transfers.back_seen[2], hidden);
  ASSERT_FALSE(transfers.exchanges.empty());
  EXPECT_EQ(transfers.exchanges[0].receiver, 0);
  EXPECT_EQ(transfers.exchanges[0].source, 1);
  EXPECT_EQ(transfers.exchanges[0].area, 197.0 / 224);
}

TEST_P(ExactEngines, StopImmediatelyWhenCanceled) {
  const auto scene = load_scene("cornell-box");
  const TransferEngine engine =
      make_engine(GetParam(), scene, std::make_shared<const BspTree>(*scene));
  EXPECT_THROW(engine({0, 0, 1}, testing::canceled()), Canceled);
}

TEST_P(ExactEngines, StopQuicklyWhenCanceledDuringAPass) {
  const auto scene = load_scene("sphere-flake:levels=2,slices=10,stacks=6");
  const TransferEngine engine =
      make_engine(GetParam(), scene, std::make_shared<const BspTree>(*scene));
  const auto seconds = testing::seconds_to_stop(
      [&](const Cancellation& cancellation) {
        engine(normalized({1, 2, 3}), cancellation);
      },
      0.15);
  ASSERT_TRUE(seconds) << "the pass ended before";
  EXPECT_LT(*seconds, testing::longest_stop);
}

TEST_P(ExactEngines, GiveTheSameBitsEachTimeAndInAnyThread) {
  const auto scene = load_scene("boards");
  const TransferEngine engine =
      make_engine(GetParam(), scene, std::make_shared<const BspTree>(*scene));
  const Vec3 omega = normalized({3, -1, 2});
  const Transfers here = engine(omega, {});
  Transfers there[2];
  std::thread one([&] { there[0] = engine(omega, {}); });
  std::thread two([&] { there[1] = engine(omega, {}); });
  one.join();
  two.join();
  for (const Transfers& other : there) {
    ASSERT_EQ(other.exchanges.size(), here.exchanges.size());
    for (std::size_t k = 0; k < here.exchanges.size(); ++k) {
      EXPECT_EQ(other.exchanges[k].area, here.exchanges[k].area);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Engines, ExactEngines, ::testing::Values(Engine::exact, Engine::global),
                         [](const auto& engine) { return name_of(engine.param); });

class MapsAgree : public ::testing::TestWithParam<const char*> {};

using Pair = std::pair<PatchId, PatchId>;

std::map<Pair, double> by_pair(const Transfers& transfers) {
  std::map<Pair, double> areas;
  for (const Transfer& t : transfers.exchanges) {
    areas[{t.receiver, t.source}] = t.area;
  }
  return areas;
}

/// Largest difference relative to the patch's area; for a pair, to the smaller area of the two.
double difference(const Scene& scene, const Transfers& a, const Transfers& b) {
  double largest = 0;
  const auto compare = [&](PatchId i, double one, double other) {
    largest = std::max(largest, std::abs(one - other) / scene.patch(i).area);
  };
  auto pairs = by_pair(a);
  for (const auto& [pair, area] : by_pair(b)) {
    pairs[pair] -= area;
  }
  for (const auto& [pair, area] : pairs) {
    compare(pair.first, area, 0);
    compare(pair.second, area, 0);
  }
  for (PatchId i = 0; i < scene.patch_count(); ++i) {
    const auto k = static_cast<std::size_t>(i);
    compare(i, a.forward[k].projected, b.forward[k].projected);
    compare(i, a.forward[k].covered, b.forward[k].covered);
    compare(i, a.backward[k].projected, b.backward[k].projected);
    compare(i, a.backward[k].covered, b.backward[k].covered);
    compare(i, a.back_seen[k], b.back_seen[k]);
  }
  return largest;
}

TEST_P(MapsAgree, LocalAndGlobalWithExact) {
  const auto scene = load_scene(GetParam());
  const auto tree = std::make_shared<const BspTree>(*scene);
  const TransferEngine exact = make_engine(Engine::exact, scene, tree);
  const TransferEngine local = make_engine(Engine::local, scene, tree);
  const TransferEngine global = make_engine(Engine::global, scene, tree);
  for (const Vec3& omega : test_directions(15, 17)) {
    const Transfers truth = exact(omega, {});
    EXPECT_LE(difference(*scene, truth, local(omega, {})), 1e-10);
    EXPECT_LE(difference(*scene, truth, global(omega, {})), 1e-10);
  }
}

INSTANTIATE_TEST_SUITE_P(BuiltIns, MapsAgree,
                         ::testing::Values("cornell-box", "boards", "furnace", "stars", "rooms",
                                           "sphere-flake:levels=1,slices=6,stacks=4"));

/// Two triangles with the same corners are a sheet of two sides, which do not see each other. The
/// rounding of a needle's plane cut the other in two: F was 0.44 instead of 0.
TEST(Needles, BackToBackDoNotSeeEachOther) {
  std::mt19937_64 random(3);
  const auto uniform = [&](double low, double high) {
    return low + (high - low) * static_cast<double>(random() >> 11U) * 0x1p-53;
  };
  const auto point = [&](double size) {
    return Vec3{uniform(-size, size), uniform(-size, size), uniform(-size, size)};
  };
  for (int k = 0; k < 100; ++k) {
    const Vec3 a = point(100), b = point(100), c = b + point(std::pow(10, uniform(-6, 1)));
    Sketch sketch;
    const int gray = sketch.material(0.5, 1);
    sketch.face({a, b, c}, gray).face({a, c, b}, gray);
    sketch.box({-200, -200, -200}, {200, 200, 200}, true, gray);
    const std::shared_ptr<const Scene> scene = sketch.scene();
    for (const Engine engine : {Engine::fast, Engine::local, Engine::global, Engine::exact}) {
      for (const Vec3& omega : test_directions(5, static_cast<std::uint64_t>(k))) {
        for (const Transfer& t : transfers_of(engine, scene, omega).exchanges) {
          EXPECT_TRUE(t.receiver > 1 || t.source > 1 || t.source < 0)
              << name_of(engine) << ", needles " << k << ": " << t.area << " m²";
        }
      }
    }
  }
}

}  // namespace
}  // namespace transillum::exact_engines_test
