// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
// One row of the form factors, recomputed from the directions of a solve, against the kept ones.
#include "radiosity/form_factors/receiver_row.h"

#include <gtest/gtest.h>

#include <cmath>

#include "support/scenes.h"
#include "transillum/at.h"
#include "transillum/radiosity_solver.h"
#include "transillum/sun.h"

namespace transillum::receiver_row_test {
namespace {

/// The scene of each case has all kinds of neighbors: closed, open, and with shared planes.
void expect_row_of_solve(const char* scene_name, const SolveOptions& options) {
  const auto scene = load_scene(scene_name, {.max_patch_area = 0.2});
  RadiositySolver solver(scene, options);
  solver.advance(RadiositySolver::Until::finished);
  const FormFactors kept = solver.form_factors();
  for (PatchId i = 0; i < scene->patch_count(); i += 1 + scene->patch_count() / 7) {
    const ReceiverRow expected = row_of(kept, i);
    const ReceiverRow row =
        receiver_row(scene, solver.shared_tree(), i, solver.directions(), options);
    ASSERT_EQ(row.moments.size(), expected.moments.empty() ? 0 : row.source.size());
    double sum = 0, expected_sum = 0;
    for (std::size_t k = 0; k < expected.source.size(); ++k) {
      const auto found = std::lower_bound(row.source.begin(), row.source.end(), expected.source[k]);
      const bool has = found != row.source.end() && *found == expected.source[k];
      const auto index = static_cast<std::size_t>(found - row.source.begin());
      EXPECT_NEAR(has ? row.value[index] : 0, expected.value[k], 1e-13) << i;
      for (std::size_t b = 0; b < 2 && has && !expected.moments.empty(); ++b) {
        EXPECT_NEAR(row.moments[index][b], expected.moments[k][b], 1e-12) << i;
      }
      expected_sum += expected.value[k];
    }
    for (const double value : row.value) {
      sum += value;
    }
    EXPECT_NEAR(sum, expected_sum, 1e-12);
  }
}

TEST(ReceiverRow, IsTheRowOfTheKeptFormFactors) {
  for (const char* scene : {"cornell-box", "boards", "stars"}) {
    SCOPED_TRACE(scene);
    expect_row_of_solve(scene, {.directions = 24});
    expect_row_of_solve(scene, {.directions = 24, .normalize = Normalization::none});
  }
  expect_row_of_solve("cornell-box", {.directions = 24, .two_way = false});
  expect_row_of_solve("cornell-box", {.directions = 24, .replicas = 3});
  expect_row_of_solve("cornell-box", {.directions = 24, .basis = Basis::linear});
  expect_row_of_solve("cornell-box", {.directions = 8, .engine = Engine::local});
  expect_row_of_solve("cornell-box", {.directions = 8, .seed = 5, .engine = Engine::rays});
}

TEST(ReceiverRow, HasTheSunOfItsPatch) {
  SolveOptions options{.directions = 8};
  options.sky.sun = {{1000, 900, 800}, normalized(Vec3{0.3, 0.2, -0.9})};
  for (const bool disc : {false, true}) {
    options.sky.sun.disc = disc;
    const auto scene = load_scene("cornell-box:open=1", {.max_patch_area = 0.3});
    RadiositySolver solver(scene, options);
    solver.advance(RadiositySolver::Until::finished);
    double lit = 0;
    for (PatchId i = 0; i < scene->patch_count(); ++i) {
      const Rgb sun = sun_on_patch(scene, solver.shared_tree(), i, options);
      const Rgb expected = at(solver.sky_irradiance(), i);  // there is no other sky
      EXPECT_NEAR(sun.r, expected.r, 1e-9);
      EXPECT_NEAR(sun.b, expected.b, 1e-9);
      lit += sun.r;
    }
    EXPECT_GT(lit, 0);
  }
}

TEST(ReceiverRow, RefusesTheSymmetricNormalization) {
  const auto scene = load_scene("furnace");
  const auto tree = std::make_shared<const BspTree>(*scene);
  EXPECT_THROW(receiver_row(scene, tree, 0, {}, {.normalize = Normalization::symmetric}),
               std::invalid_argument);
}

}  // namespace
}  // namespace transillum::receiver_row_test
