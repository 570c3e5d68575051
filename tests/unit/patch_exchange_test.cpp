// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "visibility/pairs/patch_exchange.h"

#include <gtest/gtest.h>

#include <cmath>

#include "support/scenes.h"
#include "transillum/at.h"
#include "transillum/form_factors.h"

namespace transillum::patch_exchange_test {
namespace {

using testing::Sketch;

std::vector<Vec3> level_square(double z, bool up) {
  if (up) {
    return {{0, 0, z}, {1, 0, z}, {1, 1, z}, {0, 1, z}};
  }
  return {{0, 0, z}, {0, 1, z}, {1, 1, z}, {1, 0, z}};
}

constexpr double parallel_unit_squares = 0.1998248957;  // at distance 1

TEST(PatchExchange, IsCompleteInAConvexRoom) {
  Sketch sketch;
  sketch.box({0, 0, 0}, {1, 1, 1}, true, sketch.material(0.5, 1));
  const auto scene = sketch.scene({.max_patch_area = 0.08});
  const ExchangeFinder exchange(*scene);
  for (PatchId i = 0; i < scene->patch_count(); i += 7) {
    double sum = 0;
    for (PatchId j = 0; j < scene->patch_count(); ++j) {
      const PatchExchange e = exchange(i, j);
      EXPECT_TRUE(e.whole);
      sum += e.area;
    }
    EXPECT_NEAR(sum / scene->patch(i).area, 1, 1e-12);
  }
}

TEST(PatchExchange, PolygonsThatTouchTheShaftDoNotBlock) {
  Sketch sketch;
  const int gray = sketch.material(0.5, 0);
  sketch.face(level_square(0, true), gray).face(level_square(1, false), gray);
  // The squares are beside each other, coplanar, or behind each other, with a common edge or
  // corner.
  sketch.face({{0, 0, 0}, {0, 1, 0}, {0, 1, 1}, {0, 0, 1}}, gray);
  sketch.face({{1, 1, 1}, {2, 1, 0.5}, {1, 2, 0.5}}, gray);
  sketch.face({{1, 0, 0}, {2, 0, 0}, {2, 1, 0}, {1, 1, 0}}, gray);
  sketch.face(level_square(1.5, false), gray);
  const auto scene = sketch.scene({.two_sided = true});
  const PatchExchange e = ExchangeFinder(*scene)(0, 2);
  EXPECT_TRUE(e.whole);
  EXPECT_NEAR(e.area, parallel_unit_squares, 1e-10);
}

TEST(PatchExchange, IsZeroForAHiddenPatch) {
  Sketch sketch;
  const int gray = sketch.material(0.5, 0);
  sketch.face(level_square(0, true), gray).face(level_square(1, false), gray);
  // Two halves that share an edge; one faces up and one down.
  sketch.face({{-9, -9, .5}, {9, -9, .5}, {9, .3, .5}, {-9, .3, .5}}, gray);
  sketch.face({{-9, 9, .5}, {9, 9, .5}, {9, .3, .5}, {-9, .3, .5}}, gray);
  const PatchExchange e = ExchangeFinder(*sketch.scene())(0, 1);
  EXPECT_FALSE(e.whole);
  EXPECT_NEAR(e.area, 0, 1e-14);
}

/// A partition divides floor and ceiling, so that each part sees one part. The points are placed
/// independently of the partition.
TEST(PatchExchange, BehindAPartitionConverges) {
  Sketch parted;
  const int gray = parted.material(0.5, 0);
  parted.face(level_square(0, true), gray).face(level_square(1, false), gray);
  parted.face({{.3, 0, 0}, {.3, 1, 0}, {.3, 1, 1}, {.3, 0, 1}}, gray);
  double exact = 0;
  for (const auto& [x0, x1] : {std::pair{0.0, 0.3}, {0.3, 1.0}}) {
    const std::vector<Vec3> floor{{x0, 0, 0}, {x1, 0, 0}, {x1, 1, 0}, {x0, 1, 0}};
    const std::vector<Vec3> ceiling{{x0, 0, 1}, {x0, 1, 1}, {x1, 1, 1}, {x1, 0, 1}};
    exact += polygon_exchange(floor, ceiling);
  }
  const auto scene = parted.scene();
  // Measured: 2.3e-3, 5.7e-4, 2.1e-4.
  for (const auto& [density, accuracy] : {std::pair{4.0, 4e-3}, {16.0, 1e-3}, {40.0, 4e-4}}) {
    const PatchExchange e = ExchangeFinder(*scene, {}, density)(0, 1);
    EXPECT_FALSE(e.whole);
    EXPECT_NEAR(e.area, exact, accuracy) << density;
  }
}

/// A plate floats in a room. Where the floor does not see the ceiling, it sees the plate.
TEST(PatchExchange, BehindAFloatingBlockerConvergesQuadratically) {
  Sketch sketch;
  const int gray = sketch.material(0.5, 1);
  sketch.box({0, 0, 0}, {1, 1, 1}, true, gray);
  sketch.face({{.3, .2, .5}, {.7, .3, .4}, {.6, .8, .55}, {.25, .6, .6}}, gray);
  const auto scene = sketch.scene({.two_sided = true});
  double last = 1e-2;
  for (const double density : {2.0, 8.0, 32.0}) {
    const ExchangeFinder exchange(*scene, {}, density);
    double error = 0;
    for (PatchId i = 0; i < scene->patch_count(); i += 2) {
      double sum = 0;
      for (PatchId j = 0; j < scene->patch_count(); ++j) {
        sum += exchange(i, j).area;
      }
      error = std::max(error, std::abs(sum / scene->patch(i).area - 1));
    }
    EXPECT_LT(error, last) << density;
    last = error / 8;
  }
}

/// Two boards of which one sees the other only from a strip along an edge, or from all but a strip:
/// rows of `pairs` find it, and errors say that points may have missed it.
void expect_strip_is_found(const std::vector<Vec3>& board, const std::vector<Vec3>& other,
                           const std::vector<Vec3>& blocker) {
  Sketch sketch;
  const int gray = sketch.material(0.5, 0);
  sketch.face(board, gray).face(other, gray).face(blocker, gray);
  const auto scene = sketch.scene({.two_sided = true});
  // The edge of the blocker that matters runs along x, through y = 0.1, z = 0, and is as good as
  // endless: a plane through it and a point cuts off what is hidden.
  constexpr int columns = 40, rows = 4000;
  double exact = 0;
  for (int i = 0; i < columns; ++i) {
    for (int k = 0; k < rows; ++k) {
      const Vec3 along = board[1] - board[0], up = board[3] - board[0];
      const Vec3 x = board[0] + (i + 0.5) / columns * along + (k + 0.5) / rows * up;
      const Vec3 normal = normalized(Vec3{0, x.z, 0.1});  // upward
      const Corners seen = clipped(other, {normal, dot(normal, x)});
      exact += seen.empty() ? 0 : point_form_factor(x, {0, 1, 0}, seen) / (columns * rows);
    }
  }
  exact *= scene->patch(0).area;
  ASSERT_GT(exact, 0);
  for (const double density : {16.0, 32.0}) {
    const ExchangeFinder exchange(*scene, {}, density);
    const double tolerated = std::max(6 * exact, 0.03 * scene->patch(0).area) / (density * density);
    EXPECT_NEAR(exchange.area_between(0, 2, {}), exact, tolerated) << density;
    const PatchExchange estimated = exchange(0, 2);
    EXPECT_LE(std::abs(estimated.area - exact), 2 * std::abs(estimated.error)) << density;
  }
}

TEST(PatchExchange, FindsAStripThatSees) {
  // Over a wall as high as the board.
  expect_strip_is_found({{.05, 0, -.2}, {-.05, 0, -.2}, {-.05, 0, 0}, {.05, 0, 0}},
                        {{-4, 1, -.3}, {4, 1, -.3}, {4, 1, .076}, {-4, 1, .078}},
                        {{-99, .1, -1}, {99, .1, -1}, {99, .1, 0}, {-99, .1, 0}});
}

TEST(PatchExchange, FindsAStripThatDoesNotSee) {
  // Over a lower wall.
  expect_strip_is_found({{.05, 0, -.006}, {-.05, 0, -.006}, {-.05, 0, .2}, {.05, 0, .2}},
                        {{-4, 1, -.05}, {4, 1, -.06}, {4, 1, .3}, {-4, 1, .3}},
                        {{-99, .1, -1}, {99, .1, -1}, {99, .1, 0}, {-99, .1, 0}});
}

/// Past three boards, sums over points of the first patch and over a quarter of them agree by
/// chance to 0.2 %, and both miss an eighth.
TEST(PatchExchange, DoesNotTrustSumsThatAgreeByChance) {
  Sketch sketch;
  const int gray = sketch.material(0.5, 0);
  const std::vector<std::vector<Vec3>> boards{
      {{.042, -.011, -.01}, {.017, .038, -.015}, {-.042, .011, .01}, {-.017, -.038, .015}},
      {{-.669, .39, 1.644}, {1.115, -.111, 2.128}, {.7, -1.367, 2.356}, {-1.084, -.866, 1.872}},
      {{.133, -.216, -.023}, {-.456, .532, .131}, {-.364, .45, .878}, {.225, -.298, .724}},
      {{.201, -.037, .437}, {.239, .384, .347}, {.26, .445, .643}, {.222, .025, .733}},
      {{.249, .35, 1.08}, {-.14, .746, 1.021}, {-.625, .39, 1.823}, {-.236, -.007, 1.882}}};
  for (const std::vector<Vec3>& board : boards) {
    sketch.face(board, gray);
  }
  const auto scene = sketch.scene();
  // By ten million pairs of random points of both; the standard error is 2e-5.
  constexpr double exact = 0.041425;
  const double area = scene->patch(0).area;
  for (const double density : {16.0, 32.0}) {
    const ExchangeFinder exchange(*scene, {}, density);
    EXPECT_NEAR(exchange.area_between(0, 1, {}) / area, exact, 0.01 * exact) << density;
    const PatchExchange estimated = exchange(0, 1);
    EXPECT_LE(std::abs(estimated.area / area - exact), 3 * std::abs(estimated.error) / area)
        << density;
    EXPECT_LE(std::abs(estimated.error) / area, 0.1 * exact) << density;
  }
}

/// A lamp in the plane of its ceiling, with the same normal, covers it.
TEST(PatchExchange, TheBrighterOfCoincidentPatchesIsVisible) {
  Sketch sketch;
  const int gray = sketch.material(0.5, 0), light = sketch.material(0.5, 9);
  sketch.face(level_square(0, true), gray).face(level_square(1, false), gray);
  sketch.face({{.5, 0, 1}, {.5, 1, 1}, {1, 1, 1}, {1, 0, 1}}, light);
  const ExchangeFinder exchange(*sketch.scene());
  EXPECT_NEAR(exchange(0, 1).area, parallel_unit_squares / 2, 1e-10);
  EXPECT_NEAR(exchange(0, 2).area, parallel_unit_squares / 2, 1e-10);
  EXPECT_TRUE(exchange(0, 1).whole);
}

/// Interpenetrating triangles, against ray casting.
TEST(PatchExchange, AgreesWithRays) {
  for (const std::uint64_t seed : {1, 2, 3}) {
    Sketch sketch;
    const int gray = sketch.material(0.5, 1);
    sketch.triangles(12, 0.8, seed, gray);
    sketch.face({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {.5, 1, 0}, {.5, .5, 0}, {0, .5, 0}}, gray);
    const auto scene = sketch.scene({.two_sided = true});
    constexpr int rays = 1 << 16;
    const FormFactors gathered = gather_form_factors(*scene, {.rays_per_patch = rays});
    const ExchangeFinder exchange(*scene);
    int partial = 0;
    for (PatchId i = 0; i < scene->patch_count(); ++i) {
      std::vector<double> row(static_cast<std::size_t>(scene->patch_count()));
      const auto begin = at(gathered.row_begin, i);
      const auto end = gathered.row_begin[static_cast<std::size_t>(i) + 1];
      for (std::size_t k = begin; k < end; ++k) {
        at(row, gathered.source[k]) = gathered.value[k];
      }
      for (PatchId j = 0; j < scene->patch_count(); ++j) {
        const PatchExchange e = exchange(i, j);
        const double f = e.area / scene->patch(i).area;
        // Four standard deviations of a count, and the quadrature's error near a blocker.
        const double deviation = std::sqrt(f * (1 - std::min(f, 1.0)) / rays) + 1.0 / rays;
        EXPECT_NEAR(at(row, j), f, 4 * deviation + (e.whole ? 0 : 2e-3))
            << seed << ": " << i << " " << j;
        partial += !e.whole && e.area > 0;
      }
    }
    EXPECT_GT(partial, 20);
  }
}

TEST(PatchExchange, RowsOfClosedScenesSumToOne) {
  for (const auto& [spec, accuracy] :
       {std::pair{"cornell-box", 1e-3}, {"furnace", 1e-3}, {"stars:n=2", 1e-3}}) {
    const auto scene = load_scene(spec);
    const ExchangeFinder exchange(*scene);
    for (PatchId i = 0; i < scene->patch_count(); i += 3) {
      double sum = 0;
      for (PatchId j = 0; j < scene->patch_count(); ++j) {
        sum += exchange(i, j).area;
      }
      EXPECT_NEAR(sum / scene->patch(i).area, 1, accuracy) << spec << " " << i;
    }
  }
}

}  // namespace
}  // namespace transillum::patch_exchange_test
