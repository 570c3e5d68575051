// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QString>
#include <optional>
#include <vector>

#include "focus.h"
#include "snapshot.h"

namespace transillum::viewer {

/// The lines of the paper's pseudo-code (sections 3.3 and 3.2), as they are listed.
enum class CodeLine {
  start,  ///< B(0) = E
  each_iteration,
  restart,  ///< B(n+1) = E
  each_direction,
  sort,
  empty_map,
  each_patch,
  clip,
  if_front,
  gather,  ///< eq. 11 with eq. 14
  leave_hole,
  otherwise,
  put_in,
};
struct CodeText {
  CodeLine line;
  int indent;
  QString words;
};
/// In our words, and with the receiver's reflectance, where the paper prints the source's.
const std::vector<CodeText>& algorithm_code();
/// The global map of section 3.1, which takes the place of the lines from `sort` on.
const std::vector<QString>& global_map_code();

/// The lines that the focus stands on; more than one where a phase does several.
std::vector<CodeLine> current_lines(const Focus& focus);

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

}  // namespace transillum::viewer
