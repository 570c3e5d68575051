// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
// Fuzz target: the convex clipper. An input defines a subject and some windows on a small grid, so
// that shared edges, touching corners and straight corners are frequent. The windows are subtracted
// from the subject one after the other, as the engines do, and the areas are compared with exact
// areas.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <memory>
#include <utility>

#include "fuzz/byte_source.h"
#include "fuzz/exact_clip.h"
#include "fuzz/require.h"
#include "transillum/at.h"
#include "visibility/plane/map_polygon.h"

namespace transillum::fuzz {
namespace {

struct GridPoint {
  int x, y;
  // NOLINTNEXTLINE(modernize-use-nullptr)
  friend auto operator<=>(const GridPoint&, const GridPoint&) = default;
};
using GridPolygon = std::vector<GridPoint>;

constexpr unsigned grid_size = 16;
constexpr unsigned max_windows = 5;

int turn(const GridPoint& a, const GridPoint& b, const GridPoint& p) {
  return (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x);
}

/// The lower side of the convex hull of sorted points, with collinear points on it.
GridPolygon chain(const GridPolygon& points) {
  GridPolygon chain;
  for (const GridPoint& p : points) {
    while (chain.size() >= 2 && turn(chain[chain.size() - 2], chain.back(), p) < 0) {
      chain.pop_back();
    }
    chain.push_back(p);
  }
  return chain;
}

/// The convex hull of up to eight points, with collinear corners; empty if it has no area.
GridPolygon take_polygon(ByteSource& bytes) {
  GridPolygon points(3 + bytes.below(6));
  for (GridPoint& p : points) {
    const int xy = static_cast<int>(bytes.byte());
    p = {xy % static_cast<int>(grid_size), xy / static_cast<int>(grid_size)};
  }
  std::sort(points.begin(), points.end());
  points.erase(std::unique(points.begin(), points.end()), points.end());
  GridPolygon hull = chain(points);
  std::reverse(points.begin(), points.end());
  const GridPolygon upper = chain(points);
  const bool flat = std::all_of(points.begin(), points.end(), [&](const GridPoint& p) {
    return turn(points.front(), points.back(), p) == 0;
  });
  if (flat) {
    return {};
  }
  hull.insert(hull.end(), upper.begin() + 1, upper.end() - 1);
  return hull;
}

ExactPolygon exact(const GridPolygon& polygon) {
  ExactPolygon result;
  for (const GridPoint& p : polygon) {
    result.push_back({p.x, p.y});
  }
  return result;
}

/// The content of an input: polygons, the subject first, and the direction of projection.
struct Case {
  std::vector<GridPolygon> polygons;
  /// Direction of projection; integers, not a unit vector.
  Vec3 along{0, 0, 1};
  /// Whether each polygon is moved along the direction, so that it shares no points and lines with
  /// the previous one, but projects to the same positions.
  bool lifted = false;

  /// Whether the projection is exact; then polygons that only touch must not overlap.
  bool is_exact() const { return along.x == 0 && along.y == 0; }
  Vec3 omega() const { return normalized(along); }
};

Case take_case(ByteSource& bytes) {
  Case made;
  made.lifted = bytes.flag();
  if (bytes.flag()) {
    const double x = bytes.below(16) - 7.0, y = bytes.below(16) - 7.0, z = bytes.below(8) + 1.0;
    made.along = {x, y, z};
  }
  const std::size_t count = 2 + bytes.below(max_windows);
  for (std::size_t k = 0; k < count; ++k) {
    GridPolygon polygon = take_polygon(bytes);
    if (!polygon.empty()) {
      made.polygons.push_back(std::move(polygon));
    }
  }
  return made;
}

std::shared_ptr<const Scene> scene_of(const Case& from) {
  SceneDescription description;
  description.name = "case";
  description.materials = {{"gray", {0.5, 0.5, 0.5}, {}}};
  double height = 0;
  for (const GridPolygon& polygon : from.polygons) {
    std::vector<PointId> outline;
    for (const GridPoint& p : polygon) {
      outline.push_back(static_cast<PointId>(description.points.size()));
      description.points.push_back(Vec3{static_cast<double>(p.x), static_cast<double>(p.y), 0} +
                                   height * from.along);
    }
    description.add_face(outline, 0);
    if (from.lifted) {
      height += 1;
    }
  }
  return std::make_shared<const Scene>(description);
}

/// The projected polygons as an engine gets them, but whole: the tree may have split them, and it
/// has the lines of their edges.
std::vector<MapPolygon> projected(const Scene& scene, const BspTree& tree,
                                  const Projection& projection) {
  std::map<std::pair<PointId, PointId>, LineId> line_between;
  for (const BspTree::Line& line : tree.lines()) {
    line_between.try_emplace({line.a, line.b}, static_cast<LineId>(line_between.size()));
  }
  std::vector<MapPolygon> polygons;
  for (const Piece& piece : scene.pieces()) {
    const auto corners = scene.corners(piece);
    MapPolygon& polygon = polygons.emplace_back();
    for (std::size_t k = 0; k < corners.size(); ++k) {
      const auto [a, b] = std::minmax(corners[k], corners[(k + 1) % corners.size()]);
      polygon.push_back(
          {at(projection.points, corners[k]), line_between.at({a, b}), corners[k] == a});
    }
  }
  return polygons;
}

/// The result of clipping a subject by a window.
struct Cut {
  bool overlap = false;
  Real inside_area = 0;
  std::vector<MapPolygon> outside;
};

/// A clipper under test.
struct Clipper {
  const char* name;
  Cut (*clip)(const Projection&, const MapPolygon& subject, const MapPolygon& window);
};

Cut clip_for_map(const Projection& projection, const MapPolygon& subject,
                 const MapPolygon& window) {
  MapClipper clipper(projection);
  Cut cut;
  cut.overlap = clipper.clip(subject, window);
  if (!cut.overlap) {
    return cut;
  }
  cut.inside_area = clipper.inside_area();
  for (std::size_t k = 0; k < clipper.outside_count(); ++k) {
    cut.outside.push_back(clipper.outside(k));
  }
  return cut;
}

constexpr std::array<Clipper, 1> clippers{{{"map", clip_for_map}}};

/// Subtracts all windows from the subject, with the clipper and exactly, and compares the areas.
class Trial {
 public:
  Trial(const Clipper& clipper, const Case& from, const Projection& projection,
        const std::vector<MapPolygon>& polygons)
      : clipper_(clipper),
        case_(from),
        projection_(projection),
        polygons_(polygons),
        remaining_{polygons[0]},
        exactly_remaining_{exact(from.polygons[0])} {
    // Otherwise the axes of the plane are rounded to doubles.
    if (!case_.is_exact()) {
      tolerance_to_exact_ = 1e-11L;
    }
  }

  void run() {
    const Real whole = area_of(remaining_[0]);
    require_near(whole, area_of(exactly_remaining_[0]), "the subject's area");
    Real total = 0;
    for (std::size_t k = 1; k < polygons_.size(); ++k) {
      check_symmetry(k);
      const Real inside = cut_out(polygons_[k]);
      require_near(inside, cut_out_exactly(exact(case_.polygons[k])), "the area inside");
      total += inside;
    }
    for (const MapPolygon& part : remaining_) {
      total += area_of(part);
    }
    require(std::abs(total - whole) <= tolerance_,
            named("the parts inside and outside cover the subject"));
  }

 private:
  /// Checks that subject and window may be exchanged, with the whole subject.
  void check_symmetry(std::size_t k) {
    const Cut one = clipper_.clip(projection_, polygons_[0], polygons_[k]);
    const Cut other = clipper_.clip(projection_, polygons_[k], polygons_[0]);
    require(std::abs(one.inside_area - other.inside_area) <= tolerance_,
            named("subject and window may be exchanged"));
    if (!case_.is_exact()) {
      return;
    }
    std::vector<ExactPolygon> outside;
    const bool overlap =
        area_of(clip(exact(case_.polygons[0]), exact(case_.polygons[k]), outside)) > 0;
    require(one.overlap == overlap && other.overlap == overlap,
            named("only polygons with a common area overlap"));
  }

  Real cut_out(const MapPolygon& window) {
    std::vector<MapPolygon> remaining;
    Real inside = 0;
    for (MapPolygon& part : remaining_) {
      Cut cut = clipper_.clip(projection_, part, window);
      if (!cut.overlap) {
        remaining.push_back(std::move(part));
        continue;
      }
      require(cut.inside_area > 0, named("an overlap has an area"));
      inside += cut.inside_area;
      for (MapPolygon& outside : cut.outside) {
        if (!(area_of(outside) > 0)) {
          continue;  // like the engines
        }
        require_left_turns(outside);
        remaining.push_back(std::move(outside));
      }
    }
    remaining_ = std::move(remaining);
    return inside;
  }

  Real cut_out_exactly(const ExactPolygon& window) {
    std::vector<ExactPolygon> remaining;
    Real inside = 0;
    for (ExactPolygon& part : exactly_remaining_) {
      std::vector<ExactPolygon> outside;
      const Real area = area_of(clip(part, window, outside));
      inside += area;
      if (area > 0) {
        remaining.insert(remaining.end(), outside.begin(), outside.end());
      } else {
        remaining.push_back(std::move(part));
      }
    }
    exactly_remaining_ = std::move(remaining);
    return inside;
  }

  void require_left_turns(const MapPolygon& polygon) {
    const std::size_t count = polygon.size();
    for (std::size_t k = 0; k < count; ++k) {
      const PlanePoint& at = polygon[(k + 1) % count].at;
      const Real turn = cross(at - polygon[k].at, polygon[(k + 2) % count].at - at);
      require(turn >= -tolerance_, named("the remaining parts are convex"));
    }
  }

  void require_near(Real area, Real exact_area, const char* what) {
    const Real expected = exact_area * case_.omega().z;
    require(std::abs(area - expected) <= tolerance_to_exact_,
            named(fmt::format("{} is {}, expected {}", what, static_cast<double>(area),
                              static_cast<double>(expected))));
  }
  std::string named(const std::string& what) const {
    return std::string(clipper_.name) + ": " + what;
  }

  const Clipper& clipper_;
  const Case& case_;
  const Projection& projection_;
  const std::vector<MapPolygon>& polygons_;
  std::vector<MapPolygon> remaining_;
  std::vector<ExactPolygon> exactly_remaining_;
  Real tolerance_ = 1e-15L * grid_size * grid_size;
  Real tolerance_to_exact_ = tolerance_;
};

}  // namespace
}  // namespace transillum::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace transillum;
  using namespace transillum::fuzz;
  ByteSource bytes(data, size);
  const Case from = take_case(bytes);
  if (from.polygons.size() < 2) {
    return 0;
  }
  const auto scene = scene_of(from);
  const BspTree tree(*scene);
  require(scene->pieces().size() == from.polygons.size(), "a convex polygon is one piece");
  const Projection projection(*scene, tree, from.omega());
  const std::vector<MapPolygon> polygons = projected(*scene, tree, projection);
  for (const Clipper& clipper : clippers) {
    Trial(clipper, from, projection, polygons).run();
  }
  return 0;
}
