// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Adaptive refinement: patches are divided where the radiosity is represented worst, in a few
// rounds (ALGORITHM.md 6.13).
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "transillum/cancellation.h"
#include "transillum/choice.h"
#include "transillum/export.h"
#include "transillum/scene.h"
#include "transillum/solution.h"

namespace TRANSILLUM_API transillum {

/// The criterion by which patches are divided.
enum class RefineBy {
  jump,   ///< the jump of the radiosity across its edges; costs no solve of its own
  error,  ///< the part of the radiosity that the functions of the patch cannot represent, from a
          ///< solve in which every patch is divided
};
/// Their names (choice.h).
template <>
const Choices& choices_of<RefineBy>();

/// Per patch: root of the mean square, along its edges, of the jump from its radiosity to the
/// radiosity of the patches beyond them, W/m², as the length of an RGB vector. Light alone is
/// compared: beyond an edge, the irradiance of the neighbor times the reflectance of the patch, so
/// that neither paint nor lamps count as jumps. Taken at two points of each edge.
///
/// Neighbors are the patches of the same plane that touch the edge. Where a patch has none of these
/// they are those that touch it at an angle; where it has none of these either, the jump is the
/// reflected radiosity itself, as beside darkness: nothing is known about how it varies.
/// @throws Canceled
std::vector<double> radiosity_jumps(const Solution& solution,
                                    const Cancellation& cancellation = {});
/// The same with other reflectances than the scene's materials have.
/// @param reflectance by patch; with the fraction of its lobe, if lobes take part.
/// @throws Canceled
std::vector<double> radiosity_jumps(const Solution& solution, std::span<const Rgb> reflectance,
                                    const Cancellation& cancellation = {});

/// The options of refine().
struct RefineOptions {
  RefineBy by = RefineBy::jump;  ///< criterion by which patches are divided
  std::int64_t patches = 0;      ///< N > 0: the most patches to make
  double until = 0;              ///< RefinementRound::measure to reach, [0,1); 0: N decides alone
  /// @throws InputError naming the option and its range.
  void validate() const;
};

}  // namespace TRANSILLUM_API transillum
