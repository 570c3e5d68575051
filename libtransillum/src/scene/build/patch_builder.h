// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
// From the faces of a checked SceneDescription to patches, their convex pieces and the report of
// what was repaired. Faces without area are removed, non-planar ones split into triangles, large
// ones refined (SceneOptions::max_patch_area).
#pragma once

#include <set>
#include <string>
#include <utility>
#include <vector>

#include "scene/build/point_table.h"
#include "scene/build/polygon_shape.h"
#include "scene/build/warnings.h"
#include "transillum/scene.h"

namespace transillum {

/// Builds the patches of a Scene and their convex pieces from a checked description. The public
/// members are the results of build().
class PatchBuilder {
 public:
  /// Limit of the number of patches.
  static constexpr std::int64_t max_patches = 50'000'000;

  PatchBuilder(const SceneDescription& description, const SceneOptions& options,
               const Cancellation& cancellation);
  /// @throws InputError, Canceled
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
  void remove(std::size_t face);
  /// Why the face has no area, for messages.
  std::string no_area_reason(std::size_t face) const;
  /// Splits a non-planar face into triangles and adds each as a part.
  void add_triangles(std::size_t face, const Outline& outline, const PolygonShape& shape);
  /// Splits a face that crosses itself into triangles, on the side of `normal`, by the even-odd
  /// rule; removes it if there are none.
  void add_crossing(std::size_t face, const Outline& outline, const Vec3& normal);
  std::vector<CornerList> triangles_of_crossing(Outline& corners, const Vec3& normal);
  /// Adds a planar part of a face as one patch, or as many patches if it is to be refined.
  void add_part(std::size_t face, const Outline& outline, const PolygonShape& shape);
  void refine(std::size_t face, const Outline& outline, const std::vector<CornerList>& convex,
              const PolygonShape& shape);
  void add_patch(std::size_t face, const Outline& outline, const PolygonShape& shape,
                 const std::vector<CornerList>& parts);
  bool is_two_sided(std::size_t face) const {
    return options_.two_sided || description_.is_two_sided(face);
  }
  /// Adds the back side of the last patch, of a two-sided face.
  void add_opposite();
  /// @throws InputError if `more` patches would exceed max_patches.
  void check_patch_limit(std::size_t face, std::int64_t more) const;

  bool is_planar(const PolygonShape& shape) const;
  bool is_flat(const PolygonShape& shape) const;
  bool is_flat_in_file(const PolygonShape& shape) const;
  /// The outline's convex pieces, each planar to rounding; none if the outline crosses itself.
  std::vector<CornerList> convex_pieces(const Outline& outline, const PolygonShape& shape) const;

  void note_moves(double rounding);
  void count_coincident();
  void check_copies(const std::vector<std::pair<std::size_t, std::size_t>>& pairs) const;
  void count_unused();

  const SceneDescription& description_;
  const SceneOptions& options_;
  const Cancellation& cancellation_;
  std::vector<Vec3> points_;     // of the description, without the rounding of its file
  std::vector<PointId> welded_;  // for each point of the description its number in `table`, or -1
  double flatness_ = 0;          // deviation from a plane by the rounding of doubles, m
  double file_flatness_ = 0;     // by the rounding of the coordinates in a file, m; >= flatness_
  std::size_t last_refined_ = no_face;
  std::set<std::size_t> removed_crossing_;  // faces that cross themselves and cannot be split
  Warnings warnings_;
};

/// Pairs (face, earliest face with the same set of distinct points), sorted by the first.
/// @param welded for each point of the description its number among the distinct ones
std::vector<std::pair<std::size_t, std::size_t>> coincident_faces(
    const SceneDescription& description, const std::vector<PointId>& welded);

/// The first patch of a face; the end if it has none. The patches are in the order of faces.
std::vector<Patch>::const_iterator first_patch_of(std::size_t face,
                                                  const std::vector<Patch>& patches);
/// SceneReport::covered_faces.
/// @param pairs of coincident_faces()
/// @param patches by face, before refinement or after it; of a refined face the first patch decides
std::vector<std::int32_t> covered_faces(
    const std::vector<std::pair<std::size_t, std::size_t>>& pairs,
    const std::vector<Patch>& patches, const std::vector<Material>& materials);

}  // namespace transillum
