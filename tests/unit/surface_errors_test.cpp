// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Which surfaces a scene has, and the errors and common limit of surfaces, from known replicas.
#include "radiosity/error/surface_errors.h"

#include <gtest/gtest.h>

#include <boost/math/distributions/fisher_f.hpp>
#include <cmath>
#include <random>

#include "support/scenes.h"
#include "transillum/at.h"
#include "transillum/errors.h"

namespace transillum::surface_errors_test {
namespace {

/// Squares in a row, each of one group and material, -1: none.
struct Square {
  double side;
  int group;
  int material;
};

SceneDescription row_of(const std::vector<Square>& squares) {
  SceneDescription description;
  description.name = "row";
  description.groups = {"floor", "wall", "chip"};
  for (const auto& [name, reflectance, exitance] : {std::tuple{"paint", 0.5, 0.0},
                                                    {"wood", 0.3, 0.0},
                                                    {"lamp", 0.5, 7.0},
                                                    {"soot", 0.0, 0.0}}) {
    Material material;
    material.name = name;
    material.reflectance = {reflectance, reflectance, reflectance};
    material.exitance = {exitance, exitance, exitance};
    description.materials.push_back(material);
  }
  double x = 0;
  for (const Square& square : squares) {
    const auto first = static_cast<PointId>(description.points.size());
    const double end = x + square.side;
    for (const Vec3& point :
         {Vec3{x, 0, 0}, {end, 0, 0}, {end, square.side, 0}, {x, square.side, 0}}) {
      description.points.push_back(point);
    }
    const PointId corners[] = {first, first + 1, first + 2, first + 3};
    description.add_face(corners, square.material, 0, square.group);
    x = end + 1;
  }
  return description;
}

std::vector<std::string> names_of(const Surfaces& surfaces) {
  std::vector<std::string> names;
  for (const Surfaces::Surface& surface : surfaces.surfaces) {
    names.push_back(surface.name);
  }
  return names;
}

using Names = std::vector<std::string>;

/// Few replicas cannot show that errors are more independent than their own number.
TEST(SurfaceErrors, IndependentErrorsAreAtMostAsManyAsReplicas) {
  for (const int replicas : {4, 8}) {
    const auto count = static_cast<std::size_t>(replicas);
    DeviationProducts apart(count, std::vector<double>(count)), alike = apart;
    for (std::size_t r = 0; r < count; ++r) {
      apart[r][r] = 1;
      for (std::size_t q = 0; q < count; ++q) {
        alike[r][q] = (1.0 + static_cast<double>(r)) * (1.0 + static_cast<double>(q));
      }
    }
    EXPECT_DOUBLE_EQ(independent_errors(apart), replicas);
    EXPECT_DOUBLE_EQ(independent_errors(alike), 1);
  }
  EXPECT_EQ(independent_errors({{1, 0}, {0, 1}}), 1);
}

TEST(Surfaces, AreGroupsAndSmallOnesCountTogether) {
  const Scene scene(row_of({{1, 0, 0}, {1, 0, 2}, {2, 1, 0}, {0.1, 2, 0}, {1, -1, 1}, {1, 1, 3}}),
                    {});
  const Surfaces surfaces = find_surfaces(scene, Measured::reflecting);
  EXPECT_EQ(names_of(surfaces), (Names{"floor", "wall", "no group", "others"}));
  EXPECT_EQ(surfaces.of_patch,
            (std::vector<std::int32_t>{0, Surfaces::none, 1, 3, 2, Surfaces::none}));
  EXPECT_EQ(surfaces.surfaces[1].patches, 1);
  EXPECT_DOUBLE_EQ(surfaces.surfaces[1].area, 4);
  // Black patches receive; a surface that is asked for counts alone.
  const Surfaces receiving = find_surfaces(scene, Measured::receiving, {"chip"});
  EXPECT_EQ(names_of(receiving), (Names{"floor", "wall", "chip", "no group"}));
  EXPECT_EQ(receiving.surfaces[1].patches, 2);
  EXPECT_NO_THROW(check_surfaces(scene, {"chip", "no group"}));
  EXPECT_THROW(check_surfaces(scene, {"roof"}), InputError);
}

TEST(Surfaces, AreMaterialsOrConnectedComponentsWithoutGroups) {
  const Scene materials(row_of({{1, -1, 0}, {1, -1, 1}, {1, -1, 2}}), {});
  EXPECT_EQ(names_of(find_surfaces(materials, Measured::reflecting)), (Names{"paint", "wood"}));
  const Scene components(row_of({{1, 0, 0}, {1, 0, 0}, {1, 1, 2}}), {});
  EXPECT_EQ(names_of(find_surfaces(components, Measured::reflecting)),
            (Names{"component 0", "component 1"}));
  const Scene one(row_of({{1, -1, 0}}), {});
  EXPECT_EQ(find_surfaces(one, Measured::reflecting).surfaces.size(), 1U);
  const Scene lamps(row_of({{1, 0, 2}, {1, 1, 2}}), {});  // all emit: all count
  EXPECT_EQ(names_of(find_surfaces(lamps, Measured::reflecting)), (Names{"floor", "wall"}));
}

/// Replicas of two surfaces of `patches` each, whose values scatter independently by these amounts.
SurfaceErrors errors_of(int patches, double level, double sigma, double other_level,
                        double other_sigma, std::vector<double>* off = nullptr,
                        std::uint64_t seed = 1) {
  Surfaces surfaces;
  surfaces.surfaces = {{"one", patches, 1}, {"other", patches, 1}};
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  constexpr int count = 8;
  std::vector<Rgb> mean;
  std::vector<std::vector<Rgb>> replicas(count);
  double errors[2] = {};
  for (int s = 0; s < 2; ++s) {
    for (int p = 0; p < patches; ++p) {
      surfaces.of_patch.push_back(s);
      const double value = s == 0 ? level : other_level, spread = s == 0 ? sigma : other_sigma;
      Rgb sum;
      for (auto& replica : replicas) {
        replica.push_back(Rgb{value + spread * normal(random), value + spread * normal(random),
                              value + spread * normal(random)});
        sum += (1.0 / count) * replica.back();
      }
      mean.push_back(sum);
      const Rgb d = sum - Rgb{value, value, value};
      errors[s] += (d.r * d.r + d.g * d.g + d.b * d.b) / (3 * patches);
    }
  }
  if (off != nullptr) {
    *off = {std::sqrt(errors[0]) / level, std::sqrt(errors[1]) / other_level};
  }
  return surface_errors(surfaces, mean, replicas);
}

TEST(SurfaceErrors, AreRelativeToTheLevelOfTheSurface) {
  const SurfaceErrors errors = errors_of(400, 10, 0.8, 1, 0.4);
  ASSERT_EQ(errors.surfaces.size(), 2U);
  EXPECT_NEAR(errors.surfaces[0].level, 10, 0.1);
  EXPECT_NEAR(errors.surfaces[0].rms, 0.08 / std::sqrt(8), 0.003);
  EXPECT_NEAR(errors.surfaces[1].rms, 0.4 / std::sqrt(8), 0.01);
  EXPECT_EQ(errors.worst, 1);
  EXPECT_GE(errors.limit, errors.surfaces[1].limit);
  EXPECT_FALSE(errors.surfaces[1].is_dark);
}

TEST(SurfaceErrors, InTheDarkAreRelativeToAThousandthOfTheBrightest) {
  const SurfaceErrors errors = errors_of(400, 10, 0.8, 1e-4, 1e-4);
  EXPECT_TRUE(errors.surfaces[1].is_dark);
  EXPECT_NEAR(errors.surfaces[1].rms, 1e-4 / std::sqrt(8) / 0.01, 2e-4);
}

/// With one surface it is the limit of that surface; where both are alike, each may exceed it half
/// as often.
TEST(SurfaceErrors, CommonLimitAddsProbabilities) {
  const SurfaceErrors errors = errors_of(50, 1, 0.3, 1, 0.3);
  const SurfaceError& one = errors.surfaces[0];
  EXPECT_NEAR(limit_of_all(errors, {"one"}), one.limit, 1e-3 * one.limit);
  double sum = 0;
  for (const SurfaceError& surface : errors.surfaces) {
    const boost::math::fisher_f fisher(surface.independent_errors, 7 * surface.independent_errors);
    sum += cdf(complement(fisher, std::pow(errors.limit / surface.spread, 2)));
  }
  EXPECT_NEAR(sum, 0.05, 2e-3);
  // A second surface that is hardly off does not count.
  const SurfaceErrors uneven = errors_of(50, 1, 0.3, 1, 0.001);
  EXPECT_NEAR(uneven.limit, uneven.surfaces[0].limit, 1e-3 * uneven.limit);
}

TEST(SurfaceErrors, CommonLimitHoldsAsOftenAsStated) {
  int held = 0;
  constexpr int runs = 400;
  for (int run = 0; run < runs; ++run) {
    std::vector<double> off;
    const SurfaceErrors errors =
        errors_of(2, 10, 1, 1, 0.1, &off, 100 + static_cast<std::uint64_t>(run));
    held += std::max(off[0], off[1]) <= errors.limit ? 1 : 0;
  }
  EXPECT_GE(held, 0.95 * runs - 2.33 * std::sqrt(0.95 * 0.05 * runs));
}

TEST(SurfaceErrors, BiasAddsAsARootOfSquares) {
  SurfaceErrors errors = errors_of(100, 2, 0.1, 1, 0.1);
  Surfaces surfaces;
  surfaces.surfaces = {{"one", 100, 1}, {"other", 100, 1}};
  surfaces.of_patch.assign(100, 0);
  surfaces.of_patch.resize(200, 1);
  const double before = errors.limit;
  std::vector<Rgb> bias(200);
  std::fill(bias.begin(), bias.begin() + 100, Rgb{1, 1, 1});
  include_bias(errors, surfaces, bias);
  EXPECT_NEAR(errors.surfaces[0].bias, 0.5, 0.01);
  EXPECT_NEAR(errors.surfaces[0].rms, std::hypot(0.5, errors.surfaces[0].spread), 0.01);
  EXPECT_EQ(errors.surfaces[1].bias, 0);
  EXPECT_EQ(errors.worst, 0);
  EXPECT_GT(errors.limit, before);
}

TEST(SurfaceErrors, OfNothingAreNothing) {
  Surfaces surfaces;
  surfaces.surfaces = {{"one", 2, 1}};
  surfaces.of_patch = {0, 0};
  const std::vector<Rgb> dark(2);
  const SurfaceErrors errors = surface_errors(surfaces, dark, {dark, dark, dark});
  EXPECT_EQ(errors.limit, 0);
  EXPECT_EQ(surface_differences(surfaces, dark, dark).limit, 0);
  const std::vector<Rgb> lit(2, {1, 1, 1});
  EXPECT_EQ(surface_differences(surfaces, dark, lit).limit, HUGE_VAL);
}

}  // namespace
}  // namespace transillum::surface_errors_test
