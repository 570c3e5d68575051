// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "scene/build/polygon_shape.h"
#include "transillum/cancellation.h"

namespace transillum {

/// A plane that several points lay on before they were rounded: normal·(p - center) = 0.
struct RoundedPlane {
  Vec3 normal, center;
  Vec3 across;                     ///< unit vector in the plane, the short way of its points
  double breadth = 0, length = 0;  ///< typical distances of its points across and along, m
  bool fixed = false;              ///< along two axes, exactly: rounding does not tilt it
};

/// Point `point` lies on plane `plane`, but for rounding.
struct PlaneIncidence {
  PointId point;
  std::int32_t plane;
  bool corner;  ///< of a face in the plane; else it touches one from elsewhere
};

/// Point `point` lies on the edge of a face from `from` to `to`, but for rounding; if these are the
/// same, it is that point, in one of two directions.
struct EdgeIncidence {
  PointId point, from, to;
  int direction;       ///< 0 or 1: the second of two directions in which points coincide
  std::int32_t plane;  ///< of the face
  Vec3 across;         ///< unit vector in the plane of the face, perpendicular to the edge
};

/// Which points lie on which planes and edges, but for rounding.
struct PlaneIncidences {
  std::vector<RoundedPlane> planes;
  std::vector<PlaneIncidence> incidences;  ///< sorted by plane, then point; without repetition
  std::vector<EdgeIncidence> on_edges;     ///< each edge once per point
  std::vector<bool> movable;               ///< per point: its faces are much wider than rounding
};

/// Finds the planes of faces, one for coplanar faces, and all points on the faces: their corners,
/// and corners of other faces that touch them.
/// @param points distinct.
/// @param faces outlines without repeated corners.
/// @param rounding of coordinates, m.
/// @throws Canceled
PlaneIncidences find_plane_incidences(std::span<const Vec3> points,
                                      const std::vector<std::vector<PointId>>& faces,
                                      double rounding, const Cancellation& cancellation);

}  // namespace transillum
