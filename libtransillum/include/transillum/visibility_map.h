// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "transillum/engine.h"

namespace transillum {

/// A point of the transillumination plane, meters along PlaneFrame::u and v.
struct Vec2 {
  double x = 0, y = 0;
};

/// The plane perpendicular to a direction. u, v and omega form a right-handed orthonormal frame.
struct PlaneFrame {
  Vec3 origin;
  Vec3 u, v, omega;

  Vec2 project(const Vec3& p) const { return {dot(p - origin, u), dot(p - origin, v)}; }
};
/// The frame that the engines use for `omega`: the same bits each time.
PlaneFrame plane_frame(const Scene& scene, const Vec3& omega);

/// The history of one direction, as a table: every fragment of the visibility map once, with the
/// step that made it and the step that consumed it. Step k processes order[k].
///
/// The map V after step k is the filter made <= k < consumed. The inside list of step k holds the
/// rows made and consumed at k; the outside list those with a parent that were made at k and
/// consumed later. So stepping back needs no undo.
struct MapRecord {
  static constexpr std::int32_t never = std::numeric_limits<std::int32_t>::max();
  static constexpr std::int32_t no_row = -1;

  struct Row {
    PatchId patch;             ///< whose surface it is
    std::int32_t made;         ///< step
    std::int32_t consumed;     ///< step, or `never`
    std::int32_t parent;       ///< row it was cut from, or no_row for a polygon new at its step
    bool front_facing;         ///< it receives for omega and shows its back to what lies below
    std::uint32_t begin, end;  ///< in `corners`
  };

  PlaneFrame frame;
  std::vector<FragmentId> order;    ///< BSP fragments, as processed
  std::vector<PatchId> step_patch;  ///< the patch that step k processes
  std::vector<Row> rows;
  std::vector<Vec2> corners;

  std::int32_t step_count() const { return static_cast<std::int32_t>(order.size()); }
  std::span<const Vec2> outline(const Row& row) const {
    return {corners.data() + row.begin, row.end - row.begin};
  }
  /// Of the row's polygon, m².
  double area(const Row& row) const;
  /// Whether point `p` of the plane lies in the row's polygon or on its edge.
  bool covers(const Row& row, const Vec2& p) const;
  /// The numbers of the rows that make up V after step k (-1: before the first).
  std::vector<std::int32_t> map_after(std::int32_t step) const;
  /// The step after which what shines down in V (is back facing) makes the most of a picture: the
  /// largest product of its rows and its area. Later, what receives covers it more and more.
  std::int32_t fullest_step() const;
};

/// Runs the local map engine on one direction and keeps its history. The transfers are the same
/// bits as the engine's.
/// @throws Canceled
struct RecordedDirection {
  Transfers transfers;
  MapRecord record;
};
RecordedDirection record_local_map(const Scene& scene, const BspTree& tree, const Vec3& omega,
                                   const Cancellation& cancellation = {});

/// What is seen of a scene along one direction, upward: convex polygons of the transillumination
/// plane that do not overlap (paper, section 3). For files and pictures; map_files.h writes it.
struct VisibilityMap {
  struct Polygon {
    PatchId patch;             ///< whose surface it is
    bool front_facing;         ///< it receives, and shows its back here; else it shines down
    double area;               ///< m², >= 0
    std::uint32_t begin, end;  ///< in `corners`
  };

  PlaneFrame frame;
  PatchId receiver = no_patch;      ///< who looks up; no_patch: somebody below the whole scene
  std::vector<Polygon> polygons;    ///< by patch, then in the order they were made
  std::vector<Polygon> window;      ///< the receiver's own; outside `polygons` nothing is above it
  std::vector<Vec2> corners;        ///< of polygons and window, counter-clockwise as u turns to v
  std::vector<Transfer> exchanges;  ///< who sees whom along the direction, by receiver

  /// Of a map drawn in pixels (pixel_map.h).
  struct Pixels {
    double side = 0;                   ///< meters; 0: the map is exact, and nothing below
    std::vector<Vec2> borders;         ///< between different patches: ends of lines, two by two
    std::vector<Polygon> differences;  ///< where not what is there is shown; corners in `corners`
  };
  Pixels pixels;

  std::span<const Vec2> outline(const Polygon& polygon) const {
    return {corners.data() + polygon.begin, polygon.end - polygon.begin};
  }
};
/// V after step `step` (-1: before the first), without exchanges.
VisibilityMap map_after(const MapRecord& record, std::int32_t step);
/// V after the last step: what is seen from below the scene.
VisibilityMap map_from_below(const RecordedDirection& direction);
/// What patch `receiver` of the scene sees: the inside lists of the steps that process it. Without
/// a window, and empty, where it is edge-on or faces away.
VisibilityMap map_of_receiver(const RecordedDirection& direction, PatchId receiver);

}  // namespace transillum
