// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
// Results do not depend on the units of length and power (decision 44): if lengths and emissions
// are multiplied by powers of two, all results change by powers of two and keep every digit.
#include <gtest/gtest.h>

#include <cmath>
#include <utility>

#include "base/power_of_two.h"
#include "support/scenes.h"
#include "transillum/form_factor_solve.h"
#include "transillum/solution.h"
#include "transillum/solve_options.h"
#include "transillum/solve_session.h"
#include "transillum/study.h"

namespace transillum::units_test {
namespace {

using testing::Sketch;

/// A closed room with a block, and a small lamp below its ceiling.
SceneDescription room() {
  Sketch sketch;
  const int wall = sketch.material(0.6, 0), lamp = sketch.material(0.2, 5);
  sketch.box({0, 0, 0}, {3, 2, 2}, true, wall);
  sketch.box({1, 0.5, 0.1}, {2, 1.2, 1.1}, false, wall);
  sketch.box({1.3, 0.9, 1.7}, {1.4, 1, 1.8}, false, lamp);
  return sketch.description();
}

/// Lengths times 2^length, exitances times `power`.
std::shared_ptr<const Scene> scaled(SceneDescription description, int length, double power) {
  description =
      testing::moved(description, [&](const Vec3& p) { return std::ldexp(1.0, length) * p; });
  for (Material& material : description.materials) {
    material.exitance = power * material.exitance;
  }
  return std::make_shared<const Scene>(description);
}

/// The values over `power`.
std::vector<Rgb> over(double power, std::vector<Rgb> values) {
  for (Rgb& value : values) {
    value = {value.r / power, value.g / power, value.b / power};
  }
  return values;
}

Solution solved(const std::shared_ptr<const Scene>& scene, const SolveOptions& options) {
  return takes_directions(options.engine) ? solve(scene, options)
                                          : solve_by_form_factors(scene, options);
}

void expect_same(const Solution& solution, const Solution& expected, double power) {
  EXPECT_TRUE(over(power, solution.radiosity) == expected.radiosity);
  EXPECT_TRUE(over(power, solution.irradiance) == expected.irradiance);
  EXPECT_TRUE(over(power, solution.error.standard_error) == expected.error.standard_error);
  EXPECT_EQ(solution.error.rms, expected.error.rms);
  EXPECT_EQ(over(power, {solution.error.mean_standard_error})[0],
            expected.error.mean_standard_error);
  const SolveStatistics &a = solution.statistics, &b = expected.statistics;
  EXPECT_EQ(a.iterations, b.iterations);
  EXPECT_EQ(a.closure_defect_max, b.closure_defect_max);
  EXPECT_EQ(a.escaped, b.escaped);
  EXPECT_EQ(a.energy_balance, b.energy_balance);
  EXPECT_EQ(a.energy_defect, b.energy_defect);
  EXPECT_EQ(a.shot_power_fraction, b.shot_power_fraction);
}

/// Solves the room in several units, with the same bits.
void expect_units_do_not_matter(const SolveOptions& options) {
  const Solution expected = solved(scaled(room(), 0, 1), options);
  for (const auto& [length, power] :
       {std::pair{-190, 0}, {190, 0}, {-100, -540}, {0, 540}, {0, -540}, {190, 540}}) {
    SCOPED_TRACE(::testing::Message() << "lengths times 2^" << length << ", E times 2^" << power);
    const double unit = std::ldexp(1.0, power);
    expect_same(solved(scaled(room(), length, unit), options), expected, unit);
  }
}

TEST(Units, EnginesGiveTheSameBits) {
  for (const std::string& name : names_of<Engine>()) {
    SCOPED_TRACE(name);
    const Engine engine = from_name<Engine>(name);
    const bool slow = engine == Engine::global || engine == Engine::exact;
    SolveOptions options{.directions = slow ? 2 : 16, .engine = engine};
    if (engine != Engine::rays) {
      options.engine_options.resolution = 64;
    }
    expect_units_do_not_matter(options);
  }
}

TEST(Units, SchemesAndNormalizationsGiveTheSameBits) {
  expect_units_do_not_matter({.directions = 64, .scheme = Scheme::growing});
  expect_units_do_not_matter(
      {.directions = 16, .scheme = Scheme::semi_iterative, .iterations = 12});
  expect_units_do_not_matter({.directions = 64, .scheme = Scheme::conjugate_gradients});
  for (const Normalization normalize : {Normalization::rows, Normalization::symmetric}) {
    expect_units_do_not_matter({.directions = 64, .normalize = normalize});
  }
}

TEST(Units, ErrorEstimatesAndFirstShotsGiveTheSameBits) {
  SolveOptions options{.directions = 64};
  options.replicas = 4;
  expect_units_do_not_matter(options);
  options.first_shot = small_source_ratio;
  expect_units_do_not_matter(options);
}

TEST(Units, AnyEmissionGivesTheSameResultsUpToRounding) {
  for (const Scheme scheme : {Scheme::fixed, Scheme::conjugate_gradients}) {
    SolveOptions options{.directions = 64, .scheme = scheme};
    options.replicas = 4;
    const Solution expected = solve(scaled(room(), 0, 1), options);
    for (const double power : {3.7e160, 7.3e-160}) {
      const Solution solution = solve(scaled(room(), 0, power), options);
      const auto b = over(power, solution.radiosity);
      const auto errors = over(power, solution.error.standard_error);
      for (std::size_t i = 0; i < b.size(); ++i) {
        EXPECT_LE(max_abs(b[i] - expected.radiosity[i]), 1e-12 * max_abs(expected.radiosity[i]));
        EXPECT_LE(max_abs(errors[i] - expected.error.standard_error[i]),
                  1e-12 * max_abs(expected.radiosity[i]));
      }
      EXPECT_NEAR(solution.error.rms, expected.error.rms, 1e-12);
    }
  }
}

TEST(Units, ErrorsOfStudiesAreRelative) {
  const std::vector<Rgb> reference{{1, 2, 3}, {4, 5, 6}}, b{{1, 2, 3.5}, {4, 4, 6}};
  testing::Sketch sketch;
  const auto scene = sketch.triangles(2, 0.1, 1, sketch.material(0.5, 0)).scene();
  const RadiosityError expected = radiosity_error(*scene, b, reference);
  EXPECT_NEAR(expected.rms, std::sqrt(1.0 / 29), 1e-15);  // green
  for (const double unit : {0x1p-600, 0x1p600}) {
    const RadiosityError error =
        radiosity_error(*scene, over(1 / unit, b), over(1 / unit, reference));
    EXPECT_EQ(error.rms, expected.rms);
    EXPECT_EQ(error.max, expected.max);
  }
}

TEST(Units, ScaleBringsNumbersNearOne) {
  for (const double x : {1.0, 1.999, 3e-300, -5e200, 1e-9}) {
    const double scaled = std::abs(scale_to_one(x) * x);
    EXPECT_GE(scaled, 1);
    EXPECT_LT(scaled, 2);
    EXPECT_EQ(std::frexp(scale_to_one(x), std::make_unique<int>().get()), 0.5);
  }
  EXPECT_EQ(scale_to_one(0), 1);
}

}  // namespace
}  // namespace transillum::units_test
