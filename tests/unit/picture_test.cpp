// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Light at points of surfaces, and pictures: closed forms, agreement of methods, no leaks, the same
// bits for any number of threads. Against a path tracer: reference/pictures.
#include "transillum/picture.h"

#include <gmock/gmock.h>

#include <cmath>
#include <numbers>
#include <random>

#include "pictures/light_by_picker.h"
#include "pictures/sequences.h"
#include "support/canceled.h"
#include "support/glossy_scenes.h"
#include "support/refusal.h"
#include "support/scenes.h"
#include "support/stopping.h"
#include "transillum/at.h"
#include "transillum/point_sensors.h"
#include "transillum/solve_session.h"

namespace transillum::testing::picture_test {
namespace {

using test::refusal;
using ::testing::HasSubstr;

std::shared_ptr<const Solution> solved(std::shared_ptr<const Scene> scene, int directions = 256,
                                       Basis basis = Basis::constant) {
  SolveOptions options;
  options.directions = directions;
  options.basis = basis;
  return std::make_shared<const Solution>(solve(std::move(scene), options));
}

std::shared_ptr<const Scene> cornell_box(double patch_area) {
  return load_scene("cornell-box", {.max_patch_area = patch_area});
}

/// Points of patches, away from their borders.
struct SurfacePoint {
  PatchId patch;
  Vec3 position;
};
std::vector<SurfacePoint> points_of(const Scene& scene, int count) {
  std::mt19937 random(7);
  std::uniform_int_distribution<PatchId> any(0, scene.patch_count() - 1);
  std::uniform_real_distribution<double> weight(0.05, 1);
  std::vector<SurfacePoint> points;
  for (int n = 0; n < count; ++n) {
    const PatchId i = any(random);
    const auto& pieces = scene.pieces();
    const Piece& piece =
        *std::find_if(pieces.begin(), pieces.end(), [&](const Piece& p) { return p.patch == i; });
    Vec3 sum;
    double weights = 0;
    for (const PointId p : scene.corners(piece)) {
      const double w = weight(random);
      sum = sum + w * scene.point(p);
      weights += w;
    }
    points.push_back({i, sum / weights});
  }
  return points;
}

/// Irradiance by the exitance of patches, from exact form factors of sensors.
std::vector<Rgb> direct_by_sensors(const Scene& scene, const std::vector<SurfacePoint>& points) {
  std::vector<PointSensor> sensors;
  for (const SurfacePoint& point : points) {
    sensors.push_back({point.position, scene.patch(point.patch).normal});
  }
  std::vector<Rgb> exitance;
  for (PatchId i = 0; i < scene.patch_count(); ++i) {
    exitance.push_back(scene.exitance(i));
  }
  return sensor_irradiance(sensor_form_factors(scene, sensors), exitance);
}

TEST(Picture, DirectLightIsThatOfExactFormFactors) {
  for (const auto& scene :
       {cornell_box(0.02), load_scene("rooms", {.max_patch_area = 2}), load_scene("gallery"),
        box_in_cube().scene(), box_in_cube(4, 2, random_rotation(5)).scene()}) {
    const SurfaceLight light(solved(scene, 8));
    const std::vector<SurfacePoint> points = points_of(*scene, 200);
    const std::vector<Rgb> expected = direct_by_sensors(*scene, points);
    double largest = 0;
    for (const Rgb& value : expected) {
      largest = std::max(largest, max_abs(value));
    }
    for (std::size_t n = 0; n < points.size(); ++n) {
      EXPECT_LE(max_abs(light.direct_irradiance(points[n].patch, points[n].position) - expected[n]),
                1e-9 * largest)
          << scene->name() << ", patch " << points[n].patch;
    }
    EXPECT_GT(largest, 0);
  }
}

TEST(Picture, IsTheSameWithThePickerOfAnother) {
  const auto scene = load_scene("gallery");
  const auto solution = solved(scene);
  const SurfaceLight light(solution);
  const SurfaceLight sharing =
      LightByPicker::light(solution, std::make_shared<const Picker>(scene), {});
  const Vec3 eye = scene->patch(0).center + 0.1 * scene->patch(0).normal;
  for (const SurfacePoint& point : points_of(*scene, 50)) {
    EXPECT_EQ(light.radiance(eye, point.position - eye),
              sharing.radiance(eye, point.position - eye));
    EXPECT_EQ(light.radiosity(point.patch, point.position),
              sharing.radiosity(point.patch, point.position));
  }
}

TEST(Picture, InAFurnaceEveryPointSendsTwo) {
  const auto scene = load_scene("furnace");
  for (const int gather : {0, 64}) {
    const SurfaceLight light(solved(scene), gather);
    for (const SurfacePoint& point : points_of(*scene, 100)) {
      EXPECT_NEAR(light.radiosity(point.patch, point.position).r, 2, 1e-3);
    }
    EXPECT_NEAR(light
                    .radiance(scene->patch(0).center + 0.01 * scene->patch(0).normal,
                              scene->patch(0).normal)
                    .g,
                2 / std::numbers::pi, 1e-3);
  }
}

TEST(Picture, InterpolatedLightIsTheGathered) {
  const auto scene = cornell_box(0.006);
  for (const Basis basis : {Basis::constant, Basis::linear}) {
    const auto solution = solved(scene, 512, basis);
    const SurfaceLight interpolated(solution), gathered(solution, 8192);
    double squares = 0, all = 0;
    for (const SurfacePoint& point : points_of(*scene, 300)) {
      const Rgb exact =
                    gathered.radiosity(point.patch, point.position) - scene->exitance(point.patch),
                found = interpolated.radiosity(point.patch, point.position) -
                        scene->exitance(point.patch);
      squares += std::pow(max_abs(found - exact), 2);
      all += std::pow(max_abs(exact), 2);
    }
    EXPECT_LT(std::sqrt(squares / all), 0.006);
  }
}

/// A room of 1 m with a thin shelf before a wall, and a lamp that lights the ceiling. The wall's
/// cells are 1/16 m wide; the shelf is at the middle of a row of them.
std::shared_ptr<const Scene> room_with_shelf() {
  Sketch sketch("room with shelf");
  const int gray = sketch.material(0.7, 0), black = sketch.material(0.05, 0);
  sketch.box({0, 0, 0}, {1, 1, 1}, true, gray);
  sketch.box({0.01, 0.004, 0.53025}, {0.99, 0.6, 0.53225}, false, black);
  sketch.face({{0.2, 0.5, 0.8}, {0.8, 0.5, 0.8}, {0.8, 0.8, 0.8}, {0.2, 0.8, 0.8}},
              sketch.material(0, 10));
  return sketch.scene();
}

TEST(Picture, AnEdgeOfAShadowInTheMiddleOfACellIsFound) {
  const auto scene = room_with_shelf();
  const auto solution = solved(scene, 512);
  const SurfaceLight interpolated(solution), gathered(solution, 2048);
  PatchId wall = 0;
  while (scene->patch(wall).normal.y < 0.5 || scene->patch(wall).center.y > 0.001) {
    ++wall;
  }
  double least = HUGE_VAL, largest = 0;
  constexpr double edge = 0.53125, gap = 0.004;
  for (int k = 251; k < 280; ++k) {
    const double z = 0.002 * k;
    if (std::abs(z - edge) < gap) {
      continue;  // the edge is as soft as the gap is wide
    }
    const Vec3 x{0.47, 0, z};
    const double expected = gathered.radiosity(wall, x).r;
    EXPECT_NEAR(interpolated.radiosity(wall, x).r, expected, 0.02 * expected) << z;
    least = std::min(least, expected);
    largest = std::max(largest, expected);
  }
  EXPECT_GT(largest, 1.1 * least);
}

/// Two rooms of 1 m with one floor and one ceiling, and a wall between them; a lamp in one.
std::shared_ptr<const Scene> divided_room() {
  Sketch sketch("divided room");
  const int gray = sketch.material(0.7, 0), lamp = sketch.material(0, 10);
  const auto all_gray = [&](double, double) { return gray; };
  // The floor under the wall is a row of patches of its own.
  sketch.grid({0, 0, 0}, {2, 0, 0}, {0, 1, 0}, 20, all_gray);
  sketch.grid({0, 1, 1}, {2, 0, 0}, {0, -1, 0}, 20, all_gray);
  sketch.grid({0, 0, 0}, {0, 0, 1}, {2, 0, 0}, 20, all_gray);
  sketch.grid({0, 1, 0}, {2, 0, 0}, {0, 0, 1}, 20, all_gray);
  sketch.grid({0, 0, 0}, {0, 1, 0}, {0, 0, 1}, 10, all_gray);
  sketch.grid({2, 0, 0}, {0, 0, 1}, {0, 1, 0}, 10, all_gray);
  sketch.box({1, 0, 0}, {1.1, 1, 1}, false, gray);
  sketch.face({{0.3, 0.3, 0.999}, {0.3, 0.6, 0.999}, {0.6, 0.6, 0.999}, {0.6, 0.3, 0.999}}, lamp);
  return sketch.scene();
}

TEST(Picture, NoLightLeaksUnderAWall) {
  const auto scene = divided_room();
  const SurfaceLight light(solved(scene, 64));
  for (PatchId i = 0; i < scene->patch_count(); ++i) {
    const Patch& patch = scene->patch(i);
    if (patch.normal.z < 0.5 || patch.center.z > 0.5) {
      continue;  // not of the floor
    }
    const double left = patch.center.x - 0.04, y = patch.center.y;
    for (int k = 0; k < 12; ++k) {
      const double x = left + 0.007 * k;
      if (x > 1.101) {
        EXPECT_EQ(light.radiosity(i, {x, y, 0}).r, 0) << x << ' ' << y;
      } else if (x < 0.999) {
        EXPECT_GT(light.radiosity(i, {x, y, 0}).r, 0.03) << x << ' ' << y;
      }
    }
  }
}

TEST(Picture, UnderAUniformSkyAFlatGroundReflectsAll) {
  Sketch sketch("ground");
  sketch.face({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, sketch.material(0.4, 0));
  SolveOptions options;
  options.directions = 64;
  options.sky.exitance = {3, 2, 1};
  const SurfaceLight light(std::make_shared<const Solution>(solve(sketch.scene(), options)));
  const Rgb ground = light.radiosity(0, {0.3, 0.6, 0});
  EXPECT_NEAR(ground.r, 1.2, 1e-12);
  EXPECT_NEAR(ground.b, 0.4, 1e-12);
  EXPECT_NEAR(light.radiance({0, 0, 1}, {0.1, 0.2, 1}).g, 2 / std::numbers::pi, 1e-12);
  EXPECT_NEAR(light.irradiance({0.3, 0.6, 1}, {0, 0, -1}).r, 3, 1e-12);
  EXPECT_EQ(light.irradiance({0, 0, 1}, {0.1, 0.2, 1}), Rgb());
}

/// A box on a ground of divisions² patches, under a uniform sky.
std::shared_ptr<const Scene> box_on_ground(int divisions) {
  Sketch sketch("box on ground");
  const int gray = sketch.material(0.6, 0);
  sketch.grid({0, 0, 0}, {3, 0, 0}, {0, 3, 0}, divisions, [&](double, double) { return gray; });
  sketch.box({1, 1, 0}, {2, 2, 1}, false, gray);
  return sketch.scene();
}

TEST(Picture, TheFootOfABoxHasTheLightOfTheGroundBesideIt) {
  SolveOptions options;
  options.directions = 1024;
  options.sky.exitance = {1, 1, 1};
  const auto light_on = [&](int divisions) {
    return SurfaceLight(std::make_shared<const Solution>(solve(box_on_ground(divisions), options)));
  };
  // The box covers whole patches of 60, parts of some of 10: of those at its corners a ninth.
  const SurfaceLight cut = light_on(60), uncut = light_on(10);
  const auto side = [](int divisions) {
    const auto scene = box_on_ground(divisions);
    for (PatchId i = 0; i < scene->patch_count(); ++i) {
      if (scene->patch(i).normal.x < -0.5) {
        return i;
      }
    }
    return no_patch;
  };
  for (const double height : {0.01, 0.03, 0.1, 0.3}) {
    for (const double y : {1.1, 1.5, 1.83}) {
      const Vec3 x{1, y, height};
      const double expected = cut.radiosity(side(60), x).r;
      EXPECT_NEAR(uncut.radiosity(side(10), x).r, expected, 0.03 * expected) << y << ' ' << height;
    }
  }
}

/// Radiance along a ray, mean over the samples of a pixel.
double seen(const SurfaceLight& light, const Vec3& from, const Vec3& along, std::uint64_t pixel,
            std::uint32_t samples) {
  double sum = 0;
  for (std::uint32_t k = 0; k < samples; ++k) {
    sum += light.radiance(from, along, joined({pixel, k})).r / samples;
  }
  return sum;
}

TEST(Picture, InAGlossyFurnaceEveryPointSendsTwo) {
  for (const Lobe& lobe : {phong(0.3, 3), phong(0.3, 300), ggx(0.3, 0.8), ggx(0.3, 0.2)}) {
    Sketch sketch("glossy furnace");
    sketch.box({0, 0, 0}, {1, 1, 1}, true, sketch.material(0.2, 1));
    SceneDescription description = sketch.description();
    description.materials[0].lobe = lobe;
    SolveOptions options;
    options.directions = 128;
    options.glossy = true;
    const SurfaceLight light(std::make_shared<const Solution>(
        solve(std::make_shared<const Scene>(description), options)));
    for (const Vec3& along : {Vec3{0.1, 0.2, -1}, Vec3{1, 0.3, -0.2}, Vec3{0.4, 1, 0.3}}) {
      EXPECT_NEAR(std::numbers::pi * seen(light, {0.5, 0.45, 0.4}, along, 7, 16), 2, 0.02);
    }
  }
}

TEST(Picture, LampsInLobesHaveNoGrain) {
  SceneDescription description = box_in_cube(4, 2).description();
  for (Material& material : description.materials) {
    material.lobe = max_abs(material.exitance) > 0 ? Lobe() : ggx(0.4, 0.5);
  }
  SolveOptions options;
  options.directions = 256;
  options.glossy = true;
  const SurfaceLight light(
      std::make_shared<const Solution>(solve(std::make_shared<const Scene>(description), options)));
  const Vec3 from{0.1, 0.1, 0.9}, along{0.3, 0.7, -0.85};
  const double expected = seen(light, from, along, 1, 1024);
  double squares = 0;
  constexpr int pixels = 64;
  for (std::uint64_t pixel = 2; pixel < 2 + pixels; ++pixel) {
    squares += std::pow(seen(light, from, along, pixel, 16) / expected - 1, 2) / pixels;
  }
  EXPECT_LT(std::sqrt(squares), 0.005);
}

TEST(Picture, LampsPastTheMostPowerfulAreGathered) {
  Sketch sketch("many lamps");
  const int black = sketch.material(0, 0);
  std::vector<int> lamps;
  for (int k = 0; k < 30; ++k) {
    lamps.push_back(sketch.material(0, 1 + k));
  }
  sketch.face({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, black);
  sketch.grid({0, 1, 1}, {1, 0, 0}, {0, -1, 0}, 30, [&](double s, double t) {
    return lamps[static_cast<std::size_t>(7 * std::floor(30 * s) + std::floor(30 * t)) % 30];
  });
  const auto scene = sketch.scene();
  const auto solution = solved(scene, 16);
  const SurfaceLight light(solution, 16384);
  EXPECT_EQ(light.gathered_lamps(), 900 - 512);
  const std::vector<SurfacePoint> points{{0, {0.31, 0.4, 0}}, {0, {0.9, 0.1, 0}}};
  const std::vector<Rgb> expected = direct_by_sensors(*scene, points);
  for (std::size_t n = 0; n < points.size(); ++n) {
    const Vec3& x = points[n].position;
    const Rgb all = light.irradiance(x + Vec3{0, 0, 0.5}, {0, 0, -1});
    EXPECT_NEAR(all.r, expected[n].r, 0.005 * expected[n].r);
    EXPECT_LT(light.direct_irradiance(0, x).r, 0.95 * expected[n].r);
  }
}

/// Two boxes that touch on a floor; the other sides of the room emit like a sky, as divisions²
/// faces each.
std::shared_ptr<const Scene> boxes_under_sides(int divisions) {
  Sketch sketch("boxes under sides");
  const int gray = sketch.material(0.6, 0), warm = sketch.material(0, 1.2),
            cool = sketch.material(0, 0.5);
  const auto side = [&](const Vec3& corner, const Vec3& u, const Vec3& v) {
    sketch.grid(corner, u, v, divisions, [&](double s, double) { return s < 0.5 ? warm : cool; });
  };
  sketch.grid({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, 10, [&](double, double) { return gray; });
  sketch.box({0.3, 0.4, 0}, {0.6, 0.6, 0.4}, false, gray);
  sketch.box({0.2, 0.4, 0}, {0.3, 0.6, 0.2}, false, gray);
  side({0, 1, 1}, {1, 0, 0}, {0, -1, 0});
  side({0, 0, 0}, {0, 1, 0}, {0, 0, 1});
  side({1, 0, 0}, {0, 0, 1}, {0, 1, 0});
  side({0, 0, 0}, {0, 0, 1}, {1, 0, 0});
  side({0, 1, 0}, {1, 0, 0}, {0, 0, 1});
  return sketch.scene();
}

TEST(Picture, ManyFacesThatAreNotBrightAreGatheredWithoutNoise) {
  const auto few = boxes_under_sides(2), many = boxes_under_sides(8);
  const SurfaceLight exact(solved(few, 512)), gathered(solved(many, 512));
  EXPECT_EQ(exact.gathered_lamps(), 0);
  EXPECT_EQ(gathered.gathered_lamps(), 5 * 8 * 8);
  double squares = 0, all = 0;
  for (const auto& [patch, x] : points_of(*few, 500)) {
    if (max_abs(few->reflectance(patch)) > 0) {  // the same patch in both
      EXPECT_EQ(gathered.direct_irradiance(patch, x), Rgb());
      const Rgb expected = exact.radiosity(patch, x);
      squares += std::pow(max_abs(gathered.radiosity(patch, x) - expected), 2);
      all += std::pow(max_abs(expected), 2);
    }
  }
  EXPECT_LT(std::sqrt(squares / all), 0.004);
}

TEST(Picture, HasTheSameBitsForAnyNumberOfThreads) {
  const auto solution = solved(cornell_box(0.02), 64);
  const Camera camera{{0.278, 0.273, 0.05}, {0.278, 0.2, 0.5}, Vec3{0, 1, 0}};
  for (const int gather : {0, 16}) {
    PictureOptions options;
    options.width = 40;
    options.height = 30;
    options.samples = 2;
    options.gather = gather;
    options.threads = 1;
    const Picture one = make_picture(solution, camera, options);
    options.threads = 3;
    EXPECT_EQ(make_picture(solution, camera, options).radiance, one.radiance);
    // A point's value does not depend on what was asked for before.
    const SurfaceLight light(solution, gather);
    const CameraRays rays(*solution->scene, camera, options.width, options.height);
    EXPECT_EQ(pixel_radiance(light, rays, 33, 21, 2), one.radiance[21 * 40 + 33]);
  }
}

TEST(Picture, SamplesOfAPixelAreSpreadEvenlyAboutItsMiddle) {
  const int count = 64;
  std::vector<int> cells(16, 0);
  for (int k = 0; k < count; ++k) {
    const auto [x, y] = sample_place(k, count);
    ++cells[static_cast<std::size_t>(4 * std::floor(4 * y) + std::floor(4 * x))];
  }
  EXPECT_THAT(cells, ::testing::Each(4));
  for (const int samples : {1, 2, 4, 16, 64}) {
    double x = 0, y = 0;
    for (int k = 0; k < samples; ++k) {
      x += sample_place(k, samples).first / samples;
      y += sample_place(k, samples).second / samples;
    }
    EXPECT_NEAR(x, 0.5, 1e-12) << samples;
    EXPECT_NEAR(y, 0.5, 1e-12) << samples;
  }
}

TEST(CameraRays, OfEachProjectionPointWhereTheyShould) {
  const auto scene = cornell_box(0);
  Camera camera{{0.1, 0.2, 0.3}, {0.1, 1.2, 0.3}};
  camera.field_of_view = 90;
  const CameraRays view(*scene, camera, 200, 100);
  const auto near = [](const Vec3& found, const Vec3& expected) {
    EXPECT_LT(norm(normalized(found) - normalized(expected)), 1e-12);
  };
  near(view.at(100, 50).direction, {0, 1, 0});
  near(view.at(100, 0).direction, {0, 1, 1});   // 45 degrees up
  near(view.at(200, 50).direction, {2, 1, 0});  // square pixels
  camera.projection = CameraProjection::panorama;
  const CameraRays panorama(*scene, camera, 200, 100);
  near(panorama.at(100, 50).direction, {0, 1, 0});
  near(panorama.at(150, 50).direction, {1, 0, 0});
  near(panorama.at(0, 50).direction, {0, -1, 0});
  near(panorama.at(77, 0).direction, {0, 0, 1});
  camera.projection = CameraProjection::orthographic;
  camera.height = 2;
  const CameraRays parallel(*scene, camera, 200, 100);
  near(parallel.at(0, 0).direction, {0, 1, 0});
  EXPECT_LT(norm(parallel.at(0, 0).origin - Vec3{-1.9, 0.2, 1.3}), 1e-12);
}

TEST(Picture, RefusesWhatHasNoPicture) {
  const auto solution = solved(cornell_box(0), 8);
  const auto refused = [&](const Camera& camera, const PictureOptions& options = {}) {
    return refusal([&] { make_picture(solution, camera, options); });
  };
  const Vec3 eye{0.278, 0.273, 0.1}, target{0.278, 0.2, 0.5};
  EXPECT_THAT(refused({eye, eye}), HasSubstr("0.278 0.273 0.1, is the point in its middle"));
  // In the short block.
  EXPECT_THAT(refused({{0.185, 0.08, 0.169}, target}), HasSubstr("is inside a wall or a solid"));
  EXPECT_THAT(refused({eye, target, Vec3{0, 0, 0}}), HasSubstr("up not 0"));
  Camera wide{eye, target};
  wide.field_of_view = 180;
  EXPECT_THAT(refused(wide), HasSubstr("180 degrees"));
  PictureOptions options;
  options.width = 0;
  EXPECT_THAT(refused({eye, target}, options), HasSubstr("width in pixels is 0"));
  options.width = 100000;
  EXPECT_THAT(refused({eye, target}, options), HasSubstr("1 to 32767"));
}

TEST(Picture, IsCanceledAtOnce) {
  const auto solution = solved(cornell_box(0.006), 64);
  PictureOptions options;
  options.width = 4000;
  options.height = 4000;
  const Cancellation cancellation;
  double done = 0;
  EXPECT_THROW(
      make_picture(solution, {{0.278, 0.273, 0.05}, {0.278, 0.2, 0.5}}, options, cancellation,
                   [&](double fraction) {
                     done = fraction;
                     cancellation.cancel();
                   }),
      Canceled);
  EXPECT_LT(done, 0.01);
}

/// A room of 1 m of 4,356 patches on each side, with 484 bright lamps in its ceiling.
std::shared_ptr<const Scene> room_of_small_lamps() {
  Sketch sketch("room of small lamps");
  const int gray = sketch.material(0.5, 0), lamp = sketch.material(0, 1);
  constexpr int cells = 66;
  const auto all_gray = [&](double, double) { return gray; };
  sketch.grid({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, cells, all_gray);
  sketch.grid({0, 0, 0}, {0, 1, 0}, {0, 0, 1}, cells, all_gray);
  sketch.grid({1, 0, 0}, {0, 0, 1}, {0, 1, 0}, cells, all_gray);
  sketch.grid({0, 0, 0}, {0, 0, 1}, {1, 0, 0}, cells, all_gray);
  sketch.grid({0, 1, 0}, {1, 0, 0}, {0, 0, 1}, cells, all_gray);
  sketch.grid({0, 1, 1}, {1, 0, 0}, {0, -1, 0}, cells, [&](double s, double t) {
    const auto middle = [](double x) { return static_cast<int>(x * cells) % 3 == 1; };
    return middle(s) && middle(t) ? lamp : gray;
  });
  return sketch.scene();
}

/// The light of one point takes minutes: of all patches that it sees, the light of all lamps.
TEST(Picture, AQueryIsCanceledAtOnceAndEndsNoOther) {
  const auto solution = solved(room_of_small_lamps(), 4);
  const Cancellation of_light;
  const SurfaceLight light(solution, 0, of_light);
  of_light.cancel();
  EXPECT_EQ(light.gathered_lamps(), 0);
  const Vec3 x{0.31, 0.42, 0}, above = x + Vec3{0, 0, 0.5}, down{0, 0, -1};
  constexpr double in_one_patch = 0.002, in_many = 0.2;
  for (const double delay : {in_one_patch, in_many}) {
    for (const auto& query : std::vector<std::function<void(const Cancellation&)>>{
             [&](const Cancellation& own) { (void)light.radiosity(0, x, own); },
             [&](const Cancellation& own) { (void)light.radiance(above, down, 1, own); },
             [&](const Cancellation& own) { (void)light.irradiance(above, down, 1, own); },
             [&](const Cancellation& own) {
               (void)LightMap(*solution->scene, light, {.threads = 1}, own);
             }}) {
      EXPECT_LT(seconds_to_stop(query, delay).value_or(HUGE_VAL), longest_stop) << delay;
    }
  }
  EXPECT_EQ(light.direct_irradiance(0, x), SurfaceLight(solution).direct_irradiance(0, x));
  // Also where the views of the lamps are known by then.
  EXPECT_THROW((void)light.direct_irradiance(0, x, canceled()), Canceled);
}

TEST(Picture, CanceledQueriesDoNotChangeTheLight) {
  const auto solution = solved(cornell_box(0.02), 64);
  const SurfaceLight light(solution), never_canceled(solution);
  const std::vector<SurfacePoint> points = points_of(*solution->scene, 20);
  for (const SurfacePoint& point : points) {
    const auto query = [&](const Cancellation& own) {
      (void)light.radiosity(point.patch, point.position, own);
    };
    (void)seconds_to_stop(query, 0.001);
    EXPECT_EQ(light.radiosity(point.patch, point.position),
              never_canceled.radiosity(point.patch, point.position));
  }
}

}  // namespace
}  // namespace transillum::testing::picture_test
