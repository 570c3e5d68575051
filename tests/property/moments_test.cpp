// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
// ALGORITHM.md 6.12: moments of exchanges, for a linear basis. Oracles 1, 2, 5 and 7 for them.

#include <gtest/gtest.h>

#include <array>
#include <map>

#include "support/imperfect_scenes.h"
#include "support/random_scenes.h"
#include "support/scenes.h"
#include "support/transfer_difference.h"
#include "transillum/at.h"
#include "transillum/engine.h"
#include "transillum/errors.h"
#include "transillum/linear_basis.h"

namespace transillum::moments_test {
namespace {

using testing::largest_difference;
using testing::moments_of;
using testing::PairMoments;
using testing::Sketch;
using testing::test_directions;

const EngineOptions with_moments{.moments = true};

/// An L, a kite, a long triangle, a hexagon with a reentrant corner, and a square.
Sketch shapes() {
  Sketch sketch;
  const int gray = sketch.material(0.5, 1);
  sketch.face({{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {1, 1, 0}, {1, 3, 0}, {0, 3, 0}}, gray);
  sketch.face({{0, 0, 1}, {1, -1, 1}, {4, 0, 1}, {1, 1, 1}}, gray);
  sketch.face({{0, 0, 2}, {1000, 0, 2}, {400, 0.01, 2}}, gray);
  sketch.face({{0, 0, 3}, {3, 0, 3}, {3, 2, 4}, {1.5, 0.2, 3.1}, {0, 2, 4}}, gray);
  sketch.face({{5, 0, 0}, {5, 1, 0}, {5, 1, 1}, {5, 0, 1}}, gray);
  return sketch;
}

/// Integral of f over a patch, by the three midpoints of edges of the triangles of its pieces,
/// which is exact for polynomials of degree 2.
template <class Function>
double integral(const Scene& scene, PatchId i, Function f) {
  double sum = 0;
  for (const Piece& piece : scene.pieces()) {
    if (piece.patch != i) {
      continue;
    }
    const auto corners = scene.corners(piece);
    for (std::size_t k = 2; k < corners.size(); ++k) {
      const Vec3 &a = scene.point(corners[0]), &b = scene.point(corners[k - 1]),
                 &c = scene.point(corners[k]);
      const double area = dot(cross(b - a, c - a), scene.patch(i).normal) / 2;
      sum += area / 3 * (f(0.5 * (a + b)) + f(0.5 * (b + c)) + f(0.5 * (c + a)));
    }
  }
  return sum;
}

TEST(LinearBasis, IsOrthonormalOnAnyPolygon) {
  const auto scene = shapes().scene();
  for (PatchId i = 0; i < scene->patch_count(); ++i) {
    const LinearBasis basis = linear_basis(*scene, i);
    const double area = scene->patch(i).area;
    for (std::size_t a = 0; a < 2; ++a) {
      const auto phi = [&](const Vec3& x) { return basis.at(x)[a]; };
      EXPECT_NEAR(integral(*scene, i, phi) / area, 0, 1e-11) << i;
      EXPECT_NEAR(integral(*scene, i, [&](const Vec3& x) { return phi(x) * phi(x); }) / area, 1,
                  1e-11)
          << i;
      EXPECT_NEAR(dot(basis.gradient[a], scene->patch(i).normal) / norm(basis.gradient[a]), 0,
                  1e-12);
    }
    const auto product = [&](const Vec3& x) { return basis.at(x)[0] * basis.at(x)[1]; };
    EXPECT_NEAR(integral(*scene, i, product) / area, 0, 1e-11) << i;
  }
}

void expect_closure(const std::shared_ptr<const Scene>& scene, Engine by, int directions) {
  const auto tree = std::make_shared<const BspTree>(*scene);
  const TransferEngine engine = make_engine(by, scene, tree, with_moments);
  for (const Vec3& omega : test_directions(directions, 7)) {
    const Transfers transfers = engine(omega, {});
    ASSERT_EQ(transfers.moments.size(), transfers.exchanges.size());
    ASSERT_LE(closure_defect(transfers, *scene).moments, 1e-10)
        << omega.x << ", " << omega.y << ", " << omega.z;
    for (std::size_t k = 0; k < transfers.exchanges.size(); ++k) {
      ASSERT_EQ(transfers.moments[k].of(0, 0), transfers.exchanges[k].area);
    }
    // The projection of a patch has no first moments.
    for (PatchId i = 0; i < scene->patch_count(); ++i) {
      for (std::size_t a = 0; a < 2; ++a) {
        ASSERT_NEAR(at(transfers.forward_moments, i).projected[a], 0, 1e-10 * scene->patch(i).area);
        ASSERT_NEAR(at(transfers.backward_moments, i).projected[a], 0,
                    1e-10 * scene->patch(i).area);
      }
    }
  }
}

TEST(MomentClosure, WhatIsSeenHasTheMomentsOfTheProjection) {
  for (const Engine engine : {Engine::fast, Engine::local}) {
    SCOPED_TRACE(name_of(engine));
    expect_closure(load_scene("cornell-box"), engine, 100);
    expect_closure(load_scene("cornell-box", {.max_patch_area = 0.05}), engine, 50);
    expect_closure(load_scene("rooms"), engine, 50);
    expect_closure(load_scene("boards"), engine, 50);
    expect_closure(load_scene("sphere-flake:levels=1"), engine, 20);
  }
}

TEST(MomentClosure, HoldsWhereSurfacesInterpenetrate) {
  Sketch sketch;
  const int gray = sketch.material(0.5, 1);
  sketch.tetrahedra(10, 0.6, 23, gray).box({-0.5, -0.5, -0.5}, {1.5, 1.5, 1.5}, true, gray);
  for (const Engine engine : {Engine::fast, Engine::local}) {
    expect_closure(sketch.scene(), engine, 100);
  }
}

/// Compares fast with local, and both with exact where that is quick.
void expect_agreement(const Scene& scene, const std::vector<Vec3>& directions) {
  const auto shared = std::make_shared<const Scene>(scene);
  const auto tree = std::make_shared<const BspTree>(*shared);
  const auto fast = make_engine(Engine::fast, shared, tree, with_moments);
  const auto local = make_engine(Engine::local, shared, tree, with_moments);
  const auto exact = make_engine(Engine::exact, shared, tree, with_moments);
  for (const Vec3& omega : directions) {
    const PairMoments by_fast = moments_of(fast(omega, {}));
    const PairMoments by_local = moments_of(local(omega, {}));
    ASSERT_LE(largest_difference(scene, by_fast, by_local), 1e-10)
        << omega.x << ", " << omega.y << ", " << omega.z;
    if (tree->fragments().size() <= 100) {
      const PairMoments by_exact = moments_of(exact(omega, {}));
      ASSERT_LE(largest_difference(scene, by_local, by_exact), 1e-10)
          << omega.x << ", " << omega.y << ", " << omega.z;
    }
  }
}

TEST(MomentAgreement, OfEnginesOnBuiltIns) {
  for (const char* spec : {"cornell-box", "furnace", "boards", "rooms", "stars"}) {
    SCOPED_TRACE(spec);
    expect_agreement(*load_scene(spec), test_directions(10, 5));
  }
  expect_agreement(*load_scene("sphere-flake:levels=1"), test_directions(3, 5));
}

TEST(MomentAgreement, OfEnginesOnRandomScenesWithDegeneracies) {
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    const testing::RandomScene random = testing::random_scene(seed);
    SCOPED_TRACE(::testing::Message() << "seed " << seed << ", " << random.kind);
    expect_agreement(Scene(random.description, random.options), random.directions);
  }
}

TEST(MomentAgreement, OfEnginesOnScenesAsFilesHaveThem) {
  for (std::uint64_t seed = 1; seed <= 30; ++seed) {
    const testing::RandomScene random = testing::random_imperfect_scene(seed);
    SCOPED_TRACE(::testing::Message() << "seed " << seed << ", " << random.kind);
    expect_agreement(Scene(random.description, random.options), random.directions);
  }
}

/// Oracle 2: T^ab(i,j,omega) = T^ba(j,i,-omega), here by separate passes.
TEST(MomentReciprocity, HoldsBetweenOppositePasses) {
  const auto scene = load_scene("rooms");
  const auto tree = std::make_shared<const BspTree>(*scene);
  const TransferEngine engine = make_engine(Engine::fast, scene, tree, with_moments);
  for (const Vec3& omega : test_directions(20, 3)) {
    const PairMoments there = moments_of(engine(omega, {}));
    PairMoments back;
    for (const auto& [pair, moments] : moments_of(engine(-omega, {}))) {
      TransferMoments& turned = back[{pair.second, pair.first}];
      for (std::size_t a = 0; a < 3; ++a) {
        for (std::size_t b = 0; b < 3; ++b) {
          turned.of(a, b) = moments.of(b, a);
        }
      }
    }
    ASSERT_LE(largest_difference(*scene, there, back), 1e-10);
  }
}

/// phi_a of the whole on a part: its value at the part's center, and its coefficients there.
std::array<double, 3> on_part(const LinearBasis& whole, std::size_t a, const LinearBasis& part) {
  std::array<double, 3> coefficients{1, 0, 0};
  if (a > 0) {
    const Vec3& g = whole.gradient[a - 1];
    coefficients[0] = dot(g, part.center - whole.center);
    // The gradient of phi_2 is perpendicular to the gradient of phi_1, except for a part along it.
    const Vec3 &g1 = part.gradient[0], &g2 = part.gradient[1];
    const Vec3 across = g2 - (dot(g2, g1) / dot(g1, g1)) * g1;
    coefficients[2] = dot(g, across) / dot(across, across);
    coefficients[1] = dot(g - coefficients[2] * g2, g1) / dot(g1, g1);
  }
  return coefficients;
}

/// Oracle 5: the moments of a concave wall are the sums over three parts into which it is cut by
/// hand.
TEST(MomentInvariance, MomentsOfPartsAddUp) {
  const auto scene = [](bool cut) {
    Sketch sketch;
    const int gray = sketch.material(0.5, 1);
    if (cut) {
      sketch.face({{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {1, 1, 0}}, gray);
      sketch.face({{0, 0, 0}, {1, 1, 0}, {1, 2, 0}}, gray);
      sketch.face({{0, 0, 0}, {1, 2, 0}, {1, 3, 0}, {0, 3, 0}}, gray);
    } else {
      sketch.face({{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {1, 1, 0}, {1, 3, 0}, {0, 3, 0}}, gray);
    }
    sketch.tetrahedra(6, 0.7, 11, gray);
    sketch.box({-1, -1, -1}, {3, 4, 3}, true, gray);
    return sketch.scene();
  };
  const auto whole = scene(false), parts = scene(true);
  const PatchId cuts = 3;
  const auto engine_of = [](const std::shared_ptr<const Scene>& of) {
    return make_engine(Engine::fast, of, std::make_shared<const BspTree>(*of), with_moments);
  };
  const TransferEngine of_whole = engine_of(whole), of_parts = engine_of(parts);
  const LinearBasis basis = linear_basis(*whole, 0);
  int compared = 0;
  for (const Vec3& omega : test_directions(40, 9)) {
    std::map<PatchId, TransferMoments> sums;
    for (const auto& [pair, moments] : moments_of(of_parts(omega, {}))) {
      if (pair.first >= cuts) {
        continue;
      }
      TransferMoments& sum = sums[pair.second - cuts + 1];
      for (std::size_t a = 0; a < 3; ++a) {
        const auto coefficients = on_part(basis, a, linear_basis(*parts, pair.first));
        for (std::size_t b = 0; b < 3; ++b) {
          for (std::size_t c = 0; c < 3; ++c) {
            sum.of(a, b) += coefficients[c] * moments.of(c, b);
          }
        }
      }
    }
    for (const auto& [pair, moments] : moments_of(of_whole(omega, {}))) {
      if (pair.first != 0) {
        continue;
      }
      ++compared;
      for (std::size_t k = 0; k < moments.value.size(); ++k) {
        ASSERT_NEAR(moments.value[k], sums[pair.second].value[k], 1e-11);
      }
    }
  }
  EXPECT_GT(compared, 100);
}

TEST(Moments, AreasHaveTheBitsOfPassesWithoutMoments) {
  for (const char* spec : {"rooms", "sphere-flake:levels=1"}) {
    const auto scene = load_scene(spec);
    const auto tree = std::make_shared<const BspTree>(*scene);
    for (const Engine engine : {Engine::fast, Engine::local}) {
      const auto with = make_engine(engine, scene, tree, with_moments);
      const auto without = make_engine(engine, scene, tree);
      for (const Vec3& omega : test_directions(8, 2)) {
        const Transfers a = with(omega, {}), b = without(omega, {});
        EXPECT_TRUE(b.moments.empty());
        ASSERT_EQ(a.exchanges.size(), b.exchanges.size());
        for (std::size_t k = 0; k < a.exchanges.size(); ++k) {
          ASSERT_EQ(a.exchanges[k].area, b.exchanges[k].area);
        }
      }
    }
  }
}

TEST(Moments, OtherEnginesRefuseThem) {
  const auto scene = load_scene("furnace");
  const auto tree = std::make_shared<const BspTree>(*scene);
  for (const Engine engine :
       {Engine::global, Engine::zbuffer, Engine::painter, Engine::rays, Engine::corrected}) {
    EXPECT_FALSE(has_moments(engine));
    EXPECT_THROW(make_engine(engine, scene, tree, with_moments), InputError) << name_of(engine);
  }
}

}  // namespace
}  // namespace transillum::moments_test
