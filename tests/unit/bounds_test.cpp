// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// The bounds against the paper's tables and formulas, and measured direction sets.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "sampling/discrepancy.h"
#include "support/scenes.h"
#include "transillum/bounds.h"
#include "transillum/errors.h"

namespace transillum::bounds_test {
namespace {

constexpr double pi = std::numbers::pi;

TEST(Bounds, Table1EqualsThePaper) {
  const PaperTables& paper = paper_tables();
  const double printed[] = {5, 9, 15, 24, 37, 61, 111, 272};
  for (std::size_t k = 0; k < PaperTables::rows; ++k) {
    EXPECT_EQ(directions_to_contract(paper.rho[k]), printed[k]);
    EXPECT_EQ(paper.to_contract[k], printed[k]);
  }
}

TEST(Bounds, Tables2And3ByFormula) {
  const double table_2[] = {836, 1505, 2434, 3777, 5855, 9428, 16832, 40127};
  const double table_3[] = {2.67e6, 4.71e6, 7.50e6, 11.5e6, 17.6e6, 27.9e6, 49.1e6, 115e6};
  const PaperTables& paper = paper_tables();
  for (std::size_t k = 0; k < PaperTables::rows; ++k) {
    EXPECT_EQ(directions_if_homogeneous(paper.rho[k], 0.01), table_2[k]);
    const double anywhere = directions_if_heterogeneous(paper.rho[k], 0.01, 150);
    EXPECT_NEAR(anywhere, table_3[k], 0.005 * table_3[k]);
    // The printed values, up to rounding; Table 2 of the paper deviates slightly from its formula.
    EXPECT_GE(paper.if_heterogeneous[k], anywhere);
    EXPECT_LE(paper.if_heterogeneous[k], 1.13 * anywhere);
    EXPECT_NEAR(paper.if_homogeneous[k], table_2[k], 0.16 * table_2[k]);
  }
}

TEST(Bounds, EqualTheFormulas) {
  EXPECT_DOUBLE_EQ(star_discrepancy_bound(1024), 17. / 2048);
  EXPECT_DOUBLE_EQ(quadrature_error_bound(1024), 2 * pi / 1024 * 17);
  EXPECT_DOUBLE_EQ(contraction_bound(0.5, pi / 10), 0.55);
  EXPECT_DOUBLE_EQ(homogeneous_error_bound(0.5, pi / 10), 0.1);
  EXPECT_DOUBLE_EQ(heterogeneous_error_bound(0.5, 2, 0.25), 8 * pi);
}

TEST(Bounds, IterationsReduceTheErrorBelowTheTolerance) {
  for (const double contraction : {0.1, 0.5, 0.62, 0.999}) {
    for (const double tolerance : {0.5, 1e-2, 1e-6}) {
      const double steps = *iterations_to(tolerance, contraction);
      EXPECT_LE(std::pow(contraction, steps), tolerance * (1 + 1e-12));
      EXPECT_GT(std::pow(contraction, steps - 1), tolerance);
    }
  }
  EXPECT_FALSE(iterations_to(1e-6, 1));
  EXPECT_FALSE(iterations_to(1e-6, 1.2));
  EXPECT_EQ(*iterations_to(1e-6, 0), 1);
  EXPECT_EQ(*iterations_to(1, 0.5), 0);
}

/// The smallest M suffices and M - 1 does not, however large M is.
TEST(Bounds, SmallestNumbersSufficeAndOneLessDoesNot) {
  for (const double rho : {0.0, 0.05, 0.6, 0.999999}) {
    const double m = directions_to_contract(rho);
    EXPECT_LT(contraction_bound(rho, quadrature_error_bound(m)), 1);
    if (m > 1) {
      EXPECT_GE(contraction_bound(rho, quadrature_error_bound(m - 1)), 1);
    }
    for (const double accuracy : {0.3, 1e-4, 1e-12}) {
      const double h = directions_if_homogeneous(rho, accuracy);
      EXPECT_LE(homogeneous_error_bound(rho, quadrature_error_bound(h)), accuracy);
      if (h > 1 && h < 1e15) {
        EXPECT_GT(homogeneous_error_bound(rho, quadrature_error_bound(h - 1)), accuracy);
      }
      const double a = directions_if_heterogeneous(rho, accuracy, 1e6);
      EXPECT_LE(heterogeneous_error_bound(rho, 1e6, star_discrepancy_bound(a)), accuracy);
    }
  }
}

TEST(Bounds, RejectValuesOutOfRange) {
  for (const double rho : {-0.1, 1.0, HUGE_VAL, std::nan("")}) {
    EXPECT_THROW(directions_to_contract(rho), InputError);
    EXPECT_THROW(directions_if_homogeneous(rho, 0.01), InputError);
    EXPECT_THROW(actual_directions_to_contract({}, rho), InputError);
  }
  for (const double bad : {0.0, -1.0, HUGE_VAL, std::nan("")}) {
    EXPECT_THROW(directions_if_homogeneous(0.5, bad), InputError);
    EXPECT_THROW(directions_if_heterogeneous(0.5, 0.01, bad), InputError);
    EXPECT_THROW(actual_directions_if_homogeneous({}, 0.5, bad), InputError);
  }
}

TEST(DirectionSetFamily, NeedFarFewerDirectionsThanProven) {
  const DirectionSetFamily antipodal, paper{Sampling::hammersley, 1, {}, false};
  for (const double rho : {0.2, 0.6, 0.9}) {
    for (const DirectionSetFamily& sets : {antipodal, paper}) {
      const int contract = *actual_directions_to_contract(sets, rho);
      EXPECT_LE(contract, directions_to_contract(rho));
      EXPECT_LT(contraction_bound(rho, measured_quadrature_error(sets, contract)), 1);
      const int accurate = *actual_directions_if_homogeneous(sets, rho, 0.01);
      EXPECT_LE(homogeneous_error_bound(rho, measured_quadrature_error(sets, accurate)), 0.01);
      EXPECT_GT(homogeneous_error_bound(rho, measured_quadrature_error(sets, accurate - 1)), 0.01);
      EXPECT_LT(accurate, 0.2 * directions_if_homogeneous(rho, 0.01));
    }
  }
  EXPECT_LE(*actual_directions_if_homogeneous(antipodal, 0.6, 0.01), 100);
  EXPECT_FALSE(actual_directions_if_homogeneous({Sampling::random, 1, {}, true}, 0.9, 1e-5));
}

TEST(DirectionSetFamily, EstimateOfTable3FollowsTheMeasuredDiscrepancy) {
  // At a measured M the estimate equals the measurement.
  const DirectionSetFamily sets{Sampling::fibonacci};
  for (const int m : {1024, 16384}) {
    const double accuracy = heterogeneous_error_bound(0.5, 9, star_discrepancy(sets.make(m)));
    EXPECT_NEAR(*estimated_directions_if_heterogeneous(sets, 0.5, accuracy, 9), m, 1);
  }
  EXPECT_LT(*estimated_directions_if_heterogeneous(sets, 0.6, 0.01, 150),
            directions_if_heterogeneous(0.6, 0.01, 150));
  EXPECT_FALSE(estimated_directions_if_heterogeneous({Sampling::antipodal}, 0.6, 0.01, 150));
}

TEST(SceneMeasures, OfABox) {
  testing::Sketch sketch;
  const int dark = sketch.material(0.25, 1), bright = sketch.material(0.75, 0);
  sketch.box({0, 0, 0}, {3, 4, 12}, true, dark).box({1, 1, 1}, {1.5, 1.5, 1.5}, false, bright);
  const SceneMeasures m = measure(*sketch.scene());
  EXPECT_DOUBLE_EQ(m.rho_max, 0.75);
  EXPECT_DOUBLE_EQ(m.smallest_area, 0.25);
  EXPECT_GE(m.extent, 13);
  EXPECT_LE(m.extent, 13 * 1.0041);
  EXPECT_DOUBLE_EQ(m.size_ratio, m.extent * m.extent / 0.25);
}

TEST(SceneMeasures, ExtentIsAnUpperBoundForAnyRotation) {
  testing::Sketch sketch;
  sketch.box({0, 0, 0}, {1, 1e-3, 1e-3}, true, sketch.material(0.5, 1));
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    const auto turned = testing::moved(sketch.description(), testing::random_rotation(seed));
    const double extent = measure(Scene(turned)).extent;
    EXPECT_GE(extent, 1);
    EXPECT_LE(extent, 1.005);
  }
}

TEST(EstimatedPasses, FollowTheSlope) {
  EXPECT_EQ(estimated_passes(Sampling::fibonacci, 100, 0.08, 0.01), 1600);
  EXPECT_EQ(estimated_passes(Sampling::random, 100, 0.08, 0.01), 6400);
  EXPECT_EQ(estimated_passes(Sampling::random, 100, 0.0009, 0.01), 1);
  // Replicas do not change random directions; four evenly spread sets of 100 halve the error of
  // one.
  EXPECT_EQ(estimated_passes_by_replicas(Sampling::random, 100, 4, 0.08, 0.01), 6400);
  EXPECT_EQ(estimated_passes_by_replicas(Sampling::fibonacci, 400, 4, 0.04, 0.01), 1600);
}

}  // namespace
}  // namespace transillum::bounds_test
