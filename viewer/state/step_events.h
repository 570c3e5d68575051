// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QString>
#include <vector>

#include "visibility/map/map_history.h"

namespace transillum::viewer {

/// An event of a step: its polygon is inserted, or it cuts a polygon of V.
struct StepEvent {
  enum class Kind {
    edge_on,       ///< the polygon is edge-on: not processed
    inserted,      ///< the polygon is inserted into V
    exchange,      ///< below receives from above
    back_seen,     ///< below faces the back of above
    back_shown,    ///< above faces (along -omega) the back of below
    back_to_back,  ///< neither faces the other
  };
  static constexpr int kind_count = 6;
  std::int32_t step = 0;
  Kind kind = Kind::inserted;
  PatchId below = no_patch;  ///< patch of the polygon that the step processes
  PatchId above = no_patch;  ///< patch of the cut polygon; no_patch if none is cut
  double area = 0;           ///< m²: of the polygon, or of the cut part above it
  int parts = 0;             ///< number of parts of the cut polygon that remain in V
  double pair_area = 0;      ///< events_at_point(): A(below, above) of the direction, m²

  friend bool operator==(const StepEvent&, const StepEvent&) = default;
};

/// The events of a step: its polygon first, then the cut parts by decreasing area.
std::vector<StepEvent> events_of_step(const MapHistory& history, std::int32_t step);
/// The events of a direction that involve one patch, in order.
std::vector<StepEvent> events_of_patch(const MapHistory& history, PatchId patch);
/// A(i, j, omega), m²: area of `source` that `receiver` sees, over all steps of the direction.
double exchanged_area(const MapHistory& history, PatchId receiver, PatchId source);
/// The polygons that cover point `p`, in BSP order, each with the polygon above it there.
std::vector<StepEvent> events_at_point(const MapHistory& history, const Vec2& p);

/// A verb phrase without the patches.
QString text_of(StepEvent::Kind kind);

}  // namespace transillum::viewer
