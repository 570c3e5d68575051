// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
// Parts of the engines: plane index, BSP tree and sums of exchanges.
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <random>

#include "radiosity/exchange/exchange_sums.h"
#include "support/canceled.h"
#include "support/scenes.h"
#include "transillum/at.h"
#include "transillum/bsp_tree.h"
#include "transillum/engine.h"
#include "visibility/plane/plane_index.h"

namespace transillum::visibility_test {
namespace {

using testing::Sketch;

double uniform(std::mt19937_64& generator) {
  return static_cast<double>(generator() >> 11) * 0x1p-53;
}

TEST(PlaneIndex, FindsOverlapsWhileBoxesAreInsertedAndErased) {
  std::mt19937_64 generator(1);
  PlaneIndex index({-1, -1, 1, 1}, 300);
  std::vector<PlaneBox> boxes(400);
  std::vector<bool> present(400, false);
  const auto random_box = [&] {
    // Sizes over four decades.
    const double size = std::pow(10, -4 * uniform(generator));
    const double x = 2 * uniform(generator) - 1, y = 2 * uniform(generator) - 1;
    return PlaneBox{x, y, x + size * uniform(generator), y + size * uniform(generator)};
  };
  for (int trial = 0; trial < 3000; ++trial) {
    const auto id = static_cast<std::size_t>(generator() % boxes.size());
    if (present[id]) {
      index.erase(static_cast<std::int32_t>(id));
    } else {
      boxes[id] = random_box();
      index.insert(static_cast<std::int32_t>(id), boxes[id]);
    }
    present[id] = !present[id];
    if (trial % 10 != 0) {
      continue;
    }
    const PlaneBox asked = random_box();
    std::vector<std::int32_t> found, expected;
    index.query(asked, found);
    for (std::size_t k = 0; k < boxes.size(); ++k) {
      if (present[k] && boxes[k].x0 < asked.x1 && asked.x0 < boxes[k].x1 &&
          boxes[k].y0 < asked.y1 && asked.y0 < boxes[k].y1) {
        expected.push_back(static_cast<std::int32_t>(k));
      }
    }
    EXPECT_THAT(found, ::testing::UnorderedElementsAreArray(expected));
  }
}

/// Area of a fragment in space, m².
double area_of(const BspTree& tree, const BspTree::Fragment& fragment) {
  const auto corners = tree.corners(fragment);
  const auto place = [&](std::size_t k) { return at(tree.points(), corners[k].point); };
  Vec3 twice;
  for (std::size_t k = 2; k < corners.size(); ++k) {
    twice = twice + cross(place(k - 1) - place(0), place(k) - place(0));
  }
  return norm(twice) / 2;
}

void expect_consistent(const Scene& scene, const BspTree& tree) {
  std::vector<double> areas(static_cast<std::size_t>(scene.patch_count()), 0.0);
  for (const auto& fragment : tree.fragments()) {
    at(areas, fragment.patch) += area_of(tree, fragment);
    for (const auto& corner : tree.corners(fragment)) {
      // Every edge lies on its line.
      const auto& line = at(tree.lines(), corner.line);
      const Vec3& a = at(tree.points(), line.a);
      const Vec3& b = at(tree.points(), line.b);
      const Vec3& p = at(tree.points(), corner.point);
      EXPECT_LE(norm(cross(normalized(b - a), p - a)), 1e-13 * scene.bounds().diagonal());
    }
  }
  for (PatchId i = 0; i < scene.patch_count(); ++i) {
    EXPECT_NEAR(at(areas, i), scene.patch(i).area, 1e-12 * scene.patch(i).area);
  }
  // Each fragment occurs once in every order.
  for (const Vec3& omega : testing::test_directions(10, 1)) {
    auto order = tree.order(omega);
    std::sort(order.begin(), order.end());
    ASSERT_EQ(order.size(), tree.fragments().size());
    for (std::size_t k = 0; k < order.size(); ++k) {
      EXPECT_EQ(order[k], static_cast<FragmentId>(k));
    }
  }
}

TEST(BspTree, FragmentsAddUpToThePatches) {
  for (const char* spec :
       {"cornell-box", "boards", "rooms", "stars", "furnace", "sphere-flake:levels=1"}) {
    const auto scene = load_scene(spec);
    expect_consistent(*scene, BspTree(*scene));
  }
}

TEST(BspTree, CutsInterpenetratingTriangles) {
  Sketch sketch;
  const auto scene = sketch.triangles(60, 1.5, 2, sketch.material(0.5, 1)).scene();
  const BspTree tree(*scene);
  EXPECT_GT(tree.fragments().size(), scene->pieces().size());
  expect_consistent(*scene, tree);
}

/// Triangles whose planes nearly coincide: several successive corners of an outline are treated as
/// on the plane, and must not be assigned to both sides.
TEST(BspTree, KeepsTheAreaOfNearlyCoplanarTriangles) {
  std::mt19937_64 generator(3);
  for (const double spread : {1e-13, 1e-12, 1e-11, 1e-9}) {
    Sketch sketch;
    const int gray = sketch.material(0.5, 1);
    for (int k = 0; k < 40; ++k) {
      std::vector<Vec3> outline;
      for (int corner = 0; corner < 3; ++corner) {
        outline.push_back(
            {uniform(generator), uniform(generator), 0.5 + spread * uniform(generator)});
      }
      sketch.face(outline, gray);
    }
    sketch.box({-1, -1, -1}, {2, 2, 2}, true, gray);
    const auto scene = sketch.scene();
    const auto tree = std::make_shared<const BspTree>(*scene);
    std::vector<double> areas(static_cast<std::size_t>(scene->patch_count()), 0.0);
    for (const auto& fragment : tree->fragments()) {
      at(areas, fragment.patch) += area_of(*tree, fragment);
    }
    for (PatchId i = 0; i < scene->patch_count(); ++i) {
      EXPECT_NEAR(at(areas, i), scene->patch(i).area, 1e-9) << spread;
    }
    const TransferEngine engine = make_engine(Engine::local, scene, tree);
    for (const Vec3& omega : testing::test_directions(20, 2)) {
      EXPECT_LE(closure_defect(engine(omega, {}), *scene).relative, 1e-6) << spread;
    }
  }
}

TEST(BspTree, SplitsFewFacesOfTheSphereFlake) {
  const auto scene = load_scene("sphere-flake");
  const BspTree tree(*scene);
  EXPECT_LE(static_cast<double>(tree.fragments().size()), 1.15 * scene->patch_count());
}

TEST(BspTree, ThrowsWhenCanceled) {
  const auto scene = load_scene("furnace");
  EXPECT_THROW(BspTree(*scene, testing::canceled()), Canceled);
  EXPECT_THROW(BspTree(*scene).order({0, 0, 1}, testing::canceled()), Canceled);
}

/// Among coincident faces, receiving ones come before emitting ones; a lamp covers its ceiling.
TEST(BspTree, OrdersCoincidentFaces) {
  Sketch sketch;
  const int gray = sketch.material(0.5, 0), lamp = sketch.material(0, 1);
  const std::vector<Vec3> down{{0, 0, 1}, {0, 1, 1}, {1, 1, 1}, {1, 0, 1}};
  std::vector<Vec3> up(down.rbegin(), down.rend());
  sketch.face(down, gray).face(down, lamp).face(up, gray);
  const auto scene = sketch.scene();
  const BspTree tree(*scene);
  std::vector<PatchId> patches;
  for (const FragmentId f : tree.order({0, 0, 1})) {
    patches.push_back(tree.fragment(f).patch);
  }
  // Toward +z: first the upward face, which receives; then ceiling and lamp, which emit downward,
  // the lamp last.
  EXPECT_THAT(patches, ::testing::ElementsAre(2, 0, 1));
  patches.clear();
  for (const FragmentId f : tree.order({0, 0, -1})) {
    patches.push_back(tree.fragment(f).patch);
  }
  // Toward -z: the lamp comes first, so it receives.
  EXPECT_THAT(patches, ::testing::ElementsAre(1, 0, 2));
}

TEST(ExchangeSums, AddUpAndGatherInBothDirections) {
  std::mt19937_64 generator(8);
  for (const bool two_way : {false, true}) {
    constexpr std::size_t n = 12;
    ExchangeSums sums(12, two_way, 1 << 20, {});
    double dense[n][n] = {};
    for (int pass = 0; pass < 37; ++pass) {
      std::vector<Transfer> exchanges;
      for (PatchId i = 0; i < 12; ++i) {
        for (PatchId j = 0; j < 12; ++j) {
          if (i == j || uniform(generator) > 0.2) {
            continue;
          }
          const double area = uniform(generator);
          exchanges.push_back({i, j, area});
          dense[i][j] += area;
          if (two_way) {
            dense[j][i] += area;
          }
        }
      }
      sums.add(sums.sort(exchanges));
    }
    sums.finish();
    std::vector<Rgb> b(n), gathered(n);
    for (auto& value : b) {
      value = {uniform(generator), uniform(generator), uniform(generator)};
    }
    sums.gather(b, gathered);
    for (std::size_t i = 0; i < n; ++i) {
      Rgb expected;
      for (std::size_t j = 0; j < n; ++j) {
        expected += dense[i][j] * b[j];
      }
      EXPECT_LE(max_abs(gathered[i] - expected), 1e-12);
    }
    EXPECT_LE(sums.size(), n * (n - 1) / (two_way ? 2 : 1));
    EXPECT_FALSE(sums.overrun());
  }
}

TEST(ExchangeSums, DropEverythingBeyondTheMemoryLimit) {
  ExchangeSums sums(7, true, 10 * sizeof(Transfer), {});
  sums.add({{0, 1, 1.0}, {0, 2, 1.0}});
  EXPECT_FALSE(sums.overrun());
  sums.add({{0, 3, 1.0}, {0, 4, 1.0}, {0, 5, 1.0}, {0, 6, 1.0}});
  EXPECT_TRUE(sums.overrun());
  EXPECT_EQ(sums.size(), 0u);
  sums.finish();
  sums.for_each([](PatchId, PatchId, double) { ADD_FAILURE(); });
}

TEST(ExchangeSums, HaveTheSameBitsWheneverTheyAreMerged) {
  constexpr PatchId n = 40;
  constexpr std::uint64_t pairs = n * (n - 1) / 2;
  ExchangeSums roomy(n, true, 1 << 30, {}), crowded(n, true, 3 * pairs * sizeof(Transfer), {});
  std::map<std::pair<PatchId, PatchId>, double> in_order_of_passes;
  std::mt19937_64 generator(11);
  for (int pass = 0; pass < 300; ++pass) {
    std::vector<Transfer> exchanges;
    for (PatchId i = 0; i < n; ++i) {
      const auto j = static_cast<PatchId>(generator() % n);
      if (i == j) {
        continue;
      }
      const double area = uniform(generator);
      exchanges.push_back({i, j, area});
      in_order_of_passes[std::minmax(i, j)] += area;
    }
    roomy.add(roomy.sort(exchanges));
    crowded.add(crowded.sort(exchanges));
  }
  for (ExchangeSums* sums : {&roomy, &crowded}) {
    ASSERT_FALSE(sums->overrun());
    sums->finish();
    ASSERT_EQ(sums->size(), in_order_of_passes.size());
    auto expected = in_order_of_passes.begin();
    sums->for_each([&](PatchId i, PatchId j, double area) {
      EXPECT_EQ(std::pair(i, j), expected->first);
      EXPECT_EQ(area, expected->second);
      ++expected;
    });
  }
}

TEST(ExchangeSums, StopWhenCanceled) {
  const Cancellation cancellation;
  ExchangeSums sums(3, true, 1 << 20, cancellation);
  sums.add({{0, 1, 1.0}});
  cancellation.cancel();
  EXPECT_THROW(sums.add({{0, 1, 1.0}, {0, 2, 1.0}}), Canceled);
  EXPECT_THROW(sums.finish(), Canceled);
}

}  // namespace
}  // namespace transillum::visibility_test
