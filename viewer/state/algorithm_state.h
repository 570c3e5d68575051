// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QString>
#include <map>
#include <optional>
#include <vector>

#include "model/snapshot.h"
#include "state/focus.h"
#include "transillum/transfers.h"
#include "visibility/map/map_history.h"
#include "visibility/map/map_region.h"

namespace transillum::viewer {

/// Local visibility map (section 3.2) or global one (section 3.1).
enum class MapKind { local, global };

/// The lines of the pseudo-code, in the order of the listing.
enum class CodeLine {
  start,  ///< B(0) = E
  each_iteration,
  restart,         ///< B(n+1) = E
  each_direction,  ///< the lines from `start` to this one are in section 3.3
  sort,
  empty_map,
  each_patch,
  clip,
  if_front,
  gather,  ///< eq. 11 with eq. 14
  leave_hole,
  otherwise,
  put_in,      ///< last line of section 3.2
  global_map,  ///< first line of section 3.1
  each_region,
  region_list,
  each_receiver,
  next_above,
  if_back,
  gather_region,  ///< eq. 11 with eq. 14, of one region
};
struct CodeText {
  CodeLine line;
  int indent;
  QString text;
};
/// The listing. It has the reflectance rho_i of the receiver where the paper prints the source's.
const std::vector<CodeText>& algorithm_code();

/// The lines at the position of the focus; a phase can have several. For a global map, only the
/// region at the probed point is followed.
std::vector<CodeLine> current_lines(const Focus& focus, MapKind kind);

/// The variables of the pseudo-code in a step.
struct AlgorithmState {
  PatchId i = no_patch;
  bool front_facing = false;
  double area_i = 0;                                                    ///< A_i, m²
  std::int32_t map_before = 0, inside = 0, outside = 0, map_after = 0;  ///< |V|, |I|, |O|, |V|
  PatchId j = no_patch;  ///< a patch of the inside list: the selected one, else the one with the
                         ///< largest area
  double area_j = 0;     ///< A(j), m²: sum over its parts in the inside list
  double weight = 0;     ///< J_d = 4 pi
  int directions = 0;    ///< M; a two-way pass counts as two
  std::optional<Rgb> radiosity_j;  ///< B_j(n), W/m²; not set if it was not stored
  std::optional<Rgb> gathered;     ///< summand of line `gather` to B_i(n+1), W/m²
  /// T^ab of i and j, where B is linear on patches; radiosity_j and gathered are then means.
  std::optional<TransferMoments> moments = {};
};
/// The variables at the position in focus; not set before the first step.
/// @param selected  the patch j, if it is in the inside list
std::optional<AlgorithmState> algorithm_state(const Focus& focus, const SolverSnapshot& snapshot,
                                              PatchId selected);

/// The variables at the region R of a global map that contains the probed point. Cuts of the BSP
/// tree are among its edges, as in the engine `global`.
struct RegionState {
  Vec2 point;
  std::optional<MapRegion> region;  ///< R; not set on an edge
  std::vector<PatchId> list;        ///< L, in BSP order
  PatchId i = no_patch;             ///< the last patch of L that the focus has processed
  bool front_facing = false;
  PatchId j = no_patch;            ///< the patch of L directly above i
  bool exchanges = false;          ///< i receives from j in R
  double pair_area = 0;            ///< A(i, j) over all regions, m²
  std::optional<Rgb> radiosity_j;  ///< B_j(n), W/m²
  std::optional<Rgb> gathered;     ///< summand of line `gather_region` to B_i(n+1), W/m²
};
/// The variables at the probed point; not set without one.
std::optional<RegionState> region_state(const Focus& focus, const SolverSnapshot& snapshot);

/// The moments T^ab of the area that the receiver of a step sees of each patch j with which it
/// exchanges light (ALGORITHM.md 6.12), by j. They are computed from the polygons of the inside
/// list. Empty before the first step, and where the step's patch does not receive.
std::map<PatchId, TransferMoments> moments_of_step(const MapHistory& history, const Scene& scene,
                                                   std::int32_t step);

}  // namespace transillum::viewer
