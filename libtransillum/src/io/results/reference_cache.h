// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "transillum/bsp_tree.h"
#include "transillum/cancellation.h"
#include "transillum/radiosity_solver.h"
#include "transillum/scene.h"
#include "transillum/solve_options.h"

namespace transillum {

/// B of long reference runs, cached as files in a folder. A file's name is a hash of the scene's
/// geometry and materials, of the options that affect the result and of the library's version. It
/// is written completely or not at all and ends in a hash of its content, by which damaged files
/// are detected. Files may be deleted at any time.
///
/// Threads, processes: any number may use one folder at a time.
class ReferenceCache {
 public:
  /// @param folder created when something is stored; empty: nothing is ever found or stored.
  explicit ReferenceCache(std::filesystem::path folder) : folder_(std::move(folder)) {}

  /// $XDG_CACHE_HOME/transillum, or ~/.cache/transillum; empty if neither is defined.
  static std::filesystem::path default_folder();

  /// B, W/m², one per patch; nothing if there is no file or it is damaged.
  std::optional<std::vector<Rgb>> find(const Scene& scene, const SolveOptions& options) const;
  /// Stores B.
  /// @throws std::runtime_error if the file cannot be written.
  void store(const Scene& scene, const SolveOptions& options,
             const std::vector<Rgb>& radiosity) const;
  /// The file for a scene and options, whether it exists or not; empty if the folder is.
  std::filesystem::path file_of(const Scene& scene, const SolveOptions& options) const;

 private:
  std::filesystem::path folder_;
};

/// The solution that a study compares its series with.
struct ReferenceSolution {
  std::vector<Rgb> radiosity;  ///< B, W/m², one per patch
  bool from_cache = false;     ///< false: it was solved
  std::string store_error;  ///< why it could not be stored in the cache; empty if no error occurred
};

/// The reference solution of a study: from `cache` if found there, otherwise computed by
/// solve_reference() and stored. A cache that cannot be written is no error
/// (ReferenceSolution::store_error).
/// @param cache where it is looked up and stored.
/// @param scene the scene.
/// @param tree BSP tree of `scene`.
/// @param options StudyOptions::reference().
/// @param observer if set, called after every pass, on the calling thread.
/// @param cancellation checked during the solve.
/// @throws InputError, Canceled, std::runtime_error
ReferenceSolution find_or_solve_reference(
    const ReferenceCache& cache, const std::shared_ptr<const Scene>& scene,
    const std::shared_ptr<const BspTree>& tree, const SolveOptions& options,
    const std::function<void(const SolveProgress&)>& observer = {},
    const Cancellation& cancellation = {});

}  // namespace transillum
