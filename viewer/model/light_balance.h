// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// The equation B_i = E_i + rho_i sum_j F_ij B_j of one patch with its numbers.
#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include "model/snapshot.h"
#include "radiosity/form_factors/receiver_row.h"

namespace transillum::viewer {

/// Why B of a patch is what it is. B is the sum of all members of type Rgb from `exitance` on and
/// of the contributions of `terms`. Powers per area in W/m².
struct LightBalance {
  /// Reflected light of one source: a group, or else a face.
  struct Term {
    std::vector<PatchId> patches;  ///< patches of the source that the receiver sees, ascending
    PatchId largest = no_patch;    ///< the one that contributes most
    double form_factor = 0;        ///< sum of F_ij
    Rgb radiosity;                 ///< mean of B_j, weighted by F_ij
    Rgb contribution;              ///< rho_i times the sum of F_ij B_j
  };
  PatchId receiver = no_patch;
  Rgb radiosity;            ///< B_i
  Rgb reflectance;          ///< rho_i
  Rgb exitance;             ///< E_i
  std::vector<Term> terms;  ///< the largest, by luminance; the largest first
  Rgb others;               ///< contribution of all other sources
  std::size_t other_count = 0;
  Rgb shot;  ///< reflected light of the first shot, which `terms` omit
  Rgb sky;   ///< reflected light of the sky, without the sun
  Rgb sun;   ///< reflected light of the sun
  /// The rest: the change by the last iteration, and reflection by lobes.
  Rgb remainder;
};
/// The group or face whose patches are summed as one source.
std::pair<int, int> source_of(const Patch& patch);
/// @param row of the receiver, of the directions of the snapshot
/// @param most length of `terms`
LightBalance light_balance(const SolverSnapshot& snapshot, PatchId receiver, const ReceiverRow& row,
                           std::size_t most = 10);

}  // namespace transillum::viewer
