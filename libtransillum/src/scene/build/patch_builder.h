// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "scene/build/point_table.h"
#include "scene/build/polygon_shape.h"
#include "scene/build/warnings.h"

namespace transillum {

/// Makes patches and their convex pieces of the faces of a checked description.
class PatchBuilder {
 public:
  /// More patches than this are refused.
  static constexpr std::int64_t most_patches = 50'000'000;

  PatchBuilder(const SceneDescription& description, const SceneOptions& options,
               const Cancellation& cancellation);
  void build();

  PointTable table;
  std::vector<Patch> patches;
  std::vector<PointId> outline_corners;
  std::vector<Piece> pieces;
  std::vector<PointId> piece_corners;
  SceneReport report;

 private:
  using Outline = std::vector<PointId>;
  static constexpr std::size_t no_face = static_cast<std::size_t>(-1);

  void add_face(std::size_t face);
  Outline welded_outline(std::size_t face);
  void drop(std::size_t face);
  /// Why a face that is dropped has none.
  std::string lack_of_area(std::size_t face) const;
  /// Cuts a face that is not planar into triangles; each becomes a face's part of its own.
  void add_triangles(std::size_t face, const Outline& outline, const PolygonShape& shape);
  /// A planar part of a face: one patch, or many where it is to be refined.
  void add_part(std::size_t face, const Outline& outline, const PolygonShape& shape);
  void refine(std::size_t face, const Outline& outline, const PolygonShape& shape);
  void add_patch(std::size_t face, const Outline& outline, const PolygonShape& shape,
                 const std::vector<CornerList>& parts);
  void add_opposite();
  void check_room(std::size_t face, std::int64_t more) const;

  bool is_planar(const PolygonShape& shape) const;
  bool is_flat(const PolygonShape& shape) const;
  /// The outline's convex pieces; flat ones to rounding.
  /// @throws InputError where the outline crosses itself.
  std::vector<CornerList> convex_pieces(std::size_t face, const Outline& outline,
                                        const PolygonShape& shape) const;
  std::vector<CornerList> triangles_of(std::size_t face,
                                       const std::vector<PlanePoint>& plane) const;

  /// The parts, if they are what the outline goes round.
  std::vector<CornerList> checked(std::size_t face, const std::vector<PlanePoint>& plane,
                                  std::vector<CornerList> parts) const;

  [[noreturn]] void refuse_crossing(std::size_t face) const;

  void count_coincident();
  void count_unused();

  const SceneDescription& description_;
  const SceneOptions& options_;
  const Cancellation& cancellation_;
  std::vector<PointId> welded_;  // a point of the description: its number in the table, or -1
  double flatness_ = 0;          // meters; within it a polygon counts as planar
  std::size_t last_refined_ = no_face;
  Warnings warnings_;
};

}  // namespace transillum
