// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// The sky (decisions/0055-sky.md): open scenes against the same scenes closed by black patches, the
// furnace, known answers, and the balance of energy.
#include "transillum/sky.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "radiosity/analysis/power_table.h"
#include "support/refusal.h"
#include "support/scenes.h"
#include "transillum/at.h"
#include "transillum/errors.h"
#include "transillum/form_factor_solve.h"
#include "transillum/solution.h"
#include "transillum/solve_options.h"
#include "transillum/solve_session.h"

namespace transillum::sky_test {
namespace {

using test::refusal;
using ::testing::HasSubstr;
using testing::Sketch;

constexpr double tight = 1e-13;

Sky gray_sky(double exitance, SkyModel model = SkyModel::uniform, const Vec3& up = {0, 0, 1}) {
  return {.exitance = {exitance, exitance, exitance}, .model = model, .up = up};
}

/// A box without its top, around a block, as `divisions`² faces a wall. With a lid, black and
/// emitting `lid`, it is closed.
std::shared_ptr<const Scene> open_box(double reflectance, int divisions, double lid = 0) {
  Sketch sketch("open box");
  const int gray = sketch.material(reflectance, 0);
  const auto wall = [&](const Vec3& corner, const Vec3& u, const Vec3& v) {
    sketch.grid(corner, u, v, divisions, [=](double, double) { return gray; });
  };
  wall({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
  wall({0, 0, 0}, {0, 0, 1}, {1, 0, 0});
  wall({0, 1, 0}, {1, 0, 0}, {0, 0, 1});
  wall({0, 0, 0}, {0, 1, 0}, {0, 0, 1});
  wall({1, 0, 0}, {0, 0, 1}, {0, 1, 0});
  // The block is not on the floor: points between two touching faces see the sky or backs through
  // them.
  sketch.box({0.3, 0.3, 0.1}, {0.6, 0.7, 0.5}, false, gray);
  if (lid > 0) {
    const int black = sketch.material(0, lid);
    sketch.face({{0, 0, 1}, {0, 1, 1}, {1, 1, 1}, {1, 0, 1}}, black);
  }
  return sketch.scene();
}

void expect_same_where_open(const Solution& open, const Solution& closed, double tolerance) {
  for (PatchId i = 0; i < open.scene->patch_count(); ++i) {
    ASSERT_LE(max_abs(at(open.radiosity, i) - at(closed.radiosity, i)), tolerance) << i;
    ASSERT_GT(at(open.irradiance, i).r, 0) << i;
  }
}

class SkyOfEngine : public ::testing::TestWithParam<Engine> {};

TEST_P(SkyOfEngine, GivesTheLightOfABlackLid) {
  for (const bool two_way : {true, false}) {
    for (const Normalization normalize : {Normalization::none, Normalization::rows}) {
      SolveOptions options{.directions = 48,
                           .engine = GetParam(),
                           .two_way = two_way,
                           .normalize = normalize,
                           .tolerance = tight};
      const Solution closed = solve(open_box(0.6, 2, 3), options);
      options.sky = gray_sky(3);
      expect_same_where_open(solve(open_box(0.6, 2), options), closed, 1e-10);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Engines, SkyOfEngine, ::testing::Values(Engine::fast, Engine::local));

TEST(Sky, GivesTheLightOfABlackLidInEveryScheme) {
  const auto open = open_box(0.6, 2), closed = open_box(0.6, 2, 3);
  for (const Scheme scheme :
       {Scheme::fixed, Scheme::growing, Scheme::conjugate_gradients, Scheme::semi_iterative}) {
    SolveOptions options{.directions = 64, .scheme = scheme, .tolerance = 1e-12};
    if (scheme == Scheme::semi_iterative) {
      options.iterations = 40;
      options.burn_in = 20;
    }
    const Solution of_lid = solve(closed, options);
    options.sky = gray_sky(3);
    expect_same_where_open(solve(open, options), of_lid, 1e-9);
  }
}

TEST(Sky, SymmetricRowsSumToOneWithIt) {
  const Solution solution = solve(open_box(0.6, 2), {.directions = 64,
                                                     .normalize = Normalization::symmetric,
                                                     .tolerance = tight,
                                                     .sky = gray_sky(3)});
  for (std::size_t i = 0; i < solution.sky_fractions.size(); ++i) {
    EXPECT_NEAR(solution.form_factor_sums[i] + solution.sky_fractions[i], 1, 1e-8);
  }
}

/// A convex body of reflectance rho receives the whole sky: B = rho E. In a furnace of patches and
/// sky, E = 1 and rho = 0.5 of the patches and an exitance of 2 of the sky give B = 2 everywhere.
TEST(Sky, FurnacesHaveTheKnownRadiosity) {
  Sketch body("body");
  body.box({0, 0, 0}, {1, 2, 3}, false, body.material(0.5, 0));
  SolveOptions options{
      .directions = 32, .normalize = Normalization::rows, .tolerance = tight, .sky = gray_sky(4)};
  for (const Rgb& b : solve(body.scene(), options).radiosity) {
    EXPECT_NEAR(b.r, 2, 1e-12);
  }
  Sketch furnace("furnace");
  furnace.box({0, 0, 0}, {1, 1, 1}, false, furnace.material(0.5, 1));
  furnace.box({2, 0, 0}, {3, 1, 1}, false, furnace.material(0.5, 1));
  options.sky = gray_sky(2);
  const Solution solution = solve(furnace.scene(), options);
  for (const Rgb& b : solution.radiosity) {
    EXPECT_NEAR(b.g, 2, 1e-12);
  }
  EXPECT_GT(*std::max_element(solution.form_factor_sums.begin(), solution.form_factor_sums.end()),
            0.01);
}

/// With B everywhere equal to the exitance of the sky, an open box of rho 0 would have H = E.
TEST(Sky, BlackPatchesReceiveTheirFractionOfIt) {
  SolveOptions options{.directions = 64, .tolerance = tight, .sky = gray_sky(5)};
  const Solution solution = solve(open_box(0, 1), options);
  for (PatchId i = 0; i < solution.scene->patch_count(); ++i) {
    EXPECT_EQ(max_abs(at(solution.radiosity, i)), 0);
    EXPECT_NEAR(at(solution.irradiance, i).b, 5 * at(solution.sky_fractions, i), 1e-12);
    EXPECT_NEAR(at(solution.sky_irradiance, i).b, at(solution.irradiance, i).b, 1e-12);
  }
}

/// An unobstructed square that faces up receives all light of the overcast sky, and none if it
/// faces down. If it faces sideways, it receives 3/14 + 4 / (7 pi) of the light, the integral of L
/// cos over a quarter.
TEST(Sky, OvercastIlluminatesByTheFormulaOfTheCie) {
  Sketch sketch("squares");
  const int gray = sketch.material(0.5, 0);
  sketch.face({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, gray);
  sketch.face({{0, 0, -9}, {0, 1, -9}, {1, 1, -9}, {1, 0, -9}}, gray);
  sketch.face({{0, 40, 0}, {0, 40, 1}, {1, 40, 1}, {1, 40, 0}}, gray);
  const SolveOptions options{.directions = 4096,
                             .normalize = Normalization::rows,
                             .sky = gray_sky(10, SkyModel::cie_overcast)};
  const Solution solution = solve(sketch.scene(), options);
  EXPECT_NEAR(solution.irradiance[0].r, 10, 0.02);
  EXPECT_EQ(solution.irradiance[1].r, 0);
  EXPECT_NEAR(solution.irradiance[2].r, 10 * (3.0 / 14 + 4 / (7 * std::numbers::pi)), 0.02);
}

TEST(Sky, TurnsWithTheScene) {
  const auto turn = [](const Vec3& p) { return Vec3{p.y, p.z, p.x}; };
  Sketch sketch("block");
  const int gray = sketch.material(0.5, 0);
  sketch.face({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, gray);
  sketch.box({0.3, 0.3, 0}, {0.6, 0.7, 0.5}, false, gray);
  SolveOptions options{.directions = 8192,
                       .normalize = Normalization::rows,
                       .sky = gray_sky(1, SkyModel::cie_overcast)};
  const Solution upright = solve(sketch.scene(), options);
  options.sky.up = turn({0, 0, 1});
  const Solution sideways =
      solve(std::make_shared<const Scene>(testing::moved(sketch.description(), turn)), options);
  for (std::size_t i = 0; i < upright.irradiance.size(); ++i) {
    EXPECT_NEAR(upright.irradiance[i].r, sideways.irradiance[i].r, 0.005) << i;
  }
}

/// emitted + from the sky = absorbed + escaped, where rows sum to 1 and F is reciprocal.
TEST(Sky, EnergyIsConserved) {
  for (const Normalization normalize : {Normalization::symmetric, Normalization::none}) {
    const SolveOptions options{.directions = 256,
                               .normalize = normalize,
                               .tolerance = tight,
                               .sky = gray_sky(3, SkyModel::cie_overcast)};
    const PowerTable table = power_table(solve(open_box(0.7, 3), options), SurfaceKind::material);
    const double in = table.total.emitted.r + table.total.from_sky.r;
    const double out = table.total.absorbed.r + table.total.escaped.r;
    EXPECT_GT(in, 1);
    EXPECT_GT(table.total.escaped.r, 0.1);
    EXPECT_NEAR(out / in, 1, normalize == Normalization::symmetric ? 1e-8 : 0.01);
  }
}

TEST(Sky, DoesNotDependOnTheNumberOfThreads) {
  SolveOptions options{.directions = 40, .replicas = 4, .sky = gray_sky(1)};
  options.threads = 1;
  const Solution one = solve(open_box(0.5, 2), options);
  options.threads = 3;
  const Solution three = solve(open_box(0.5, 2), options);
  EXPECT_TRUE(one.radiosity == three.radiosity);
  EXPECT_TRUE(one.error.standard_error == three.error.standard_error);
  EXPECT_TRUE(one.sky_fractions == three.sky_fractions);
}

TEST(Sky, IsRefusedWhereItCannotBe) {
  const auto refused = [](const Sky& sky) {
    return refusal([&] { SolveOptions{.sky = sky}.validate(); });
  };
  EXPECT_EQ(refused(gray_sky(2)), "");
  EXPECT_THAT(refused(gray_sky(-1)), HasSubstr("\"-1\" is not one or three numbers of at least 0"));
  EXPECT_THAT(refused(gray_sky(NAN)), HasSubstr("nan"));
  EXPECT_THAT(refused(gray_sky(1, SkyModel::cie_overcast, {0, 2, 0})), HasSubstr("0 2 0"));
  EXPECT_THAT(refusal([] {
                solve_by_form_factors(open_box(0.5, 1),
                                      {.engine = Engine::pairs, .sky = gray_sky(1)});
              }),
              HasSubstr("cannot tell the sky from the backs"));
}

}  // namespace
}  // namespace transillum::sky_test
