// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Properties that must hold for lobes in any scene (ALGORITHM.md, oracle 6c): the diffuse limit,
// the furnace, energy, reciprocity of paths, invariance, bits.
#include "transillum/glossy.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <random>

#include "support/glossy_scenes.h"
#include "support/refusal.h"
#include "support/scenes.h"
#include "transillum/at.h"
#include "transillum/directions.h"
#include "transillum/errors.h"
#include "transillum/radiosity_solver.h"
#include "transillum/solution.h"
#include "transillum/solve_options.h"
#include "transillum/solve_session.h"

namespace transillum::glossy_test {
namespace {

using test::refusal;
using testing::box_in_cube;
using testing::box_scene;
using testing::box_with_weak_lobes;
using testing::ggx;
using testing::glossy_box;
using testing::glossy_box_description;
using testing::glossy_options;
using ::testing::HasSubstr;
using testing::largest;
using testing::largest_difference;
using testing::phong;

constexpr double pi = std::numbers::pi;

TEST(GlossyDiffuseLimit, ScenesWithoutLobesHaveTheSameBits) {
  const auto scene = box_in_cube(3, 2).scene();
  SolveOptions options{.directions = 64, .first_shot = {}};
  const Solution without = solve(scene, options);
  options.glossy = true;
  const Solution with = solve(scene, options);
  EXPECT_EQ(with.radiosity, without.radiosity);
  EXPECT_EQ(with.irradiance, without.irradiance);
  EXPECT_EQ(with.glossy, nullptr);
}

/// The solver of lobes itself, on lobes that reflect next to nothing.
TEST(GlossyDiffuseLimit, WeakLobesGiveTheDiffuseSolution) {
  const auto plain = box_scene([](std::size_t, Material&) {}), weak = box_with_weak_lobes();
  for (const Normalization normalize : {Normalization::none, Normalization::rows}) {
    SolveOptions options = glossy_options(48);
    options.normalize = normalize;
    const Solution diffuse = solve(plain, options), glossy = solve(weak, options);
    ASSERT_NE(glossy.glossy, nullptr);
    EXPECT_LE(largest_difference(glossy.radiosity, diffuse.radiosity), 1e-12);
    EXPECT_LE(largest_difference(glossy.irradiance, diffuse.irradiance), 1e-12);
    EXPECT_NEAR(glossy.statistics.energy_balance, diffuse.statistics.energy_balance, 1e-12);
    for (std::size_t i = 0; i < diffuse.form_factor_sums.size(); ++i) {
      EXPECT_NEAR(glossy.form_factor_sums[i], diffuse.form_factor_sums[i], 1e-13);
    }
  }
}

/// cos^0 is the same in all directions: a lobe of exponent 0 is a diffuse surface whose row is
/// normalized.
TEST(GlossyDiffuseLimit, ExponentZeroIsADiffuseSurface) {
  const auto plain = box_scene([](std::size_t, Material& m) { m.reflectance = {0.6, 0.6, 0.6}; });
  const auto lobes = box_scene([](std::size_t, Material& m) {
    m.reflectance = {0.2, 0.2, 0.2};
    m.lobe = phong(0.4, 0);
  });
  SolveOptions options = glossy_options(64);
  options.normalize = Normalization::rows;
  EXPECT_LE(largest_difference(solve(lobes, options).radiosity, solve(plain, options).radiosity),
            1e-11);
}

/// E = 1 and rho + k = 0.5 everywhere: B = 2, and the same radiance in every direction.
TEST(GlossyFurnace, HasTheSameRadianceEverywhere) {
  for (const Lobe& lobe : {phong(0.3, 12), phong(0.3, 300), phong(0.5, 1), ggx(0.3, 0.4),
                           ggx(0.3, 0.05), ggx(0.3, 1)}) {
    const auto scene = box_scene([&](std::size_t f, Material& m) {
      const double fraction = f % 2 == 0 ? lobe.reflectance.r : 0;
      m.exitance = {1, 1, 1};
      m.reflectance = {0.5 - fraction, 0.5 - fraction, 0.5 - fraction};
      m.lobe = lobe;
      m.lobe.reflectance = {fraction, fraction, fraction};
    });
    SolveOptions options = glossy_options(60);
    options.normalize = Normalization::rows;
    const Solution solution = solve(scene, options);
    ASSERT_NE(solution.glossy, nullptr);
    EXPECT_LE(solution.statistics.glossy.sum_defect, 1e-13);
    for (PatchId i = 0; i < scene->patch_count(); ++i) {
      EXPECT_NEAR(at(solution.radiosity, i).r, 2, 1e-11);
      for (int p = 0; p < 60; ++p) {
        ASSERT_NEAR(solution.glossy->leaving(i, p).g, 2 / pi, 1e-11) << i << " " << p;
      }
      const Vec3 up = scene->patch(i).normal;
      const Vec3 aside = std::abs(up.x) < 0.5 ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
      ASSERT_NEAR(solution.glossy->radiance(i, normalized(0.3 * up + cross(up, aside))).b, 2 / pi,
                  1e-11);
    }
  }
}

TEST(GlossyEnergy, WhatIsReceivedWasSent) {
  for (const int directions : {16, 128}) {
    const Solution solution = solve(glossy_box(), glossy_options(directions));
    EXPECT_LE(solution.statistics.energy_defect, 1e-13);
    // In a closed scene the balance is off by the quadrature of the cosine of emitted and diffusely
    // reflected light.
    double emitted = 0, absorbed = 0;
    const Scene& scene = *solution.scene;
    for (PatchId i = 0; i < scene.patch_count(); ++i) {
      const Patch& patch = scene.patch(i);
      double cosines = 0;
      for (const Vec3& omega : solution.glossy->directions()) {
        cosines += std::abs(dot(omega, patch.normal));
      }
      const double quadrature = 2 * cosines / directions;
      const double lobe = used_lobe(scene.material(i)).reflectance.r;
      const double h = at(solution.irradiance, i).r;
      emitted += patch.area * quadrature * scene.exitance(i).r;
      absorbed += patch.area * (1 - quadrature * scene.reflectance(i).r - lobe) * h;
    }
    EXPECT_NEAR(absorbed / emitted, 1, 1e-11) << directions;
    EXPECT_NEAR(solution.statistics.energy_balance, 1, directions < 100 ? 0.05 : 0.01);
  }
}

/// If lamp and receiver are exchanged, A_b H_b of a lamp a equals A_a H_a of a lamp b, over all
/// paths.
TEST(GlossyReciprocity, LampAndReceiverCanBeExchanged) {
  const auto dark = glossy_box();
  const auto lit = [&](PatchId lamp) {
    std::vector<Material> materials = dark->materials();
    for (Material& m : materials) {
      m.exitance = {};
    }
    at(materials, dark->patch(lamp).material).exitance = {1, 1, 1};
    return materials;
  };
  GlossySolver solver(dark, glossy_options(40));
  const auto power = [&](PatchId lamp, PatchId receiver) {
    solver.set_materials(lit(lamp));
    EXPECT_TRUE(solver.solve());
    return dark->patch(receiver).area * at(solver.solution().irradiance, receiver).g;
  };
  int compared = 0;
  for (const auto& [a, b] : {std::pair<PatchId, PatchId>{0, 13}, {1, 22}, {5, 26}, {2, 9}}) {
    const double forward = power(a, b), backward = power(b, a);
    EXPECT_GT(forward, 0);
    EXPECT_NEAR(forward / backward, 1, 1e-11) << a << " " << b;
    ++compared;
  }
  EXPECT_EQ(compared, 4);
  EXPECT_EQ(solver.solution().statistics.passes_made, 40);  // transfers were kept
}

TEST(GlossyBits, DependOnNothingButTheProblem) {
  SolveOptions options = glossy_options(48);
  options.sky.exitance = {1, 2, 3};
  options.threads = 1;
  const Solution one = solve(glossy_box(), options);
  for (const int threads : {2, 5}) {
    options.threads = threads;
    const Solution more = solve(glossy_box(), options);
    EXPECT_EQ(more.radiosity, one.radiosity);
    for (PatchId i = 0; i < one.scene->patch_count(); ++i) {
      EXPECT_TRUE(std::ranges::equal(more.glossy->arriving(i), one.glossy->arriving(i)));
    }
  }
}

/// This also holds where passes are recomputed in each iteration.
TEST(GlossyBits, DependOnNoThreadsWithoutKeptTransfers) {
  SolveOptions options = glossy_options(48);
  options.memory = 1000;
  options.threads = 1;
  const Solution one = solve(glossy_box(), options);
  EXPECT_FALSE(one.statistics.kept_form_factors);
  options.threads = 3;
  const Solution more = solve(glossy_box(), options);
  EXPECT_EQ(more.radiosity, one.radiosity);
  for (PatchId i = 0; i < one.scene->patch_count(); ++i) {
    EXPECT_TRUE(std::ranges::equal(more.glossy->arriving(i), one.glossy->arriving(i)));
  }
}

/// Exchanges of glossy patches are added in the same order whether they are kept or not. Only
/// exchanges between two diffuse patches are kept as sums, whose rounding differs.
TEST(GlossyMemory, ChangesNoBitWhereAllPatchesAreGlossy) {
  const auto scene = box_scene([](std::size_t f, Material& material) {
    material.reflectance = {0.3, 0.2, 0.4};
    material.lobe = f % 2 == 0 ? phong(0.4, 8) : ggx(0.3, 0.6);
  });
  SolveOptions options = glossy_options(32);
  const Solution kept = solve(scene, options);
  options.memory = 1000;
  const Solution again = solve(scene, options);
  EXPECT_TRUE(kept.statistics.kept_form_factors);
  EXPECT_FALSE(again.statistics.kept_form_factors);
  EXPECT_EQ(again.radiosity, kept.radiosity);
}

TEST(GlossyMemory, ComputesAgainWhatItCannotKeep) {
  SolveOptions options = glossy_options(32);
  const Solution kept = solve(glossy_box(), options);
  options.memory = 1000;
  const Solution again = solve(glossy_box(), options);
  EXPECT_TRUE(kept.statistics.kept_form_factors);
  EXPECT_FALSE(again.statistics.kept_form_factors);
  EXPECT_EQ(kept.statistics.passes_made, 32);
  EXPECT_EQ(again.statistics.passes_made, 32 * again.statistics.iterations);
  EXPECT_LE(largest_difference(again.radiosity, kept.radiosity), 1e-12);
  EXPECT_GT(kept.statistics.glossy.transfer_bytes, 0U);
  EXPECT_EQ(again.statistics.glossy.transfer_bytes, 0U);
}

/// The rotation that a seed gives: its columns are the images of the axes.
std::function<Vec3(const Vec3&)> rotation_of(std::uint64_t seed) {
  const auto plain = make_directions(Sampling::fibonacci, 50, 1);
  const auto turned = rotated(plain, seed);
  const Vec3 a = plain[10].direction, b = plain[27].direction;
  const Vec3 x = a, z = normalized(cross(a, b)), y = cross(z, x);
  const Vec3 ra = turned[10].direction, rb = turned[27].direction;
  const Vec3 rx = ra, rz = normalized(cross(ra, rb)), ry = cross(rz, rx);
  return [=](const Vec3& p) { return dot(p, x) * rx + dot(p, y) * ry + dot(p, z) * rz; };
}

TEST(GlossyInvariance, RotationWithTheSetAndScaleChangeNothing) {
  SceneDescription description = box_in_cube(3, 1).description();
  for (Material& m : description.materials) {
    m.lobe = phong(0.3, 9);
  }
  const SolveOptions options = glossy_options(40);
  const Solution plain = solve(std::make_shared<const Scene>(description), options);
  SolveOptions turned_options = options;
  turned_options.rotation = 7;
  const auto rotate = rotation_of(7);
  const Solution turned =
      solve(std::make_shared<const Scene>(testing::moved(description, rotate)), turned_options);
  EXPECT_LE(largest_difference(turned.radiosity, plain.radiosity), 1e-9);
  const Solution scaled = solve(std::make_shared<const Scene>(testing::moved(
                                    description, [](const Vec3& p) { return 1000 * p; })),
                                options);
  EXPECT_LE(largest_difference(scaled.radiosity, plain.radiosity), 1e-9);
  for (Material& m : description.materials) {
    m.exitance = 1e6 * m.exitance;
  }
  const Solution bright = solve(std::make_shared<const Scene>(description), options);
  std::vector<Rgb> dimmed;
  for (const Rgb& b : bright.radiosity) {
    dimmed.push_back(1e-6 * b);
  }
  EXPECT_LE(largest_difference(dimmed, plain.radiosity), 1e-12);
}

/// The order of the faces in the file, and thereby of the sums.
TEST(GlossyInvariance, OrderOfFacesChangesNothing) {
  const SceneDescription description = glossy_box_description();
  std::vector<std::size_t> order(description.face_count());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::shuffle(order.begin(), order.end(), std::mt19937(5));  // NOLINT: repeatable
  SceneDescription shuffled;
  shuffled.name = description.name;
  shuffled.points = description.points;
  shuffled.materials = description.materials;
  for (const std::size_t f : order) {
    shuffled.add_face(description.outline(f), description.face_material[f]);
  }
  const SolveOptions options = glossy_options(40);
  const Solution plain = solve(std::make_shared<const Scene>(description), options);
  const Solution other = solve(std::make_shared<const Scene>(shuffled), options);
  double worst = 0;
  for (std::size_t k = 0; k < order.size(); ++k) {
    worst = std::max(worst, max_abs(other.radiosity[k] - plain.radiosity[order[k]]));
  }
  EXPECT_LE(worst / largest(plain.radiosity), 1e-11);
}

/// Under a uniform sky a glossy convex body receives the whole sky, and each direction of it.
TEST(GlossySky, IsReflectedByConvexBodies) {
  testing::Sketch sketch("body");
  sketch.box({0, 0, 0}, {1, 2, 3}, false, sketch.material(0.3, 0));
  SceneDescription d = sketch.description();
  d.materials[0].lobe = ggx(0.4, 0.5);
  SolveOptions options = glossy_options(50);
  options.normalize = Normalization::rows;
  options.sky.exitance = {4, 4, 4};
  const Solution solution = solve(std::make_shared<const Scene>(d), options);
  for (PatchId i = 0; i < 6; ++i) {
    EXPECT_NEAR(at(solution.irradiance, i).r, 4, 1e-11);
    EXPECT_NEAR(at(solution.radiosity, i).r, 0.7 * 4, 1e-11);
    EXPECT_NEAR(solution.glossy->leaving(i, 17).r, 0.7 * 4 / pi, 1e-11);
  }
}

/// The integral over the hemisphere of the continuous lobe, by a quadrature of its own.
TEST(GlossyLobes, ReflectEverythingInTheContinuousLimit) {
  for (const Lobe& lobe :
       {phong(1, 0), phong(1, 1), phong(1, 7.5), phong(1, 40), ggx(1, 0.9), ggx(1, 0.5)}) {
    const LobeFunction function(lobe);
    const auto directions = make_directions(Sampling::fibonacci, 200'000, 1);
    for (const double theta : {0.0, 0.5, 1.0, 1.4, 1.55}) {
      const Vec3 a{std::sin(theta), 0, std::cos(theta)};
      double sum = 0;
      for (const DirectionSample& sample : directions) {
        const Vec3 b = sample.direction;
        sum += b.z > 0 ? b.z * function.value(a, b, {0, 0, 1}) : 0.0;
      }
      EXPECT_NEAR(4 * pi * sum / 200'000, 1, 1e-3) << lobe.exponent << " " << theta;
      const Vec3 b = normalized(Vec3{0.3, -0.2, 0.5});
      EXPECT_DOUBLE_EQ(function.value(a, b, {0, 0, 1}), function.value(b, a, {0, 0, 1}));
    }
  }
}

TEST(GlossyLobes, AreLoweredToWhatASurfaceCanReflect) {
  Material material{"m", {0.8, 0.5, 0.99}, {}};
  material.lobe = phong(0.5, 30);
  const Lobe used = used_lobe(material);
  EXPECT_NEAR(used.reflectance.r, 0.18, 1e-15);
  EXPECT_NEAR(used.reflectance.g, 0.48, 1e-15);
  EXPECT_EQ(used.reflectance.b, 0);
  material.reflectance = {0.5, 0.4, 0.3};
  material.lobe = phong(0.499, 30);
  EXPECT_EQ(used_lobe(material), material.lobe);
}

TEST(GlossyLobes, TooNarrowOnesAreNamed) {
  const auto scene = box_scene([](std::size_t f, Material& m) {
    m.name = f == 0 ? "mirror" : "wall";
    m.lobe = f == 0 ? phong(0.3, 1000) : phong(0.9, 10);
    m.reflectance = f == 0 ? Rgb{} : Rgb{0.5, 0.5, 0.5};
  });
  const std::vector<std::string> warnings = lobe_warnings(*scene, 256);
  EXPECT_THAT(warnings, ::testing::Contains(HasSubstr("`mirror`: its lobe, of the exponent "
                                                      "1000, is too narrow for 256 passes")));
  EXPECT_THAT(warnings, ::testing::Contains(HasSubstr("more than a surface can")));
  EXPECT_NEAR(equivalent_exponent(ggx(1, 0.5)), std::log(2.0) * 16, 1e-12);
}

/// Lobes that the set cannot resolve still reflect no more than their fraction.
TEST(GlossyLobes, StayWithinTheirShareWhereTheSetIsTooCoarse) {
  const auto scene = box_scene([](std::size_t f, Material& m) {
    m.reflectance = {};
    m.lobe = f % 2 == 0 ? phong(0.5, 20'000) : ggx(0.5, 0.01);
  });
  const Solution solution = solve(scene, glossy_options(24));
  EXPECT_TRUE(solution.statistics.converged);
  EXPECT_LE(solution.statistics.glossy.sum_defect, 1e-12);
  EXPECT_LE(solution.statistics.energy_defect, 1e-12);
}

TEST(GlossyOptions, RefusesWhatItCannotDo) {
  const auto refused = [](auto change) {
    SolveOptions options{.directions = 16, .glossy = true};
    change(options);
    return refusal([&] { options.validate(); });
  };
  EXPECT_THAT(refused([](SolveOptions& o) { o.two_way = false; }), HasSubstr("one-way"));
  EXPECT_THAT(refused([](SolveOptions& o) { o.basis = Basis::linear; }), HasSubstr("linear"));
  EXPECT_THAT(refused([](SolveOptions& o) { o.normalize = Normalization::symmetric; }),
              HasSubstr("symmetric"));
  EXPECT_THAT(refused([](SolveOptions& o) { o.scheme = Scheme::growing; }), HasSubstr("scheme"));
  EXPECT_THAT(refused([](SolveOptions& o) { o.engine = Engine::pairs; }), HasSubstr("pairs"));
}

}  // namespace
}  // namespace transillum::glossy_test
