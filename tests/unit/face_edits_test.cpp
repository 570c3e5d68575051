// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
// Edits of faces: areas under turns, volumes under scale, corners that faces share, numbers, and
// the way through a file.
#include "scene/edit/face_edits.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "support/temporary_folder.h"
#include "transillum/engine.h"
#include "transillum/files.h"

#include "transillum/solve_session.h"

namespace transillum::face_edits_test {
namespace {

using ::testing::ElementsAre;
using ::testing::SizeIs;

constexpr Vec3 somewhere{0.3, -0.2, 0.7};

double area_of(const Scene& scene, const SceneDescription& d, const FaceList& faces) {
  double area = 0;
  for (const Patch& patch : scene.patches()) {
    for (const std::int32_t face : faces) {
      area += patch.face == d.number_of(static_cast<std::size_t>(face)) ? patch.area : 0;
    }
  }
  return area;
}

/// The volume that closed faces enclose, by the divergence theorem.
double volume_of(const SceneDescription& d, const FaceList& faces) {
  double volume = 0;
  for (const std::int32_t face : faces) {
    const auto outline = d.outline(static_cast<std::size_t>(face));
    for (std::size_t k = 1; k + 1 < outline.size(); ++k) {
      volume += dot(at(d.points, outline[0]),
                    cross(at(d.points, outline[k]), at(d.points, outline[k + 1]))) /
                6;
    }
  }
  return volume;
}

/// The first face of a box: an object of six faces.
std::int32_t face_of_a_box(const SceneDescription& d) {
  for (std::int32_t f = 0; f < static_cast<std::int32_t>(d.face_count()); ++f) {
    const FaceList object = faces_of_object(d, f);
    if (object.size() >= 5 && object.size() <= 6) {
      return f;
    }
  }
  return -1;
}

SceneDescription with_box(FaceList& box) {
  SceneDescription d = describe_scene("furnace");
  box = add_solid(d, AddedSolid::box, {1, 1, 1}, {0.5, 0.75, 0.25}, 2);
  return d;
}

/// A cube of six faces with eight corners.
SceneDescription cube() {
  SceneDescription d;
  add_solid(d, AddedSolid::room, {1, 1, 1}, {2, 2, 2}, 2);
  return d;
}

TEST(FacePlacement, quarter_turns_are_exact) {
  EXPECT_EQ(turned({1, 2, 3}, {0, 0, 90}), (Vec3{-2, 1, 3}));
  EXPECT_EQ(turned({1, 2, 3}, {180, 0, 0}), (Vec3{1, -2, -3}));
  EXPECT_EQ(turned({1, 2, 3}, {0, -90, 0}), (Vec3{-3, 2, 1}));
}

TEST(FacePlacement, turns_are_composed_about_the_axes_of_the_scene) {
  const Vec3 v{0.2, -1.5, 0.8};
  for (const Vec3& turn : {Vec3{20, 30, 40}, Vec3{-100, 80, 170}, Vec3{10, 90, 5}}) {
    for (int axis = 0; axis < 3; ++axis) {
      Vec3 by;
      coordinate(by, axis) = 25;
      const Vec3 expected = turned(turned(v, turn), by);
      EXPECT_LT(norm(turned(v, turned_further(turn, axis, 25)) - expected), 1e-12);
    }
  }
}

TEST(FaceEdits, translations_and_turns_keep_areas) {
  FaceList box;
  const SceneDescription before = with_box(box);
  const double area = area_of(Scene(before), before, box);
  for (const FacePlacement& placement : {FacePlacement{somewhere}, FacePlacement{{}, {0, 0, 90}},
                                         FacePlacement{somewhere, {20, -35, 110}}}) {
    SceneDescription d = before;
    place_faces(d, box, {1, 1, 1}, placement);
    EXPECT_NEAR(area_of(Scene(d), d, box), area, 1e-12);
    EXPECT_NEAR(volume_of(d, box), volume_of(before, box), 1e-12);
  }
}

TEST(FaceEdits, volume_grows_with_the_factors) {
  FaceList box;
  const SceneDescription before = with_box(box);
  EXPECT_NEAR(volume_of(before, box), 0.5 * 0.75 * 0.25, 1e-15);
  SceneDescription d = before;
  place_faces(d, box, {1, 1, 1}, {{}, {10, 20, 30}, {2, 3, 0.5}});
  EXPECT_NEAR(volume_of(d, box), 3 * volume_of(before, box), 1e-12);
}

TEST(FaceEdits, a_shared_corner_stays_with_the_faces_that_stay) {
  SceneDescription d = cube();
  const SceneDescription before = d;
  place_faces(d, FaceList{0}, {}, {{0, 0, -0.5}});
  EXPECT_THAT(d.points, SizeIs(12));
  for (std::size_t f = 1; f < 6; ++f) {
    for (std::size_t k = 0; k < d.outline(f).size(); ++k) {
      EXPECT_EQ(at(d.points, d.outline(f)[k]), at(before.points, before.outline(f)[k]));
    }
  }
  for (std::size_t k = 0; k < 4; ++k) {
    EXPECT_EQ(at(d.points, d.outline(0)[k]),
              (at(before.points, before.outline(0)[k]) + Vec3{0, 0, -0.5}));
  }
}

TEST(FaceEdits, no_placement_changes_nothing) {
  FaceList box;
  const SceneDescription before = with_box(box);
  SceneDescription d = before;
  place_faces(d, box, somewhere, {});
  EXPECT_EQ(d.points, before.points);
  EXPECT_EQ(d.corners, before.corners);
}

TEST(FaceEdits, factors_must_be_positive) {
  FaceList box;
  SceneDescription d = with_box(box);
  EXPECT_THROW(place_faces(d, box, {}, {{}, {}, {1, 0, 1}}), InputError);
  EXPECT_THROW(place_faces(d, box, {}, {{}, {}, {1, 1, -1}}), InputError);
}

TEST(FaceEdits, an_object_is_a_connected_component) {
  const SceneDescription d = describe_scene("cornell-box");
  const std::int32_t face = face_of_a_box(d);
  ASSERT_GE(face, 0);
  const FaceList object = faces_of_object(d, face);
  for (const std::int32_t f : object) {
    EXPECT_EQ(faces_of_object(d, f), object);
  }
}

TEST(FaceEdits, a_lamp_is_found_from_anywhere) {
  const SceneDescription d = describe_scene("cornell-box");
  const FaceList lamp = faces_of_lamp(d, 0);
  ASSERT_FALSE(lamp.empty());
  for (const std::int32_t f : lamp) {
    EXPECT_GT(max_abs(at(d.materials, d.face_material[static_cast<std::size_t>(f)]).exitance), 0);
  }
  EXPECT_EQ(faces_of_lamp(d, lamp.front()), lamp);
}

TEST(FaceEdits, faces_keep_their_numbers_and_new_ones_follow) {
  SceneDescription d = cube();
  remove_faces(d, FaceList{1, 4});
  EXPECT_THAT(d.face_number, ElementsAre(0, 2, 3, 5));
  const FaceList copies = copy_faces(d, FaceList{1, 2}, somewhere);
  EXPECT_THAT(copies, ElementsAre(4, 5));
  EXPECT_THAT(d.face_number, ElementsAre(0, 2, 3, 5, 6, 7));
  EXPECT_EQ(d.face_material[4], d.face_material[1]);
  EXPECT_EQ(at(d.points, d.outline(4)[0]), at(d.points, d.outline(1)[0]) + somewhere);
  EXPECT_EQ(Scene(d).patch(5).face, 7);  // patches follow in the order of faces
}

TEST(FaceEdits, added_solids_face_the_right_way) {
  for (int up = 0; up < 3; ++up) {
    SceneDescription d = describe_scene("furnace");
    const Vec3 size{1, 2, 3};
    EXPECT_NEAR(volume_of(d, add_solid(d, AddedSolid::box, somewhere, size, up)), 6, 1e-12);
    EXPECT_NEAR(volume_of(d, add_solid(d, AddedSolid::room, somewhere, size, up)), -6, 1e-12);
    const FaceList lamp = add_solid(d, AddedSolid::lamp, somewhere, size, up);
    const FaceList board = add_solid(d, AddedSolid::board, {}, size, up);
    const Scene scene(d);
    EXPECT_EQ(scene.patches().back().face, board.front());
    const Patch& lamp_patch = scene.patch(scene.patch_count() - 3);
    EXPECT_EQ(lamp_patch.face, lamp.front());
    EXPECT_NEAR(dot(lamp_patch.normal, unit_of_axis(up)), -1, 1e-12);
    EXPECT_NEAR(lamp_patch.area, 6 / coordinate(size, up), 1e-12);
  }
}

// A scene that was edited in memory and the file saved from it are one scene.
TEST(FaceEdits, an_edited_scene_and_its_file_have_the_same_light) {
  const test::TemporaryFolder folder;
  SceneDescription d = describe_scene("cornell-box");
  const FaceList object = faces_of_object(d, face_of_a_box(d));
  const Bounds bounds = bounds_of(d, object);
  place_faces(d, object, 0.5 * (bounds.low + bounds.high),
              {{0.1, 0, 0.03}, {0, 17, 0}, {1, 1.2, 1}});
  copy_faces(d, object, {0.05, 0.4, 0.1});
  add_solid(d, AddedSolid::board, {0.3, 0.2, 0.3}, {0.2, 0.2, 0.2}, 1);
  remove_faces(d, FaceList{object.back()});
  const auto path = folder.path() / "edited.obj";
  write_obj(path, d);
  const SolveOptions options{.directions = 16};
  const Solution memory = solve(std::make_shared<const Scene>(d), options);
  const Solution file = solve(load_scene(path.string()), options);
  EXPECT_EQ(memory.radiosity, file.radiosity);
}

// Crossing, touching and coinciding faces: closure as ever, for all positions of a drag.
TEST(FaceEdits, a_box_is_dragged_through_a_wall_and_onto_another_face) {
  SceneDescription start = describe_scene("furnace");  // inward faces of [0, 2]^3
  const FaceList box = add_solid(start, AddedSolid::box, {1, 1, 0.25}, {0.5, 0.5, 0.5}, 2);
  add_solid(start, AddedSolid::box, {1.5, 1, 0.25}, {0.5, 0.5, 0.5}, 2);
  add_solid(start, AddedSolid::room, {1, 1, 1}, {6, 6, 6}, 2);
  for (int k = -4; k <= 8; ++k) {  // 0 touches the other box; 2 coincides; 4 crosses the wall
    SceneDescription d = start;
    place_faces(d, box, {}, {{0.25 * k, 0, 0}});
    const auto scene = std::make_shared<const Scene>(d);
    const auto tree = std::make_shared<const BspTree>(*scene);
    const TransferEngine engine = make_engine(Engine::local, scene, tree);
    for (const Vec3& omega :
         {Vec3{1, 0, 0}, Vec3{0, 0, 1}, normalized(Vec3{0.3, 0.5, 0.8}), Vec3{0.6, -0.8, 0}}) {
      const ClosureDefect defect = closure_defect(engine(omega, {}), *scene);
      EXPECT_LE(defect.relative, 1e-10) << k;
    }
    const Solution light = solve(scene, {.directions = 16});
    EXPECT_TRUE(std::all_of(light.radiosity.begin(), light.radiosity.end(), [](const Rgb& b) {
      return std::isfinite(max_abs(b)) && b.r >= 0;
    })) << k;
  }
}

}  // namespace
}  // namespace transillum::face_edits_test
