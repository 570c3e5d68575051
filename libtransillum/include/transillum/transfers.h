// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <cstdint>
#include <vector>

#include "transillum/scene.h"

namespace transillum {

/// A(i,j,omega) of eq. 14: the area, on the plane perpendicular to omega, where front-facing i
/// sees back-facing j with nothing between; m², > 0.
struct Transfer {
  PatchId receiver;
  PatchId source;
  double area;
};

/// How much of a receiver's projection was accounted for, m².
struct Coverage {
  double projected = 0;  ///< area of the patch's projection, 0 where it does not receive
  double covered = 0;    ///< of it, where some surface lies above, lit side or back
};

/// What a pass took, for statistics and tests; engines leave at 0 what does not apply.
struct PassCounts {
  std::int64_t pairs = 0;            ///< polygons compared edge by edge
  std::int64_t cuts = 0;             ///< of a polygon by a line
  std::int64_t decisions = 0;        ///< on which side of a line a corner lies
  std::int64_t exact_decisions = 0;  ///< of them, those that took whole numbers
  std::int64_t exact_queries = 0;      ///< polygons looked at by pieces, their signs exact
  std::int64_t pixels = 0;           ///< that patches cover, lines that meet them: of all patches
  std::int64_t missed = 0;           ///< patches so small or thin that no pixel or line meets them
  // Seconds of the thread that made the pass.
  double seconds_order = 0;  ///< ordering and projecting
  double seconds_bins = 0;   ///< dealing out to bins
  double seconds_clip = 0;   ///< looking, cutting, adding up

  PassCounts& operator+=(const PassCounts& other);
};

/// All that one direction tells, and the one currency between engines and solvers.
///
/// `exchanges` serves two directions: it lists A(i,j,omega), and A(j,i,-omega) is the same number.
struct Transfers {
  Vec3 direction;                   ///< omega: unit, from the receiver toward the source
  std::vector<Transfer> exchanges;  ///< by receiver, then source; one entry a pair
  std::vector<Coverage> forward;    ///< a patch: as receiver for omega
  std::vector<Coverage> backward;   ///< a patch: as receiver for -omega
  std::vector<double> back_seen;    ///< a patch: area of its back that receivers look at, both ways
  PassCounts counts;
};

/// What one direction's transfers leave open (method: closure), both ways taken together.
struct ClosureDefect {
  double relative = 0;       ///< largest |projected - covered| / projected, patches seen at >= 1e-6
  double grazing = 0;        ///< the same over the patch's own area, patches seen at less
  PatchId worst = no_patch;  ///< where `relative` is reached
};
ClosureDefect closure_defect(const Transfers& transfers, const Scene& scene);

}  // namespace transillum
