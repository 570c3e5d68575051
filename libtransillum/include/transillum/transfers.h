// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "transillum/export.h"
#include "transillum/scene.h"

namespace TRANSILLUM_API transillum {

/// A(i,j,omega) of eq. 14: the area, on the plane perpendicular to omega, over which front-facing
/// patch i sees back-facing patch j with nothing between them.
struct Transfer {
  PatchId receiver;  ///< i
  PatchId source;    ///< j
  double area;       ///< m², > 0
};

/// Moments of a Transfer for a linear basis: T^ab(i,j,omega) = ∫ phi_a(x) phi_b(y) dp over the part
/// of the plane that makes up its area, x and y being the points of receiver i and source j above p
/// (LinearBasis; ALGORITHM.md 6.12), m².
struct TransferMoments {
  std::array<double, 9> value{};  ///< T^ab at 3 a + b

  /// T^ab; T^00 is the area.
  double& of(std::size_t a, std::size_t b) { return value[3 * a + b]; }
  /// T^ab; T^00 is the area.
  double of(std::size_t a, std::size_t b) const { return value[3 * a + b]; }
};

/// Integrals of phi_1 and phi_2 over the parts of a receiver's projection that a Coverage measures,
/// m².
struct CoverageMoments {
  std::array<double, 2> projected{};  ///< over all of it: 0, but for rounding
  std::array<double, 2> covered{};    ///< over what has some surface above
};

/// How much of a receiver's projection is accounted for.
struct Coverage {
  double projected = 0;  ///< area of the patch's projection, m²; 0 where it does not receive
  double covered = 0;    ///< part of it with some surface above, front or back side, m²

  /// The part with nothing above, which sees the sky, m²; 0 where it is rounding (ALGORITHM.md,
  /// oracle 1).
  double uncovered() const {
    const double rest = projected - covered;
    return rest > 1e-12 * projected ? rest : 0;
  }
};

/// The work done by one pass, for statistics and tests. Counts that do not apply to an engine stay
/// 0.
struct PassCounts {
  std::int64_t pairs = 0;            ///< pairs of polygons compared edge by edge
  std::int64_t cuts = 0;             ///< cuts of a polygon by a line
  std::int64_t decisions = 0;        ///< decisions on which side of a line a corner lies
  std::int64_t exact_decisions = 0;  ///< decisions made in integer arithmetic
  std::int64_t exact_queries = 0;    ///< visibility queries repeated with exact predicates
  std::int64_t pixels = 0;           ///< pixels covered by a patch, or lines that hit one; summed
  std::int64_t missed = 0;           ///< patches too small or thin for any pixel or line
  double seconds_order = 0;          ///< ordering and projecting, s of the pass's thread
  double seconds_bins = 0;           ///< distributing to bins, s of the pass's thread
  double seconds_clip = 0;           ///< querying, cutting and summing, s of the pass's thread

  /// Adds all counts and times.
  PassCounts& operator+=(const PassCounts& other);
};

/// The result of an engine for one direction, and the only input of the solvers.
///
/// `exchanges` serves two directions: it lists A(i,j,omega), which equals A(j,i,-omega).
struct Transfers {
  Vec3 direction;                   ///< omega: unit, from the receiver toward the source
  std::vector<Transfer> exchanges;  ///< sorted by receiver, then source; one entry per pair
  std::vector<Coverage> forward;    ///< per patch: as receiver for omega
  std::vector<Coverage> backward;   ///< per patch: as receiver for -omega
  std::vector<double> back_seen;  ///< per patch: m² of its back side that receivers see, for both
                                  ///< omega and -omega
  PassCounts counts;              ///< work done
  /// Moments of each exchange, if EngineOptions::moments; else empty.
  std::vector<TransferMoments> moments = {};
  std::vector<CoverageMoments> forward_moments = {};   ///< beside `forward`; empty without moments
  std::vector<CoverageMoments> backward_moments = {};  ///< beside `backward`; the same
};

/// The closure defect of one direction, omega and -omega together: projected area minus everything
/// visible, over the projected area. 0 up to rounding in a closed scene (ALGORITHM.md, oracle 1).
struct ClosureDefect {
  /// Largest |projected - covered| / projected over the patches at no grazing angle: those whose
  /// projection is at least 1e-6 of their area.
  double relative = 0;
  /// Largest |projected - covered| / area over the others.
  double grazing = 0;
  PatchId worst = no_patch;  ///< the patch with the defect `relative`
  /// Largest defect of the integrals of phi_1 and phi_2, over the projected area, among the patches
  /// at no grazing angle. 0 without moments.
  double moments = 0;
};
/// Computes the closure defect from the coverages of one direction.
ClosureDefect closure_defect(const Transfers& transfers, const Scene& scene);

}  // namespace TRANSILLUM_API transillum
