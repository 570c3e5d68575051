// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
// The built-in scenes: patch counts, areas, closedness, geometry, and errors in their names and
// parameters.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>

#include "scene_test_support.h"

namespace transillum::scene_built_in_test {
namespace {

using ::testing::HasSubstr;

struct Expected {
  const char* spec;
  PatchId patches;
  double area;  ///< m²; 0 if it is not known in closed form
};

class BuiltIns : public ::testing::TestWithParam<Expected> {};

TEST_P(BuiltIns, HaveExpectedPatchesAndNoWarnings) {
  const auto scene = load_scene(GetParam().spec);
  EXPECT_EQ(scene->patch_count(), GetParam().patches);
  EXPECT_EQ(scene->report().faces, GetParam().patches);
  EXPECT_TRUE(scene->report().warnings.empty())
      << ::testing::PrintToString(scene->report().warnings);
  if (GetParam().area > 0) {
    EXPECT_NEAR(total_area(*scene), GetParam().area, 1e-12 * GetParam().area);
  }
}

INSTANTIATE_TEST_SUITE_P(
    Scene, BuiltIns,
    ::testing::Values(Expected{"sphere-flake", 145 * 136 + 256, 0},
                      Expected{"sphere-flake:levels=2,slices=17,stacks=8", 19'976, 0},
                      Expected{"sphere-flake:levels=0,slices=3,stacks=2", 6 + 256, 0},
                      Expected{"sphere-flake:levels=1,slices=4,stacks=3", 13 * 12 + 256, 0},
                      // Floors are split around the objects that stand on them.
                      Expected{"cornell-box", 27, 0}, Expected{"cornell-box:open=1", 26, 0},
                      Expected{"furnace", 12, 6 * 4 + 2 * (0.75 * 0.5 + 0.5 * 1 + 0.75 * 1)},
                      Expected{"boards", 10 + 5 * 6, 0}, Expected{"boards:n=3", 10 + 3 * 6, 0},
                      Expected{"flatland", 16, 0}, Expected{"gallery", 678, 0},
                      Expected{"boards:n=24", 10 + 24 * 6, 0}, Expected{"rooms", 254, 0},
                      Expected{"rooms:n=0,rooms=1", 10, 2 * (4 * 5 + (4 + 5) * 2.75)},
                      Expected{"stars", 127, 0}));

/// Every edge is used by as many faces in one direction as in the other.
bool is_watertight(const Scene& scene) {
  std::map<std::pair<PointId, PointId>, int> balance;
  for (PatchId i = 0; i < scene.patch_count(); ++i) {
    const auto outline = scene.outline(i);
    for (std::size_t k = 0; k < outline.size(); ++k) {
      const PointId a = outline[k], b = outline[(k + 1) % outline.size()];
      a < b ? ++balance[{a, b}] : --balance[{b, a}];
    }
  }
  for (const auto& [edge, sum] : balance) {
    if (sum != 0) {
      return false;
    }
  }
  return true;
}

TEST(BuiltInScenes, AreWatertight) {
  for (const char* spec : {"sphere-flake", "furnace", "boards", "boards:n=3", "rooms:n=0,rooms=1",
                           "rooms:n=0,rooms=5"}) {
    EXPECT_TRUE(is_watertight(*load_scene(spec))) << spec;
  }
}

/// The floor parts and the tops of the blocks together have the area of the whole floor.
TEST(BuiltInScenes, HaveNoFloorUnderBlocks) {
  struct Floor {
    const char* spec;
    Vec3 up;
    double area;
  };
  for (const Floor& floor :
       {Floor{"cornell-box", {0, 1, 0}, 0.556 * 0.5592}, Floor{"stars:n=1", {0, 0, 1}, 4 * 4},
        Floor{"rooms:rooms=1", {0, 0, 1}, 4 * 5}, Floor{"rooms:rooms=1,n=200", {0, 0, 1}, 4 * 5}}) {
    const auto scene = load_scene(floor.spec);
    double area = 0, highest = 0;
    for (const Patch& patch : scene->patches()) {
      if (dot(patch.normal, floor.up) < 0.999) {
        continue;
      }
      area += patch.area;
      highest = std::max(highest, dot(patch.center, floor.up));
    }
    EXPECT_GT(highest, 0) << floor.spec;
    EXPECT_NEAR(area, floor.area, 1e-12) << floor.spec;
  }
}

TEST(SphereFlake, IsInsideItsSkyAndFacesOutward) {
  const auto scene = load_scene("sphere-flake");
  const PatchId flake = 145 * 136;
  double highest = 0, lowest_sky = 1e9;
  for (PatchId i = 0; i < scene->patch_count(); ++i) {
    const Patch& p = scene->patch(i);
    if (i < 136) {
      EXPECT_GT(dot(p.normal, p.center), 0);
    }
    if (i >= flake) {
      EXPECT_LT(dot(p.normal, p.center), 0);
      lowest_sky = std::min(lowest_sky, -dot(p.normal, p.center));
      EXPECT_EQ(scene->reflectance(i), (Rgb{0, 0, 0}));
      EXPECT_GT(scene->exitance(i).g, 0);
    } else {
      EXPECT_EQ(scene->reflectance(i), (Rgb{0.6, 0.6, 0.6}));
      EXPECT_EQ(scene->exitance(i), (Rgb{0, 0, 0}));
      for (const PointId c : scene->outline(i)) {
        highest = std::max(highest, norm(scene->point(c)));
      }
    }
  }
  EXPECT_NEAR(highest, 1 + 2.0 / 3 + 2.0 / 9, 1e-12);
  EXPECT_GT(lowest_sky, highest + 0.5);
  EXPECT_NE(scene->exitance(flake), scene->exitance(flake + 16)) << "two hemispheres";
}

TEST(SphereFlake, SpheresTouchTheirParents) {
  // The first child of the first child, in the order in which they are made: balls 1 and 13.
  const auto scene = load_scene("sphere-flake");
  const auto center = [&](int ball) {
    const PatchId first = ball * 136;
    return 0.5 *
           (scene->point(scene->outline(first)[0]) + scene->point(scene->outline(first + 135)[1]));
  };
  for (int child = 1; child <= 12; ++child) {
    EXPECT_NEAR(norm(center(child)), 1 + 1.0 / 3, 1e-12);
    for (int k = 0; k < 11; ++k) {
      EXPECT_NEAR(norm(center(13 + 11 * (child - 1) + k) - center(child)), 4.0 / 9, 1e-12);
    }
  }
  // The icosahedron's corners are 63.43 degrees apart.
  double nearest = 10;
  for (int child = 2; child <= 12; ++child) {
    nearest = std::min(nearest, norm(center(child) - center(1)));
  }
  EXPECT_NEAR(nearest, 4.0 / 3 * 1.0514622242382672, 1e-12);
}

TEST(CornellBox, HasItsLightInTheCeilingFacingDown) {
  const auto scene = load_scene("cornell-box");
  int lights = 0;
  for (PatchId i = 0; i < scene->patch_count(); ++i) {
    if (scene->exitance(i).r == 0) {
      continue;
    }
    ++lights;
    EXPECT_EQ(scene->patch(i).normal.y, -1);
    EXPECT_NEAR(scene->patch(i).area, 0.130 * 0.105, 1e-15);
    EXPECT_NEAR(scene->patch(i).center.y, 0.5488, 1e-15);
  }
  EXPECT_EQ(lights, 1);
}

TEST(Furnace, EmitsEverywhere) {
  const auto scene = load_scene("furnace");
  for (PatchId i = 0; i < scene->patch_count(); ++i) {
    EXPECT_EQ(scene->exitance(i), (Rgb{1, 1, 1}));
    EXPECT_EQ(scene->reflectance(i), (Rgb{0.5, 0.5, 0.5}));
  }
}

TEST(Boards, OverlapCyclically) {
  const auto scene = load_scene("boards:n=5");
  // Board k has faces 10 + 6k …; its far end is above the near end of the next board.
  const auto center_height = [&](int board, bool far_end) {
    // Walls of a block are in the order near, right, far, left.
    const Patch& end = scene->patch(10 + 6 * board + (far_end ? 2 : 0));
    return end.center.z;
  };
  for (int k = 0; k < 5; ++k) {
    EXPECT_GT(center_height(k, true), center_height((k + 1) % 5, false) + 0.1);
  }
}

TEST(Rooms, HaveConcaveWallsAndTheSameBoxesForTheSameSeed) {
  const auto a = load_scene("rooms:n=10,seed=7"), b = load_scene("rooms:n=10,seed=7"),
             c = load_scene("rooms:n=10,seed=8");
  EXPECT_EQ(a->points(), b->points());
  EXPECT_NE(a->points(), c->points());
  EXPECT_GT(a->pieces().size(), a->patches().size());
  EXPECT_GT(load_scene("rooms:n=1000")->patch_count(), 3 * 9 + 2 * 4 + 5000);
}

TEST(BuiltInScenes, DescribeTheirParameters) {
  for (const BuiltInScene& b : built_in_scenes()) {
    EXPECT_FALSE(b.summary.empty());
    const std::string spec = b.parameters.empty() ? b.name : b.name + ":" + b.parameters;
    EXPECT_EQ(describe_scene(spec).points, describe_scene(b.name).points) << spec;
  }
}

std::string error_of(const std::string& spec) {
  return test::refusal([&] { describe_scene(spec); });
}

TEST(BuiltInScenes, MisspelledNamesGetASuggestion) {
  EXPECT_EQ(error_of("sphere-flak"),
            "sphere-flak: no such file or built-in scene; did you mean \"sphere-flake\"? "
            "Built-in scenes: sphere-flake, cornell-box, furnace, boards, rooms, stars, gallery, "
            "flatland.");
  EXPECT_THAT(error_of("cornel-box"), HasSubstr("did you mean \"cornell-box\"?"));
  EXPECT_THAT(error_of("room"), HasSubstr("did you mean \"rooms\"?"));
  EXPECT_THAT(error_of("cornell_box:open=1"), HasSubstr("did you mean \"cornell-box\"?"));
  EXPECT_EQ(error_of("teapot"),
            "teapot: no such file or built-in scene. "
            "Built-in scenes: sphere-flake, cornell-box, furnace, boards, rooms, stars, gallery, "
            "flatland.");
  EXPECT_THAT(error_of(""), HasSubstr("no such file or built-in scene"));
  EXPECT_THAT(error_of(std::string(100'000, 'x')), HasSubstr("no such"));
}

TEST(BuiltInScenes, WrongParametersAreReported) {
  EXPECT_EQ(
      error_of("sphere-flake:level=3"),
      "sphere-flake: unknown parameter `level`; did you mean \"levels\"?; available: "
      "levels (0 to 5, default 2), slices (3 to 4096, default 17), stacks (2 to 4096, default 8)");
  EXPECT_EQ(error_of("furnace:n=3"), "furnace: unknown parameter `n`; the scene has no parameters");
  EXPECT_EQ(error_of("sphere-flake:levels=6"),
            "sphere-flake: parameter `levels` is `6`, but must be a whole number from 0 to 5");
  for (const char* value : {"", "x", "2.5", "-1", "99999999999999999999", "2 "}) {
    EXPECT_THAT(error_of(std::string("sphere-flake:levels=") + value),
                HasSubstr("must be a whole number from 0 to 5"));
  }
  EXPECT_THAT(error_of("rooms:n"), HasSubstr("parameter `n` has no value; example: n=24"));
  EXPECT_EQ(error_of("rooms:n=3,n=3"), "rooms: parameter `n` is given twice");
  EXPECT_THAT(error_of("rooms:n=3,"), HasSubstr("unknown parameter ``"));
  EXPECT_THAT(error_of("sphere-flake:levels=5,slices=4096,stacks=4096"),
              HasSubstr("faces exceed the limit"));
}

}  // namespace
}  // namespace transillum::scene_built_in_test
