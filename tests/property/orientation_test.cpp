// transillum: diffuse light by the transillumination method. GPL-3.0-or-later. Scenes whose faces
// are oriented correctly are restored after some faces have been turned.
#include "transillum/orientation.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <functional>
#include <random>

#include "support/scenes.h"
#include "transillum/at.h"
#include "transillum/solve_options.h"
#include "transillum/solve_session.h"

namespace transillum::orientation_test {
namespace {

using testing::Sketch;

constexpr const char* scenes[] = {
    "furnace", "cornell-box", "cornell-box:open=1", "sphere-flake:levels=1,slices=9,stacks=5",
    "boards",  "rooms",       "rooms:n=0,rooms=2",  "stars"};

void turn(SceneDescription& description, std::size_t face) {
  const auto first =
      description.corners.begin() + static_cast<std::ptrdiff_t>(description.face_begin[face]);
  std::reverse(first, first + std::ssize(description.outline(face)));
}

/// The faces that differ from `original`.
std::vector<std::size_t> different(const SceneDescription& original,
                                   const SceneDescription& other) {
  std::vector<std::size_t> faces;
  for (std::size_t f = 0; f < original.face_count(); ++f) {
    if (!std::ranges::equal(original.outline(f), other.outline(f)) || other.is_two_sided(f)) {
      faces.push_back(f);
    }
  }
  return faces;
}

void expect_restored(const SceneDescription& original,
                     const std::function<bool(std::size_t)>& turns) {
  SceneDescription description = original;
  std::int64_t turned = 0;
  for (std::size_t f = 0; f < original.face_count(); ++f) {
    if (turns(f)) {
      turn(description, f);
      ++turned;
    }
  }
  const OrientationReport report = orient(description);
  EXPECT_THAT(different(original, description), ::testing::IsEmpty());
  EXPECT_EQ(report.faces_turned, turned);
  EXPECT_EQ(report.faces_two_sided, 0);
}

TEST(Orientation, KeepsCorrectScenes) {
  for (const char* spec : scenes) {
    SCOPED_TRACE(spec);
    const SceneDescription original = describe_scene(spec);
    expect_restored(original, [](std::size_t) { return false; });
    EXPECT_FALSE(plan_orientation(original).changes());
  }
}

TEST(Orientation, RestoresSingleFaces) {
  for (const char* spec : scenes) {
    const SceneDescription original = describe_scene(spec);
    const std::size_t step = std::max<std::size_t>(1, original.face_count() / 8);
    for (std::size_t f = 0; f < original.face_count(); f += step) {
      SCOPED_TRACE(std::string(spec) + ", face " + std::to_string(f));
      expect_restored(original, [f](std::size_t g) { return g == f; });
    }
  }
}

TEST(Orientation, RestoresScenesTurnedInsideOut) {
  for (const char* spec : scenes) {
    SCOPED_TRACE(spec);
    expect_restored(describe_scene(spec), [](std::size_t) { return true; });
  }
}

TEST(Orientation, RestoresRandomFaces) {
  for (const char* spec : scenes) {
    for (const double fraction : {0.1, 0.5, 0.9}) {
      SCOPED_TRACE(std::string(spec) + ", " + std::to_string(fraction));
      std::mt19937 random(7);
      expect_restored(describe_scene(spec), [&](std::size_t) {
        return static_cast<double>(random()) < fraction * 0x1p32;
      });
    }
  }
}

/// Faces that share no points in memory are connected by equal coordinates.
TEST(Orientation, RestoresFacesWithPointsOfTheirOwn) {
  for (const char* spec : scenes) {
    SCOPED_TRACE(spec);
    const SceneDescription shared = describe_scene(spec);
    SceneDescription own;
    own.name = "own points";
    own.materials = shared.materials;
    for (std::size_t f = 0; f < shared.face_count(); ++f) {
      std::vector<PointId> outline;
      for (const PointId p : shared.outline(f)) {
        outline.push_back(static_cast<PointId>(own.points.size()));
        own.points.push_back(at(shared.points, p));
      }
      own.add_face(outline, shared.face_material[f]);
    }
    std::mt19937 random(3);
    expect_restored(own, [&](std::size_t) { return random() % 2 == 0; });
  }
}

TEST(Orientation, SolvesLikeTheOriginal) {
  for (const char* spec : {"cornell-box", "furnace", "rooms"}) {
    SCOPED_TRACE(spec);
    const SceneDescription original = describe_scene(spec);
    SceneDescription turned = original;
    for (std::size_t f = 0; f < turned.face_count(); f += 3) {
      turn(turned, f);
    }
    orient(turned);
    const SolveOptions options{.directions = 32, .iterations = 6};
    const auto expected = solve(std::make_shared<const Scene>(original), options).radiosity;
    const auto found = solve(std::make_shared<const Scene>(turned), options).radiosity;
    EXPECT_EQ(found, expected);
  }
}

TEST(Orientation, IsTheSameForAnyNumberOfThreadsAndRigidMotion) {
  SceneDescription description = describe_scene("rooms:n=40,rooms=3");
  std::mt19937 random(5);
  for (std::size_t f = 0; f < description.face_count(); ++f) {
    if (random() % 3 == 0) {
      turn(description, f);
    }
  }
  const auto rotate = testing::random_rotation(2);
  const OrientationPlan one = plan_orientation(description, 1);
  for (const int threads : {2, 5}) {
    const OrientationPlan many = plan_orientation(description, threads);
    EXPECT_EQ(many.turned, one.turned);
    EXPECT_EQ(many.two_sided, one.two_sided);
    EXPECT_EQ(many.report.sentences, one.report.sentences);
  }
  for (const double scale : {1e-5, 1.0, 1e6}) {
    const SceneDescription moved = testing::moved(description, [&](const Vec3& p) {
      return scale * (rotate(p) + Vec3{3, -20, 7});
    });
    EXPECT_EQ(plan_orientation(moved).turned, one.turned);
  }
}

}  // namespace
}  // namespace transillum::orientation_test
