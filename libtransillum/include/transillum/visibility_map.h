// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Visibility maps as data: the plane perpendicular to a direction, the recorded history of one
// direction (MapRecord), and a map for files and pictures (VisibilityMap). The interactive viewer
// and the writers of map_files.h work on these.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "transillum/bsp_tree.h"
#include "transillum/engine.h"
#include "transillum/export.h"

namespace TRANSILLUM_API transillum {

/// A point of the transillumination plane.
struct Vec2 {
  double x = 0;  ///< m along PlaneFrame::u
  double y = 0;  ///< m along PlaneFrame::v
};

/// The transillumination plane: perpendicular to a direction omega. u, v and omega form a
/// right-handed orthonormal frame.
struct PlaneFrame {
  Vec3 origin;  ///< a point of the plane, m
  Vec3 u;       ///< first axis of the plane, unit
  Vec3 v;       ///< second axis of the plane, unit
  Vec3 omega;   ///< the direction, unit; "above" means farther along it

  /// Coordinates of the projection of p along omega.
  Vec2 project(const Vec3& p) const { return {dot(p - origin, u), dot(p - origin, v)}; }
  /// The point of a patch's plane that is projected to p, m; not set where the patch is edge-on.
  std::optional<Vec3> point_on(const Patch& patch, const Vec2& p) const;
};
/// The frame that the engines use for `omega`: the same bits each time.
PlaneFrame plane_frame(const Scene& scene, const Vec3& omega);

/// The history of one direction as a table: every polygon that was ever in the local visibility map
/// V, with the step that made it and the step that consumed it. Step k processes order[k].
///
/// The map V after step k consists of the rows with made <= k < consumed. The inside list of step k
/// consists of the rows made and consumed at k; its outside list of the rows with a parent that
/// were made at k and consumed later. Stepping back therefore needs no undo.
struct MapRecord {
  /// Row::consumed of a row that is still in V after the last step.
  static constexpr std::int32_t never = std::numeric_limits<std::int32_t>::max();
  /// No row.
  static constexpr std::int32_t no_row = -1;

  /// A convex polygon of the plane and its lifetime in V.
  struct Row {
    PatchId patch;          ///< the patch whose projection it is a part of
    std::int32_t made;      ///< step that made it
    std::int32_t consumed;  ///< step that removed it from V, or `never`
    std::int32_t parent;    ///< row it was cut from; no_row for the polygon that entered at `made`
    bool front_facing;      ///< the patch receives for omega; its back is visible from below
    std::uint32_t begin;    ///< first index in `corners`
    std::uint32_t end;      ///< one past the last index
  };

  PlaneFrame frame;                 ///< frame of the direction
  std::vector<FragmentId> order;    ///< BSP fragments in the order processed
  std::vector<PatchId> step_patch;  ///< per step: the patch of its fragment
  std::vector<Row> rows;            ///< in the order made
  std::vector<Vec2> corners;        ///< corners of all rows
  std::vector<LineId> lines;        ///< per corner: the line of the BSP tree on which the edge to
                                    ///< the next corner lies

  /// Number of steps: fragments processed.
  std::int32_t step_count() const { return static_cast<std::int32_t>(order.size()); }
  /// Corners of a row's polygon.
  std::span<const Vec2> outline(const Row& row) const {
    return {corners.data() + row.begin, row.end - row.begin};
  }
  /// Lines of the edges of a row's polygon: the first is that from the first corner to the second.
  std::span<const LineId> edge_lines(const Row& row) const {
    return {lines.data() + row.begin, row.end - row.begin};
  }
  /// Area of the row's polygon, m².
  double area(const Row& row) const;
  /// Whether point `p` of the plane lies inside the row's polygon or on its boundary.
  bool covers(const Row& row, const Vec2& p) const;
  /// The numbers of the rows that form V after step `step` (-1: before the first).
  std::vector<std::int32_t> map_after(std::int32_t step) const;
  /// The step whose V makes the most informative picture: the one with the largest product of the
  /// number and the total area of its back-facing (emitting) rows. In later steps front-facing rows
  /// cover more and more of them.
  std::int32_t fullest_step() const;
};

/// The result of the local map engine for one direction, with its history.
struct RecordedDirection {
  Transfers transfers;  ///< the same bits as the engine's transfers
  MapRecord record;     ///< how they were found
};
/// Runs the local map engine on one direction and records its history.
/// @param scene the scene.
/// @param tree BSP tree of `scene`.
/// @param omega unit.
/// @param cancellation checked between steps.
/// @param memory limit of what the record takes, bytes, also while its lists grow; some 100 per
/// polygon that is ever in V; 0: a quarter of the machine's memory.
/// @throws Canceled, MemoryLimitExceeded
RecordedDirection record_local_map(const Scene& scene, const BspTree& tree, const Vec3& omega,
                                   const Cancellation& cancellation = {},
                                   std::uint64_t memory = 0);

/// The surfaces visible along one direction omega, upward: convex polygons of the transillumination
/// plane that do not overlap (paper, section 3). For files and pictures; map_files.h writes it.
struct VisibilityMap {
  /// A convex polygon of the map.
  struct Polygon {
    PatchId patch;        ///< the visible patch
    bool front_facing;    ///< its back is visible and it receives; else its front, and it emits
    double area;          ///< m², >= 0
    std::uint32_t begin;  ///< first index in `corners`
    std::uint32_t end;    ///< one past the last index
  };

  PlaneFrame frame;             ///< frame of the direction
  PatchId receiver = no_patch;  ///< patch whose map this is; no_patch: the map from below the scene
  std::vector<Polygon> polygons;  ///< sorted by patch, then in the order made
  std::vector<Polygon> window;    ///< the receiver's projection; parts of it not covered by
                                  ///< `polygons` have nothing above
  std::vector<Vec2> corners;      ///< corners of polygons and window, counter-clockwise from u to v
  std::vector<Transfer> exchanges;  ///< all exchanges along the direction, sorted by receiver

  /// Additional data of a map drawn in pixels (pixel_map.h).
  struct Pixels {
    double side = 0;  ///< side of a pixel, m; 0: the map is exact, and the lists are empty
    std::vector<Vec2> borders;  ///< line segments between different patches: pairs of end points
    std::vector<Polygon> differences;  ///< where the pixels differ from the exact map; corners in
                                       ///< `corners`
  };
  Pixels pixels;  ///< data of a map drawn in pixels

  /// Corners of a polygon.
  std::span<const Vec2> outline(const Polygon& polygon) const {
    return {corners.data() + polygon.begin, polygon.end - polygon.begin};
  }
};
/// V after step `step` (-1: before the first), without exchanges.
VisibilityMap map_after(const MapRecord& record, std::int32_t step);
/// The same with the exchanges of the steps so far.
VisibilityMap map_after(const RecordedDirection& direction, std::int32_t step);
/// V after the last step: what is visible from below the scene.
VisibilityMap map_from_below(const RecordedDirection& direction);
/// The map that patch `receiver` sees along the direction: the inside lists of its steps.
/// Empty, also the window, if the patch is edge-on or back-facing.
VisibilityMap map_of_receiver(const RecordedDirection& direction, PatchId receiver);

}  // namespace TRANSILLUM_API transillum
