// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QString>
#include <vector>

#include "transillum/map_history.h"

namespace transillum::viewer {

/// One thing that happened in a step: a polygon came, or one of V was cut by it.
struct StepEvent {
  enum class Kind {
    edge_on,       ///< the polygon takes no part
    comes,         ///< the polygon is put into V
    exchange,      ///< below receives from above
    back_seen,     ///< below looks at the back of above
    back_shown,    ///< above looks (along -omega) at the back of below
    back_to_back,  ///< neither looks at the other
  };
  std::int32_t step = 0;
  Kind kind = Kind::comes;
  PatchId below = no_patch;  ///< whose polygon the step processes
  PatchId above = no_patch;  ///< what it met; no_patch where it came or is edge-on
  double area = 0;           ///< m²: of the polygon, or of the part above it
  int parts = 0;             ///< of what was cut, left in V
  double pair_area = 0;      ///< of an exchange along a line: A(below, above) of the direction, m²

  friend bool operator==(const StepEvent&, const StepEvent&) = default;
};

/// All of a step: its polygon first, then what it cut, the largest first.
std::vector<StepEvent> events_of_step(const MapHistory& history, std::int32_t step);
/// Those of a direction that concern one patch, in order.
std::vector<StepEvent> events_of_patch(const MapHistory& history, PatchId patch);
/// A(i, j, omega), m²: what `receiver` sees of `source` at all steps of the direction.
double exchanged_area(const MapHistory& history, PatchId receiver, PatchId source);
/// The polygons that cover point `p`, from the light down, each with what it meets there.
std::vector<StepEvent> events_at_point(const MapHistory& history, const Vec2& p);

/// In a few words, without the patches.
QString text_of(StepEvent::Kind kind);

}  // namespace transillum::viewer
