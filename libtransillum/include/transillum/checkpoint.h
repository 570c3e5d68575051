// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// A solve that can go on where it was stopped, killed or interrupted by a power cut
// (decisions/0061-checkpoints.md).
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "transillum/accuracy_plan.h"
#include "transillum/bsp_tree.h"
#include "transillum/cancellation.h"
#include "transillum/export.h"
#include "transillum/first_shot.h"
#include "transillum/radiosity.h"
#include "transillum/scene.h"

namespace TRANSILLUM_API transillum {

/// A file with the state of a solve. It is replaced as a whole, so that there is always a complete
/// one, and ends in a checksum; it goes with the same version of the library, scene and options
/// (memory and threads may differ). Not thread-safe.
class Checkpoint {
 public:
  /// @param file created when something is saved.
  /// @param scene, options of the solve.
  Checkpoint(std::filesystem::path file, const Scene& scene, const SolveOptions& options);
  ~Checkpoint();
  /// The moved-from object may only be destroyed or assigned to.
  Checkpoint(Checkpoint&&) noexcept;
  /// The moved-from object may only be destroyed or assigned to.
  Checkpoint& operator=(Checkpoint&&) noexcept;

  /// The file.
  const std::filesystem::path& file() const;

  /// Saves a solve.
  /// @param solver the solver; an observer may call this.
  /// @param plan of a solve with a goal, else null. In a group all members must call it after the
  /// same pass; member 0 writes the file.
  /// @throws std::runtime_error if the file cannot be written; the one before is kept then.
  void save(const RadiositySolver& solver, const AccuracyPlan* plan = nullptr);
  /// Saves a solve if `interval` has passed since this object was made or last saved, and so long
  /// that saving takes less than a hundredth of the time.
  /// @param solver, plan as for save().
  /// @param interval s; 0: always.
  /// @returns whether it was saved.
  /// @throws std::runtime_error as save()
  bool save_if_due(const RadiositySolver& solver, const AccuracyPlan* plan = nullptr,
                   double interval = 60);

  /// Whether save_if_due() would save.
  /// @param interval s
  bool is_due(double interval) const;

  /// A solve that goes on.
  struct Resumed {
    RadiositySolver solver;            ///< in the state saved
    std::optional<AccuracyPlan> plan;  ///< of a solve with a goal
    double seconds = 0;                ///< wall time that it had taken
  };
  /// The solve in the file.
  /// @param scene the scene.
  /// @param options of the solve.
  /// @param tree, shot, cancellation, group as for RadiositySolver. The number of members may be
  /// another than the one that has saved the file.
  /// @throws InputError naming the file and why it cannot be used: it is damaged, or which version,
  /// option or property of the scene is another; Canceled
  Resumed resume(const std::shared_ptr<const Scene>& scene, const SolveOptions& options,
                 std::shared_ptr<const BspTree> tree = nullptr,
                 std::shared_ptr<const DirectLight> shot = nullptr,
                 const Cancellation& cancellation = {},
                 const std::shared_ptr<SolverGroup>& group = nullptr);

  /// Compares the file with the scene and options, without its content, before work is done that
  /// takes long.
  /// @throws InputError as resume()
  void check() const;

  /// What saving has cost so far.
  struct Cost {
    int times = 0;            ///< the file was saved
    double seconds = 0;       ///< wall time, all together
    std::uint64_t bytes = 0;  ///< size of the last
  };
  const Cost& cost() const;  ///< of this object

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace TRANSILLUM_API transillum
