// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// The first shot with linear functions (ALGORITHM.md 6.5, 6.12): linear terms of its irradiance
// against a quadrature over points of the receiver, and solves against passes without a shot.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>

#include "session/measure_errors.h"
#include "support/imperfect_scenes.h"
#include "support/refusal.h"
#include "support/scenes.h"
#include "transillum/at.h"
#include "transillum/first_shot.h"
#include "transillum/radiosity_solver.h"
#include "transillum/solve_session.h"
#include "visibility/pairs/patch_exchange.h"

namespace transillum::linear_first_shot_test {
namespace {

using ::testing::HasSubstr;
using testing::Imperfect;
using testing::Sketch;

DirectLight linear_shot(const Scene& scene, const std::vector<PatchId>& sources, int threads = 0) {
  return shoot(scene, sources, {.threads = threads, .basis = Basis::linear});
}

double larger(const Rgb& a, const Rgb& b) { return std::max(max_abs(a), max_abs(b)); }

/// The largest difference of two lists of linear terms.
double difference(const std::vector<LinearTerm>& a, const std::vector<LinearTerm>& b) {
  double largest = a.size() == b.size() ? 0 : HUGE_VAL;
  for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i) {
    largest = std::max(largest, larger(a[i].first - b[i].first, a[i].second - b[i].second));
  }
  return largest;
}

double largest(const std::vector<LinearTerm>& contributions) {
  return difference(contributions, std::vector<LinearTerm>(contributions.size()));
}

/// RMS over patches that do not emit of the difference of two functions, over the RMS of `known`.
double error_of(const Solution& solution, const Solution& known) {
  double error = 0, norm = 0;
  const auto add = [&](double area, const Rgb& a, const Rgb& b) {
    error += area * std::pow(a.g - b.g, 2);
    norm += area * std::pow(b.g, 2);
  };
  const Scene& scene = *known.scene;
  for (PatchId i = 0; i < scene.patch_count(); ++i) {
    if (max_abs(scene.exitance(i)) > 0) {
      continue;
    }
    const double area = scene.patch(i).area;
    const LinearTerm &a = at(solution.linear_terms, i), &b = at(known.linear_terms, i);
    add(area, at(solution.radiosity, i), at(known.radiosity, i));
    add(area, a.first, b.first);
    add(area, a.second, b.second);
  }
  return std::sqrt(error / norm);
}

/// Coefficients of phi_1 and phi_2 of the irradiance of a parallelogram, by the midpoints of
/// `points`² cells; each sees the sources exactly.
std::array<double, 2> by_points(const Scene& scene, PatchId i, const std::vector<PatchId>& sources,
                                int points) {
  const ExchangeFinder exchange(scene);
  const LinearBasis basis = linear_basis(scene, i);
  const auto outline = scene.outline(i);
  const Vec3& corner = scene.point(outline[0]);
  const Vec3 u = scene.point(outline[1]) - corner, v = scene.point(outline[3]) - corner;
  std::array<double, 2> sum{};
  for (int k = 0; k < points * points; ++k) {
    const int column = k % points, row = k / points;
    const Vec3 x = corner + (column + 0.5) / points * u + (row + 0.5) / points * v;
    double h = 0;
    for (const PatchId j : sources) {
      h += scene.exitance(j).g * exchange.from_point(x, scene.patch(i).normal, j);
    }
    const std::array<double, 2> phi = basis.at(x);
    for (std::size_t a = 0; a < 2; ++a) {
      sum[a] += phi[a] * h / (points * points);
    }
  }
  return sum;
}

/// A floor of 2 by 1 m below a lamp of `size` m, beside it; with or without a board between.
Sketch floor_and_lamp(double size, bool board) {
  Sketch sketch;
  const int dark = sketch.material(0.5, 0), lamp = sketch.material(0, 1 / (size * size));
  sketch.face({{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {0, 1, 0}}, dark);
  sketch.face(
      {{1.2, 0.3, 1}, {1.2, 0.3 + size, 1}, {1.2 + size, 0.3 + size, 1}, {1.2 + size, 0.3, 1}},
      lamp);
  if (board) {
    sketch.face({{0.9, 0.1, 0.5}, {0.9, 0.6, 0.6}, {1.4, 0.6, 0.6}, {1.4, 0.1, 0.5}}, dark);
    sketch.face({{0.9, 0.1, 0.5}, {1.4, 0.1, 0.5}, {1.4, 0.6, 0.6}, {0.9, 0.6, 0.6}}, dark);
  }
  return sketch;
}

TEST(LinearFirstShot, LinearTermsAreTheQuadratureOverTheReceiver) {
  for (const bool board : {false, true}) {
    for (const double size : {0.02, 0.2, 0.8}) {
      const auto scene = floor_and_lamp(size, board).scene();
      const DirectLight light = linear_shot(*scene, {1});
      const std::array<double, 2> expected = by_points(*scene, 0, {1}, 150);
      const LinearTerm &part = light.linear_terms[0], &error = light.linear_term_errors[0];
      SCOPED_TRACE(::testing::Message() << board << " " << size);
      const double h = light.irradiance[0].g;
      EXPECT_GT(std::abs(expected[0]), 0.1 * h);
      // The quadrature itself is off by its steps across shadows.
      const double steps = board ? 2e-3 * h : 3e-5 * h;
      EXPECT_NEAR(part.first.g, expected[0], error.first.g + steps);
      EXPECT_NEAR(part.second.g, expected[1], error.second.g + steps);
      EXPECT_LT(larger(error.first, error.second), (board ? 5e-3 : 1e-3) * h);
      EXPECT_EQ(light.linear_terms[1].first.g, 0);
    }
  }
}

/// A small receiver is sampled itself.
TEST(LinearFirstShot, ASmallReceiverBelowALargeLamp) {
  Sketch sketch;
  const int dark = sketch.material(0.5, 0), lamp = sketch.material(0, 1);
  sketch.face({{0, 0, 0}, {0.3, 0, 0}, {0.3, 0.2, 0}, {0, 0.2, 0}}, dark);
  sketch.face({{-1, -1, 1}, {-1, 0.1, 1}, {0.5, 0.1, 1}, {0.5, -1, 1}}, lamp);
  const auto scene = sketch.scene();
  const DirectLight light = linear_shot(*scene, {1});
  const std::array<double, 2> expected = by_points(*scene, 0, {1}, 100);
  EXPECT_NEAR(light.linear_terms[0].first.g, expected[0], 2e-5);
  EXPECT_NEAR(light.linear_terms[0].second.g, expected[1], 2e-5);
  EXPECT_LE(std::abs(light.linear_terms[0].second.g - expected[1]),
            light.linear_term_errors[0].second.g + 1e-6);
}

TEST(LinearFirstShot, MeansAreTheBitsOfConstantFunctions) {
  for (const char* spec : {"cornell-box", "rooms", "boards", "stars:n=2", "furnace"}) {
    const auto scene = load_scene(spec);
    const std::vector<PatchId> sources = find_small_sources(*scene, 0);
    const DirectLight constant = shoot(*scene, sources), linear = linear_shot(*scene, sources);
    EXPECT_EQ(linear.irradiance, constant.irradiance) << spec;
    EXPECT_EQ(linear.irradiance_error, constant.irradiance_error) << spec;
    EXPECT_EQ(linear.integrated_pairs, constant.integrated_pairs) << spec;
    EXPECT_TRUE(constant.linear_terms.empty()) << spec;
    EXPECT_EQ(linear.linear_terms.size(), scene->patches().size()) << spec;
  }
}

/// No place of a patch receives less than 0: |H_a| is at most H times the largest |phi_a|.
TEST(LinearFirstShot, LinearTermsAreBoundedByTheMean) {
  for (const char* spec : {"cornell-box", "rooms", "boards"}) {
    const auto scene = load_scene(spec, {.max_patch_area = 0.3});
    const DirectLight light = linear_shot(*scene, find_small_sources(*scene, 0));
    for (PatchId i = 0; i < scene->patch_count(); ++i) {
      const LinearBasis basis = linear_basis(*scene, i);
      std::array<double, 2> most{};
      for (const PointId p : scene->outline(i)) {
        const std::array<double, 2> phi = basis.at(scene->point(p));
        most = {std::max(most[0], std::abs(phi[0])), std::max(most[1], std::abs(phi[1]))};
      }
      const double h = at(light.irradiance, i).g * (1 + 1e-9);
      EXPECT_LE(std::abs(at(light.linear_terms, i).first.g), most[0] * h) << spec << i;
      EXPECT_LE(std::abs(at(light.linear_terms, i).second.g), most[1] * h) << spec << i;
    }
  }
}

/// Passes without a shot come ever closer to the passes with one, and are far off at the start.
TEST(LinearFirstShot, IsTheLimitOfPassesWithoutIt) {
  const auto scene = load_scene("stars:n=2");
  const auto solved = [&](int directions, std::optional<double> shot) {
    return solve(scene, {.directions = directions, .basis = Basis::linear, .first_shot = shot});
  };
  const Solution known = solved(2048, 0);
  EXPECT_DOUBLE_EQ(known.statistics.shot_power_fraction, 1);
  EXPECT_LE(known.statistics.energy_defect, 1e-12);
  EXPECT_LE(known.statistics.shot_disagreement, 1);
  EXPECT_LT(error_of(solved(128, 0), known), 5e-3);
  double last = HUGE_VAL;
  for (const int directions : {128, 1024, 8192}) {
    const double error = error_of(solved(directions, std::nullopt), known);
    EXPECT_LT(error, 0.6 * last) << directions;
    last = error;
  }
  EXPECT_LT(last, 0.02);
}

TEST(LinearFirstShot, AgreesWithPassesOnBuiltIns) {
  for (const char* spec : {"cornell-box", "rooms", "boards"}) {
    const auto scene = load_scene(spec);
    const Solution known = solve(scene, {.directions = 8192, .basis = Basis::linear});
    const Solution shot =
        solve(scene, {.directions = 1024, .basis = Basis::linear, .first_shot = 0});
    EXPECT_GT(shot.statistics.shot_sources, 0) << spec;
    EXPECT_LT(error_of(shot, known), 4e-3) << spec;
    EXPECT_LE(shot.statistics.energy_defect, 1e-12) << spec;
    EXPECT_NEAR(shot.statistics.energy_balance, 1, 3e-3) << spec;
  }
}

TEST(LinearFirstShot, AgreesWithPassesOnImperfectMeshes) {
  for (const Imperfect kind : {Imperfect::rails, Imperfect::clutter, Imperfect::terrain}) {
    const auto scene = std::make_shared<const Scene>(testing::describe(
        {.kind = kind, .count = 4, .gap = 0.05, .digits = 8, .turned = true, .quads = true}));
    const Solution known = solve(scene, {.directions = 4096, .basis = Basis::linear});
    const Solution shot =
        solve(scene, {.directions = 1024, .basis = Basis::linear, .first_shot = 0});
    EXPECT_GT(shot.statistics.shot_sources, 0);
    EXPECT_LT(error_of(shot, known), 1.5e-2) << static_cast<int>(kind);
    EXPECT_LE(shot.statistics.shot_disagreement, 1) << static_cast<int>(kind);
  }
}

/// Oracle 3: uniform light has linear terms of 0, but for the points.
TEST(LinearFirstShot, LeavesTheFurnaceConstant) {
  const Solution solution = solve(load_scene("furnace"), {.directions = 64,
                                                          .normalize = Normalization::rows,
                                                          .basis = Basis::linear,
                                                          .first_shot = 0});
  for (const Rgb& b : solution.radiosity) {
    EXPECT_NEAR(b.g, 2, 1e-3);
  }
  EXPECT_LT(largest(solution.linear_terms), 3e-3);
}

/// The error of the shot's points is in no replica's spread.
TEST(LinearFirstShot, ItsErrorIsIncludedInTheErrorFromReplicas) {
  const auto rms = [](Basis basis) {
    return solve(load_scene("furnace"), {.directions = 128,
                                         .normalize = Normalization::rows,
                                         .basis = basis,
                                         .first_shot = 0,
                                         .replicas = 8,
                                         .tolerance = 1e-10})
        .error.rms;
  };
  const Solution solution = solve(load_scene("furnace"), {.directions = 128,
                                                          .normalize = Normalization::rows,
                                                          .basis = Basis::linear,
                                                          .first_shot = 0,
                                                          .replicas = 8,
                                                          .tolerance = 1e-10});
  double squares = 0, all = 0;
  for (std::size_t i = 0; i < solution.radiosity.size(); ++i) {
    const LinearTerm& part = solution.linear_terms[i];
    squares += std::pow(solution.radiosity[i].g - 2, 2) + std::pow(part.first.g, 2) +
               std::pow(part.second.g, 2);
    all += 1;  // B - E
  }
  EXPECT_LT(std::sqrt(squares / all), solution.error.rms_limit);
  EXPECT_GT(rms(Basis::linear), rms(Basis::constant));
  EXPECT_LT(rms(Basis::linear), 1e-2);
}

/// Nothing stands between, so that means are exact and only linear terms are wrong.
TEST(LinearFirstShot, TheErrorOfItsLinearTermsCountsInReportsAndGoals) {
  const auto solved = [](double accuracy) {
    SolveOptions options{.directions = 64, .basis = Basis::linear, .first_shot = 0, .replicas = 4};
    options.goal.accuracy = accuracy;
    SolveSession session({.scene = floor_and_lamp(0.8, false).scene(), .options = options});
    session.advance(SolveSession::Until::finished);
    return session;
  };
  const SolveSession one = solved(0);
  const double limit = one.solution().error.surfaces.limit;
  const ErrorReport report = measure_errors(measured_solve(one));
  EXPECT_GT(limit, 1e-5);
  EXPECT_NEAR(at(report.surfaces, report.worst).errors.method, limit, 0.01 * limit);
  const SolveSession finer = solved(0.1 * limit);
  EXPECT_TRUE(finer.accuracy()->reached);
  const std::vector<int>& points = finer.diffuse()->direct_light()->points;
  ASSERT_FALSE(points.empty());
  EXPECT_GT(*std::max_element(points.begin(), points.end()), ShotOptions::default_points);
}

/// The length of a linear term, which does not depend on the axes that a patch has.
double length_of(const LinearTerm& term) { return std::hypot(term.first.g, term.second.g); }

/// Oracle 5. The axes of a square may turn, and the points of the shot with them.
TEST(LinearFirstShot, IsInvariantUnderMotionAndScale) {
  const SceneDescription still = testing::box_in_cube(4, 2).description();
  const auto turn = testing::random_rotation(3);
  const SceneDescription other = testing::moved(still, [&](const Vec3& p) {
    return 1000 * turn(p) + Vec3{1e4, 2e4, -5e3};
  });
  const auto shot_of = [](const SceneDescription& description) {
    const Scene scene(description, {});
    return linear_shot(scene, find_small_sources(scene, 0));
  };
  const DirectLight a = shot_of(still), b = shot_of(other);
  EXPECT_GT(largest(a.linear_terms), 0.01);
  ASSERT_EQ(a.linear_terms.size(), b.linear_terms.size());
  for (std::size_t i = 0; i < a.linear_terms.size(); ++i) {
    const double error = length_of(a.linear_term_errors[i]) + length_of(b.linear_term_errors[i]);
    EXPECT_NEAR(length_of(a.linear_terms[i]), length_of(b.linear_terms[i]),
                error + 1e-9 * largest(a.linear_terms))
        << i;
    EXPECT_LE(error, 0.01 * largest(a.linear_terms)) << i;
  }
}

SolveOptions options_of(int directions) {
  return {.directions = directions, .basis = Basis::linear, .first_shot = 0};
}

TEST(LinearFirstShot, IsTheSameBitsForAnyNumberOfThreads) {
  const auto scene = load_scene("rooms");
  const std::vector<PatchId> sources = find_small_sources(*scene, 0);
  EXPECT_EQ(difference(linear_shot(*scene, sources, 1).linear_terms,
                       linear_shot(*scene, sources, 3).linear_terms),
            0);
  SolveOptions options = options_of(24);
  options.replicas = 2;
  options.threads = 1;
  const Solution one = solve(scene, options);
  options.threads = 3;
  const Solution three = solve(scene, options);
  EXPECT_EQ(one.radiosity, three.radiosity);
  EXPECT_EQ(difference(one.linear_terms, three.linear_terms), 0);
}

TEST(LinearFirstShot, IsTheSameBitsAfterACheckpoint) {
  const auto scene = load_scene("cornell-box");
  RadiositySolver solver(scene, options_of(20));
  for (int k = 0; k < 7; ++k) {
    solver.advance(RadiositySolver::Until::direction);
  }
  std::ostringstream saved;
  solver.save(saved);
  RadiositySolver restored(scene, options_of(20));
  std::istringstream in(saved.str());
  restored.restore(in, saved.str().size());
  solver.advance(RadiositySolver::Until::finished);
  restored.advance(RadiositySolver::Until::finished);
  EXPECT_EQ(solver.radiosity(), restored.radiosity());
  EXPECT_EQ(difference(solver.linear_terms(), restored.linear_terms()), 0);
}

TEST(LinearFirstShot, SchemesLeadToTheSameFunction) {
  const auto scene = load_scene("cornell-box");
  SolveOptions options = options_of(64);
  options.tolerance = 1e-12;
  const Solution fixed = solve(scene, options);
  for (const Scheme scheme : {Scheme::growing, Scheme::conjugate_gradients}) {
    options.scheme = scheme;
    EXPECT_LT(error_of(solve(scene, options), fixed), 1e-9) << name_of(scheme);
  }
}

TEST(LinearFirstShot, OtherMaterialsHaveTheLightOfAnotherShot) {
  const auto scene = testing::box_in_cube(4, 2).scene();
  const std::vector<PatchId> sources = find_small_sources(*scene, 0);
  std::vector<Material> materials = scene->materials();
  for (Material& m : materials) {
    m.exitance = {3 * m.exitance.r, 0.5 * m.exitance.g, m.exitance.b};
  }
  const DirectLight light = linear_shot(*scene, sources);
  const DirectLight other = with_materials(light, *scene, materials);
  ASSERT_EQ(other.linear_terms.size(), light.linear_terms.size());
  for (std::size_t i = 0; i < other.linear_terms.size(); ++i) {
    EXPECT_NEAR(other.linear_terms[i].first.r, 3 * light.linear_terms[i].first.r, 1e-14);
    EXPECT_NEAR(other.linear_terms[i].second.g, 0.5 * light.linear_terms[i].second.g, 1e-14);
  }
}

TEST(LinearFirstShot, AShotForConstantFunctionsIsRefused) {
  const auto scene = load_scene("cornell-box");
  const auto light =
      std::make_shared<const DirectLight>(shoot(*scene, find_small_sources(*scene, 0)));
  EXPECT_THAT(test::refusal([&] { RadiositySolver(scene, options_of(8), {.shot = light}); }),
              HasSubstr("the first shot was made for constant functions"));
}

}  // namespace
}  // namespace transillum::linear_first_shot_test
