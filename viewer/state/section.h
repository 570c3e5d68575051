// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// A recorded direction in two dimensions: the plane that contains omega cuts the patches in
// segments, and the polygons of V in intervals of a line. The panel Section and the HTML pages of
// lessons draw it.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <vector>

#include "model/requests/recorded_map.h"
#include "state/callout.h"

namespace transillum::viewer {

/// The scene and the polygons of V of one direction in a plane that contains omega. Points of the
/// plane are in meters, x to the right and y up, as seen along the plane's normal.
struct Section {
  /// Where the plane cuts a patch. A patch that is not convex can have several.
  struct Segment {
    PatchId patch = no_patch;
    Vec2 a, b;
    Vec2 front;  ///< unit; to the side that the patch faces
  };
  /// Where the plane cuts a row of the map's record.
  struct Interval {
    std::int32_t row = MapRecord::no_row;
    double low = 0, high = 0;  ///< along `across`, m
  };

  Vec3 right, up;   ///< axes of the plane, unit
  Vec3 axis;        ///< the coordinate axis along which the section looks, as far as omega allows
  Vec3 foot;        ///< the point of the plane that is nearest to the origin of space, m
  Vec2 omega;       ///< unit
  Vec2 across;      ///< unit, perpendicular to omega: the direction of the line
  double base = 0;  ///< the line's place along omega, m: below all segments
  std::vector<Segment> segments;
  std::vector<Interval> intervals;  ///< by row, ascending; rows that the plane misses have none

  /// The projection of a point of space, m.
  Vec2 in_plane(const Vec3& p) const { return {dot(p, right), dot(p, up)}; }
  /// The point of space at a point of the plane, m.
  Vec3 in_space(const Vec2& p) const { return foot + p.x * right + p.y * up; }
  /// The point of the line at a place along `across`.
  Vec2 on_line(double place) const { return above(place, base); }
  /// The point at a place along `across`, and a place along omega.
  Vec2 above(double place, double height) const {
    return {place * across.x + height * omega.x, place * across.y + height * omega.y};
  }
  /// The smallest box of segments and line, m.
  struct Box {
    double left = HUGE_VAL, right = -HUGE_VAL, bottom = HUGE_VAL, top = -HUGE_VAL;
  };
  Box box() const;
  /// The interval of a row; null if it has none.
  const Interval* interval_of(std::int32_t row) const;
};

/// The section through the middle of the scene, perpendicular to the axis along which the scene is
/// shortest, as far as omega allows: of a scene of prisms, the plane in which it is drawn by hand.
/// O(patches + rows).
Section section_of(const RecordedMap& map);

/// The parts of two patches that see each other: corners in the order around. The lower side is a
/// part of the patch that receives, or of the line.
using SectionStrip = std::array<Vec2, 4>;
/// The strip from an interval to the patch of its row.
/// @param receiver  no_patch: the strip begins at the line
std::optional<SectionStrip> strip_of(const Section& section, const RecordedMap& map,
                                     const Section::Interval& interval, PatchId receiver);

/// The point that a callout points at: of a patch its longest segment, of V the line, of the inside
/// list its first interval; none for the direction, and where the section has none of these.
/// @param step  whose inside list is meant, from 0
std::optional<Vec2> place_in_section(const Callout& callout, const Section& section,
                                     const RecordedMap& map, std::int32_t step);

}  // namespace transillum::viewer
