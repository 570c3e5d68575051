// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Form factors with moments (ALGORITHM.md 6.12): what a solve with linear functions keeps, relit,
// stored, summed by part, and scaled by the symmetric normalization.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "radiosity/analysis/power_table.h"
#include "radiosity/form_factors/small_form_factors.h"
#include "support/refusal.h"
#include "support/scenes.h"
#include "support/temporary_folder.h"
#include "transillum/at.h"
#include "transillum/files.h"
#include "transillum/form_factor_solve.h"
#include "transillum/radiosity_solver.h"
#include "transillum/relight.h"
#include "transillum/solve_session.h"

namespace transillum::linear_form_factors_test {
namespace {

using ::testing::HasSubstr;
using testing::Sketch;

SolveOptions options_of(int directions, Normalization normalize = Normalization::none) {
  return {.directions = directions,
          .normalize = normalize,
          .basis = Basis::linear,
          .first_shot = {},
          .tolerance = 1e-12};
}

/// A solution with the form factors of its solve.
Solution solved(const std::shared_ptr<const Scene>& scene, const SolveOptions& options,
                std::shared_ptr<const DirectLight>* shot = nullptr) {
  RadiositySolver solver(scene, options);
  solver.advance(RadiositySolver::Until::finished);
  Solution solution = solver.solution();
  solution.form_factors = std::make_shared<const FormFactors>(solver.form_factors());
  if (shot != nullptr) {
    *shot = solver.direct_light();
  }
  return solution;
}

/// The largest difference of B as a function, in coefficients.
double difference(const std::vector<Rgb>& radiosity, const std::vector<LinearTerm>& parts,
                  const Solution& other) {
  double largest = parts.size() == other.linear_terms.size() ? 0 : HUGE_VAL;
  for (std::size_t i = 0; i < std::min(parts.size(), other.linear_terms.size()); ++i) {
    largest = std::max({largest, max_abs(radiosity[i] - other.radiosity[i]),
                        max_abs(parts[i].first - other.linear_terms[i].first),
                        max_abs(parts[i].second - other.linear_terms[i].second)});
  }
  return largest;
}

double difference(const Solution& a, const Solution& b) {
  return difference(a.radiosity, a.linear_terms, b);
}

/// The index of entry (i, j).
std::size_t entry_of(const FormFactors& f, PatchId i, PatchId j) {
  const auto row = static_cast<std::size_t>(i);
  std::size_t k = f.row_begin[row];
  while (k < f.row_begin[row + 1] && f.source[k] != j) {
    ++k;
  }
  return k;
}

/// The largest difference of A_i T^ab(i,j) and A_j T^ba(j,i).
double irreciprocity(const Scene& scene, const FormFactors& f) {
  double largest = 0;
  for (PatchId i = 0; i < scene.patch_count(); ++i) {
    const auto row = static_cast<std::size_t>(i);
    for (std::size_t k = f.row_begin[row]; k < f.row_begin[row + 1]; ++k) {
      const PatchId j = f.source[k];
      const TransferMoments &here = f.moments[k], &there = f.moments[entry_of(f, j, i)];
      for (std::size_t a = 0; a < 3; ++a) {
        for (std::size_t b = 0; b < 3; ++b) {
          largest = std::max(largest, std::abs(scene.patch(i).area * here.of(a, b) -
                                               scene.patch(j).area * there.of(b, a)));
        }
      }
    }
  }
  return largest;
}

/// Sums of the rows over phi_0 of the sources.
std::vector<std::array<double, 3>> row_sums(const FormFactors& f) {
  std::vector<std::array<double, 3>> sums(f.row_begin.size() - 1);
  for (std::size_t i = 0; i < sums.size(); ++i) {
    for (std::size_t k = f.row_begin[i]; k < f.row_begin[i + 1]; ++k) {
      for (std::size_t a = 0; a < 3; ++a) {
        sums[i][a] += f.moments[k].of(a, 0);
      }
    }
  }
  return sums;
}

constexpr Normalization normalizations[] = {Normalization::none, Normalization::rows,
                                            Normalization::symmetric};

TEST(LinearFormFactors, IteratedTheyGiveTheSolve) {
  const auto scene = load_scene("cornell-box");
  for (const Normalization normalize : normalizations) {
    SolveOptions options = options_of(64, normalize);
    options.replicas = 2;
    const Solution solution = solved(scene, options);
    const FormFactors& f = *solution.form_factors;
    ASSERT_EQ(f.moments.size(), f.size());
    for (std::size_t k = 0; k < f.size(); ++k) {
      EXPECT_NEAR(f.moments[k].of(0, 0), f.value[k], 1e-14);
      EXPECT_GT(f.value[k], 0);
    }
    SolveOptions again;
    again.basis = Basis::linear;
    again.tolerance = 1e-12;
    EXPECT_LT(difference(solve_with_form_factors(scene, f, again), solution), 1e-10)
        << name_of(normalize);
  }
  SolveOptions one_way = options_of(64);
  one_way.two_way = false;
  const Solution solution = solved(scene, one_way);
  EXPECT_LT(difference(solve_with_form_factors(scene, *solution.form_factors, options_of(1024)),
                       solution),
            1e-10);
}

TEST(LinearFormFactors, AreReciprocal) {
  for (const char* spec : {"cornell-box", "rooms"}) {
    const auto scene = load_scene(spec);
    for (const Normalization normalize : {Normalization::none, Normalization::symmetric}) {
      EXPECT_LT(irreciprocity(*scene, *solved(scene, options_of(48, normalize)).form_factors),
                1e-14)
          << spec << name_of(normalize);
    }
  }
}

SceneDescription with_other_materials(SceneDescription description) {
  for (Material& material : description.materials) {
    const bool emits = max_abs(material.exitance) > 0;
    material.exitance = emits ? Rgb{3, 0, 20} : material.exitance;
    material.reflectance = {0.2, 0.9, material.reflectance.r};
  }
  return description;
}

TEST(LinearFormFactors, RelitTheyGiveASolveWithTheOtherMaterials) {
  const SceneDescription description = describe_scene("cornell-box:open=1");
  const SceneDescription changed = with_other_materials(description);
  const auto scene = std::make_shared<const Scene>(description);
  const auto other = std::make_shared<const Scene>(changed);
  for (const Normalization normalize : normalizations) {
    for (const bool shot_first : {false, true}) {
      SolveOptions options = options_of(100, normalize);
      options.sky = {.exitance = {1, 2, 3}, .model = SkyModel::cie_overcast, .up = {0, 0, -1}};
      options.first_shot = shot_first ? std::optional(0.0) : std::nullopt;
      std::shared_ptr<const DirectLight> shot;
      const Solution before = solved(scene, options, &shot), after = solved(other, options);
      ASSERT_EQ(before.sky_linear_terms.size(), scene->patches().size());
      RelightOptions relit{.tolerance = 1e-12,
                           .start = before.radiosity,
                           .start_linear_terms = before.linear_terms,
                           .shot = shot.get(),
                           .sky_irradiance = before.sky_irradiance,
                           .sky_linear_terms = before.sky_linear_terms,
                           .basis = Basis::linear};
      const RelightResult result = relight(*scene, *before.form_factors, changed.materials, relit);
      EXPECT_LT(difference(result.radiosity, result.linear_terms, after), 1e-9)
          << name_of(normalize) << shot_first;
      EXPECT_GT(difference(before, after), 0.1);
      relit.threads = 3;
      EXPECT_EQ(relight(*scene, *before.form_factors, changed.materials, relit).radiosity,
                result.radiosity);
    }
  }
}

TEST(LinearFormFactors, WithoutMomentsAreRefusedForLinearFunctions) {
  const auto scene = load_scene("furnace");
  FormFactors f = *solved(scene, options_of(8)).form_factors;
  f.moments.clear();
  EXPECT_THAT(
      test::refusal([&] { relight(*scene, f, scene->materials(), {.basis = Basis::linear}); }),
      HasSubstr("no moments for linear functions"));
  f.moments.resize(1);
  EXPECT_THAT(test::refusal([&] { relight(*scene, f, scene->materials()); }),
              HasSubstr("1 moments for"));
  Solution solution = solved(scene, options_of(8));
  f.moments.clear();
  EXPECT_THAT(test::refusal([&] { power_table(solution, SurfaceKind::material, &f); }),
              HasSubstr("no moments"));
}

TEST(LinearFormFactors, FilesKeepMomentsBitForBit) {
  const test::TemporaryFolder folder;
  const auto scene = load_scene("cornell-box");
  const FormFactors f = *solved(scene, options_of(16)).form_factors;
  for (const char* name : {"f.npz", "f.mtx"}) {
    write_form_factors(folder / name, *scene, f);
    const StoredFormFactors stored = read_form_factors(folder / name);
    EXPECT_EQ(test::refusal([&] { check_form_factors(*scene, stored); }), "");
    EXPECT_EQ(stored.form_factors.value, f.value);
    ASSERT_EQ(stored.form_factors.moments.size(), f.moments.size());
    for (std::size_t k = 0; k < f.size(); ++k) {
      std::array<double, 9> expected = f.moments[k].value;
      if (std::string(name) == "f.mtx") {
        expected[0] = f.value[k];
      }
      EXPECT_EQ(stored.form_factors.moments[k].value, expected) << name << k;
    }
  }
  EXPECT_THAT(test::refusal([&] { write_form_factors(folder / "f.vf", *scene, f); }),
              HasSubstr("has no moments"));
  FormFactors damaged = f;
  damaged.moments[3].of(1, 2) = std::numeric_limits<double>::quiet_NaN();
  write_form_factors(folder / "nan.npz", *scene, damaged);
  EXPECT_THAT(test::refusal([&] { read_form_factors(folder / "nan.npz"); }),
              HasSubstr("is not finite"));
  damaged = f;
  damaged.moments.pop_back();
  write_form_factors(folder / "short.npz", *scene, damaged);
  EXPECT_THAT(test::refusal([&] { read_form_factors(folder / "short.npz"); }),
              HasSubstr("moments for"));
}

TEST(LinearFormFactors, TinyOnesAreOmittedWithTheirMoments) {
  const auto scene = load_scene("cornell-box");
  const FormFactors f = *solved(scene, options_of(64)).form_factors;
  const FormFactors rest = drop_small_form_factors(*scene, f, 3e-3).form_factors;
  EXPECT_LT(rest.size(), f.size());
  ASSERT_EQ(rest.moments.size(), rest.size());
  for (std::size_t k = 0; k < rest.size(); ++k) {
    EXPECT_NEAR(rest.moments[k].of(0, 0), rest.value[k], 1e-14);
  }
  EXPECT_LT(irreciprocity(*scene, rest), 1e-12);
}

/// Without sky and shot, what arrives from all parts is all that a part receives.
TEST(LinearFormFactors, ExchangesOfPartsSumToWhatIsReceived) {
  const auto scene = load_scene("rooms");
  const Solution passes = solved(scene, options_of(64));
  SolveOptions by_pairs{.engine = Engine::pairs, .basis = Basis::linear, .tolerance = 1e-12};
  by_pairs.engine_options.points = 4;
  for (const Solution& solution : {passes, solve_by_form_factors(scene, by_pairs)}) {
    const PowerTable table =
        power_table(solution, SurfaceKind::material, solution.form_factors.get());
    ASSERT_EQ(table.exchanged.size(), table.surfaces.size());
    for (std::size_t p = 0; p < table.surfaces.size(); ++p) {
      Rgb sum;
      for (const Rgb& power : table.exchanged[p]) {
        sum += power;
      }
      EXPECT_NEAR(max_abs(sum - table.surfaces[p].received), 0,
                  1e-8 * max_abs(table.surfaces[p].received));
    }
  }
}

/// Oracle 3 with reciprocity: all rows of a closed scene sum to 1, and rows of moments to 0.
TEST(LinearSymmetric, RowsOfClosedScenesAddUp) {
  for (const char* spec : {"furnace", "cornell-box", "rooms"}) {
    const auto scene = load_scene(spec);
    const Solution solution = solved(scene, options_of(48, Normalization::symmetric));
    for (const std::array<double, 3>& sum : row_sums(*solution.form_factors)) {
      EXPECT_NEAR(sum[0], 1, 2e-9) << spec;
      EXPECT_NEAR(sum[1], 0, 2e-9) << spec;
      EXPECT_NEAR(sum[2], 0, 2e-9) << spec;
    }
    EXPECT_LE(solution.statistics.energy_defect, 1e-12) << spec;
    EXPECT_NEAR(solution.statistics.energy_balance, 1, 1e-8) << spec;
  }
}

TEST(LinearSymmetric, LeavesTheFurnaceConstant) {
  const Solution solution = solved(load_scene("furnace", {.max_patch_area = 0.3}),
                                   options_of(24, Normalization::symmetric));
  for (std::size_t i = 0; i < solution.radiosity.size(); ++i) {
    EXPECT_NEAR(solution.radiosity[i].g, 2, 1e-8);
    EXPECT_NEAR(solution.linear_terms[i].first.g, 0, 1e-8);
    EXPECT_NEAR(solution.linear_terms[i].second.g, 0, 1e-8);
  }
}

TEST(LinearSymmetric, ConjugateGradientsAndThreadsGiveTheSame) {
  const auto scene = load_scene("cornell-box");
  SolveOptions options = options_of(64, Normalization::symmetric);
  const Solution fixed = solved(scene, options);
  options.threads = 3;
  EXPECT_EQ(difference(solved(scene, options), fixed), 0);
  options.scheme = Scheme::conjugate_gradients;
  EXPECT_LT(difference(solved(scene, options), fixed), 1e-9);
  options.first_shot = 0;
  const Solution shot_by_gradients = solved(scene, options);
  options.scheme = Scheme::fixed;
  EXPECT_LT(difference(solved(scene, options), shot_by_gradients), 1e-9);
}

/// Oracle 4b.
TEST(LinearSymmetric, ASkyIsLikeAnEnclosure) {
  const auto scene = [](bool enclosed) {
    Sketch sketch;
    const int gray = sketch.material(0.6, 0.2), sky = sketch.material(0, 1);
    sketch.box({0, 0, 0}, {1, 1, 1}, false, gray);
    if (enclosed) {
      sketch.box({-9, -9, -9}, {9, 9, 9}, true, sky);
    }
    return sketch.scene();
  };
  SolveOptions options = options_of(200, Normalization::symmetric);
  const Solution enclosed = solved(scene(true), options);
  options.sky.exitance = {1, 1, 1};
  const Solution open = solved(scene(false), options);
  for (std::size_t i = 0; i < open.radiosity.size(); ++i) {
    EXPECT_NEAR(open.radiosity[i].r, 0.8, 1e-8);
    EXPECT_NEAR(enclosed.radiosity[i].r, 0.8, 1e-7);
    EXPECT_NEAR(open.linear_terms[i].first.r, 0, 1e-8);
  }
}

/// An open scene whose patches see others from one edge: sums are right, and all stays finite.
TEST(LinearSymmetric, OpenScenesKeepTheirSums) {
  for (const char* spec : {"boards", "cornell-box:open=1"}) {
    const auto scene = load_scene(spec);
    const Solution symmetric = solved(scene, options_of(200, Normalization::symmetric));
    const Solution rows = solved(scene, options_of(200, Normalization::rows));
    const auto expected = row_sums(*rows.form_factors), sums = row_sums(*symmetric.form_factors);
    for (std::size_t i = 0; i < sums.size(); ++i) {
      EXPECT_NEAR(sums[i][0], expected[i][0], 1e-4) << spec << i;
    }
    for (const double value : symmetric.form_factors->value) {
      EXPECT_GT(value, 0) << spec;
    }
    EXPECT_LT(difference(symmetric, rows), 0.05) << spec;
  }
}

}  // namespace
}  // namespace transillum::linear_form_factors_test
