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
#include "transillum/export.h"
#include "transillum/radiosity.h"
#include "transillum/scene.h"

namespace TRANSILLUM_API transillum {

/// What says that a patch is to be divided.
enum class RefineBy {
  jump,   ///< the jump of the radiosity across its edges; costs no solve of its own
  error,  ///< the part of the radiosity that the functions of the patch cannot represent, from a
          ///< solve in which every patch is divided
};
/// The names of the criteria as in options, in the order of the enumeration.
const std::vector<std::string>& refine_by_names();
/// The criterion called `name`.
/// @throws InputError listing the choices.
RefineBy refine_by_from_name(const std::string& name);
/// The name in refine_by_names().
const std::string& name_of(RefineBy by);

/// Per patch: root of the mean square, along its edges, of the jump of its radiosity to that of the
/// patches beyond them, W/m², as the length of an RGB vector. Light alone is compared: beyond an
/// edge, the irradiance of the neighbor times the reflectance of the patch, so that neither paint
/// nor lamps count as jumps. Taken at two points of each edge.
///
/// Neighbors are the patches of the same plane that touch the edge. Where a patch has none of these
/// they are those that touch it at an angle; where it has none of these either, the jump is the
/// reflected radiosity itself, as beside darkness: nothing is known about how it varies.
/// @throws Canceled
std::vector<double> radiosity_jumps(const Solution& solution,
                                    const Cancellation& cancellation = {});
/// The same with other reflectances than those of the scene's materials.
/// @param reflectance by patch; with the share of its lobe, if lobes take part.
/// @throws Canceled
std::vector<double> radiosity_jumps(const Solution& solution, std::span<const Rgb> reflectance,
                                    const Cancellation& cancellation = {});

/// What refine() does.
struct RefineOptions {
  RefineBy by = RefineBy::jump;  ///< what patches are divided by
  std::int64_t patches = 0;      ///< N > 0: the most patches to make
  double until = 0;              ///< RefinementRound::figure to reach, [0,1); 0: N decides alone
  /// @throws InputError naming the option and its range.
  void validate() const;
};

/// The rounds of a refinement, for a caller that solves step by step; refine() does all of it in
/// one call. Each round: the caller solves scene(), then assess(), then divide_worst(). Not
/// thread-safe.
class RefinementPlan {
 public:
  /// @param scene to start from.
  /// @param options of the solves. Engines that make no passes are refused.
  /// @param refine criterion and limits.
  /// @param cancellation checked while patches are divided.
  /// @throws InputError, Canceled
  RefinementPlan(std::shared_ptr<const Scene> scene, const SolveOptions& options,
                 const RefineOptions& refine, const Cancellation& cancellation = {});

  /// Whether no round is left: scene() is the refined one.
  bool finished() const { return finished_; }
  /// What is to be solved next. By RefineBy::error, in a round, refined() with every patch divided.
  const std::shared_ptr<const Scene>& scene() const { return scene_; }
  /// The scene so far.
  const std::shared_ptr<const Scene>& refined() const { return refined_; }
  /// Criterion and limits.
  const RefineOptions& options() const { return refine_; }
  /// Those that are done, in order.
  const std::vector<RefinementRound>& rounds() const { return rounds_; }

  /// Adds a round, unless finished().
  /// @param solution of scene(), complete.
  /// @param seconds wall time that it took.
  /// @param cancellation checked throughout.
  /// @throws Canceled
  const RefinementRound& assess(const Solution& solution, double seconds,
                                const Cancellation& cancellation = {});
  /// Divides the patches that are worst by the last assess().
  /// @returns whether there is another round
  /// @throws InputError where another does not fit into memory; Canceled
  bool divide_worst(const Cancellation& cancellation = {});

 private:
  void begin_round(const Cancellation& cancellation);
  void finish();

  SolveOptions options_;
  RefineOptions refine_;
  std::shared_ptr<const Scene> refined_, scene_;
  std::vector<PatchId> parent_;  ///< DividedScene::parent of scene_, by RefineBy::error
  std::vector<double> squares_;  ///< per patch of refined_, of the last assess()
  double seconds_ = 0;           ///< of dividing, before the solve
  bool finished_ = false;
  std::vector<RefinementRound> rounds_;
};

/// A refined scene and how it was reached.
struct Refinement {
  std::shared_ptr<const Scene> scene;   ///< to be solved by the caller
  std::vector<RefinementRound> rounds;  ///< in order; by RefineBy::error the last is of `scene`
};

/// Called after each round with what was solved: the scene so far, or by RefineBy::error that scene
/// with every patch divided.
using RoundObserver = std::function<void(const RefinementRound&, const Solution&)>;

/// Refines a scene in rounds: each solves it and divides the patches that are worst, until the
/// number of patches or the figure is reached, or nothing is left to divide. The number of patches
/// at most doubles in a round, so that each decision is made by a solve that can see it.
/// @param scene to start from.
/// @param options of the solves. Engines that make no passes are refused.
/// @param refine criterion and limits.
/// @param rounds called after each round.
/// @param observer of the solves, as for solve().
/// @throws InputError, Canceled; those of solve()
Refinement refine(std::shared_ptr<const Scene> scene, const SolveOptions& options,
                  const RefineOptions& refine, const RoundObserver& rounds = {},
                  const RadiositySolver::Observer& observer = {},
                  const Cancellation& cancellation = {});

}  // namespace TRANSILLUM_API transillum
