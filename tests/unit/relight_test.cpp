// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "transillum/relight.h"

#include <gtest/gtest.h>

#include "transillum/radiosity.h"

namespace transillum {
namespace {

constexpr double tight = 1e-12;

struct Solved {
  std::shared_ptr<const Scene> scene;
  FormFactors form_factors;
  std::vector<Rgb> radiosity, irradiance;
};

Solved solved(const SceneDescription& description, const SolveOptions& options) {
  Solved result;
  result.scene = std::make_shared<const Scene>(description);
  RadiositySolver solver(result.scene, options);
  solver.advance(RadiositySolver::Until::finished);
  result.form_factors = solver.form_factors();
  result.radiosity = solver.radiosity();
  result.irradiance = solver.irradiance();
  return result;
}

/// Another light and another wall than the scene has.
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

TEST(Relight, GivesWhatASolveOfTheOtherMaterialsGives) {
  const SceneDescription description = describe_scene("cornell-box");
  SceneDescription changed = description;
  changed.materials = other(description.materials);
  for (const Normalization normalize :
       {Normalization::none, Normalization::rows, Normalization::symmetric}) {
    const SolveOptions options{.directions = 200, .normalize = normalize, .tolerance = tight};
    const Solved before = solved(description, options), after = solved(changed, options);
    const Relit relit =
        relight(*before.scene, before.form_factors, changed.materials, {.tolerance = tight});
    expect_same(relit.radiosity, after.radiosity, 1e-10);
    expect_same(relit.irradiance, after.irradiance, 1e-10);
    EXPECT_GT(max_abs(after.radiosity[0] - before.radiosity[0]), 1e-3);
  }
}

TEST(Relight, ComesBackToTheSolveWithTheScenesOwnMaterials) {
  const Solved s = solved(describe_scene("rooms"), {.directions = 64, .tolerance = tight});
  const Relit relit = relight(*s.scene, s.form_factors, s.scene->materials(),
                              {.tolerance = 1e-9, .start = s.radiosity});
  EXPECT_LE(relit.steps, 2);
  expect_same(relit.radiosity, s.radiosity, 1e-9);
}

TEST(Relight, IsTheSameBitsForAnyNumberOfThreads) {
  const Solved s = solved(describe_scene("rooms"), {.directions = 32});
  const auto materials = other(s.scene->materials());
  const Relit one = relight(*s.scene, s.form_factors, materials, {.threads = 1});
  const Relit three = relight(*s.scene, s.form_factors, materials, {.threads = 3});
  EXPECT_EQ(one.steps, three.steps);
  for (std::size_t i = 0; i < one.radiosity.size(); ++i) {
    EXPECT_EQ(one.radiosity[i], three.radiosity[i]);
    EXPECT_EQ(one.irradiance[i], three.irradiance[i]);
  }
}

TEST(Relight, EndsAtTheSamePlaceFromAnyStart) {
  const Solved s = solved(describe_scene("cornell-box"), {.directions = 64});
  const auto materials = other(s.scene->materials());
  const std::vector<Rgb> bright(s.radiosity.size(), Rgb{50, 50, 50});
  const Relit from_light = relight(*s.scene, s.form_factors, materials, {.tolerance = tight});
  const Relit from_bright =
      relight(*s.scene, s.form_factors, materials, {.tolerance = tight, .start = bright});
  expect_same(from_bright.radiosity, from_light.radiosity, 1e-8);
}

TEST(Relight, RefusesWhatIsNoMaterialOrOfAnotherScene) {
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
  Cancellation cancellation;
  cancellation.cancel();
  EXPECT_THROW(relight(*s.scene, s.form_factors, s.scene->materials(), {}, cancellation),
               Cancelled);
}

}  // namespace
}  // namespace transillum
