// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>

#include "scene_test_support.h"

namespace transillum {
namespace {

using testing::HasSubstr;

struct Expected {
  const char* spec;
  PatchId patches;
  double area;  ///< m², 0: not known in closed form
};

class BuiltIns : public testing::TestWithParam<Expected> {};

TEST_P(BuiltIns, HaveTheirPatchesAndNothingToReport) {
  const auto scene = load_scene(GetParam().spec);
  EXPECT_EQ(scene->patch_count(), GetParam().patches);
  EXPECT_EQ(scene->report().faces, GetParam().patches);
  EXPECT_TRUE(scene->report().warnings.empty()) << testing::PrintToString(scene->report().warnings);
  if (GetParam().area > 0) {
    EXPECT_NEAR(test::total_area(*scene), GetParam().area, 1e-12 * GetParam().area);
  }
}

INSTANTIATE_TEST_SUITE_P(
    Scene, BuiltIns,
    testing::Values(Expected{"sphere-flake", 145 * 136 + 256, 0},
                    Expected{"sphere-flake:levels=2,slices=17,stacks=8", 19'976, 0},
                    Expected{"sphere-flake:levels=0,slices=3,stacks=2", 6 + 256, 0},
                    Expected{"sphere-flake:levels=1,slices=4,stacks=3", 13 * 12 + 256, 0},
                    // Floors are cut around what stands on them, in as many parts as the cuts make.
                    Expected{"cornell-box", 27, 0}, Expected{"cornell-box:open=1", 26, 0},
                    Expected{"furnace", 12, 6 * 4 + 2 * (0.75 * 0.5 + 0.5 * 1 + 0.75 * 1)},
                    Expected{"boards", 10 + 5 * 6, 0}, Expected{"boards:n=3", 10 + 3 * 6, 0},
                    Expected{"boards:n=24", 10 + 24 * 6, 0}, Expected{"rooms", 254, 0},
                    Expected{"rooms:n=0,rooms=1", 10, 2 * (4 * 5 + (4 + 5) * 2.75)},
                    Expected{"stars", 127, 0}));

/// Every edge has as many faces along it as against it.
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

/// What looks up on the floor, and what looks up on top of the blocks, makes one whole floor.
TEST(BuiltInScenes, LeaveTheFloorOutUnderWhatStandsOnIt) {
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

TEST(CornellBox, HasItsLightInTheCeilingLookingDown) {
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

TEST(Furnace, GlowsEverywhere) {
  const auto scene = load_scene("furnace");
  for (PatchId i = 0; i < scene->patch_count(); ++i) {
    EXPECT_EQ(scene->exitance(i), (Rgb{1, 1, 1}));
    EXPECT_EQ(scene->reflectance(i), (Rgb{0.5, 0.5, 0.5}));
  }
}

TEST(Boards, LieEachOverTheNext) {
  const auto scene = load_scene("boards:n=5");
  // Faces 10 + 6k …: board k; its points of one end are above those of the next one's other end.
  const auto center_height = [&](int board, bool far_end) {
    double sum = 0;
    // Walls of a block come in the order near, right, far, left.
    const Patch& end = scene->patch(10 + 6 * board + (far_end ? 2 : 0));
    sum = end.center.z;
    return sum;
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

std::string said(const std::string& spec) {
  return test::refusal([&] { describe_scene(spec); });
}

TEST(BuiltInScenes, NearlyRightNamesAreAskedBack) {
  EXPECT_EQ(said("sphere-flak"),
            "sphere-flak: no such file, and no such built-in scene; did you mean \"sphere-flake\"? "
            "Built-in are sphere-flake, cornell-box, furnace, boards, rooms, stars.");
  EXPECT_THAT(said("cornel-box"), HasSubstr("did you mean \"cornell-box\"?"));
  EXPECT_THAT(said("room"), HasSubstr("did you mean \"rooms\"?"));
  EXPECT_THAT(said("cornell_box:open=1"), HasSubstr("did you mean \"cornell-box\"?"));
  EXPECT_EQ(said("teapot"),
            "teapot: no such file, and no such built-in scene. "
            "Built-in are sphere-flake, cornell-box, furnace, boards, rooms, stars.");
  EXPECT_THAT(said(""), HasSubstr("no such built-in scene"));
  EXPECT_THAT(said(std::string(100'000, 'x')), HasSubstr("no such"));
}

TEST(BuiltInScenes, WrongParametersAreSaidSo) {
  EXPECT_EQ(
      said("sphere-flake:level=3"),
      "sphere-flake: no parameter `level`; did you mean \"levels\"?; there are "
      "levels (0 … 5, default 2), slices (3 … 4096, default 17), stacks (2 … 4096, default 8)");
  EXPECT_EQ(said("furnace:n=3"), "furnace: no parameter `n`; it takes none");
  EXPECT_EQ(said("sphere-flake:levels=6"),
            "sphere-flake: parameter `levels` is `6`, but must be a whole number from 0 to 5");
  for (const char* value : {"", "x", "2.5", "-1", "99999999999999999999", "2 "}) {
    EXPECT_THAT(said(std::string("sphere-flake:levels=") + value),
                HasSubstr("must be a whole number from 0 to 5"));
  }
  EXPECT_THAT(said("rooms:n"), HasSubstr("parameter `n` has no value; write n=24"));
  EXPECT_EQ(said("rooms:n=3,n=3"), "rooms: parameter `n` is given twice");
  EXPECT_THAT(said("rooms:n=3,"), HasSubstr("no parameter ``"));
  EXPECT_THAT(said("sphere-flake:levels=5,slices=4096,stacks=4096"),
              HasSubstr("faces are more than"));
}

}  // namespace
}  // namespace transillum
