// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
// Changes of materials by name: which faces each target means, new materials for a part of a
// material's faces, the order of changes, and errors.
#include "transillum/material_changes.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "scene_test_support.h"

namespace transillum::material_changes_test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

/// Five faces: 0 and 1 of wall, 2 of lamp, 3 and 4 of floor; 1, 2 and 3 are in the group east.
SceneDescription five_faces() {
  SceneDescription d;
  d.name = "s.obj";
  d.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  d.materials = {{"wall", {.5, .5, .5}, {}},
                 {"lamp", {0, 0, 0}, {1, 1, 1}},
                 {"floor", {.2, .2, .2}, {}},
                 {"unused", {.1, .1, .1}, {}}};
  d.groups = {"east"};
  const std::vector<PointId> outline{0, 1, 2};
  d.add_face(outline, 0);
  d.add_face(outline, 0, 0, 0);
  d.add_face(outline, 1, 0, 0);
  d.add_face(outline, 2, 0, 0);
  d.add_face(outline, 2);
  return d;
}

SceneDescription changed(const std::vector<MaterialChange>& changes,
                         SceneDescription d = five_faces()) {
  change_materials(d, changes);
  return d;
}

/// The red exitance of every face.
std::vector<double> exitances(const SceneDescription& d) {
  std::vector<double> all;
  for (const std::int32_t m : d.face_material) {
    all.push_back(at(d.materials, m).exitance.r);
  }
  return all;
}

std::vector<double> reflectances(const SceneDescription& d) {
  std::vector<double> all;
  for (const std::int32_t m : d.face_material) {
    all.push_back(at(d.materials, m).reflectance.r);
  }
  return all;
}

TEST(MaterialChanges, OfAMaterialAGroupAndAFace) {
  EXPECT_THAT(exitances(changed({exitance_change("wall=7")})), ElementsAre(7, 7, 1, 0, 0));
  EXPECT_THAT(exitances(changed({exitance_change("east=7")})), ElementsAre(0, 7, 7, 7, 0));
  EXPECT_THAT(exitances(changed({exitance_change("face:4=7")})), ElementsAre(0, 0, 1, 0, 7));
  EXPECT_THAT(reflectances(changed({reflectance_change("east=.3")})),
              ElementsAre(.5, .3, .3, .3, .2));
}

TEST(MaterialChanges, KeepWhatTheyDoNotName) {
  const SceneDescription d = changed({reflectance_change("east=.3,.4,.5")});
  EXPECT_THAT(exitances(d), ElementsAre(0, 0, 1, 0, 0));
  EXPECT_EQ(at(d.materials, d.face_material[1]).reflectance, (Rgb{.3, .4, .5}));
  EXPECT_EQ(d.corners, five_faces().corners);
  EXPECT_EQ(d.face_group, five_faces().face_group);
  EXPECT_THAT(d.notes, IsEmpty());
}

TEST(MaterialChanges, MakeNewMaterialsOnlyForAPartOfAMaterialsFaces) {
  EXPECT_EQ(changed({exitance_change("wall=7")}).materials.size(), 4u);
  EXPECT_EQ(changed({exitance_change("face:2=7")}).materials.size(), 4u) << "its only face";
  EXPECT_EQ(changed({reflectance_change("face:0=.5")}).materials.size(), 4u) << "no change";
  const SceneDescription d = changed({exitance_change("east=7")});
  ASSERT_EQ(d.materials.size(), 6u);
  EXPECT_EQ(d.materials[4].name, "wall-east");
  EXPECT_EQ(d.materials[5].name, "floor-east");
  EXPECT_EQ(changed({exitance_change("face:0=7")}).materials[4].name, "wall-face-0");
}

TEST(MaterialChanges, NamesOfNewMaterialsAreUnique) {
  SceneDescription d = five_faces();
  d.materials[3].name = "wall-east";
  EXPECT_EQ(changed({exitance_change("east=7")}, d).materials[4].name, "wall-east-2");
}

TEST(MaterialChanges, OfTwoTheLaterHolds) {
  EXPECT_THAT(exitances(changed({exitance_change("wall=7"), exitance_change("east=3")})),
              ElementsAre(7, 3, 3, 3, 0));
  EXPECT_THAT(exitances(changed({exitance_change("east=3"), exitance_change("wall=7")})),
              ElementsAre(7, 7, 3, 3, 0));
}

// A face that has its own material since the first change is still one of the wall's faces.
TEST(MaterialChanges, TargetsReferToTheDescriptionBeforeTheFirstChange) {
  const SceneDescription d = changed({exitance_change("face:0=7"), reflectance_change("wall=.9")});
  EXPECT_THAT(exitances(d), ElementsAre(7, 0, 1, 0, 0));
  EXPECT_THAT(reflectances(d), ElementsAre(.9, .9, 0, .2, .2));
}

TEST(MaterialChanges, ANameOfBothIsTheMaterialWithANote) {
  SceneDescription d = five_faces();
  d.groups = {"wall"};
  const SceneDescription material = changed({exitance_change("wall=7")}, d);
  EXPECT_THAT(exitances(material), ElementsAre(7, 7, 1, 0, 0));
  EXPECT_THAT(material.notes, ElementsAre(HasSubstr("`wall` is a material and a group")));
  const SceneDescription group = changed({exitance_change("group:wall=7")}, d);
  EXPECT_THAT(exitances(group), ElementsAre(0, 7, 7, 7, 0));
  EXPECT_THAT(group.notes, IsEmpty());
  EXPECT_THAT(exitances(changed({exitance_change("material:wall=7")}, d)),
              ElementsAre(7, 7, 1, 0, 0));
}

TEST(MaterialChanges, AMaterialMayBeNamedLikeAFace) {
  SceneDescription d = five_faces();
  d.materials[0].name = "face:4";
  EXPECT_THAT(exitances(changed({exitance_change("face:4=7")}, d)), ElementsAre(7, 7, 1, 0, 0));
}

TEST(MaterialChanges, IgnoreCaseWhereNoNameIsSpelledSo) {
  EXPECT_THAT(exitances(changed({exitance_change("WALL=7")})), ElementsAre(7, 7, 1, 0, 0));
  EXPECT_THAT(exitances(changed({exitance_change("East=7")})), ElementsAre(0, 7, 7, 7, 0));
  SceneDescription d = five_faces();
  d.materials[2].name = "Wall";
  EXPECT_THAT(exitances(changed({exitance_change("Wall=7")}, d)), ElementsAre(0, 0, 1, 7, 7));
}

TEST(MaterialChanges, SeveralMaterialsOfOneNameAreChangedTogether) {
  SceneDescription d = five_faces();
  d.materials[2].name = "wall";
  EXPECT_THAT(exitances(changed({exitance_change("wall=7")}, d)), ElementsAre(7, 7, 1, 7, 7));
}

TEST(MaterialChanges, OfAnUnusedMaterialAreNoted) {
  const SceneDescription d = changed({exitance_change("unused=7")});
  EXPECT_EQ(d.materials[3].exitance, (Rgb{7, 7, 7}));
  EXPECT_THAT(d.notes, ElementsAre(HasSubstr("`unused` is changed, but no face uses it")));
}

TEST(MaterialChanges, UnknownTargetsAreRefusedAndNothingIsChanged) {
  const std::vector<std::pair<std::string, std::string>> rows{
      {"lampe=1", "`lampe`; did you mean \"lamp\"?"},
      {"xyzzy=1", "`xyzzy`; there are `wall`, `lamp`, `floor`, `unused`, `east`"},
      {"group:wall=1", "`group:wall`"},
      {"face:5=1", "there is no face 5; faces are numbered 0 to 4"},
      {"face:99999999999999999999=1", "there is no face 99999999999999999999"},
      {"face:-1=1", "face `-1` is not a number"},
      {"face:=1", "face `` is not a number"},
  };
  for (const auto& [text, expected] : rows) {
    SceneDescription d = five_faces();
    EXPECT_THAT(test::refusal([&, t = text] {
                  change_materials(d, std::vector{exitance_change("wall=7"), exitance_change(t)});
                }),
                HasSubstr(expected));
    EXPECT_THAT(exitances(d), ElementsAre(0, 0, 1, 0, 0)) << text;
  }
}

TEST(MaterialChanges, ValuesOutOfRangeAreRefused) {
  EXPECT_THAT(test::refusal([] { changed({reflectance_change("wall=.5,1,.5")}); }),
              HasSubstr("change of `wall`: green reflectance rho (Kd) is 1, but must be"));
  EXPECT_THAT(test::refusal([] { changed({exitance_change("wall=-1")}); }),
              HasSubstr("red exitance E (Ke) is -1"));
  EXPECT_THAT(test::refusal([] { changed({exitance_change("wall=nan")}); }), HasSubstr("is nan"));
}

TEST(MaterialChanges, TextsOfAnotherFormAreRefused) {
  EXPECT_EQ(exitance_change("a=b=1,2,3"), (MaterialChange{"a=b", {}, Rgb{1, 2, 3}}));
  EXPECT_EQ(reflectance_change("my wall=.5"), (MaterialChange{"my wall", Rgb{.5, .5, .5}, {}}));
  for (const std::string text : {"", "wall", "=1", "wall=", "wall=1,2", "wall=1,2,3,4", "wall=1,,2",
                                 "wall=1,2,", "wall=x", "wall=1 2 3"}) {
    EXPECT_THAT(test::refusal([&] { exitance_change(text); }),
                HasSubstr("is not NAME=VALUE or NAME=RED,GREEN,BLUE"))
        << text;
  }
}

TEST(SuggestedLight, IsANameOfTheScene) {
  SceneDescription d = five_faces();
  EXPECT_EQ(suggested_light(d), "lamp");
  d.materials[1].name = "x";
  EXPECT_EQ(suggested_light(d), "x") << "the fewest faces";
  d.groups = {"Ceiling LIGHTS"};
  EXPECT_EQ(suggested_light(d), "Ceiling LIGHTS");
  d.groups = {"east"};
  for (Material& m : d.materials) {
    m.name.clear();
  }
  EXPECT_EQ(suggested_light(d), "face:0");
}

}  // namespace
}  // namespace transillum::material_changes_test
