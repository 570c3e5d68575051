// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
// ALGORITHM.md, oracles 1 and 2: sums of the transfers of closed scenes.

#include <gtest/gtest.h>

#include <array>
#include <map>
#include <string>
#include <tuple>

#include "support/imperfect_scenes.h"
#include "support/map_on_failure.h"
#include "support/scenes.h"
#include "transillum/at.h"
#include "transillum/engine.h"

namespace transillum::closure_test {
namespace {

using testing::test_directions;

/// Properties of all passes through a scene without open sides.
void expect_closure(const std::shared_ptr<const Scene>& scene, Engine by, int directions) {
  const auto tree = std::make_shared<const BspTree>(*scene);
  const TransferEngine engine = make_engine(by, scene, tree);
  for (const Vec3& omega : test_directions(directions, 7)) {
    const testing::MapOnFailure map(*scene, *tree, omega);
    const Transfers transfers = engine(omega, {});
    const ClosureDefect defect = closure_defect(transfers, *scene);
    ASSERT_LE(defect.relative, 1e-10)
        << "patch " << defect.worst << ", omega " << omega.x << ", " << omega.y << ", " << omega.z;
    ASSERT_LE(defect.grazing, 1e-12);
    // The exchanged area is a large part of the projected area, and no more.
    double projected = 0, exchanged = 0;
    for (const Coverage& c : transfers.forward) {
      projected += c.projected;
    }
    for (const Transfer& t : transfers.exchanges) {
      ASSERT_GT(t.area, 0);
      exchanged += t.area;
    }
    ASSERT_GT(exchanged, 0.1 * projected);
    ASSERT_LE(exchanged, projected * (1 + 1e-10));
  }
}

struct BuiltIn {
  const char* spec;
  double max_patch_area;
};

/// The exact engines, except the slow `global` and `exact`.
constexpr std::array tested_engines{Engine::local, Engine::fast};

class Closure : public ::testing::TestWithParam<std::tuple<BuiltIn, Engine>> {};

TEST_P(Closure, ReceivedAreasAddUpTo200Projections) {
  const auto& [built_in, engine] = GetParam();
  expect_closure(load_scene(built_in.spec, {.max_patch_area = built_in.max_patch_area}), engine,
                 200);
}

INSTANTIATE_TEST_SUITE_P(
    BuiltIns, Closure,
    ::testing::Combine(::testing::Values(BuiltIn{"sphere-flake", 0}, BuiltIn{"cornell-box", 0},
                                         BuiltIn{"cornell-box", 0.01}, BuiltIn{"furnace", 0},
                                         BuiltIn{"furnace", 0.02}, BuiltIn{"boards", 0},
                                         BuiltIn{"boards", 0.01}, BuiltIn{"rooms", 0},
                                         BuiltIn{"stars", 0}, BuiltIn{"stars", 0.1}),
                       ::testing::ValuesIn(tested_engines)),
    [](const auto& test) {
      return std::to_string(test.index / tested_engines.size()) +
             name_of(std::get<Engine>(test.param));
    });

/// Interpenetrating closed surfaces: back sides are seen, and closure still holds.
class ClosureInterpenetrating : public ::testing::TestWithParam<Engine> {};

TEST_P(ClosureInterpenetrating, ReceivedAreasAddUpTo200Projections) {
  testing::Sketch sketch;
  const int gray = sketch.material(0.5, 1);
  sketch.tetrahedra(10, 0.6, 23, gray).box({-0.5, -0.5, -0.5}, {1.5, 1.5, 1.5}, true, gray);
  expect_closure(sketch.scene(), GetParam(), 200);
}

INSTANTIATE_TEST_SUITE_P(Engines, ClosureInterpenetrating, ::testing::ValuesIn(tested_engines),
                         [](const auto& test) { return name_of(test.param); });

/// Needles cut by the tree: edges between corners that rounding put on the same grid point, or on
/// the wrong side of each other; cuts along needles, whose lines meet far from where they end.
/// Worst found: 1.5e-10 of a patch.
class ClosureNeedles : public ::testing::TestWithParam<int> {};

TEST_P(ClosureNeedles, ReceivedAreasAddUpToProjections) {
  for (const double aspect : {1e6, 1e8}) {
    for (std::uint64_t seed = 1; seed <= 4; ++seed) {
      testing::ImperfectScene truss;
      truss.kind = testing::Imperfect::truss;
      truss.count = 100;
      truss.aspect = aspect;
      truss.digits = GetParam();
      truss.turned = true;
      truss.seed = seed;
      const auto scene = std::make_shared<const Scene>(testing::describe(truss));
      const auto tree = std::make_shared<const BspTree>(*scene);
      const TransferEngine engine = make_engine(Engine::fast, scene, tree);
      for (const Vec3& omega : test_directions(8, seed)) {
        const Transfers transfers = engine(omega, {});
        for (PatchId i = 0; i < scene->patch_count(); ++i) {
          const double rounding = 3e-10 * scene->patch(i).area;
          for (const Coverage& side : {at(transfers.forward, i), at(transfers.backward, i)}) {
            ASSERT_NEAR(side.covered, side.projected, rounding)
                << "patch " << i << ", aspect " << aspect << ", seed " << seed << ", omega "
                << omega.x << ", " << omega.y << ", " << omega.z;
          }
        }
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Digits, ClosureNeedles, ::testing::Values(6, 9, 17));

/// Compares projected areas with areas computed from the normals.
TEST(Projection, AreasFollowTheCosine) {
  const auto scene = load_scene("rooms");
  const auto tree = std::make_shared<const BspTree>(*scene);
  const TransferEngine engine = make_engine(Engine::local, scene, tree);
  for (const Vec3& omega : test_directions(20, 3)) {
    const Transfers transfers = engine(omega, {});
    for (PatchId i = 0; i < scene->patch_count(); ++i) {
      const Patch& patch = scene->patch(i);
      const double seen = patch.area * dot(patch.normal, omega);
      const auto k = static_cast<std::size_t>(i);
      EXPECT_NEAR(transfers.forward[k].projected, std::max(seen, 0.0), 1e-12 * patch.area);
      EXPECT_NEAR(transfers.backward[k].projected, std::max(-seen, 0.0), 1e-12 * patch.area);
    }
  }
}

TEST(Reciprocity, OppositeDirectionsGiveTheSameAreas) {
  for (const char* spec : {"cornell-box", "boards", "rooms"}) {
    const auto scene = load_scene(spec);
    const auto tree = std::make_shared<const BspTree>(*scene);
    const TransferEngine engine = make_engine(Engine::local, scene, tree);
    for (const Vec3& omega : test_directions(20, 11)) {
      const testing::MapOnFailure drawn(*scene, *tree, omega);
      std::map<std::pair<PatchId, PatchId>, double> there;
      for (const Transfer& t : engine(omega, {}).exchanges) {
        there[{t.receiver, t.source}] = t.area;
      }
      for (const Transfer& t : engine(-omega, {}).exchanges) {
        const double area = scene->patch(t.receiver).area;
        EXPECT_NEAR((there[{t.source, t.receiver}]), t.area, 1e-11 * area) << spec;
        there.erase({t.source, t.receiver});
      }
      for (const auto& [pair, area] : there) {
        EXPECT_LT(area, 1e-11 * scene->patch(pair.first).area) << spec;
      }
    }
  }
}

}  // namespace
}  // namespace transillum::closure_test
