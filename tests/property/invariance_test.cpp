// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
// ALGORITHM.md, oracle 5: changes of the input that must not change the results.

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>

#include "support/scenes.h"
#include "transillum/at.h"
#include "transillum/solution.h"
#include "transillum/solve_options.h"
#include "transillum/solve_session.h"

namespace transillum::invariance_test {
namespace {

using testing::Sketch;

/// Compares A(i,j) of scenes `a` and `b`, patch by patch, for corresponding directions.
void expect_same_transfers(std::shared_ptr<const Scene> a, std::shared_ptr<const Scene> b,
                           const std::function<Vec3(const Vec3&)>& turn, double scale,
                           const std::vector<int>& patch_in_b) {
  const auto tree_a = std::make_shared<const BspTree>(*a);
  const auto tree_b = std::make_shared<const BspTree>(*b);
  const auto engine_a = make_engine(Engine::local, a, tree_a),
             engine_b = make_engine(Engine::local, b, tree_b);
  const auto n = static_cast<std::size_t>(a->patch_count());
  for (const Vec3& omega : testing::test_directions(15, 9)) {
    std::vector<double> difference(n * n, 0.0);
    for (const Transfer& t : engine_a(omega, {}).exchanges) {
      const auto i = static_cast<std::size_t>(at(patch_in_b, t.receiver));
      const auto j = static_cast<std::size_t>(at(patch_in_b, t.source));
      difference[i * n + j] += t.area * scale * scale;
    }
    for (const Transfer& t : engine_b(normalized(turn(omega)), {}).exchanges) {
      difference[static_cast<std::size_t>(t.receiver) * n + static_cast<std::size_t>(t.source)] -=
          t.area;
    }
    for (std::size_t k = 0; k < difference.size(); ++k) {
      const double area = b->patch(static_cast<PatchId>(k / n)).area;
      // Rotating a scene rounds it: a patch at a grazing angle changes by that rounding.
      ASSERT_NEAR(difference[k], 0, 1e-12 * scale * scale + 1e-11 * area);
    }
  }
}

std::vector<int> identity(PatchId count) {
  std::vector<int> ids(static_cast<std::size_t>(count));
  std::iota(ids.begin(), ids.end(), 0);
  return ids;
}

constexpr const char* scenes[] = {"cornell-box", "boards", "rooms", "stars"};

TEST(Invariance, RigidMotion) {
  for (const char* spec : scenes) {
    const SceneDescription description = describe_scene(spec);
    const auto rotate = testing::random_rotation(4);
    const auto still = std::make_shared<const Scene>(description);
    const auto turned =
        std::make_shared<const Scene>(testing::moved(description, [&](const Vec3& p) {
          return rotate(p) + Vec3{3, -2, 1};
        }));
    expect_same_transfers(still, turned, rotate, 1, identity(still->patch_count()));
  }
}

TEST(Invariance, UniformScale) {
  for (const char* spec : scenes) {
    for (const double scale : {1e-6, 1024.0, 1e6}) {
      const SceneDescription description = describe_scene(spec);
      const auto small = std::make_shared<const Scene>(description);
      const auto large = std::make_shared<const Scene>(
          testing::moved(description, [&](const Vec3& p) { return scale * p; }));
      expect_same_transfers(
          small, large, [](const Vec3& d) { return d; }, scale, identity(small->patch_count()));
    }
  }
}

TEST(Invariance, OrderOfFaces) {
  for (const char* spec : scenes) {
    const SceneDescription description = describe_scene(spec);
    auto order = identity(static_cast<PatchId>(description.face_count()));
    std::shuffle(order.begin(), order.end(), std::mt19937(6));
    std::vector<int> place(order.size());
    for (std::size_t k = 0; k < order.size(); ++k) {
      at(place, order[k]) = static_cast<int>(k);
    }
    expect_same_transfers(
        std::make_shared<const Scene>(description),
        std::make_shared<const Scene>(testing::reordered(description, order)),
        [](const Vec3& d) { return d; }, 1, place);
  }
}

/// If a patch is split into two triangles, their areas add up to the area of the whole.
TEST(Invariance, PatchSplitInTwo) {
  const auto room = [](bool cut) {
    Sketch sketch;
    const int gray = sketch.material(0.5, 1);
    sketch.box({0, 0, 0}, {3, 2, 2}, true, gray);
    sketch.box({1, 0.5, 0.5}, {2, 1.2, 1.1}, false, gray);
    if (cut) {
      sketch.face({{0.2, 0.2, 1.7}, {0.2, 0.9, 1.5}, {0.9, 0.2, 1.7}}, gray);
      sketch.face({{0.9, 0.2, 1.7}, {0.2, 0.9, 1.5}, {0.9, 0.9, 1.5}}, gray);
    } else {
      sketch.face({{0.2, 0.2, 1.7}, {0.2, 0.9, 1.5}, {0.9, 0.9, 1.5}, {0.9, 0.2, 1.7}}, gray);
    }
    return sketch.scene();
  };
  const auto whole = room(false), halves = room(true);
  const PatchId last = whole->patch_count() - 1;
  const auto whole_engine =
      make_engine(Engine::local, whole, std::make_shared<const BspTree>(*whole));
  const auto halves_engine =
      make_engine(Engine::local, halves, std::make_shared<const BspTree>(*halves));
  const auto n = static_cast<std::size_t>(whole->patch_count());
  double seen = 0;
  for (const Vec3& omega : testing::test_directions(40, 12)) {
    std::vector<double> difference(n * n, 0.0);
    const auto at = [&](PatchId i, PatchId j) -> double& {
      return difference[static_cast<std::size_t>(std::min(i, last)) * n +
                        static_cast<std::size_t>(std::min(j, last))];
    };
    for (const Transfer& t : whole_engine(omega, {}).exchanges) {
      at(t.receiver, t.source) += t.area;
      if (t.receiver == last || t.source == last) {
        seen += t.area;
      }
    }
    for (const Transfer& t : halves_engine(omega, {}).exchanges) {
      at(t.receiver, t.source) -= t.area;
    }
    for (const double d : difference) {
      ASSERT_NEAR(d, 0, 1e-13);
    }
  }
  EXPECT_GT(seen, 1);
}

TEST(Invariance, ThreadsGiveTheSameBits) {
  for (const char* spec : {"rooms", "boards"}) {
    const auto scene = load_scene(spec);
    for (const std::uint64_t memory : {std::uint64_t{0}, std::uint64_t{1}}) {
      SolveOptions options{.directions = 61, .tolerance = 1e-4, .memory = memory, .threads = 1};
      const Solution one = solve(scene, options);
      for (const int threads : {2, 7}) {
        options.threads = threads;
        const Solution many = solve(scene, options);
        EXPECT_EQ(one.statistics.iterations, many.statistics.iterations);
        EXPECT_TRUE(one.radiosity == many.radiosity) << spec << ", threads " << threads;
      }
    }
  }
}

TEST(Invariance, KeptAndRecomputedFormFactorsAgree) {
  const auto scene = load_scene("cornell-box", {.max_patch_area = 0.1});
  for (const bool two_way : {true, false}) {
    SolveOptions options{.directions = 50, .two_way = two_way};
    const Solution kept = solve(scene, options);
    options.memory = 1;
    const Solution recomputed = solve(scene, options);
    EXPECT_TRUE(kept.statistics.kept_form_factors);
    EXPECT_FALSE(recomputed.statistics.kept_form_factors);
    EXPECT_EQ(kept.statistics.iterations, recomputed.statistics.iterations);
    for (std::size_t i = 0; i < kept.radiosity.size(); ++i) {
      EXPECT_LE(max_abs(kept.radiosity[i] - recomputed.radiosity[i]),
                1e-12 * max_abs(kept.radiosity[i]));
    }
  }
}

/// ALGORITHM.md, section 8: any limit under which form factors are kept gives the same bits, and so
/// does any under which they are not.
TEST(Invariance, MemoryChangesNoBitWhileFormFactorsAreKeptOrRecomputedAlike) {
  const auto scene = load_scene("cornell-box", {.max_patch_area = 0.1});
  for (const int replicas : {1, 3}) {
    SolveOptions options{.directions = 48, .replicas = replicas};
    const Solution kept = solve(scene, options), *before[2] = {nullptr, &kept};
    Solution recomputed;
    const std::uint64_t most = 200 * static_cast<std::uint64_t>(kept.statistics.form_factors);
    for (options.memory = 1; options.memory < most; options.memory += most / 20) {
      const Solution solution = solve(scene, options);
      const Solution*& same = before[solution.statistics.kept_form_factors ? 1 : 0];
      if (same == nullptr) {
        recomputed = solution;
        same = &recomputed;
      }
      EXPECT_TRUE(solution.radiosity == same->radiosity) << options.memory;
      EXPECT_TRUE(solution.error.standard_error == same->error.standard_error) << options.memory;
    }
    ASSERT_NE(before[0], nullptr);
  }
}

}  // namespace
}  // namespace transillum::invariance_test
