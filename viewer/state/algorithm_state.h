// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QString>
#include <optional>
#include <vector>

#include "model/snapshot.h"
#include "state/focus.h"
#include "transillum/map_region.h"

namespace transillum::viewer {

/// The two ways to one direction's transfers: sections 3.2 and 3.1.
enum class MapKind { local, global };

/// The lines of the paper's pseudo-code, as they are listed.
enum class CodeLine {
  start,  ///< B(0) = E
  each_iteration,
  restart,         ///< B(n+1) = E
  each_direction,  ///< down to here section 3.3
  sort,
  empty_map,
  each_patch,
  clip,
  if_front,
  gather,  ///< eq. 11 with eq. 14
  leave_hole,
  otherwise,
  put_in,      ///< the last of section 3.2
  global_map,  ///< the first of section 3.1
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
  QString words;
};
/// In our words, and with the receiver's reflectance, where the paper prints the source's.
const std::vector<CodeText>& algorithm_code();

/// The lines that the focus stands on; more than one where a phase does several. The regions of a
/// global map are not walked through one by one: that of the probed point stands for all.
std::vector<CodeLine> current_lines(const Focus& focus, MapKind kind);

/// What the variables of the pseudo-code hold in a step.
struct AlgorithmState {
  PatchId i = no_patch;
  bool front_facing = false;
  double area_i = 0;                                                    ///< A_i, m²
  std::int32_t map_before = 0, inside = 0, outside = 0, map_after = 0;  ///< |V|, |I|, |O|, |V|
  PatchId j = no_patch;  ///< of the inside list: the selected one, or that with most of it
  double area_j = 0;     ///< A(j), m²: all its parts in the inside list
  double weight = 0;     ///< J_d = 4 pi
  int directions = 0;    ///< M; a pass both ways counts as two
  std::optional<Rgb> radiosity_j;  ///< B_j(n), W/m²; nothing where it has not been kept
  std::optional<Rgb> gathered;     ///< what line `gather` adds to B_i(n+1), W/m²
};
/// Nothing before the first step. `selected`: the j to look at, if it is in the inside list.
std::optional<AlgorithmState> algorithm_state(const Focus& focus, const SolverSnapshot& snapshot,
                                              PatchId selected);

/// What they hold at the region R of a global map that the probed point lies in. With the BSP
/// tree's cuts among its edges, as the engine `global` has them.
struct RegionState {
  Vec2 point;
  std::optional<MapRegion> region;  ///< R; nothing on an edge
  std::vector<PatchId> list;        ///< L, from the light down
  PatchId i = no_patch;             ///< of L, the newest that the focus has processed
  bool front_facing = false;
  PatchId j = no_patch;            ///< next of L above i
  bool exchanges = false;          ///< i receives from j there
  double pair_area = 0;            ///< A(i, j) over all regions, m²
  std::optional<Rgb> radiosity_j;  ///< B_j(n), W/m²
  std::optional<Rgb> gathered;     ///< what line `gather_region` adds to B_i(n+1), W/m²
};
/// Nothing without a probed point.
std::optional<RegionState> region_state(const Focus& focus, const SolverSnapshot& snapshot);

}  // namespace transillum::viewer
