// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
// Basis::linear against known answers (ALGORITHM.md 6.12, oracles 3, 4 and 6).

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <sstream>

#include "support/scenes.h"
#include "transillum/at.h"
#include "transillum/linear_basis.h"
#include "transillum/radiosity_solver.h"
#include "transillum/sky.h"
#include "transillum/solution.h"
#include "transillum/solve_options.h"
#include "transillum/solve_session.h"

namespace transillum::linear_radiosity_test {
namespace {

using testing::Sketch;

SolveOptions linear(int directions) { return {.directions = directions, .basis = Basis::linear}; }

double largest_part(const Solution& solution) {
  double largest = 0;
  for (const LinearTerm& part : solution.linear_terms) {
    largest = std::max({largest, max_abs(part.first), max_abs(part.second)});
  }
  return largest;
}

/// Oracle 3. Every direction brings a patch in uniform light the moments of its projection, 0.
TEST(LinearFurnace, IsConstantWithRowNormalization) {
  for (const double max_patch_area : {0.0, 0.3}) {
    const auto scene = load_scene("furnace", {.max_patch_area = max_patch_area});
    for (const bool two_way : {true, false}) {
      SolveOptions options = linear(40);
      options.two_way = two_way;
      options.normalize = Normalization::rows;
      options.tolerance = 1e-13;
      const Solution solution = solve(scene, options);
      ASSERT_EQ(solution.linear_terms.size(), scene->patches().size());
      for (const Rgb& b : solution.radiosity) {
        EXPECT_NEAR(b.r, 2, 1e-11);
      }
      EXPECT_LE(largest_part(solution), 1e-10);
      EXPECT_EQ(solution.statistics.negative_corners, 0);
      EXPECT_LE(solution.statistics.closure_defect_moments, 1e-10);
      EXPECT_GT(solution.statistics.closure_defect_moments, 0);
    }
  }
}

/// Oracle 4: the power received is the power sent, which the linear terms share in.
TEST(LinearEnergy, ReceivedIsSent) {
  for (const char* spec : {"cornell-box", "rooms"}) {
    for (const Scheme scheme : {Scheme::fixed, Scheme::growing, Scheme::conjugate_gradients}) {
      SolveOptions options = linear(256);
      options.scheme = scheme;
      const Solution solution = solve(load_scene(spec), options);
      EXPECT_LE(solution.statistics.energy_defect, 1e-13) << spec << name_of(scheme);
      EXPECT_NEAR(solution.statistics.energy_balance, 1, 1e-2) << spec;
      EXPECT_GT(largest_part(solution), 0.01) << spec;
    }
  }
}

/// The same from kept sums, from passes in every iteration, and by conjugate gradients.
TEST(LinearSchemes, LeadToTheSameFunction) {
  const auto scene = load_scene("cornell-box");
  SolveOptions options = linear(64);
  options.tolerance = 1e-12;
  const Solution kept = solve(scene, options);
  EXPECT_TRUE(kept.statistics.kept_form_factors);
  const auto expect_same = [&](const SolveOptions& other, double accuracy) {
    const Solution solution = solve(scene, other);
    for (PatchId i = 0; i < scene->patch_count(); ++i) {
      EXPECT_NEAR(max_abs(at(solution.radiosity, i) - at(kept.radiosity, i)), 0, accuracy);
      EXPECT_NEAR(max_abs(at(solution.linear_terms, i).first - at(kept.linear_terms, i).first), 0,
                  accuracy);
      EXPECT_NEAR(max_abs(at(solution.linear_terms, i).second - at(kept.linear_terms, i).second), 0,
                  accuracy);
    }
  };
  SolveOptions again = options;
  again.memory = 1000;
  expect_same(again, 1e-11);
  SolveOptions gradients = options;
  gradients.scheme = Scheme::conjugate_gradients;
  expect_same(gradients, 1e-9);
  SolveOptions growing = options;
  growing.scheme = Scheme::growing;
  expect_same(growing, 1e-9);
  SolveOptions threads = options;
  threads.threads = 3;
  expect_same(threads, 0);
  SolveOptions local = options;
  local.engine = Engine::local;
  expect_same(local, 1e-10);
}

/// Form factor from a point with the normal +z to the rectangle (x0, x1) × (y0, y1) at height h, in
/// closed form: Lambert's sum over the edges.
double point_to_rectangle(double x, double y, double h, double x0, double x1, double y0,
                          double y1) {
  const std::array<Vec3, 4> corners{Vec3{x0 - x, y0 - y, h}, Vec3{x1 - x, y0 - y, h},
                                    Vec3{x1 - x, y1 - y, h}, Vec3{x0 - x, y1 - y, h}};
  double sum = 0;
  for (std::size_t k = 0; k < 4; ++k) {
    const Vec3 a = normalized(corners[k]), b = normalized(corners[(k + 1) % 4]);
    const Vec3 normal = cross(a, b);
    sum += std::atan2(norm(normal), dot(a, b)) * normal.z / norm(normal);
  }
  return sum / (2 * std::numbers::pi);
}

/// Oracle 6: the irradiance from a rectangle at points of another, integrated against the basis by
/// Gauss points.
TEST(LinearClosedForms, IrradianceFromARectangleIntegratedAgainstTheBasis) {
  Sketch sketch;
  const int dark = sketch.material(0.5, 0), light = sketch.material(0, 1);
  sketch.face({{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {0, 1, 0}}, dark);
  sketch.face({{1, 0, 1}, {1, 1, 1}, {3, 1, 1}, {3, 0, 1}}, light);
  const auto scene = sketch.scene();
  const LinearBasis basis = linear_basis(*scene, 0);
  double expected[3] = {};
  constexpr int points = 200;
  for (int i = 0; i < points; ++i) {
    for (int k = 0; k < points; ++k) {
      const double x = 2 * (i + 0.5) / points, y = (k + 0.5) / points;
      const double h = point_to_rectangle(x, y, 1, 1, 3, 0, 1) / (points * points);
      const auto phi = basis.at({x, y, 0});
      expected[0] += h;
      expected[1] += h * phi[0];
      expected[2] += h * phi[1];
    }
  }
  EXPECT_GT(std::abs(expected[1]), 0.03);  // the light is not above the middle
  for (const auto& [directions, accuracy] : {std::pair{1000, 1e-3}, {30000, 8e-5}}) {
    const Solution solution = solve(scene, linear(directions));
    EXPECT_NEAR(solution.irradiance[0].r, expected[0], accuracy);
    EXPECT_NEAR(solution.linear_terms[0].first.r, 0.5 * expected[1], accuracy);
    EXPECT_NEAR(solution.linear_terms[0].second.r, 0.5 * expected[2], accuracy);
    // E is constant.
    EXPECT_EQ(solution.linear_terms[1].first.r, 0);
    EXPECT_EQ(solution.radiosity[1].r, 1);
  }
}

/// L2 error of B on the unit square z = 0 below a rectangle, over the L2 norm of B.
double error_below_a_rectangle(Basis basis, double max_patch_area) {
  Sketch sketch;
  const int dark = sketch.material(0.5, 0), light = sketch.material(0, 1);
  sketch.face({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, dark);
  sketch.face({{0.2, 0.9, 0.8}, {0.8, 0.9, 0.8}, {0.8, 0.3, 0.8}, {0.2, 0.3, 0.8}}, light);
  const auto scene = sketch.scene({.max_patch_area = max_patch_area});
  const Solution solution = solve(scene, {.directions = 8192, .basis = basis});
  double errors = 0, values = 0;
  for (PatchId i = 0; i < scene->patch_count(); ++i) {
    if (scene->exitance(i).r > 0) {
      continue;
    }
    Bounds box;
    for (const PointId p : scene->outline(i)) {
      box.add(scene->point(p));
    }
    const LinearBasis functions = linear_basis(*scene, i);
    constexpr int points = 20;
    for (int k = 0; k < points * points; ++k) {
      const int column = k % points, row = k / points;
      const double x = box.low.x + (box.high.x - box.low.x) * (column + 0.5) / points;
      const double y = box.low.y + (box.high.y - box.low.y) * (row + 0.5) / points;
      const double expected = 0.5 * point_to_rectangle(x, y, 0.8, 0.2, 0.8, 0.3, 0.9);
      double b = at(solution.radiosity, i).r;
      if (basis == Basis::linear) {
        const auto phi = functions.at({x, y, 0});
        b += phi[0] * at(solution.linear_terms, i).first.r +
             phi[1] * at(solution.linear_terms, i).second.r;
      }
      const double weight = scene->patch(i).area;
      errors += weight * (b - expected) * (b - expected);
      values += weight * expected * expected;
    }
  }
  return std::sqrt(errors / values);
}

/// Where light is smooth, halving the patches' size divides the error by 4 instead of 2.
TEST(LinearConvergence, IsOfSecondOrderWhereLightIsSmooth) {
  const double coarse = error_below_a_rectangle(Basis::linear, 0.25);
  const double fine = error_below_a_rectangle(Basis::linear, 0.0625);
  EXPECT_NEAR(coarse / fine, 4, 0.5);
  EXPECT_LT(coarse, 0.05);
  const double coarse_steps = error_below_a_rectangle(Basis::constant, 0.25);
  const double fine_steps = error_below_a_rectangle(Basis::constant, 0.0625);
  EXPECT_NEAR(coarse_steps / fine_steps, 2, 0.2);
  EXPECT_LT(8 * fine, fine_steps);
}

/// Oracle 5: a patch cut by hand gets the same function. Where it receives only from lamps, the
/// projection of the parts' functions onto the functions of the whole is its function.
TEST(LinearInvariance, APatchCutByHandHasTheSameFunction) {
  const auto scene = [](bool cut) {
    Sketch sketch;
    const int lamp = sketch.material(0, 1), black = sketch.material(0, 0),
              gray = sketch.material(0.5, 0);
    sketch.face({{0.2, 0.2, 1}, {0.2, 0.9, 1}, {1.4, 0.9, 1}, {1.4, 0.2, 1}}, lamp);
    sketch.face({{1, 0.3, 0.4}, {2, 0.3, 0.6}, {1.5, 1, 0.5}}, black);
    if (cut) {
      sketch.face({{0, 0, 0}, {1.3, 0, 0}, {0.7, 1, 0}, {0, 1, 0}}, gray);
      sketch.face({{1.3, 0, 0}, {2, 0, 0}, {0.7, 1, 0}}, gray);
      sketch.face({{2, 0, 0}, {2, 1, 0}, {0.7, 1, 0}}, gray);
    } else {
      sketch.face({{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {0, 1, 0}}, gray);
    }
    return sketch.scene();
  };
  constexpr PatchId first = 2;
  const Solution whole = solve(scene(false), linear(500)), parts = solve(scene(true), linear(500));
  const LinearBasis basis = linear_basis(*whole.scene, first);
  std::array<double, 3> projected{};
  for (PatchId k = first; k < parts.scene->patch_count(); ++k) {
    // ∫ B phi_a over the triangles of a part, by the midpoints of their edges: exact for products
    // of linear functions.
    const LinearBasis own = linear_basis(*parts.scene, k);
    const auto outline = parts.scene->outline(k);
    for (std::size_t c = 2; c < outline.size(); ++c) {
      const Vec3 &p = parts.scene->point(outline[0]), &q = parts.scene->point(outline[c - 1]),
                 &r = parts.scene->point(outline[c]);
      const double weight = norm(cross(q - p, r - p)) / 2 / 3;
      for (const Vec3& x : {0.5 * (p + q), 0.5 * (q + r), 0.5 * (r + p)}) {
        const auto psi = own.at(x), phi = basis.at(x);
        const double b = at(parts.radiosity, k).r + psi[0] * at(parts.linear_terms, k).first.r +
                         psi[1] * at(parts.linear_terms, k).second.r;
        projected[0] += weight * b;
        projected[1] += weight * b * phi[0];
        projected[2] += weight * b * phi[1];
      }
    }
  }
  const double area = whole.scene->patch(first).area;
  EXPECT_NEAR(projected[0] / area, at(whole.radiosity, first).r, 1e-12);
  EXPECT_NEAR(projected[1] / area, at(whole.linear_terms, first).first.r, 1e-12);
  EXPECT_NEAR(projected[2] / area, at(whole.linear_terms, first).second.r, 1e-12);
  EXPECT_GT(std::abs(at(whole.linear_terms, first).first.r), 0.01);
  EXPECT_GT(std::abs(at(whole.linear_terms, first).second.r), 0.001);
}

/// Half of a patch below a screen: the Galerkin projection of a step. B falls below 0 at the dark
/// end, is kept so, and is counted.
TEST(LinearCorners, BelowZeroAreKeptAndCounted) {
  Sketch sketch;
  const int dark = sketch.material(0.5, 0), light = sketch.material(0, 1),
            black = sketch.material(0, 0);
  sketch.face({{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {0, 1, 0}}, dark);
  sketch.face({{1.7, 0, 0.2}, {1.7, 1, 0.2}, {2, 1, 0.2}, {2, 0, 0.2}}, light);
  sketch.face({{-1, -1, -1}, {-1, 2, -1}, {3, 2, -1}, {3, -1, -1}}, black);
  const Solution solution = solve(sketch.scene(), linear(2000));
  const std::vector<Rgb> corners = corner_radiosity(solution, 0);
  EXPECT_LT(corners[0].r, 0);
  EXPECT_LT(corners[3].r, 0);
  EXPECT_GT(corners[1].r, 0);
  EXPECT_EQ(solution.statistics.negative_corners, 2);
}

/// Oracle 4b: a uniform sky is a black enclosure of its exitance.
TEST(LinearSky, IsLikeAnEnclosure) {
  const auto scene = [](bool enclosed) {
    Sketch sketch;
    const int gray = sketch.material(0.6, 0.2), sky = sketch.material(0, 1);
    sketch.box({0, 0, 0}, {1, 1, 1}, false, gray);
    sketch.face({{-1, 0, -0.5}, {2, 0, -0.5}, {2, 1, -0.5}, {-1, 1, -0.5}}, gray);
    sketch.face({{-1, 1, -0.5}, {2, 1, -0.5}, {2, 0, -0.5}, {-1, 0, -0.5}}, gray);
    if (enclosed) {
      sketch.box({-9, -9, -9}, {9, 9, 9}, true, sky);
    }
    return sketch.scene();
  };
  for (const Normalization normalize : {Normalization::none, Normalization::rows}) {
    SolveOptions options = linear(200);
    options.normalize = normalize;
    options.tolerance = 1e-12;
    const Solution enclosed = solve(scene(true), options);
    options.sky.exitance = {1, 1, 1};
    const Solution open = solve(scene(false), options);
    for (PatchId i = 0; i < open.scene->patch_count(); ++i) {
      EXPECT_NEAR(at(open.radiosity, i).r, at(enclosed.radiosity, i).r, 1e-10);
      EXPECT_NEAR(at(open.linear_terms, i).first.r, at(enclosed.linear_terms, i).first.r, 1e-10);
      EXPECT_NEAR(at(open.linear_terms, i).second.r, at(enclosed.linear_terms, i).second.r, 1e-10);
    }
  }
}

/// The RMS over the patches of the difference between the functions, divided by the RMS of the
/// light that `known` reflects. The basis is orthogonal, with the same norm for all three
/// (linear_basis.h).
double error_of_functions(const Solution& solution, const Solution& known) {
  double error = 0, reflected = 0;
  const auto add = [&](const Rgb& a, const Rgb& b, const Rgb& emitted) {
    const Rgb off = a - b, all = b - emitted;
    error += off.r * off.r + off.g * off.g + off.b * off.b;
    reflected += all.r * all.r + all.g * all.g + all.b * all.b;
  };
  for (PatchId i = 0; i < known.scene->patch_count(); ++i) {
    add(at(solution.radiosity, i), at(known.radiosity, i), known.scene->exitance(i));
    add(at(solution.linear_terms, i).first, at(known.linear_terms, i).first, {});
    add(at(solution.linear_terms, i).second, at(known.linear_terms, i).second, {});
  }
  return std::sqrt(error / reflected);
}

/// Replicas estimate the errors of the functions.
TEST(LinearReplicas, EstimateTheError) {
  SolveOptions options = linear(256);
  options.replicas = 8;
  const auto scene = load_scene("cornell-box");
  const Solution solution = solve(scene, options);
  ASSERT_EQ(solution.error.standard_error.size(), scene->patches().size());
  // The error against many more directions, over the reflected light; 90 % of all are in between.
  const double error = error_of_functions(solution, solve(scene, linear(4096)));
  EXPECT_GT(error, solution.error.rms_lowest);
  EXPECT_LT(error, solution.error.rms_limit);
}

/// A state that is saved and restored leads to the same bits.
TEST(LinearState, IsRestoredToTheSameBits) {
  const auto scene = load_scene("cornell-box");
  for (const int replicas : {1, 4}) {
    SolveOptions options = linear(60);
    options.replicas = replicas;
    RadiositySolver solver(scene, options);
    for (int k = 0; k < 17; ++k) {
      solver.advance(RadiositySolver::Until::direction);
    }
    std::ostringstream saved;
    solver.save(saved);
    RadiositySolver restored(scene, options);
    std::istringstream in(saved.str());
    restored.restore(in, saved.str().size());
    const auto finished = [](RadiositySolver& of) {
      of.advance(RadiositySolver::Until::finished);
      return of.solution();
    };
    const Solution a = finished(solver), b = finished(restored);
    EXPECT_EQ(a.radiosity, b.radiosity);
    for (std::size_t i = 0; i < a.linear_terms.size(); ++i) {
      EXPECT_EQ(a.linear_terms[i].first, b.linear_terms[i].first);
      EXPECT_EQ(a.linear_terms[i].second, b.linear_terms[i].second);
    }
  }
}

/// The means of a linear solve of form factors that constant functions have: F_ij are the same.
TEST(LinearFormFactors, AreThoseOfConstantFunctions) {
  const auto scene = load_scene("cornell-box");
  const auto factors = [&](Basis basis) {
    SolveOptions options = linear(32);
    options.basis = basis;
    RadiositySolver solver(scene, options);
    solver.advance(RadiositySolver::Until::finished);
    return solver.form_factors();
  };
  const FormFactors linear_factors = factors(Basis::linear), constant = factors(Basis::constant);
  EXPECT_EQ(linear_factors.row_begin, constant.row_begin);
  EXPECT_EQ(linear_factors.source, constant.source);
  EXPECT_EQ(linear_factors.value, constant.value);
}

}  // namespace
}  // namespace transillum::linear_radiosity_test
