// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
// Maps of the engines zbuffer, painter and rays, and their differences from the exact map.
#include "visibility/pixels/pixel_map.h"

#include <gmock/gmock.h>

#include <cmath>
#include <fstream>
#include <numeric>
#include <optional>
#include <random>
#include <sstream>

#include "support/canceled.h"
#include "support/scenes.h"
#include "support/temporary_folder.h"
#include "transillum/errors.h"
#include "transillum/map_files.h"

namespace transillum::pixel_map_test {
namespace {

using ::testing::HasSubstr;
using testing::Sketch;
using Polygons = std::vector<VisibilityMap::Polygon>;

/// One direction of a scene, exactly and in pixels.
struct Views {
  std::shared_ptr<const Scene> scene;
  PixelMap pixels;
  VisibilityMap exact, drawn;

  Views(std::shared_ptr<const Scene> of, const Vec3& omega, Engine engine, int resolution,
        PatchId receiver = no_patch)
      : scene(std::move(of)) {
    const auto tree = std::make_shared<const BspTree>(*scene);
    const RecordedDirection direction = record_local_map(*scene, *tree, omega);
    exact = receiver == no_patch ? map_from_below(direction) : map_of_receiver(direction, receiver);
    pixels = pixel_map({engine, {.resolution = resolution}}, *scene, *tree, omega, receiver);
    drawn = drawn_in_pixels(*scene, pixels);
    mark_differences(pixels, exact, drawn);
  }
};

double area_of(const Polygons& polygons) {
  return std::accumulate(polygons.begin(), polygons.end(), 0.0,
                         [](double sum, const auto& polygon) { return sum + polygon.area; });
}

/// Whether p lies in a convex outline; nothing if it is near an edge.
std::optional<bool> contains(std::span<const Vec2> outline, const Vec2& p, double near) {
  bool inside = true;
  for (std::size_t k = 0; k < outline.size(); ++k) {
    const Vec2 &a = outline[k], &b = outline[(k + 1) % outline.size()];
    const double length = std::hypot(b.x - a.x, b.y - a.y);
    if (length < 1e-12) {
      continue;  // its direction is noise
    }
    const double side = ((b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x)) / length;
    if (side < -near) {
      return false;
    }
    if (side < near) {
      inside = false;
    }
  }
  if (inside) {
    return true;
  }
  return std::nullopt;
}

struct Found {
  bool doubtful = false;
  const VisibilityMap::Polygon* polygon = nullptr;
};

Found find(const VisibilityMap& map, const Polygons& polygons, const Vec2& p) {
  Found found;
  for (const auto& polygon : polygons) {
    if (polygon.area < 1e-15) {
      continue;  // may be a point
    }
    const auto inside = contains(map.outline(polygon), p, 1e-9);
    found.doubtful = found.doubtful || !inside;
    if (inside.value_or(false)) {
      found.polygon = &polygon;
    }
  }
  return found;
}

/// Checks random points: a point is marked if and only if the visible patch is not the one shown.
void expect_marked_where_wrong(const Views& views) {
  const PixelMap& pixels = views.pixels;
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> fraction(0, 1);
  int wrong = 0;
  for (int k = 0; k < 1500; ++k) {
    const double column = pixels.columns * fraction(random), row = pixels.rows * fraction(random);
    const Vec2 p{pixels.corner.x + column * pixels.side, pixels.corner.y + row * pixels.side};
    const PatchId shown =
        pixels.items[pixels.index(static_cast<int>(column), static_cast<int>(row))];
    const Found exact = find(views.exact, views.exact.polygons, p);
    const Found marked = find(views.drawn, views.drawn.pixels.differences, p);
    const Found drawn = find(views.drawn, views.drawn.polygons, p);
    if (exact.doubtful || marked.doubtful || drawn.doubtful) {
      continue;
    }
    const PatchId visible = exact.polygon != nullptr ? exact.polygon->patch : no_patch;
    ASSERT_EQ(drawn.polygon != nullptr ? drawn.polygon->patch : no_patch, shown);
    ASSERT_EQ(marked.polygon != nullptr, visible != shown) << visible << " " << shown;
    if (marked.polygon != nullptr) {
      ASSERT_EQ(marked.polygon->patch, visible);
      ++wrong;
    }
  }
  EXPECT_GT(wrong, 10);
}

TEST(PixelMap, MarksWhereItIsWrongAndNowhereElse) {
  const Vec3 omega = normalized({1, 2, 3});
  const auto triangles = [] {
    Sketch sketch;
    return sketch.triangles(60, 0.8, 3, sketch.material(0.5, 1)).scene();
  }();
  for (const Engine engine : {Engine::zbuffer, Engine::painter, Engine::rays}) {
    SCOPED_TRACE(name_of(engine));
    expect_marked_where_wrong({triangles, omega, engine, 40});
    expect_marked_where_wrong({load_scene("cornell-box"), omega, engine, 30, 14});
  }
}

TEST(PixelMap, DifferencesDecreaseWithPixelSize) {
  const auto scene = load_scene("cornell-box");
  const auto fraction = [&](int resolution) {
    const Views views(scene, normalized({1, 2, 3}), Engine::zbuffer, resolution, 14);
    return area_of(views.drawn.pixels.differences) / area_of(views.exact.window);
  };
  EXPECT_NEAR(fraction(64) / fraction(256), 4, 1);
}

TEST(PixelMap, PixelsThatFitDoNotDiffer) {
  Sketch sketch;
  const int gray = sketch.material(0.5, 1);
  sketch.face({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, gray);
  sketch.face({{0, 0, 1}, {0, 1, 1}, {0.5, 1, 1}, {0.5, 0, 1}}, gray);
  const Views views(sketch.scene(), {0, 0, 1}, Engine::painter, 16, 0);
  EXPECT_LT(area_of(views.drawn.pixels.differences), 1e-6);  // pixels are rounded up by 2^-24
  EXPECT_NEAR(area_of(views.drawn.window), 1, 1e-6);
  ASSERT_EQ(views.drawn.polygons.size(), 1U);  // one rectangle
  EXPECT_EQ(views.drawn.polygons[0].patch, 1);
  EXPECT_NEAR(views.drawn.polygons[0].area, 0.5, 1e-6);
  ASSERT_EQ(views.pixels.exchanges.size(), 1U);
  EXPECT_NEAR(views.pixels.exchanges[0].area, 0.5, 1e-6);
}

TEST(PixelMap, ZBufferAndPainterShowTheSame) {
  const auto scene = load_scene("sphere-flake:levels=1");
  const auto tree = std::make_shared<const BspTree>(*scene);
  for (const Vec3& omega : testing::test_directions(16, 2)) {
    const PixelMap a = pixel_map({Engine::zbuffer}, *scene, *tree, omega);
    EXPECT_EQ(a.items, pixel_map({Engine::painter}, *scene, *tree, omega).items);
    EXPECT_EQ(std::max(a.columns, a.rows), PixelMap::default_resolution);
  }
}

/// V after a step, in pixels.
struct Step {
  PixelMap pixels;
  double wrong;  ///< differing fraction of V
};

Step after_step(const std::shared_ptr<const Scene>& scene, const BspTree& tree,
                const MapRecord& record, std::int32_t step, Engine engine,
                const EngineOptions& options) {
  Step result{pixel_map_after({engine, options}, *scene, tree, record, step), 0};
  VisibilityMap drawn = drawn_in_pixels(*scene, result.pixels);
  const VisibilityMap exact = map_after(record, step);
  mark_differences(result.pixels, exact, drawn);
  result.wrong = area_of(drawn.pixels.differences) / area_of(exact.polygons);
  return result;
}

TEST(PixelMap, AllEnginesShowEachStepOfADirection) {
  Sketch concave;  // the L lies under one square and over another
  const int gray = concave.material(0.5, 1);
  concave.face({{0, 0, 0}, {3, 0, 0}, {3, 1, 0}, {1, 1, 0}, {1, 3, 0}, {0, 3, 0}}, gray);
  concave.face({{2, 0, 1}, {3, 0, 1}, {3, 2, 1}, {2, 2, 1}}, gray);
  concave.face({{0, 2, -1}, {2, 2, -1}, {2, 3, -1}, {0, 3, -1}}, gray);
  for (const auto& scene : {load_scene("cornell-box"), load_scene("sphere-flake:levels=1"),
                            concave.scene({.two_sided = true})}) {
    const auto tree = std::make_shared<const BspTree>(*scene);
    const RecordedDirection direction = record_local_map(*scene, *tree, normalized({1, 2, 3}));
    const MapRecord& record = direction.record;
    for (const std::int32_t step :
         {-1, record.step_count() / 3, record.fullest_step(), record.step_count() - 1}) {
      const auto show = [&](Engine engine, const EngineOptions& options) {
        return after_step(scene, *tree, record, step, engine, options);
      };
      const Step painter = show(Engine::painter, {.resolution = 100});
      const Step newell =
          show(Engine::painter, {.resolution = 100, .order = PaintersOrder::newell});
      EXPECT_EQ(newell.pixels.items, painter.pixels.items) << scene->name() << " " << step;
      EXPECT_EQ(show(Engine::zbuffer, {.resolution = 100}).pixels.items, painter.pixels.items);
      if (step < 0) {
        continue;
      }
      // Rays sample another point of each pixel; a similar fraction is wrong.
      const Step rays = show(Engine::rays, {.resolution = 100});
      EXPECT_NE(rays.pixels.items, painter.pixels.items);
      EXPECT_NEAR(rays.wrong / painter.wrong, 1.3, 0.45) << scene->name() << " " << step;
    }
  }
}

TEST(PixelMap, IsWrittenAndDrawn) {
  const Views views(load_scene("cornell-box"), normalized({1, 2, 3}), Engine::zbuffer, 32, 14);
  const test::TemporaryFolder folder;
  for (const char* name : {"map.svg", "map.png", "map.vtp", "map.json"}) {
    const auto path = folder.path() / name;
    write_map(path, *views.scene, views.drawn, {.size = 300});
    std::ifstream file(path);
    std::ostringstream text;
    text << file.rdbuf();
    if (path.extension() == ".png") {
      EXPECT_THAT(text.str(), HasSubstr("pixels are"));
    } else {
      EXPECT_THAT(text.str(), HasSubstr("difference"));
    }
  }
}

TEST(PixelMap, RefusesEnginesWithoutPixelsAndBadResolutions) {
  const auto scene = load_scene("furnace");
  const auto tree = std::make_shared<const BspTree>(*scene);
  const Vec3 up{0, 0, 1};
  EXPECT_THROW(pixel_map({Engine::fast}, *scene, *tree, up), InputError);
  for (const int resolution : {-1, PixelMap::largest_resolution + 1}) {
    EXPECT_THROW(
        pixel_map({Engine::painter, {.resolution = resolution}}, *scene, *tree, up, no_patch),
        InputError);
  }
  EXPECT_THROW(pixel_map({Engine::painter}, *scene, *tree, up, no_patch, testing::canceled()),
               Canceled);
}

}  // namespace
}  // namespace transillum::pixel_map_test
