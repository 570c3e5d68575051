// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
// Answers known in closed form (ALGORITHM.md, oracles 3, 4 and 6).

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "support/scenes.h"
#include "transillum/at.h"
#include "transillum/radiosity_solver.h"
#include "transillum/solution.h"
#include "transillum/solve_options.h"
#include "transillum/solve_session.h"

namespace transillum::closed_forms_test {
namespace {

using testing::Sketch;

constexpr double parallel_unit_squares = 0.1998248957;       // at distance 1
constexpr double perpendicular_unit_squares = 0.2000437761;  // with a common edge

/// F_01 by the estimator: patch 1 has exitance 1 and nothing reflects, so H_0 is the form factor.
double form_factor(const Sketch& sketch, const SolveOptions& options) {
  const Solution solution = solve(sketch.scene(), options);
  return solution.irradiance[0].r;
}

Sketch parallel_squares() {
  Sketch sketch;
  const int dark = sketch.material(0.5, 0), light = sketch.material(0, 1);
  sketch.face({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, dark);
  sketch.face({{0, 0, 1}, {0, 1, 1}, {1, 1, 1}, {1, 0, 1}}, light);
  return sketch;
}

Sketch perpendicular_squares() {
  Sketch sketch;
  const int dark = sketch.material(0.5, 0), light = sketch.material(0, 1);
  sketch.face({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, dark);
  sketch.face({{0, 0, 0}, {0, 1, 0}, {0, 1, 1}, {0, 0, 1}}, light);
  return sketch;
}

TEST(ClosedForms, FormFactorsOfSquaresMatchTheFormulas) {
  // The visible square covers a few percent of the sphere; its boundary causes an error of
  // O(M^-3/4). Measured errors are a third of these bounds.
  for (const auto& [directions, accuracy] :
       {std::pair{1000, 2e-3}, {10000, 4e-4}, {100000, 6e-5}}) {
    SolveOptions options{.directions = directions, .iterations = 1};
    EXPECT_NEAR(form_factor(parallel_squares(), options), parallel_unit_squares, accuracy);
    EXPECT_NEAR(form_factor(perpendicular_squares(), options), perpendicular_unit_squares,
                accuracy);
  }
}

TEST(ClosedForms, EverySamplingOneWayAndTwoWayConvergesToTheSame) {
  for (const std::string& name : names_of<Sampling>()) {
    const Sampling sampling = from_name<Sampling>(name);
    for (const bool two_way : {false, true}) {
      SolveOptions options{.directions = 20000,
                           .sampling = sampling,
                           .seed = 3,
                           .two_way = two_way,
                           .iterations = 1};
      // Random: three standard deviations of a mean of 20,000.
      const double accuracy = sampling == Sampling::random ? 0.02 : 1e-3;
      EXPECT_NEAR(form_factor(parallel_squares(), options), parallel_unit_squares, accuracy)
          << name_of(sampling) << two_way;
      EXPECT_NEAR(form_factor(perpendicular_squares(), options), perpendicular_unit_squares,
                  accuracy)
          << name_of(sampling) << two_way;
    }
  }
}

/// A blocker halfway between them: squares that are completely hidden exchange nothing.
TEST(ClosedForms, HiddenSquaresExchangeNothing) {
  Sketch sketch = parallel_squares();
  const int dark = sketch.material(0.5, 0);
  sketch.face({{-9, -9, .5}, {9, -9, .5}, {9, 9, .5}, {-9, 9, .5}}, dark);
  EXPECT_EQ(form_factor(sketch, {.directions = 500, .iterations = 1}), 0);
}

TEST(ClosedForms, RowSumsOfASphereInAnEnclosureAreOne) {
  const auto scene = load_scene("sphere-flake:levels=0");
  RadiositySolver solver(scene, {.directions = 2000});
  solver.advance(RadiositySolver::Until::iteration);
  const auto sums = solver.form_factor_sums();
  // eps(M)/pi measured for 2 x 2000 Fibonacci points: 6e-5 RMS.
  for (PatchId i = 0; i < scene->patch_count(); ++i) {
    EXPECT_NEAR(at(sums, i), 1.0, 5e-4) << i;
  }
}

TEST(Furnace, IsExactlyTwoWithNormalizedRows) {
  for (const std::string& name : names_of<Sampling>()) {
    const Sampling sampling = from_name<Sampling>(name);
    for (const bool two_way : {false, true}) {
      const auto scene = load_scene("furnace");
      const Solution solution = solve(scene, {.directions = 64,
                                              .sampling = sampling,
                                              .two_way = two_way,
                                              .normalize = Normalization::rows,
                                              .tolerance = 1e-14});
      for (const Rgb& b : solution.radiosity) {
        EXPECT_NEAR(b.r, 2, 1e-11);
        EXPECT_NEAR(b.g, 2, 1e-11);
        EXPECT_NEAR(b.b, 2, 1e-11);
      }
    }
  }
}

/// Plain estimator: within the bound of eq. 37, eps(M) by eq. 21.
TEST(Furnace, IsTwoWithinTheBoundWithoutNormalization) {
  for (const int directions : {64, 256, 1024}) {
    const Solution solution = solve(load_scene("furnace"), {.directions = directions,
                                                            .sampling = Sampling::hammersley,
                                                            .two_way = false,
                                                            .tolerance = 1e-12});
    const double epsilon = 2 * std::numbers::pi / directions * (std::log2(directions) + 7);
    const double rho = 0.5;
    const double bound = rho / (1 - rho) * epsilon / std::numbers::pi * 2;
    for (const Rgb& b : solution.radiosity) {
      EXPECT_NEAR(b.r, 2, bound) << directions;
    }
  }
}

TEST(Energy, PowerReceivedEqualsPowerSent) {
  for (const char* spec : {"cornell-box", "furnace", "boards", "stars"}) {
    for (const bool two_way : {false, true}) {
      const Solution solution =
          solve(load_scene(spec), {.directions = 200, .two_way = two_way, .tolerance = 1e-12});
      EXPECT_LE(solution.statistics.energy_defect, 1e-13) << spec;
      EXPECT_LE(solution.statistics.escaped, 1e-12) << spec;
    }
  }
}

/// In a closed scene without visible back sides, all power emitted is absorbed, within eps(M)/pi.
TEST(Energy, PowerEmittedEqualsPowerAbsorbed) {
  for (const char* spec :
       {"cornell-box", "furnace", "boards", "rooms", "stars", "sphere-flake:levels=1"}) {
    RadiositySolver solver(load_scene(spec), {.directions = 256, .tolerance = 1e-10});
    solver.advance(RadiositySolver::Until::finished);
    for (const double seen : solver.back_seen_fractions()) {
      ASSERT_LE(seen, 1e-12) << spec;
    }
    EXPECT_NEAR(solver.statistics().energy_balance, 1, 2e-3) << spec;
  }
}

/// Nothing is visible, so nothing is received.
TEST(ClosedForms, ALoneSquareKeepsItsExitance) {
  Sketch sketch;
  sketch.face({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, sketch.material(0.5, 3));
  const Solution solution = solve(sketch.scene(), {.directions = 100});
  EXPECT_EQ(solution.radiosity[0].r, 3);
  EXPECT_EQ(solution.statistics.escaped, 1);
}

}  // namespace
}  // namespace transillum::closed_forms_test
