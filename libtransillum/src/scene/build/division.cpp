// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Division of chosen patches of a scene. Input: a Scene, whose patches are planar and whose pieces
// are convex; output: another with the same faces.
#include "scene/build/division.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <optional>
#include <utility>

#include "geometry/convex_partition.h"
#include "scene/build/patch_builder.h"
#include "scene/build/patch_count.h"
#include "scene/build/refinement.h"
#include "scene/build/two_sided.h"
#include "transillum/errors.h"

namespace transillum {
namespace {

using Outline = std::vector<PointId>;

/// Quadrilaterals longer than this, relative to their width, are divided in a row.
constexpr double long_shape = 2;
/// Largest distance of a corner that counts as on a cut, over the square root of the patch's area.
constexpr double cut_precision = 1e-9;

double mean_length(const Scene& scene, std::span<const PointId> o, std::size_t edge) {
  const auto length = [&](std::size_t k) {
    return norm(scene.point(o[k]) - scene.point(o[(k + 1) % 4]));
  };
  return length(edge) + length(edge + 2);
}

/// The grid that divides a triangle or a convex quadrilateral into four.
CellGrid grid_of_four(const Scene& scene, Outline outline) {
  CellGrid grid{std::move(outline), 2, 2};
  if (grid.outline.size() == 3) {
    grid.rows = 1;
    return grid;
  }
  const double width = mean_length(scene, grid.outline, 0),
               height = mean_length(scene, grid.outline, 1);
  if (width > long_shape * height) {
    grid.columns = 4;
    grid.rows = 1;
  } else if (height > long_shape * width) {
    grid.columns = 1;
    grid.rows = 4;
  }
  return grid;
}

/// The pieces of a patch, by their numbers in Scene::pieces().
struct PieceRange {
  std::size_t begin = 0, end = 0;
  std::size_t size() const { return end - begin; }
};

PieceRange pieces_of(const Scene& scene, PatchId i) {
  const auto& pieces = scene.pieces();
  const auto [first, last] =
      std::equal_range(pieces.begin(), pieces.end(), Piece{i, 0, 0},
                       [](const Piece& a, const Piece& b) { return a.patch < b.patch; });
  return {static_cast<std::size_t>(first - pieces.begin()),
          static_cast<std::size_t>(last - pieces.begin())};
}

Outline as_vector(std::span<const PointId> corners) { return {corners.begin(), corners.end()}; }

/// Triangles of a convex polygon.
std::vector<Outline> triangles_of(const Scene& scene, const Outline& corners, const Vec3& normal) {
  std::vector<Outline> triangles;
  for (const auto& t : triangulate(drop_axis(scene.points(), corners, normal))) {
    Outline& triangle = triangles.emplace_back();
    for (const std::uint32_t c : t) {
      triangle.push_back(corners[c]);
    }
  }
  return triangles;
}

}  // namespace

/// Makes the scene of divide().
class PatchDivision {
 public:
  PatchDivision(const Scene& scene, const Cancellation& cancellation)
      : whole_(scene), cancellation_(cancellation) {
    for (const Vec3& point : scene.points()) {
      table_.id_of(point);
    }
  }

  DividedScene make(std::span<const PatchId> patches) {
    const std::vector<bool> divided = with_coincident(patches);
    return make([&](PatchId i) { return at(divided, i) ? cells_of(i) : std::vector<Outline>(); });
  }

  std::shared_ptr<const Scene> make_united(std::span<const UnitedPatch> patches) {
    auto scene = std::shared_ptr<Scene>(new Scene(whole_, Scene::WithoutPatches{}));
    scene_ = scene.get();
    for (const UnitedPatch& patch : patches) {
      if (scene->patches_.size() % patches_between_checks == 0) {
        cancellation_.throw_if_canceled();
      }
      if (patch.outline.empty()) {
        copy(patch.like);
      } else {
        add(patch.like, patch.outline, scene->patches_.size());
      }
    }
    scene->points_ = table_.take();
    return scene;
  }

  DividedScene make_along(std::span<const PatchCut> cuts) {
    std::map<Outline, std::vector<PatchCut>> by_points;
    for (const PatchCut& cut : cuts) {
      by_points[points_of(cut.patch)].push_back(cut);
    }
    return make([&](PatchId i) {
      const auto found = by_points.find(points_of(i));
      return found != by_points.end() ? cells_along(i, found->second) : std::vector<Outline>();
    });
  }

 private:
  /// @param cells_of gives the outlines of what a patch is divided into; none where it stays whole
  DividedScene make(const std::function<std::vector<Outline>(PatchId)>& cells_of) {
    auto scene = std::shared_ptr<Scene>(new Scene(whole_, Scene::WithoutPatches{}));
    scene_ = scene.get();
    for (PatchId i = 0; i < whole_.patch_count(); ++i) {
      if (i % patches_between_checks == 0) {
        cancellation_.throw_if_canceled();
      }
      const bool two = are_two_sides(whole_, i);
      const std::vector<Outline> cells = cells_of(i);
      if (cells.empty()) {
        copy(i);
        if (two) {
          copy(i + 1);
        }
      }
      for (const Outline& cell : cells) {
        add(i, cell, scene_->patches_.size());
        if (two) {
          add(i + 1, Outline(cell.rbegin(), cell.rend()), scene_->patches_.size());
        }
      }
      i += two ? 1 : 0;
    }
    scene->points_ = table_.take();
    return {std::move(scene), std::move(parent_)};
  }

  /// Outlines of what patch i is divided into; empty where it cannot be divided.
  std::vector<Outline> cells_of(PatchId i) {
    const auto outline = whole_.outline(i);
    const PieceRange range = pieces_of(whole_, i);
    const bool is_quadrilateral = outline.size() == 4 && range.size() == 1 &&
                                  whole_.corners(whole_.pieces()[range.begin]).size() == 4;
    std::vector<Outline> cells;
    if (outline.size() == 3 || is_quadrilateral) {
      cells = make_cells(table_, grid_of_four(whole_, as_vector(outline)));
    } else if (range.size() == 1) {
      cells = triangles_of(whole_, as_vector(whole_.corners(whole_.pieces()[range.begin])),
                           whole_.patch(i).normal);
    } else {
      for (std::size_t k = range.begin; k < range.end; ++k) {
        cells.push_back(as_vector(whole_.corners(whole_.pieces()[k])));
      }
    }
    const bool too_small = std::any_of(cells.begin(), cells.end(), [&](const Outline& cell) {
      return measure(table_.points(), cell).degenerate;
    });
    return too_small ? std::vector<Outline>() : cells;
  }

  /// The pieces of patch i, cut by the longest cuts first: they cross most of the others.
  std::vector<Outline> cells_along(PatchId i, std::vector<PatchCut> cuts) {
    const auto length = [](const PatchCut& cut) { return norm(cut.b - cut.a); };
    std::stable_sort(cuts.begin(), cuts.end(),
                     [&](const PatchCut& x, const PatchCut& y) { return length(x) > length(y); });
    const PieceRange range = pieces_of(whole_, i);
    std::vector<Outline> cells;
    for (std::size_t k = range.begin; k < range.end; ++k) {
      cells.push_back(as_vector(whole_.corners(whole_.pieces()[k])));
    }
    for (const PatchCut& cut : cuts) {
      cancellation_.throw_if_canceled();
      check_memory(whole_.name(), cell_count_ + static_cast<std::int64_t>(cells.size()));
      for (std::size_t c = 0, count = cells.size(); c < count; ++c) {
        if (auto parts = cut_in_two(cells[c], whole_.patch(i), cut)) {
          cells[c] = std::move(parts->first);
          cells.push_back(std::move(parts->second));
        }
      }
    }
    cell_count_ += static_cast<std::int64_t>(cells.size());
    return cells.size() > 1 ? cells : std::vector<Outline>();
  }

  /// The parts of a convex cell on the two sides of a cut; none where the cut does not pass through
  /// its inside.
  std::optional<std::pair<Outline, Outline>> cut_in_two(const Outline& cell, const Patch& patch,
                                                        const PatchCut& cut) {
    const double reach = cut_precision * std::sqrt(patch.area), length = norm(cut.b - cut.a);
    if (length <= reach) {
      return std::nullopt;
    }
    const Vec3 along = (1 / length) * (cut.b - cut.a), across = cross(patch.normal, along);
    const auto point = [&](std::size_t k) { return at(table_.points(), cell[k % cell.size()]); };
    const auto side = [&](std::size_t k) {
      const double s = dot(point(k) - cut.a, across);
      return std::abs(s) <= reach ? 0.0 : s;
    };
    // Where the line of the cut meets the outline: at corners or within edges.
    std::pair<Part, Part> parts;
    double first = std::numeric_limits<double>::infinity(), last = -first;
    const auto meet = [&](const Corner& corner) {
      const double place = dot(corner.position - cut.a, along);
      first = std::min(first, place);
      last = std::max(last, place);
      parts.first.push_back(corner);
      parts.second.push_back(corner);
    };
    for (std::size_t k = 0; k < cell.size(); ++k) {
      const double s = side(k), next = side(k + 1);
      const Corner corner{cell[k], point(k)};
      if (s == 0) {
        meet(corner);
        continue;
      }
      (s > 0 ? parts.first : parts.second).push_back(corner);
      if (s * next < 0) {
        // From the same end for both cells at an edge, so that they get the same point.
        const bool forward = cell[k] < cell[(k + 1) % cell.size()];
        const Vec3 from = point(forward ? k : k + 1), to = point(forward ? k + 1 : k);
        const double d = dot(from - cut.a, across), e = dot(to - cut.a, across);
        meet({new_point, from + (d / (d - e)) * (to - from)});
      }
    }
    const bool crosses = std::min(last, length) - std::max(first, 0.0) > reach;
    if (!crosses || !is_cell(parts.first) || !is_cell(parts.second)) {
      return std::nullopt;
    }
    return std::pair{outline_of(parts.first), outline_of(parts.second)};
  }

  /// A corner of a part of a cell; a new one gets its number when the cut is made.
  struct Corner {
    PointId point;
    Vec3 position;
  };
  using Part = std::vector<Corner>;
  static constexpr PointId new_point = -1;

  static bool is_cell(const Part& part) {
    std::vector<Vec3> positions;
    Outline outline;
    for (const Corner& corner : part) {
      outline.push_back(static_cast<PointId>(positions.size()));
      positions.push_back(corner.position);
    }
    return part.size() >= 3 && !measure(positions, outline).degenerate;
  }

  Outline outline_of(const Part& part) {
    Outline outline;
    for (const Corner& corner : part) {
      outline.push_back(corner.point == new_point ? table_.id_of(corner.position) : corner.point);
    }
    return outline;
  }

  static constexpr PatchId patches_between_checks = 256;

  /// Which patches are divided: those asked for, and all on the same points as one of them.
  std::vector<bool> with_coincident(std::span<const PatchId> patches) const {
    std::vector<bool> divided(whole_.patches().size(), false);
    std::map<Outline, bool> by_points;
    for (const PatchId i : patches) {
      by_points[points_of(i)] = true;
    }
    for (PatchId i = 0; i < whole_.patch_count(); ++i) {
      divided[static_cast<std::size_t>(i)] = by_points.count(points_of(i)) > 0;
    }
    return divided;
  }

  /// The same for all patches on the same points.
  Outline points_of(PatchId i) const {
    Outline points = as_vector(whole_.outline(i));
    std::sort(points.begin(), points.end());
    return points;
  }

  void copy(PatchId i) {
    start(i, whole_.patch(i), as_vector(whole_.outline(i)));
    const PieceRange range = pieces_of(whole_, i);
    for (std::size_t k = range.begin; k < range.end; ++k) {
      add_piece(whole_.corners(whole_.pieces()[k]));
    }
  }

  /// A cell of patch i: a convex polygon.
  void add(PatchId i, const Outline& cell, std::size_t count) {
    if (static_cast<std::int64_t>(count) >= PatchBuilder::max_patches) {
      throw InputError(
          fmt::format("{}: more than {} patches", whole_.name(), PatchBuilder::max_patches));
    }
    const PolygonShape shape = measure(table_.points(), cell);
    Patch patch = whole_.patch(i);
    patch.area = shape.area;
    patch.center = shape.center;
    start(i, patch, cell);
    add_piece(cell);
  }

  void start(PatchId parent, Patch patch, const Outline& outline) {
    std::vector<PointId>& corners = scene_->outline_corners_;
    patch.outline_begin = static_cast<std::uint32_t>(corners.size());
    corners.insert(corners.end(), outline.begin(), outline.end());
    patch.outline_end = static_cast<std::uint32_t>(corners.size());
    scene_->patches_.push_back(patch);
    parent_.push_back(parent);
  }

  void add_piece(std::span<const PointId> piece) {
    std::vector<PointId>& corners = scene_->piece_corners_;
    const auto begin = static_cast<std::uint32_t>(corners.size());
    corners.insert(corners.end(), piece.begin(), piece.end());
    scene_->pieces_.push_back({static_cast<PatchId>(scene_->patches_.size()) - 1, begin,
                               static_cast<std::uint32_t>(corners.size())});
  }

  const Scene& whole_;
  const Cancellation& cancellation_;
  PointTable table_;
  std::int64_t cell_count_ = 0;  ///< of cells_along() so far
  Scene* scene_ = nullptr;
  std::vector<PatchId> parent_;
};

int division_count(const Scene& scene, PatchId i) {
  const auto outline = scene.outline(i);
  const PieceRange range = pieces_of(scene, i);
  const std::size_t corners = scene.corners(scene.pieces()[range.begin]).size();
  if (outline.size() == 3 || (outline.size() == 4 && range.size() == 1 && corners == 4)) {
    return 4;
  }
  return static_cast<int>(range.size() > 1 ? range.size() : corners - 2);
}

DividedScene divide(const Scene& scene, std::span<const PatchId> patches,
                    const Cancellation& cancellation) {
  return PatchDivision(scene, cancellation).make(patches);
}

DividedScene divide_along(const Scene& scene, std::span<const PatchCut> cuts,
                          const Cancellation& cancellation) {
  return PatchDivision(scene, cancellation).make_along(cuts);
}

std::shared_ptr<const Scene> with_united(const Scene& scene, std::span<const UnitedPatch> patches,
                                         const Cancellation& cancellation) {
  return PatchDivision(scene, cancellation).make_united(patches);
}

}  // namespace transillum
