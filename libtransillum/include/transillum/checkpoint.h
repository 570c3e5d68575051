// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// A solve that can be resumed after it was stopped, killed or interrupted by a power cut
// (decisions/0061-checkpoints.md).
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>

#include "transillum/cancellation.h"
#include "transillum/export.h"
#include "transillum/scene.h"
#include "transillum/solve_options.h"
#include "transillum/solve_session.h"

namespace TRANSILLUM_API transillum {

/// A file with the state of a solve. It is replaced as a whole, so that there is always a complete
/// one, and ends in a checksum; it goes with the same version of the library, scene and options
/// (memory and threads may differ). Not thread-safe.
class Checkpoint {
 public:
  /// @param file created when something is saved.
  /// @param scene, options of the solve.
  /// @param total whether it is a solve to a total error (RunOptions::total): the first stage has
  /// `scene`, and `options` have the total as accuracy; each session is a stage.
  Checkpoint(std::filesystem::path file, const Scene& scene, const SolveOptions& options,
             bool total = false);
  ~Checkpoint();
  /// The moved-from object may only be destroyed or assigned to.
  Checkpoint(Checkpoint&&) noexcept;
  /// The moved-from object may only be destroyed or assigned to.
  Checkpoint& operator=(Checkpoint&&) noexcept;

  /// The file.
  const std::filesystem::path& file() const;

  /// Saves a solve.
  /// @param session prepared, without lobes; an observer may call this. Where several processes
  /// solve, all must call it after the same pass; the first writes the file.
  /// @throws std::runtime_error if the file cannot be written; the one before is kept then.
  void save(const SolveSession& session);
  /// Saves a solve if `interval` has passed since this object was made or last saved, and enough
  /// time that saving takes less than a hundredth of it.
  /// @param session as for save().
  /// @param interval s; 0 saves at every call.
  /// @returns whether it was saved.
  /// @throws std::runtime_error as save()
  bool save_if_due(const SolveSession& session, double interval = 60);

  /// Whether save_if_due() would save.
  /// @param interval s
  bool is_due(double interval) const;

  /// Sets a session to the solve in the file, which it then continues to the same bits.
  /// @param session of the scene and options; has made no pass. Where several processes solve,
  /// all must call this; their number may differ from when the file was saved.
  /// @throws InputError naming the file and why it cannot be used: it is damaged, or which version,
  /// option or property of the scene is another; the session then begins at its beginning.
  /// Canceled; as SolveSession::prepare()
  void resume(SolveSession& session);

  /// Sets what is saved with each stage of a solve to a total error: the state of its plan.
  void set_total_plan(std::string state);
  /// The state of the plan in the file, which resume() makes a stage of.
  /// @throws InputError, Canceled as resume()
  std::string total_plan(const Cancellation& cancellation = {}) const;

  /// Compares the file with the scene and options, without its content, before work is done that
  /// takes long.
  /// @throws InputError as resume()
  void check() const;

  /// Cost of the saves so far.
  struct Cost {
    int times = 0;            ///< the file was saved
    double seconds = 0;       ///< wall time, all together
    std::uint64_t bytes = 0;  ///< size of the last
  };
  const Cost& cost() const;  ///< cost of this object's saves

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace TRANSILLUM_API transillum
