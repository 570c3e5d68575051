// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Form factors and irradiance at points: closed rooms, closed forms, agreement with patches.
#include "transillum/point_sensors.h"

#include <gmock/gmock.h>

#include <cmath>
#include <random>

#include "geometry/form_factor.h"
#include "io/results/sensor_files.h"
#include "support/form_factor_rows.h"
#include "support/program_call.h"
#include "support/refusal.h"
#include "support/scenes.h"
#include "transillum/at.h"
#include "transillum/pair_form_factors.h"
#include "transillum/solution.h"
#include "transillum/solve_options.h"

namespace transillum::testing::point_sensors_test {
namespace {

using test::refusal;
using ::testing::HasSubstr;
using ::testing::StartsWith;

Vec3 random_unit(std::mt19937& random) {
  std::normal_distribution<double> normal;
  return normalized({normal(random), normal(random), normal(random)});
}

/// A room around a block.
Sketch room() {
  Sketch sketch("room");
  const int gray = sketch.material(0.5, 1);
  sketch.box({0, 0, 0}, {1, 1, 1}, true, gray);
  sketch.box({0.3, 0.3, 0.2}, {0.6, 0.7, 0.5}, false, gray);
  return sketch;
}

bool is_in_block(const Vec3& p) {
  return p.x > 0.29 && p.x < 0.61 && p.y > 0.29 && p.y < 0.71 && p.z > 0.19 && p.z < 0.51;
}

TEST(PointSensors, InClosedRoomsRowsSumToOne) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> inside(0.01, 0.99);
  std::vector<PointSensor> sensors;
  while (sensors.size() < 60) {
    const Vec3 p{inside(random), inside(random), inside(random)};
    if (!is_in_block(p)) {
      sensors.push_back({p, random_unit(random)});
    }
  }
  sensors.push_back({{0.4, 0.5, 0}, {0, 0, 1}});    // on the floor
  sensors.push_back({{0.4, 0.5, 0.5}, {0, 0, 1}});  // on the block
  sensors.push_back({{0, 0.5, 0.5}, {1, 0, 0}});    // on a wall
  for (const bool turns : {false, true}) {
    const std::function<Vec3(const Vec3&)> turn =
        turns ? random_rotation(3) : [](const Vec3& p) { return p; };
    const Scene scene(moved(room().description(), turn));
    std::vector<PointSensor> turned;
    for (const PointSensor& s : sensors) {
      // Rounding puts a turned point behind its surface, where the point sees something else.
      turned.push_back({turn(s.position + 1e-9 * s.normal), normalized(turn(s.normal))});
    }
    const FormFactors f = sensor_form_factors(scene, turned);
    for (PatchId i = 0; i < std::ssize(turned); ++i) {
      EXPECT_NEAR(row_sum(f, i), 1, 1e-7) << i;
    }
  }
  const FormFactors on_surfaces =
      sensor_form_factors(*room().scene(), std::span(sensors).subspan(60));
  for (PatchId i = 0; i < 3; ++i) {
    EXPECT_NEAR(row_sum(on_surfaces, i), 1, 1e-12) << i;
  }
}

TEST(PointSensors, WithNothingBetweenTheClosedFormHolds) {
  Sketch sketch("square");
  const int gray = sketch.material(0.5, 1);
  sketch.face({{0, 0, 1}, {0, 1, 1}, {1, 1, 1}, {1, 0, 1}}, gray);
  const PointSensor corner{{0, 0, 0}, {0, 0, 1}};
  const FormFactors f = sensor_form_factors(*sketch.scene(), std::vector{corner});
  // A rectangle a by b at distance 1 above a corner: with A = a / sqrt(1 + a²) …,
  // F = (A atan(b / sqrt(1 + a²)) + …) / (2 pi); here a = b = 1.
  const double expected = 2 * std::sqrt(0.5) * std::atan(std::sqrt(0.5)) / (2 * M_PI);
  ASSERT_EQ(f.size(), 1U);
  EXPECT_NEAR(f.value[0], expected, 1e-14);
}

/// The mean over a patch is the form factor of the patch; points of a grid give it up to their
/// error.
TEST(PointSensors, TheirMeanIsTheFormFactorOfThePatch) {
  const auto scene = room().scene();
  std::vector<PointSensor> sensors;
  constexpr int n = 40;
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      sensors.push_back({{(i + 0.5) / n, (j + 0.5) / n, 0}, {0, 0, 1}});
    }
  }
  const FormFactors f = sensor_form_factors(*scene, sensors);
  std::vector<double> mean(scene->patches().size());
  for (std::size_t k = 0; k < f.size(); ++k) {
    at(mean, f.source[k]) += f.value[k] / (n * n);
  }
  PatchId floor = no_patch;
  for (PatchId i = 0; i < scene->patch_count(); ++i) {
    if (scene->patch(i).center.z == 0) {
      floor = i;
    }
  }
  ASSERT_NE(floor, no_patch);
  const std::vector<double> exact = exact_form_factors(*scene, floor);
  for (std::size_t j = 0; j < exact.size(); ++j) {
    EXPECT_NEAR(mean[j], exact[j], 2e-3) << j;
  }
}

TEST(PointSensors, InAFurnaceTheIrradianceIsTwo) {
  const auto scene = load_scene("furnace");
  // Near a corner of the outer cube: the inner one is in the middle.
  const Bounds& box = scene->bounds();
  const Vec3 place = box.low + 0.05 * (box.high - box.low);
  const std::vector<PointSensor> sensors{{place, {0, 0, 1}}, {place, {0.6, 0, -0.8}}};
  const FormFactors f = sensor_form_factors(*scene, sensors);
  const std::vector<Rgb> b(scene->patches().size(), {2, 2, 2});
  for (const Rgb& h : sensor_irradiance(f, b)) {
    EXPECT_NEAR(h.g, 2, 1e-12);
  }
}

TEST(PointSensors, AreTheSameForAnyNumberOfThreads) {
  const auto scene = load_scene("rooms");
  std::vector<PointSensor> sensors;
  for (int k = 0; k < 9; ++k) {
    sensors.push_back({scene->bounds().center() + Vec3{0.1 * k, 0, 0}, {0, 0, 1}});
  }
  const FormFactors one = sensor_form_factors(*scene, sensors, {.threads = 1});
  const FormFactors four = sensor_form_factors(*scene, sensors, {.threads = 4});
  EXPECT_GT(one.size(), 0U);
  EXPECT_TRUE(one.value == four.value);
  EXPECT_TRUE(one.source == four.source);
}

TEST(PointSensors, BadFilesAreRefused) {
  const TemporaryFolder folder;
  const std::string path = folder / "p.csv";
  const auto read = [&](const std::string& text) {
    write_text(path, text);
    return read_sensors(path);
  };
  const auto refused = [&](const std::string& text) {
    std::string sentence = refusal([&] { read(text); });
    EXPECT_THAT(sentence, StartsWith(path));
    return sentence;
  };
  const auto sensors = read("x,y,z,nx,ny,nz\n# comment\n\n1, 2, 3, 0, 0, 4\r\n1 2 3 1e50 0 0\n");
  ASSERT_EQ(sensors.size(), 2U);
  EXPECT_EQ(sensors[0].normal, (Vec3{0, 0, 1}));
  EXPECT_THAT(refused("1,2,3,0,0,0\n"), HasSubstr(":1: the normal is 0"));
  EXPECT_THAT(refused("1,2,3,0,0,1\n1,2,3\n"), HasSubstr(":2: a line must have the six numbers"));
  EXPECT_THAT(refused("1,2,3,0,0,nan\n"), HasSubstr("`nan` is not a number"));
  EXPECT_THAT(refused("x,y,z\n"), HasSubstr("no points"));
  EXPECT_THAT(refusal([] {
                sensor_form_factors(*load_scene("furnace"),
                                    std::vector<PointSensor>{{{0, 0, 0}, {0, 0, 2}}});
              }),
              HasSubstr("sensor 0"));
}

TEST(CliSensors, WritesFormFactorsAndIrradiance) {
  const TemporaryFolder folder;
  const auto run = [&](const Arguments& arguments) {
    return expect_success(arguments, folder.path());
  };
  write_text(folder / "p.csv", "0.5,0.5,0.5,0,0,1\n0.4,0.5,0.5,1,0,0\n");
  run({"solve", "furnace", "-m", "16", "--normalize", "rows", "--tolerance", "1e-12", "-q", "--out",
       "r.vtp"});
  const ProgramResult factors = run({"factors", "furnace", "--points", "p.csv"});
  EXPECT_THAT(factors.out, StartsWith("point,j,F\n0,"));
  run({"factors", "furnace", "--points", "p.csv", "--result", "r.vtp", "--irradiance", "h.csv",
       "--out", "f.csv"});
  EXPECT_EQ(read_file(folder / "f.csv"), factors.out);
  EXPECT_THAT(read_file(folder / "h.csv"), StartsWith("point,x,y,z,nx,ny,nz,H_r,H_g,H_b,F_sum\n"));
  EXPECT_EQ(line_count(read_file(folder / "h.csv")), 3U);
  const Refusal refusals[] = {
      {{"boards", "--points", "p.csv", "--result", "r.vtp", "--irradiance", "-"},
       "r.vtp: the result is not of boards: one has"},
      {{"furnace", "--points", "p.csv", "--result", "r.vtp"}, "used together"},
      {{"furnace", "--irradiance", "-"}, "used only with --points FILE"},
      {{"furnace", "--points", "p.csv", "-m", "8"}, "not used with --points FILE"},
      {{"furnace", "--points", "p.csv", "--out", "p.csv"}, "would overwrite the input file"},
  };
  for (const auto& [arguments, expected] : refusals) {
    expect_refused(Arguments{"factors"} + arguments, expected, folder.path());
  }
}

}  // namespace
}  // namespace transillum::testing::point_sensors_test
