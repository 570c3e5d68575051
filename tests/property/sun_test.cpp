// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// The sun (decisions/0087-sun.md): shadows in closed form, sums over solids, its light in all kinds
// of solves, and the balance of energy.
#include "transillum/sun.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "radiosity/form_factors/light_paths.h"
#include "support/glossy_scenes.h"
#include "support/refusal.h"
#include "support/scenes.h"
#include "transillum/adjoint.h"
#include "transillum/at.h"
#include "transillum/form_factor_solve.h"
#include "transillum/glossy.h"
#include "transillum/picture.h"
#include "transillum/relight.h"
#include "transillum/shading.h"
#include "transillum/solution.h"
#include "transillum/solve_options.h"
#include "transillum/solve_session.h"

namespace transillum::sun_test {
namespace {

using test::refusal;
using ::testing::HasSubstr;
using testing::Sketch;

constexpr double degree = std::numbers::pi / 180;
constexpr Vec3 up{0, 0, 1}, north{0, 1, 0};

Vec3 toward(double azimuth, double elevation) {
  return direction_of({azimuth, elevation}, up, north);
}

Sky sunny(const Vec3& direction, double irradiance = 1000) {
  return {.exitance = {}, .sun = {{irradiance, irradiance, irradiance}, normalized(direction)}};
}

/// The sunlit fraction of each patch.
std::vector<double> sunlit(const std::shared_ptr<const Scene>& scene, const Vec3& direction,
                           int threads = 0) {
  const auto tree = std::make_shared<const BspTree>(*scene);
  std::vector<double> result;
  sunlit_fractions(
      scene, tree, std::span(&direction, 1),
      [&](std::size_t, const std::vector<double>& fractions) { result = fractions; }, threads);
  return result;
}

/// Area of all sunlit parts, projected along the direction.
double sunlit_projection(const Scene& scene, const std::vector<double>& fractions,
                         const Vec3& direction) {
  double sum = 0;
  for (PatchId i = 0; i < scene.patch_count(); ++i) {
    sum += at(fractions, i) * scene.patch(i).area *
           std::max(0.0, dot(scene.patch(i).normal, direction));
  }
  return sum;
}

/// The parallelogram at `corner`, which faces along cross(u, v).
void add_rectangle(Sketch& sketch, const Vec3& corner, const Vec3& u, const Vec3& v, int material) {
  sketch.face({corner, corner + u, corner + u + v, corner + v}, material);
}

TEST(Sun, DirectionsFollowTheCompass) {
  const auto expect_near = [](const Vec3& a, const Vec3& b) { EXPECT_LT(norm(a - b), 1e-15); };
  expect_near(toward(0, 0), {0, 1, 0});
  expect_near(toward(90, 0), {1, 0, 0});
  expect_near(toward(180, 0), {0, -1, 0});
  expect_near(toward(270, 30), {-std::cos(30 * degree), 0, 0.5});
  // Only the level part of the north counts, and y may be up.
  expect_near(direction_of({90, 0}, up, {0, 2, 5}), {1, 0, 0});
  expect_near(direction_of({90, 0}, {0, 1, 0}, default_north({0, 1, 0})), {1, 0, 0});
  EXPECT_THAT(refusal([] {
                direction_of({0, 0}, up, {0, 0, 3});
              }),
              HasSubstr("along the vertical"));
}

/// The shadow of a box on a plane is the sum of its base and of a segment: with a base of a by b,
/// its area is a b + |s_x| b + |s_y| a.
TEST(Sun, TheShadowOfABoxOnAPlaneHasTheAreaOfItsPolygon) {
  Sketch sketch("box on a plane");
  const int gray = sketch.material(0.5, 0);
  add_rectangle(sketch, {-20, -20, 0}, {40, 0, 0}, {0, 40, 0}, gray);
  sketch.box({0, 0, 0}, {2, 1, 3}, false, gray);
  const auto scene = sketch.scene();
  for (const double azimuth : {0.0, 33.0, 90.0, 145.0, 260.0}) {
    for (const double elevation : {15.0, 40.0, 75.0}) {
      const Vec3 direction = toward(azimuth, elevation);
      const double x = 3 * direction.x / direction.z, y = 3 * direction.y / direction.z;
      const double shadow = 2 + std::abs(x) * 1 + std::abs(y) * 2;
      EXPECT_NEAR(sunlit(scene, direction).front(), 1 - shadow / 1600, 1e-12)
          << azimuth << ' ' << elevation;
    }
  }
}

/// A wall of 3 m that faces south. The shadow of a wide overhang of depth D reaches down
/// D tan(elevation) / cos(g), g being the azimuth from the wall's normal; the shadow of a high fin
/// of depth D is D |tan(g)| wide.
TEST(Sun, OverhangAndFinShadeAWallAsTextbooksSay) {
  Sketch overhang("overhang"), fin("fin");
  constexpr double depth = 0.8;
  for (Sketch* sketch : {&overhang, &fin}) {
    const int gray = sketch->material(0.5, 0);
    add_rectangle(*sketch, {0, 0, 0}, {4, 0, 0}, {0, 0, 3}, gray);
    if (sketch == &overhang) {
      add_rectangle(*sketch, {-90, -depth, 3}, {180, 0, 0}, {0, depth, 0}, gray);
    } else {
      add_rectangle(*sketch, {0, -depth, -90}, {0, depth, 0}, {0, 0, 180}, gray);
      add_rectangle(*sketch, {4, -depth, -90}, {0, depth, 0}, {0, 0, 180}, gray);
    }
  }
  const auto under = overhang.scene({.two_sided = true}), beside = fin.scene({.two_sided = true});
  for (const double g : {-60.0, -20.0, 0.0, 10.0, 45.0}) {
    for (const double elevation : {5.0, 30.0, 55.0}) {
      const Vec3 direction = toward(180 + g, elevation);
      const double down = depth * std::tan(elevation * degree) / std::cos(g * degree);
      const double wide = depth * std::abs(std::tan(g * degree));
      EXPECT_NEAR(sunlit(under, direction).front(), 1 - std::min(1.0, down / 3), 1e-12);
      EXPECT_NEAR(sunlit(beside, direction).front(), 1 - std::min(1.0, wide / 4), 1e-12);
    }
  }
}

/// The shadow of a house of height h on a street reaches h |cos(g)| / tan(elevation) from its
/// foot, g being the azimuth from the street's cross direction.
TEST(Sun, AStreetCanyonIsShadedByItsHouses) {
  constexpr double width = 10, height = 15;
  Sketch sketch("street");
  const int gray = sketch.material(0.5, 0);
  add_rectangle(sketch, {0, 0, 0}, {1, 0, 0}, {0, width, 0}, gray);
  sketch.box({-500, -8, 0}, {500, 0, height}, false, gray);
  sketch.box({-500, width, 0}, {500, width + 8, height}, false, gray);
  const auto scene = sketch.scene();
  for (const double azimuth : {120.0, 150.0, 180.0, 215.0, 350.0}) {
    for (const double elevation : {20.0, 50.0, 65.0, 80.0}) {
      const double shadow =
          height * std::abs(std::cos((azimuth - 180) * degree)) / std::tan(elevation * degree);
      EXPECT_NEAR(sunlit(scene, toward(azimuth, elevation)).front(),
                  1 - std::min(1.0, shadow / width), 1e-12)
          << azimuth << ' ' << elevation;
    }
  }
}

/// The sunlit parts of solids add up, projected, to the area of their silhouette, which is the same
/// from both sides, and for two boxes along the x axis a union of rectangles.
TEST(Sun, SunlitAreaAddsUpToTheSilhouette) {
  Sketch many("many");
  many.tetrahedra(60, 0.4, 7, many.material(0.5, 0));
  const auto solids = many.scene();
  for (const Vec3& direction : testing::test_directions(20, 3)) {
    const double ahead = sunlit_projection(*solids, sunlit(solids, direction), direction);
    const double behind = sunlit_projection(*solids, sunlit(solids, -direction), -direction);
    EXPECT_GT(ahead, 0.1);
    EXPECT_NEAR(ahead, behind, 1e-10);
  }
  Sketch two("two");
  const int gray = two.material(0.5, 0);
  two.box({0, 0, 0}, {2, 2, 1}, false, gray);
  two.box({0.5, 0.5, 1.5}, {1.5, 1.5, 2.5}, false, gray);
  const auto boxes = two.scene();
  const Vec3 direction = toward(90, 30);
  const double run = direction.x / direction.z;
  // On the ground the lower box covers x from -run to 2, the upper from 0.5 - 2.5 run to
  // 1.5 - 1.5 run, which is -1.1.
  const double upper = 1 + run, overlap = std::max(0.0, 1.5 - 1.5 * run + run);
  const double silhouette = (2 * (2 + run) + upper - overlap) * direction.z;
  EXPECT_NEAR(sunlit_projection(*boxes, sunlit(boxes, direction), direction), silhouette, 1e-10);
}

/// A box without its top, around a block.
Sketch open_box(double reflectance) {
  Sketch sketch("open box");
  const int gray = sketch.material(reflectance, 0);
  const auto wall = [&](const Vec3& corner, const Vec3& u, const Vec3& v) {
    sketch.grid(corner, u, v, 2, [=](double, double) { return gray; });
  };
  wall({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
  wall({0, 0, 0}, {0, 0, 1}, {1, 0, 0});
  wall({0, 1, 0}, {1, 0, 0}, {0, 0, 1});
  wall({0, 0, 0}, {0, 1, 0}, {0, 0, 1});
  wall({1, 0, 0}, {0, 0, 1}, {0, 1, 0});
  sketch.box({0.3, 0.3, 0.1}, {0.6, 0.7, 0.5}, false, gray);
  return sketch;
}

void expect_same(const std::vector<Rgb>& a, const std::vector<Rgb>& b, double tolerance) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    ASSERT_LE(max_abs(a[i] - b[i]), tolerance) << i;
  }
}

TEST(Sun, LightsAConvexBodyByTheCosine) {
  Sketch sketch("body");
  sketch.box({0, 0, 0}, {1, 2, 3}, false, sketch.material(0.5, 0));
  const Vec3 direction = toward(200, 35);
  const Solution solution =
      solve(sketch.scene(), {.directions = 8, .tolerance = 1e-13, .sky = sunny(direction)});
  for (PatchId i = 0; i < solution.scene->patch_count(); ++i) {
    const double h = 1000 * std::max(0.0, dot(solution.scene->patch(i).normal, direction));
    EXPECT_NEAR(at(solution.irradiance, i).g, h, 1e-10);
    EXPECT_NEAR(at(solution.radiosity, i).b, 0.5 * h, 1e-10);
  }
}

/// Power from the sun is absorbed or escapes.
TEST(Sun, IsInTheBalanceOfEnergy) {
  const Solution solution = solve(open_box(0.6).scene(), {.directions = 64,
                                                          .normalize = Normalization::symmetric,
                                                          .tolerance = 1e-13,
                                                          .sky = sunny(toward(150, 60))});
  double given = 0, absorbed = 0, escaped = 0;
  for (PatchId i = 0; i < solution.scene->patch_count(); ++i) {
    const double area = solution.scene->patch(i).area;
    given += area * at(solution.sky_irradiance, i).r;
    absorbed += area * 0.4 * at(solution.irradiance, i).r;
    escaped += area * at(solution.sky_fractions, i) * at(solution.radiosity, i).r;
  }
  // The light that falls into the opening, and on the block below it.
  EXPECT_NEAR(given, 1000 * std::sin(60 * degree), 1e-9);
  EXPECT_NEAR(absorbed + escaped, given, 1e-6 * given);
}

TEST(Sun, GivesTheSameLightInEverySchemeAndAddsToASky) {
  const auto scene = open_box(0.6).scene();
  SolveOptions options{.directions = 64, .tolerance = 1e-12, .sky = sunny(toward(150, 60))};
  const Solution fixed = solve(scene, options);
  for (const Scheme scheme : {Scheme::growing, Scheme::conjugate_gradients}) {
    SolveOptions other = options;
    other.scheme = scheme;
    expect_same(solve(scene, other).radiosity, fixed.radiosity, 1e-6);
  }
  options.sky.exitance = {50, 50, 50};
  const Solution both = solve(scene, options);
  options.sky.sun = {};
  const Solution sky = solve(scene, options);
  for (PatchId i = 0; i < scene->patch_count(); ++i) {
    EXPECT_NEAR(at(both.radiosity, i).r, at(fixed.radiosity, i).r + at(sky.radiosity, i).r, 1e-6);
    EXPECT_NEAR(at(both.sky_irradiance, i).r,
                at(fixed.sky_irradiance, i).r + at(sky.sky_irradiance, i).r, 1e-9);
  }
}

TEST(Sun, HasTheSameBitsForAnyNumberOfThreads) {
  const auto scene = open_box(0.6).scene();
  SolveOptions options{.directions = 32, .threads = 1, .sky = sunny(toward(150, 60))};
  options.sky.sun.disc = true;
  const Solution one = solve(scene, options);
  options.threads = 3;
  EXPECT_EQ(solve(scene, options).radiosity, one.radiosity);
}

TEST(Sun, MeansOfLinearFunctionsAreThoseOfConstants) {
  const auto scene = open_box(0).scene();
  SolveOptions options{.directions = 16, .tolerance = 1e-12, .sky = sunny(toward(150, 60))};
  const Solution constant = solve(scene, options);
  options.basis = Basis::linear;
  const Solution linear = solve(scene, options);
  expect_same(linear.irradiance, constant.irradiance, 1e-9);
  EXPECT_EQ(linear.sky_linear_terms.size(), linear.irradiance.size());
}

TEST(Sun, LightsSolvesWithoutDirectionsAndRelighting) {
  const auto scene = open_box(0.6).scene();
  SolveOptions options{.directions = 4096, .tolerance = 1e-12, .sky = sunny(toward(150, 60))};
  const Solution passes = solve(scene, options);
  SolveOptions by_pairs = options;
  by_pairs.engine = Engine::pairs;
  const Solution pairs = solve_by_form_factors(scene, by_pairs);
  expect_same(pairs.sky_irradiance, passes.sky_irradiance, 0);
  for (std::size_t i = 0; i < pairs.radiosity.size(); ++i) {
    EXPECT_NEAR(pairs.radiosity[i].r, passes.radiosity[i].r, 3);
  }
  RadiositySolver solver(scene, options);
  solver.advance(RadiositySolver::Until::finished);
  const RelightResult relit = relight(*scene, solver.form_factors(), scene->materials(),
                                      {.sky_irradiance = passes.sky_irradiance});
  expect_same(relit.radiosity, passes.radiosity, 1e-3);
}

/// The penumbra of an edge is as wide as the disc seen from the edge's distance: a patch that
/// begins at the edge's shadow is lit to less than one that begins beyond it.
TEST(Sun, ADiscMakesAPenumbra) {
  Sketch sketch("edge");
  const int black = sketch.material(0, 0);
  const double half = 10 * std::tan(sun_diameter / 2 * degree);
  add_rectangle(sketch, {0, 0, 0}, {half, 0, 0}, {0, 1, 0}, black);
  add_rectangle(sketch, {half * 1.01, 0, 0}, {half, 0, 0}, {0, 1, 0}, black);
  add_rectangle(sketch, {-half, 0, 0}, {half, 0, 0}, {0, 1, 0}, black);
  add_rectangle(sketch, {-50, -50, 10}, {50, 0, 0}, {0, 101, 0}, black);
  SolveOptions options{.directions = 8, .sky = sunny(up)};
  const auto scene = sketch.scene();
  const auto lit = [&] { return solve(scene, options).irradiance; };
  EXPECT_NEAR(lit()[0].r, 1000, 1e-9);
  options.sky.sun.disc = true;
  const std::vector<Rgb> disc = lit();
  // The integral of the part of a disc beyond a chord, over half its width: 1 - 2 / (3 pi).
  EXPECT_NEAR(disc[0].r, 1000 * (1 - 2 / (3 * std::numbers::pi)), 10);
  EXPECT_NEAR(disc[1].r, 1000, 1e-6);
  EXPECT_NEAR(disc[2].r, 1000 * 2 / (3 * std::numbers::pi), 10);
}

TEST(Sun, PicturesHaveItsSharpShadows) {
  Sketch sketch("board");
  const int gray = sketch.material(0.5, 0);
  add_rectangle(sketch, {-5, -5, 0}, {10, 0, 0}, {0, 10, 0}, gray);
  add_rectangle(sketch, {0, -1, 2}, {1, 0, 0}, {0, 2, 0}, gray);
  const Vec3 direction = toward(90, 45);  // the shadow begins at x = -2 and ends at x = -1
  const SurfaceLight light(std::make_shared<const Solution>(
      solve(sketch.scene(), {.directions = 8, .sky = sunny(direction)})));
  for (const double x : {-2.01, -0.99}) {
    EXPECT_NEAR(light.direct_irradiance(0, {x, 0.3, 0}).g, 1000 * direction.z, 1e-9) << x;
  }
  for (const double x : {-1.99, -1.01}) {
    EXPECT_EQ(light.direct_irradiance(0, {x, 0.3, 0}).g, 0) << x;
  }
}

/// The known answer of a level plate: rho times irradiance times the cosine, of all kinds of
/// solves.
TEST(Sun, APlateHasTheKnownRadiosityInAllKindsOfSolves) {
  Sketch sketch("plate");
  add_rectangle(sketch, {0, 0, 0}, {2, 0, 0}, {0, 1, 0}, sketch.material(0.4, 0));
  const double b = 0.4 * 1000 * std::sin(35 * degree);
  const SolveOptions plain{.directions = 16, .tolerance = 1e-12, .sky = sunny(toward(200, 35))};
  SolveOptions accurate = plain, averaged = plain;
  accurate.goal = {.accuracy = 0.01};
  accurate.replicas = 8;
  averaged.scheme = Scheme::semi_iterative;
  averaged.iterations = 20;
  for (const bool two_sided : {false, true}) {
    const auto scene = sketch.scene({.two_sided = two_sided});
    ASSERT_EQ(scene->patch_count(), two_sided ? 2 : 1);
    for (const SolveOptions& options : {plain, accurate, averaged}) {
      const Solution solution = solve(scene, options);
      EXPECT_NEAR(solution.radiosity[0].r, b, 1e-9);
      if (two_sided) {
        EXPECT_EQ(solution.radiosity[1].r, 0);  // the lower side
      }
      EXPECT_EQ(solution.accuracy.has_value(), options.goal.is_set());
      EXPECT_TRUE(!solution.accuracy || solution.accuracy->reached);
    }
  }
}

/// Two unit squares with a common edge exchange F = 0.2000437761 (ALGORITHM.md, oracle 6), so that
/// B_1 = rho (H_1 + F B_2), B_2 = rho (H_2 + F B_1) with the irradiances H of the sun.
TEST(Sun, AnEdgeHasTheKnownRadiosity) {
  Sketch sketch("edge");
  const int gray = sketch.material(0.8, 0);
  add_rectangle(sketch, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, gray);
  add_rectangle(sketch, {0, 0, 0}, {0, 1, 0}, {0, 0, 1}, gray);  // faces along x
  const Vec3 direction = toward(60, 50);
  const double h1 = 1000 * direction.z, h2 = 1000 * direction.x, f = 0.2000437761, rho = 0.8;
  const double b1 = rho * (h1 + rho * f * h2) / (1 - rho * rho * f * f);
  const double b2 = rho * (h2 + f * b1);
  const auto scene = sketch.scene();
  SolveOptions options{.directions = 8192, .tolerance = 1e-12, .sky = sunny(direction)};
  const auto expect = [&](const Solution& solution, double error) {
    EXPECT_NEAR(solution.radiosity[0].r, b1, error * b1);
    EXPECT_NEAR(solution.radiosity[1].r, b2, error * b2);
  };
  expect(solve(scene, options), 1e-4);
  SolveOptions averaged = options;
  averaged.scheme = Scheme::semi_iterative;
  averaged.directions = 1024;
  averaged.iterations = 60;
  averaged.burn_in = 20;
  expect(solve(scene, averaged), 1e-3);
  SolveOptions accurate = options;
  accurate.directions = 64;
  accurate.replicas = 8;
  accurate.goal = {.accuracy = 0.002};
  const Solution reached = solve(scene, accurate);
  ASSERT_TRUE(reached.accuracy && reached.accuracy->reached);
  expect(reached, 0.004);  // the goal is about both surfaces together
  // The adjoint and the light paths begin at the sun alone.
  RadiositySolver solver(scene, options);
  solver.advance(RadiositySolver::Until::finished);
  const std::vector<Rgb> sun = solver.sky_irradiance();
  const Adjoint adjoint =
      solve_adjoint(*scene, solver.form_factors(), 0, scene->materials(), {.tolerance = 1e-13});
  EXPECT_NEAR(rho * (adjoint.per_watt[0].r * sun[0].r + adjoint.per_watt[1].r * sun[1].r), b1,
              1e-4 * b1);
  const LightPaths paths =
      find_light_paths(*scene, solver.form_factors(), 0, scene->materials(),
                       {.count = 4, .sky_irradiance = sun, .sun_irradiance = sun});
  ASSERT_EQ(paths.paths.size(), 4);
  for (std::size_t k = 0; k < 4; ++k) {
    const LightPath& path = paths.paths[k];
    EXPECT_EQ(path.origin, LightOrigin::sun);
    EXPECT_EQ(path.reflections(), path.patches.size());
    const double h = path.patches.front() == 0 ? h1 : h2;
    const double reflected = std::pow(rho, path.reflections());
    EXPECT_NEAR(path.contribution.r, reflected * std::pow(f, path.reflections() - 1) * h,
                1e-3 * b1);
  }
}

/// By hand: no other surface sends light.
TEST(Sun, IsReflectedByALobeAlone) {
  constexpr double rho = 0.3, fraction = 0.4, power = 1000;
  for (const Lobe& lobe : {testing::phong(fraction, 20), testing::ggx(fraction, 0.3)}) {
    Sketch sketch;
    const int material = sketch.material(rho, 0);
    sketch.face({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, material);
    SceneDescription description = sketch.description();
    at(description.materials, material).lobe = lobe;
    const Vec3 sun = normalized({0.5, 0.2, 1});
    SolveOptions options = testing::glossy_options(64);
    options.sky = sunny(sun, power);
    const auto solution = std::make_shared<const Solution>(
        solve(std::make_shared<const Scene>(description), options));
    const double h = power * sun.z;
    EXPECT_NEAR(solution->irradiance[0].r, h, 1e-12 * h);
    EXPECT_NEAR(solution->sky_irradiance[0].r, h, 1e-12 * h);
    EXPECT_NEAR(solution->radiosity[0].r, (rho + fraction) * h, 1e-12 * h);
    const SurfaceLight light(solution);
    const LobeFunction function(lobe);
    for (const Vec3& to :
         {Vec3{-0.5, -0.2, 1}, Vec3{0.5, 0.2, 1}, Vec3{0, 0, 1}, Vec3{-1, 0, 0.2}}) {
      const Vec3 toward = normalized(to);
      const double expected =
          rho * h / std::numbers::pi + fraction * function.value(sun, toward, up) * h;
      EXPECT_NEAR(solution->glossy->radiance(0, toward).r, expected, 1e-9 * h);
      EXPECT_NEAR(light.radiance(Vec3{0.4, 0.6, 0} + toward, -toward).r, expected, 1e-6 * h);
    }
  }
}

/// Under sky and sun, in replicas, with a disc; and with materials that replace others.
TEST(Sun, WithLobesAddsToASkyAndStaysWithOtherMaterials) {
  SceneDescription description = testing::glossy_box_description();
  // Without the ceiling, the light of sky and sun enters.
  SceneDescription open;
  open.name = "open box";
  open.points = description.points;
  open.materials = description.materials;
  for (std::size_t f = 0; f < description.face_count(); ++f) {
    const auto outline = description.outline(f);
    const bool is_ceiling = std::all_of(outline.begin(), outline.end(), [&](PointId p) {
      return at(description.points, p).z > 0.999;
    });
    if (!is_ceiling) {
      open.add_face(outline, description.face_material[f]);
    }
  }
  const auto scene = std::make_shared<const Scene>(open);
  SolveOptions options = testing::glossy_options(64);
  options.replicas = 2;
  const Sky sky{.exitance = {200, 300, 400}};
  const auto solution_under = [&](const Sky& light) {
    options.sky = light;
    return solve(scene, options);
  };
  Sky both = sky;
  both.sun = {{500, 400, 300}, normalized({0.2, 0.1, 1}), true};
  const Solution of_sky = solution_under(sky), of_both = solution_under(both);
  Sky sun = both;
  sun.exitance = {};
  const Solution of_sun = solution_under(sun);
  for (std::size_t i = 0; i < of_both.radiosity.size(); ++i) {
    const Rgb expected = of_sky.irradiance[i] + of_sun.irradiance[i];
    EXPECT_LE(max_abs(of_both.irradiance[i] - expected), 1e-9 * 1000) << i;
    EXPECT_LE(
        max_abs(of_both.sky_irradiance[i] - of_sky.sky_irradiance[i] - of_sun.sky_irradiance[i]),
        1e-9 * 1000);
  }
  // The solver of other materials, given these later.
  std::vector<Material> dull = scene->materials();
  for (Material& material : dull) {
    material.reflectance = {0.1, 0.1, 0.1};
    material.lobe = {};
  }
  std::vector<std::int32_t> of_patch;
  for (const Patch& patch : scene->patches()) {
    of_patch.push_back(patch.material);
  }
  options.sky = both;
  GlossySolver solver(std::make_shared<const Scene>(*scene, dull, of_patch), options);
  solver.solve();
  solver.set_materials(scene->materials(), of_patch, GlossySolver::Start::emission);
  solver.solve();
  EXPECT_LE(testing::largest_difference(solver.solution().radiosity, of_both.radiosity), 1e-9);
}

/// The lamp is as large as the sun's disc from 1 km, and its light is as strong.
TEST(Sun, WithLobesIsAFarLamp) {
  constexpr double power = 1000, distance = 1000, half = 2;
  const Vec3 sun = normalized({0.6, 0.3, 1});
  const auto sketch_of = [&](bool lamp) {
    Sketch sketch;
    const int floor = sketch.material(0.3, 0), wall = sketch.material(0.5, 0);
    sketch.face({{-2, -2, 0}, {2, -2, 0}, {2, 2, 0}, {-2, 2, 0}}, floor);
    sketch.box({-1, -1, 0.2}, {0, 0.5, 1.5}, false, wall);
    if (lamp) {
      const Vec3 middle = distance * sun, u = normalized(cross(sun, up)), v = cross(sun, u);
      const double area = 4 * half * half;
      sketch.face({middle - half * u - half * v, middle - half * u + half * v,
                   middle + half * u + half * v, middle + half * u - half * v},
                  sketch.material(0, std::numbers::pi * distance * distance * power / area));
    }
    SceneDescription description = sketch.description();
    at(description.materials, floor).lobe = testing::phong(0.5, 30);
    return description;
  };
  SolveOptions options = testing::glossy_options(256);
  const auto solved = [&](bool lamp) {
    options.first_shot = lamp ? std::optional<double>(0) : std::nullopt;
    options.sky = lamp ? Sky{} : sunny(sun, power);
    return solve(std::make_shared<const Scene>(sketch_of(lamp)), options);
  };
  const Solution by_sun = solved(false), by_lamp = solved(true);
  const std::size_t patches = by_sun.radiosity.size();
  ASSERT_EQ(by_lamp.radiosity.size(), patches + 1);
  double most = 0;
  for (std::size_t i = 0; i < patches; ++i) {
    EXPECT_NEAR(by_sun.irradiance[i].r, by_lamp.irradiance[i].r, 3e-3 * power) << i;
    most = std::max(most, by_sun.irradiance[i].r);
    for (const Vec3& to : {Vec3{-0.6, -0.3, 1}, Vec3{0.2, -0.5, 1}}) {
      const auto patch = static_cast<PatchId>(i);
      EXPECT_NEAR(by_sun.glossy->radiance(patch, normalized(to)).r,
                  by_lamp.glossy->radiance(patch, normalized(to)).r, 3e-3 * power)
          << i;
    }
  }
  EXPECT_GT(most, 0.5 * power);
  // The side of the box that is away from the sun gets light from the floor's lobe, too.
  options.glossy = false;
  const Solution diffuse = solved(false);
  double added = 0;
  for (std::size_t i = 1; i < patches; ++i) {
    added = std::max(added, by_sun.irradiance[i].r - diffuse.irradiance[i].r);
  }
  EXPECT_GT(added, 0.05 * power);
}

TEST(Sun, RefusesWhatItCannotLight) {
  SolveOptions options{.sky = sunny(up)};
  options.sky.sun.direction = {0, 0, 2};
  EXPECT_THAT(refusal([&] { options.validate(); }), HasSubstr("not a unit vector"));
  options.sky.sun.direction = {};
  EXPECT_THAT(refusal([&] { options.validate(); }), HasSubstr("direction is missing"));
  options.sky = sunny(up, -1);
  EXPECT_THAT(refusal([&] { options.validate(); }), HasSubstr("not"));
}

/// An unobstructed roof sees all of the sky, a wall half of it.
TEST(Shading, FractionsOfTheSkyAreThoseOfTheCosine) {
  Sketch sketch("body");
  sketch.box({0, 0, 0}, {1, 1, 1}, false, sketch.material(0.5, 0));
  const auto scene = sketch.scene();
  const std::vector<double> sky =
      seen_sky_fractions(scene, std::make_shared<const BspTree>(*scene), up, 1024);
  for (PatchId i = 0; i < scene->patch_count(); ++i) {
    EXPECT_NEAR(at(sky, i), (1 + scene->patch(i).normal.z) / 2, 2e-3);
  }
}

}  // namespace
}  // namespace transillum::sun_test
