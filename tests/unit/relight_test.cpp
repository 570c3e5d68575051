// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// relight() against solves with the other materials.
#include "transillum/relight.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>

#include "radiosity/form_factors/light_paths.h"
#include "support/canceled.h"
#include "transillum/adjoint.h"
#include "transillum/at.h"
#include "transillum/engine.h"
#include "transillum/material_changes.h"
#include "transillum/radiosity_solver.h"
#include "transillum/solution.h"
#include "transillum/solve_options.h"

namespace transillum::relight_test {
namespace {

using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

constexpr double tight = 1e-12;

struct Solved {
  std::shared_ptr<const Scene> scene;
  FormFactors form_factors;
  std::shared_ptr<const DirectLight> shot;
  std::vector<Rgb> radiosity, irradiance;
};

Solved solved(const SceneDescription& description, const SolveOptions& options,
              const std::vector<PatchId>* sources = nullptr) {
  Solved result;
  result.scene = std::make_shared<const Scene>(description);
  if (sources) {
    result.shot = std::make_shared<const DirectLight>(shoot(*result.scene, *sources));
  }
  RadiositySolver solver(result.scene, options, {.shot = result.shot});
  solver.keep_form_factors();
  solver.advance(RadiositySolver::Until::finished);
  result.form_factors = solver.form_factors();
  result.shot = solver.direct_light();
  result.radiosity = solver.radiosity();
  result.irradiance = solver.irradiance();
  return result;
}

/// The scene's materials with another light and another wall.
std::vector<Material> other(std::vector<Material> materials) {
  for (Material& material : materials) {
    const bool emits = max_abs(material.exitance) > 0;
    material.exitance = emits ? Rgb{3, 0, 20} : material.exitance;
    material.reflectance = {0.2, 0.9, material.reflectance.r};
  }
  return materials;
}

void expect_same(const std::vector<Rgb>& a, const std::vector<Rgb>& b, double tolerance) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_LE(max_abs(a[i] - b[i]), tolerance * (1 + max_abs(b[i]))) << i;
  }
}

/// The light that comes from a sky depends on the geometry only.
TEST(Relight, KeepsTheLightOfASky) {
  const SceneDescription description = describe_scene("cornell-box:open=1");
  SceneDescription changed = description;
  changed.materials = other(description.materials);
  const SolveOptions options{
      .directions = 100,
      .first_shot = {},
      .tolerance = tight,
      .sky = {.exitance = {1, 2, 3}, .model = SkyModel::cie_overcast, .up = {0, 0, -1}}};
  const auto solution_of = [&](const SceneDescription& of) {
    RadiositySolver solver(std::make_shared<const Scene>(of), options);
    solver.advance(RadiositySolver::Until::finished);
    Solution solution = solver.solution();
    solution.form_factors = std::make_shared<const FormFactors>(solver.form_factors());
    return solution;
  };
  const Solution before = solution_of(description), after = solution_of(changed);
  double from_sky = 0;
  for (const Rgb& light : before.sky_irradiance) {
    from_sky = std::max(from_sky, max_abs(light));
  }
  ASSERT_GT(from_sky, 0.1);
  const RelightResult relit =
      relight(*before.scene, *before.form_factors, changed.materials,
              {.tolerance = tight, .sky_irradiance = before.sky_irradiance});
  expect_same(relit.radiosity, after.radiosity, 1e-10);
  expect_same(relit.irradiance, after.irradiance, 1e-10);
  // Light paths begin where the sky's light arrives first, and sum to B.
  const LightPaths paths =
      find_light_paths(*before.scene, *before.form_factors, 3, changed.materials,
                       {.tolerance = tight, .sky_irradiance = before.sky_irradiance});
  Rgb sum = paths.cut_off;
  for (const LightPath& path : paths.paths) {
    sum += path.contribution;
  }
  expect_same({sum}, {after.radiosity[3]}, 1e-10);
  // The contributions of the adjoint also sum to B.
  const Adjoint adjoint = solve_adjoint(*before.scene, *before.form_factors, 3, changed.materials,
                                        {.tolerance = tight});
  Rgb contributions;
  for (PatchId j = 0; j < before.scene->patch_count(); ++j) {
    const Material& material = at(changed.materials, before.scene->patch(j).material);
    contributions += before.scene->patch(j).area *
                     (at(adjoint.per_watt, j) *
                      (material.exitance + material.reflectance * at(before.sky_irradiance, j)));
  }
  expect_same({contributions}, {after.radiosity[3]}, 1e-10);
  const std::vector<Rgb> dark(before.sky_irradiance.size(), Rgb{-1, 0, 0});
  EXPECT_THAT(([&] {
                relight(*before.scene, *before.form_factors, changed.materials,
                        {.sky_irradiance = dark});
              }),
              ThrowsMessage<InputError>(HasSubstr("the light of the sky on patch 0 is -1 0 0")));
  const std::vector<Rgb> short_sky(1);
  EXPECT_THROW(relight(*before.scene, *before.form_factors, changed.materials,
                       {.sky_irradiance = short_sky}),
               InputError);
}

TEST(Relight, EqualsASolveWithTheOtherMaterials) {
  const SceneDescription description = describe_scene("cornell-box");
  SceneDescription changed = description;
  changed.materials = other(description.materials);
  for (const Normalization normalize :
       {Normalization::none, Normalization::rows, Normalization::symmetric}) {
    const SolveOptions options{
        .directions = 200, .normalize = normalize, .first_shot = {}, .tolerance = tight};
    const Solved before = solved(description, options), after = solved(changed, options);
    const RelightResult relit =
        relight(*before.scene, before.form_factors, changed.materials, {.tolerance = tight});
    expect_same(relit.radiosity, after.radiosity, 1e-10);
    expect_same(relit.irradiance, after.irradiance, 1e-10);
    EXPECT_GT(max_abs(after.radiosity[0] - before.radiosity[0]), 1e-3);
  }
}

TEST(Relight, EqualsASolveWithTheOtherMaterialsAfterAFirstShot) {
  int several = 0;
  for (const auto& [spec, ratio] : {std::pair("stars", small_source_ratio),
                                    std::pair("cornell-box", 0.0), std::pair("rooms", 0.0)}) {
    SCOPED_TRACE(spec);
    SceneDescription description = describe_scene(spec);
    // Sources of more than one material.
    if (ratio == 0) {
      description.materials.front().exitance = {0.5, 0.25, 0};
    }
    SceneDescription changed = description;
    changed.materials = other(description.materials);
    for (const Normalization normalize : {Normalization::none, Normalization::rows}) {
      SolveOptions options{
          .directions = 100, .normalize = normalize, .first_shot = {}, .tolerance = tight};
      options.first_shot = ratio;
      const Solved before = solved(description, options), after = solved(changed, options);
      ASSERT_FALSE(before.shot->sources.empty());
      several += before.shot->contributions.size() > 1;
      ASSERT_EQ(before.shot->sources, after.shot->sources);
      const RelightResult relit = relight(*before.scene, before.form_factors, changed.materials,
                                          {.tolerance = tight, .shot = before.shot.get()});
      expect_same(relit.radiosity, after.radiosity, 1e-10);
      expect_same(relit.irradiance, after.irradiance, 1e-10);
    }
  }
  EXPECT_GT(several, 0);
}

/// The material of each patch of `scene` in a description of the same faces.
std::vector<std::int32_t> patch_materials(const Scene& scene, const SceneDescription& description) {
  std::vector<std::int32_t> materials;
  for (const Patch& patch : scene.patches()) {
    materials.push_back(at(description.face_material, patch.face));
  }
  return materials;
}

TEST(Relight, EqualsASolveWithOtherMaterialsOfSomeFaces) {
  const SceneDescription description = describe_scene("cornell-box");
  SceneDescription changed = description;
  change_materials(changed, std::vector<MaterialChange>{{"face:3", {}, Rgb{4, 5, 6}},
                                                        {"face:7", Rgb{0.1, 0.8, 0.3}}});
  ASSERT_GT(changed.materials.size(), description.materials.size());
  const SolveOptions options{.directions = 200, .first_shot = {}, .tolerance = tight};
  const Solved before = solved(description, options), after = solved(changed, options);
  const auto of_patch = patch_materials(*before.scene, changed);
  const RelightResult relit = relight(*before.scene, before.form_factors, changed.materials,
                                      {.tolerance = tight, .patch_materials = of_patch});
  expect_same(relit.radiosity, after.radiosity, 1e-10);
  expect_same(relit.irradiance, after.irradiance, 1e-10);
  const std::vector<std::int32_t> few(3), wrong(before.scene->patches().size(), 99);
  EXPECT_THAT(([&] {
                relight(*before.scene, before.form_factors, changed.materials,
                        {.patch_materials = few});
              }),
              ThrowsMessage<InputError>(HasSubstr("number of patches differs")));
  EXPECT_THAT(([&] {
                relight(*before.scene, before.form_factors, changed.materials,
                        {.patch_materials = wrong});
              }),
              ThrowsMessage<InputError>(HasSubstr("a patch has material 99")));
}

TEST(Relight, RefusesSourcesOfOnePartOfTheShotThatDiffer) {
  SceneDescription description = describe_scene("cornell-box");
  const auto lamp = static_cast<std::int32_t>(
      std::find_if(description.materials.begin(), description.materials.end(),
                   [](const Material& material) { return max_abs(material.exitance) > 0; }) -
      description.materials.begin());
  description.face_material[0] = lamp;
  SolveOptions options{.directions = 100, .tolerance = tight};
  options.first_shot = 0;
  const Solved before = solved(description, options);
  ASSERT_GE(before.shot->sources.size(), 2U);
  const auto relit_with = [&](const MaterialChange& change) {
    SceneDescription changed = description;
    change_materials(changed, std::vector{change});
    const auto of_patch = patch_materials(*before.scene, changed);
    return relight(*before.scene, before.form_factors, changed.materials,
                   {.shot = before.shot.get(), .patch_materials = of_patch});
  };
  EXPECT_THAT(
      [&] {
        relit_with({"face:0", {}, Rgb{1, 1, 1}});
      },
      ThrowsMessage<InputError>(HasSubstr("stored per material")));
  // A changed reflectance splits the material, but not the light of the shot.
  EXPECT_EQ(relit_with({"face:0", Rgb{0.25, 0.5, 0.75}}).radiosity.size(),
            before.scene->patches().size());
}

TEST(Relight, ShootsNothingIfNothingEmits) {
  const Scene scene(describe_scene("cornell-box"));
  const DirectLight light = shoot(scene, find_small_sources(scene, 0));
  std::vector<Material> dark = scene.materials();
  for (Material& material : dark) {
    material.exitance = {};
  }
  const DirectLight none = with_materials(light, scene, dark);
  EXPECT_EQ(none.power_fraction, 0);
  for (const Rgb& h : none.irradiance) {
    EXPECT_EQ(max_abs(h), 0);
  }
  for (const Rgb& e : none.exitance) {
    EXPECT_EQ(max_abs(e), 0);
  }
}

TEST(Relight, KeepsTheSourcesOfTheShot) {
  const SceneDescription description = describe_scene("cornell-box");
  SceneDescription changed = description;
  for (Material& material : changed.materials) {
    const bool emits = max_abs(material.exitance) > 0;
    material.exitance = emits ? Rgb{} : Rgb{1, 2, 0.5};
  }
  SolveOptions options{.directions = 100, .tolerance = tight};
  options.first_shot = 0;
  const Solved before = solved(description, options);
  const Solved after = solved(changed, options, &before.shot->sources);
  EXPECT_EQ(after.shot->power_fraction, 0);
  const RelightResult relit = relight(*before.scene, before.form_factors, changed.materials,
                                      {.tolerance = tight, .shot = before.shot.get()});
  expect_same(relit.radiosity, after.radiosity, 1e-10);
}

TEST(Relight, RejectsAShotWithoutPartsOrOfAnotherScene) {
  SolveOptions options{.directions = 16};
  options.first_shot = 0;
  const Solved s = solved(describe_scene("cornell-box"), options);
  DirectLight light = *s.shot;
  light.contributions.clear();
  EXPECT_THROW(relight(*s.scene, s.form_factors, s.scene->materials(), {.shot = &light}),
               InputError);
  light = *s.shot;
  light.irradiance.pop_back();
  EXPECT_THROW(relight(*s.scene, s.form_factors, s.scene->materials(), {.shot = &light}),
               InputError);
}

/// F of all directions of all iterations, assembled here.
std::vector<std::vector<double>> dense_form_factors(const RadiositySolver& solver, int steps) {
  const Scene& scene = solver.scene();
  const auto patches = scene.patches().size();
  const bool by_rows = solver.options().normalize == Normalization::rows;
  std::vector<std::vector<double>> f(patches, std::vector<double>(patches));
  std::vector<double> projected(patches);
  const TransferEngine engine =
      make_engine(solver.options().engine, solver.shared_scene(), solver.shared_tree());
  for (int n = 0; n < steps; ++n) {
    for (int k = 0; k < solver.options().directions; ++k) {
      const Transfers transfers = engine(solver.direction(n, k), {});
      for (const Transfer& t : transfers.exchanges) {
        at(at(f, t.receiver), t.source) += t.area;
        at(at(f, t.source), t.receiver) += t.area;
      }
      for (std::size_t i = 0; i < patches; ++i) {
        projected[i] += transfers.forward[i].projected + transfers.backward[i].projected;
      }
    }
  }
  for (std::size_t i = 0; i < patches; ++i) {
    const double plain = steps * solver.options().directions * 2 * scene.patches()[i].area / 4;
    for (double& value : f[i]) {
      value /= by_rows ? projected[i] : plain;
    }
  }
  return f;
}

TEST(Relight, UsesTheFormFactorsOfAllIterationsOfTheSemiIterativeScheme) {
  const auto scene = std::make_shared<const Scene>(describe_scene("cornell-box"));
  for (const Normalization normalize : {Normalization::none, Normalization::rows}) {
    for (const int replicas : {1, 3}) {
      SolveOptions options{.directions = 24, .normalize = normalize};
      options.scheme = Scheme::semi_iterative;
      options.burn_in = 2;
      options.iterations = 5;
      options.replicas = replicas;
      RadiositySolver solver(scene, options);
      solver.keep_form_factors();
      EXPECT_THROW(solver.form_factors(), std::runtime_error);
      solver.advance(RadiositySolver::Until::finished);
      const FormFactors kept = solver.form_factors();
      const auto expected = dense_form_factors(solver, 5);
      for (std::size_t i = 0; i < expected.size(); ++i) {
        std::vector<double> row(expected.size());
        for (std::size_t k = kept.row_begin[i]; k < kept.row_begin[i + 1]; ++k) {
          at(row, kept.source[k]) = kept.value[k];
        }
        for (std::size_t j = 0; j < row.size(); ++j) {
          EXPECT_NEAR(row[j], expected[i][j], 1e-14) << i << ' ' << j;
        }
      }
    }
  }
}

TEST(Relight, IsCloseToTheMeanOfTheSemiIterativeScheme) {
  SolveOptions options{.directions = 128};
  options.scheme = Scheme::semi_iterative;
  options.iterations = 40;
  SceneDescription changed = describe_scene("cornell-box");
  const Solved before = solved(changed, options);
  changed.materials = other(changed.materials);
  const Solved after = solved(changed, options);
  const RelightResult relit = relight(*before.scene, before.form_factors, changed.materials);
  double difference = 0, norm = 0;
  for (std::size_t i = 0; i < relit.radiosity.size(); ++i) {
    difference += std::pow(relit.radiosity[i].b - after.radiosity[i].b, 2);
    norm += std::pow(after.radiosity[i].b, 2);
  }
  EXPECT_LT(std::sqrt(difference / norm), 2e-3);
}

TEST(Relight, KeepingFormFactorsDoesNotChangeTheSemiIterativeScheme) {
  const auto scene = std::make_shared<const Scene>(describe_scene("cornell-box"));
  SolveOptions options{.directions = 32};
  options.scheme = Scheme::semi_iterative;
  options.iterations = 12;
  RadiositySolver keeps(scene, options), plain(scene, options);
  keeps.keep_form_factors();
  keeps.advance(RadiositySolver::Until::finished);
  plain.advance(RadiositySolver::Until::finished);
  EXPECT_TRUE(keeps.radiosity() == plain.radiosity());
  EXPECT_TRUE(keeps.statistics().kept_form_factors);
  EXPECT_FALSE(plain.statistics().kept_form_factors);
  const auto ask = [&] { plain.form_factors(); };
  EXPECT_THAT(ask, ThrowsMessage<std::runtime_error>(HasSubstr("unless they are requested")));
}

TEST(Relight, FormFactorsAreKeptFromTheNextPassOn) {
  const auto scene = std::make_shared<const Scene>(describe_scene("cornell-box"));
  SolveOptions options{.directions = 16};
  options.scheme = Scheme::semi_iterative;
  RadiositySolver solver(scene, options);
  solver.advance(RadiositySolver::Until::iteration);
  solver.keep_form_factors();
  const auto ask = [&] { solver.form_factors(); };
  EXPECT_THAT(ask, ThrowsMessage<std::runtime_error>(HasSubstr("between iterations")));
  solver.advance(RadiositySolver::Until::iteration);
  const FormFactors kept = solver.form_factors();
  const std::vector<double> sums = solver.form_factor_sums();  // sums of the newest iteration
  for (std::size_t i = 0; i < sums.size(); ++i) {
    double sum = 0;
    for (std::size_t k = kept.row_begin[i]; k < kept.row_begin[i + 1]; ++k) {
      sum += kept.value[k];
    }
    EXPECT_NEAR(sum, sums[i], 1e-12) << i;
  }
}

TEST(Relight, WithTheScenesOwnMaterialsEqualsTheSolve) {
  const Solved s =
      solved(describe_scene("rooms"), {.directions = 64, .first_shot = {}, .tolerance = tight});
  const RelightResult relit = relight(*s.scene, s.form_factors, s.scene->materials(),
                                      {.tolerance = 1e-9, .start = s.radiosity});
  EXPECT_LE(relit.iterations, 2);
  expect_same(relit.radiosity, s.radiosity, 1e-9);
}

/// The light of the sky does not depend on materials, so relighting with it equals a solve under
/// it.
TEST(Relight, RejectsTheSkyOfAnotherScene) {
  const Solved s = solved(describe_scene("boards"), {.directions = 8});
  const std::vector<Rgb> short_list(1);
  const auto ask = [&] {
    relight(*s.scene, s.form_factors, s.scene->materials(), {.sky_irradiance = short_list});
  };
  EXPECT_THAT(ask, ThrowsMessage<InputError>(HasSubstr("number of patches differs")));
}

TEST(Relight, GivesTheSameBitsForAnyNumberOfThreads) {
  const Solved s = solved(describe_scene("rooms"), {.directions = 32});
  const auto materials = other(s.scene->materials());
  const RelightResult one = relight(*s.scene, s.form_factors, materials, {.threads = 1});
  const RelightResult three = relight(*s.scene, s.form_factors, materials, {.threads = 3});
  EXPECT_EQ(one.iterations, three.iterations);
  for (std::size_t i = 0; i < one.radiosity.size(); ++i) {
    EXPECT_EQ(one.radiosity[i], three.radiosity[i]);
    EXPECT_EQ(one.irradiance[i], three.irradiance[i]);
  }
}

TEST(Relight, ConvergesToTheSameFromAnyStart) {
  const Solved s = solved(describe_scene("cornell-box"), {.directions = 64});
  const auto materials = other(s.scene->materials());
  const std::vector<Rgb> bright(s.radiosity.size(), Rgb{50, 50, 50});
  const RelightResult from_light =
      relight(*s.scene, s.form_factors, materials, {.tolerance = tight});
  const RelightResult from_bright =
      relight(*s.scene, s.form_factors, materials, {.tolerance = tight, .start = bright});
  expect_same(from_bright.radiosity, from_light.radiosity, 1e-8);
}

TEST(Relight, RejectsInvalidMaterialsAndThoseOfAnotherScene) {
  const Solved s = solved(describe_scene("furnace"), {.directions = 16});
  auto materials = s.scene->materials();
  materials[0].reflectance.g = 1;
  EXPECT_THROW(relight(*s.scene, s.form_factors, materials), InputError);
  materials = s.scene->materials();
  materials[0].exitance.b = -1;
  EXPECT_THROW(relight(*s.scene, s.form_factors, materials), InputError);
  EXPECT_THROW(relight(*s.scene, s.form_factors, {}), InputError);
  EXPECT_THROW(relight(*s.scene, {}, s.scene->materials()), InputError);
  const std::vector<Rgb> short_start(1);
  EXPECT_THROW(relight(*s.scene, s.form_factors, s.scene->materials(), {.start = short_start}),
               InputError);
  EXPECT_THROW(relight(*s.scene, s.form_factors, s.scene->materials(), {}, testing::canceled()),
               Canceled);
}

}  // namespace
}  // namespace transillum::relight_test
