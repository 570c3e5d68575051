// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "scene/build/patch_builder.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <utility>

#include "base/invariant.h"
#include "geometry/polygon_area.h"
#include "scene/build/description_check.h"
#include "scene/build/precision.h"
#include "scene/build/refinement.h"
#include "scene/build/rounding_repair.h"
#include "transillum/at.h"

namespace transillum {
namespace {

/// Largest deviation of a planar face from its plane, relative to its diameter and to its width.
constexpr double largest_deviation_by_diameter = 1e-6;
constexpr double largest_deviation_by_width = 1e-3;
/// The same of a face that is planar but for the rounding of its file: a larger deviation is a
/// feature, however few digits there are.
constexpr double largest_rounding_by_width = 0.02;
constexpr std::size_t faces_between_cancellation_checks = 256;
/// Most corners of a face of which all pairs of edges are searched for crossings, and most of
/// those.
constexpr std::size_t most_crossing_corners = 4096, most_crossings = 1000;

CornerList all_corners(std::size_t n) {
  CornerList all(n);
  std::iota(all.begin(), all.end(), CornerList::value_type{0});
  return all;
}

double signed_area(const std::vector<PlanePoint>& plane, std::span<const std::uint32_t> corners) {
  struct Corner {
    double x, y;
  };
  return polygon_area(corners.size(), [&](std::size_t k) {
    const PlanePoint& p = plane[corners[k]];
    return Corner{p[0], p[1]};
  });
}

/// Whether the parts have the outline's area. They do not if an outline that touches itself has
/// loops of opposite orientation, as an 8 has: parts by the even-odd rule have more area.
bool same_area(const std::vector<PlanePoint>& plane, const std::vector<CornerList>& parts) {
  double sum = 0, reach = 0;
  for (const CornerList& part : parts) {
    sum += signed_area(plane, part);
  }
  for (const PlanePoint& p : plane) {
    reach = std::max({reach, std::abs(p[0] - plane[0][0]), std::abs(p[1] - plane[0][1])});
  }
  // A sliver's area is the small difference of large products.
  const double rounding = 0x1p-50 * static_cast<double>(plane.size()) * reach * reach;
  return std::abs(signed_area(plane, all_corners(plane.size())) - sum) <= 1e-9 * sum + rounding;
}

/// `parts`, if they cover what the outline encloses; none if the outline crosses itself.
std::vector<CornerList> checked(const std::vector<PlanePoint>& plane,
                                std::vector<CornerList> parts) {
  return !parts.empty() && same_area(plane, parts) ? std::move(parts) : std::vector<CornerList>();
}

std::vector<CornerList> triangles_of(const std::vector<PlanePoint>& plane) {
  std::vector<CornerList> triangles;
  for (const auto& t : triangulate(plane)) {
    triangles.emplace_back(t.begin(), t.end());
  }
  return checked(plane, std::move(triangles));
}

/// The normal of the first triangle of an outline's corners that has an area.
Vec3 first_normal(std::span<const Vec3> points, std::span<const PointId> outline) {
  PolygonShape shape;
  for (std::size_t k = 1; k + 1 < outline.size() && shape.degenerate; ++k) {
    shape = measure(points, std::array<PointId, 3>{outline[0], outline[k], outline[k + 1]});
  }
  return shape.normal;
}

std::vector<PointId> pick(const std::vector<PointId>& outline, const CornerList& corners) {
  std::vector<PointId> picked;
  for (const std::uint32_t c : corners) {
    picked.push_back(outline[c]);
  }
  return picked;
}

}  // namespace

PatchBuilder::PatchBuilder(const SceneDescription& description, const SceneOptions& options,
                           const Cancellation& cancellation)
    : description_(description),
      options_(options),
      cancellation_(cancellation),
      welded_(description.points.size(), -1) {}

void PatchBuilder::build() {
  double largest = 0;
  for (const PointId p : description_.corners) {
    largest = std::max(largest, max_abs(at(description_.points, p)));
  }
  flatness_ = 64 * epsilon * largest;
  const double rounding = description_.coordinate_rounding > 0
                              ? description_.coordinate_rounding
                              : coordinate_rounding(description_.points);
  file_flatness_ = std::max(flatness_, bend_by_rounding * rounding);
  if (description_.faces_are_patches) {
    file_flatness_ = std::numeric_limits<double>::infinity();
    points_ = description_.points;
  } else {
    points_ = without_rounding(description_, rounding, cancellation_);
    note_moves(rounding);
  }
  report.faces = static_cast<std::int64_t>(description_.face_count());
  report.warnings = description_.notes;
  for (std::size_t f = 0; f < description_.face_count(); ++f) {
    if (f % faces_between_cancellation_checks == 0) {
      cancellation_.throw_if_canceled();
    }
    add_face(f);
  }
  if (patches.empty()) {
    throw InputError(face_place(description_, 0) + no_area_reason(0) +
                     (description_.face_count() > 1 ? ", and no other face has an area" : "") +
                     "; the scene has no patches");
  }
  count_coincident();
  count_unused();
  report.joined_to = description_.joined_to;
  const std::vector<std::string> sentences = warnings_.sentences();
  report.warnings.insert(report.warnings.end(), sentences.begin(), sentences.end());
}

void PatchBuilder::add_face(std::size_t face) {
  const Outline outline = welded_outline(description_.outline(face), points_, welded_, table);
  const PolygonShape shape = measure(table.points(), outline);
  if (shape.degenerate) {
    if (is_bow_tie(table.points(), outline)) {
      add_crossing(face, outline, first_normal(table.points(), outline));
    } else {
      remove(face);
    }
  } else if (!is_planar(shape)) {
    add_triangles(face, outline, shape);
  } else {
    add_part(face, outline, shape);
  }
}

void PatchBuilder::remove(std::size_t face) {
  ++report.removed_degenerate;
  warnings_.add("faces without area, removed",
                face_place(description_, face) + no_area_reason(face) + "; face removed");
}

std::string PatchBuilder::no_area_reason(std::size_t face) const {
  const std::size_t corners = description_.outline(face).size();
  if (removed_crossing_.contains(face)) {
    return "the outline crosses itself and cannot be split";
  }
  if (corners >= 3) {
    return "no area";
  }
  return fmt::format("{} corner{}, but at least 3 are required", corners, corners == 1 ? "" : "s");
}

void PatchBuilder::add_triangles(std::size_t face, const Outline& outline,
                                 const PolygonShape& shape) {
  const std::vector<PlanePoint> plane = drop_axis(table.points(), outline, shape.normal);
  std::vector<CornerList> triangles;
  if (outline.size() == 4 && !is_simple(plane)) {
    // A quadrilateral bent so much that its projection crosses itself is still two triangles.
    triangles = {{0, 1, 2}, {0, 2, 3}};
  } else {
    triangles = triangles_of(plane);
  }
  if (triangles.empty()) {
    add_crossing(face, outline, shape.normal);
    return;
  }
  ++report.cut_non_planar;
  warnings_.add(
      "non-planar faces, split into triangles",
      fmt::format("{}not planar (a corner is {:.3g} m off the plane); split into triangles",
                  face_place(description_, face), shape.deviation));
  for (const CornerList& triangle : triangles) {
    const Outline part = pick(outline, triangle);
    const PolygonShape part_shape = measure(table.points(), part);
    if (!part_shape.degenerate) {
      add_part(face, part, part_shape);
    }
  }
}

/// Triangles by the even-odd rule, of an outline with its crossings as corners.
/// @param corners the outline; the corners of the triangles are added
std::vector<CornerList> PatchBuilder::triangles_of_crossing(Outline& corners, const Vec3& normal) {
  // Rounding may leave a crossing point beside an edge, where a third edge crosses it.
  constexpr int most_rounds = 4;
  for (int round = 0; round < most_rounds; ++round) {
    cancellation_.throw_if_canceled();
    const std::vector<PlanePoint> plane = drop_axis(table.points(), corners, normal);
    std::vector<CornerList> triangles;
    for (const auto& t : triangulate(plane)) {
      triangles.emplace_back(t.begin(), t.end());
    }
    if (!triangles.empty() || corners.size() > most_crossing_corners) {
      return triangles;
    }
    std::vector<Vec3> places;
    for (const PointId p : corners) {
      places.push_back(at(table.points(), p));
    }
    const std::vector<Vec3> crossed = with_crossings(places, plane, most_crossings);
    if (crossed.size() <= corners.size()) {
      return {};
    }
    corners.clear();
    for (const Vec3& p : crossed) {
      corners.push_back(table.id_of(p));
    }
  }
  return {};
}

void PatchBuilder::add_crossing(std::size_t face, const Outline& outline, const Vec3& normal) {
  Outline corners = outline;
  const std::vector<CornerList> triangles = triangles_of_crossing(corners, normal);
  warnings_.add("faces whose outlines cross themselves",
                fmt::format("{}the outline crosses itself; {}", face_place(description_, face),
                            triangles.empty() ? "face removed" : "split into triangles"));
  if (triangles.empty()) {
    ++report.removed_degenerate;
    removed_crossing_.insert(face);
  }
  for (const CornerList& triangle : triangles) {
    const Outline part = pick(corners, triangle);
    if (const PolygonShape shape = measure(table.points(), part); !shape.degenerate) {
      add_part(face, part, shape);
    }
  }
}

void PatchBuilder::add_part(std::size_t face, const Outline& outline, const PolygonShape& shape) {
  const std::vector<CornerList> convex = convex_pieces(outline, shape);
  if (convex.empty()) {
    add_crossing(face, outline, shape.normal);
    return;
  }
  if (options_.max_patch_area > 0 && shape.area * (1 - 1e-9) > options_.max_patch_area) {
    if (last_refined_ != face) {
      ++report.refined;
    }
    last_refined_ = face;
    refine(face, outline, convex, shape);
  } else {
    add_patch(face, outline, shape, convex);
  }
}

void PatchBuilder::refine(std::size_t face, const Outline& outline,
                          const std::vector<CornerList>& convex, const PolygonShape& shape) {
  std::vector<CornerList> parts;
  for (const CornerList& piece : convex) {
    if (piece.size() <= 3 || (piece.size() == 4 && outline.size() == 4)) {
      parts.push_back(piece);
      continue;
    }
    const Outline corners = pick(outline, piece);
    for (const CornerList& part : triangles_of(drop_axis(table.points(), corners, shape.normal))) {
      CornerList& global = parts.emplace_back();
      for (const std::uint32_t c : part) {
        global.push_back(piece[c]);
      }
    }
  }
  for (const CornerList& part : parts) {
    const Outline corners = pick(outline, part);
    const double area = measure(table.points(), corners).area;
    const CellGrid grid = choose_grid(table.points(), corners, area, options_.max_patch_area);
    check_patch_limit(face, grid.cell_count());
    for (const Outline& cell : make_cells(table, grid)) {
      cancellation_.throw_if_canceled();
      const PolygonShape cell_shape = measure(table.points(), cell);
      const std::vector<CornerList> cell_pieces =
          cell_shape.degenerate ? std::vector<CornerList>() : convex_pieces(cell, cell_shape);
      if (cell_pieces.empty()) {
        throw InputError(
            face_place(description_, face) +
            "the maximum patch area is too small for the precision of the coordinates");
      }
      add_patch(face, cell, cell_shape, cell_pieces);
    }
  }
}

void PatchBuilder::check_patch_limit(std::size_t face, std::int64_t more) const {
  const std::int64_t sides = is_two_sided(face) ? 2 : 1;
  if (static_cast<std::int64_t>(patches.size()) + sides * more > max_patches) {
    throw InputError(
        fmt::format("{}more than {} patches; is the maximum patch area of {} m² too small?",
                    face_place(description_, face), max_patches, options_.max_patch_area));
  }
}

void PatchBuilder::add_patch(std::size_t face, const Outline& outline, const PolygonShape& shape,
                             const std::vector<CornerList>& parts) {
  check_patch_limit(face, 1);
  const auto id = static_cast<PatchId>(patches.size());
  Patch& patch = patches.emplace_back();
  patch.normal = shape.normal;
  patch.area = shape.area;
  patch.center = shape.center;
  patch.face = static_cast<std::int32_t>(face);
  patch.material = description_.face_material[face];
  patch.outline_begin = static_cast<std::uint32_t>(outline_corners.size());
  outline_corners.insert(outline_corners.end(), outline.begin(), outline.end());
  patch.outline_end = static_cast<std::uint32_t>(outline_corners.size());
  for (const CornerList& part : parts) {
    Piece piece{id, static_cast<std::uint32_t>(piece_corners.size()), 0};
    for (const std::uint32_t c : part) {
      piece_corners.push_back(outline[c]);
    }
    piece.end = static_cast<std::uint32_t>(piece_corners.size());
    pieces.push_back(piece);
  }
  if (is_two_sided(face)) {
    add_opposite();
  }
}

void PatchBuilder::add_opposite() {
  const PatchId front = static_cast<PatchId>(patches.size()) - 1;
  Patch patch = patches.back();
  patch.normal = -patch.normal;
  const std::vector<PointId> outline(outline_corners.begin() + patch.outline_begin,
                                     outline_corners.begin() + patch.outline_end);
  patch.outline_begin = static_cast<std::uint32_t>(outline_corners.size());
  outline_corners.insert(outline_corners.end(), outline.rbegin(), outline.rend());
  patch.outline_end = static_cast<std::uint32_t>(outline_corners.size());
  patches.push_back(patch);
  std::size_t first = pieces.size();
  while (first > 0 && pieces[first - 1].patch == front) {
    --first;
  }
  const std::size_t last = pieces.size();
  for (std::size_t p = first; p < last; ++p) {
    const Piece piece = pieces[p];
    const auto begin = static_cast<std::uint32_t>(piece_corners.size());
    for (std::uint32_t c = piece.end; c > piece.begin; --c) {
      piece_corners.push_back(PointId{piece_corners[c - 1]});
    }
    pieces.push_back({front + 1, begin, static_cast<std::uint32_t>(piece_corners.size())});
  }
}

/// A deviation that rounding explains makes no face non-planar, however thin the face is.
bool PatchBuilder::is_planar(const PolygonShape& shape) const {
  const double width = shape.area / shape.diameter;
  return is_flat(shape) || is_flat_in_file(shape) ||
         (shape.deviation <= largest_deviation_by_diameter * shape.diameter &&
          shape.deviation <= largest_deviation_by_width * width);
}

bool PatchBuilder::is_flat(const PolygonShape& shape) const { return shape.deviation <= flatness_; }

bool PatchBuilder::is_flat_in_file(const PolygonShape& shape) const {
  return shape.deviation <= file_flatness_ &&
         shape.deviation <= largest_rounding_by_width * shape.area / shape.diameter;
}

std::vector<CornerList> PatchBuilder::convex_pieces(const Outline& outline,
                                                    const PolygonShape& shape) const {
  if (outline.size() == 3) {
    return {{0, 1, 2}};
  }
  const std::vector<PlanePoint> plane = drop_axis(table.points(), outline, shape.normal);
  if (!is_flat(shape) && !is_flat_in_file(shape)) {
    return triangles_of(plane);
  }
  if (is_convex(plane)) {
    return {all_corners(outline.size())};
  }
  return checked(plane, convex_partition(plane));
}

void PatchBuilder::count_coincident() {
  const auto pairs = coincident_faces(description_, welded_);
  check_copies(pairs);
  report.coincident_faces = static_cast<std::int64_t>(pairs.size());
  report.covered_faces = covered_faces(pairs, patches, description_.materials);
  for (const auto& [later, earlier] : pairs) {
    const auto one = first_patch_of(later, patches), other = first_patch_of(earlier, patches);
    if (one != patches.end() && other != patches.end() && dot(one->normal, other->normal) < 0) {
      continue;  // both sides of one sheet
    }
    warnings_.add("faces with the same points as an earlier one",
                  fmt::format("{}same points as face {}", face_place(description_, later),
                              description_.number_of(earlier)));
  }
  for (std::int32_t& face : report.covered_faces) {
    const auto f = static_cast<std::size_t>(face);
    warnings_.add("faces that get no light",
                  fmt::format("{}covered by a face on the same points: it gets no light (B = E)",
                              face_place(description_, f)));
    face = description_.number_of(f);
  }
}

/// Each ray that meets one of the copies tests them all.
void PatchBuilder::check_copies(
    const std::vector<std::pair<std::size_t, std::size_t>>& pairs) const {
  constexpr std::int64_t most_copies = 1000;
  std::map<std::size_t, std::int64_t> copies;
  for (const auto& [later, earlier] : pairs) {
    if (++copies[earlier] > most_copies) {
      throw InputError(fmt::format(
          "{}more than {} faces have the same points as face {}; delete "
          "the copies",
          face_place(description_, later), most_copies, description_.number_of(earlier)));
    }
  }
}

void PatchBuilder::note_moves(double rounding) {
  std::int64_t moved = 0;
  double farthest = 0;
  for (std::size_t k = 0; k < points_.size(); ++k) {
    const double distance = norm(points_[k] - description_.points[k]);
    // Nearer than that, planes and faces are what they were.
    moved += distance > flatness_ ? 1 : 0;
    farthest = std::max(farthest, distance);
  }
  if (moved > 0) {
    warnings_.add("notes",
                  fmt::format("{}: {} of {} vertices moved by up to {:.2g} m to undo the rounding "
                              "of coordinates ({:.2g} m), which bends faces and opens gaps",
                              description_.name, moved, points_.size(), farthest, rounding));
  }
}

void PatchBuilder::count_unused() {
  report.unused_points = std::count(welded_.begin(), welded_.end(), PointId{-1});
  if (report.unused_points > 0) {
    warnings_.add("notes", fmt::format("{}: {} of {} vertices are not used by any face",
                                       description_.name, report.unused_points, welded_.size()));
  }
}

}  // namespace transillum
