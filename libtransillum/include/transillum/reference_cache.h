// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "transillum/bsp_tree.h"
#include "transillum/cancellation.h"
#include "transillum/radiosity.h"
#include "transillum/scene.h"

namespace transillum {

/// B of long reference runs, kept in a folder from one run of the program to the next. Each file is
/// named by a hash of the scene's geometry and materials, the options that make a difference and
/// the version of the library; it is written whole or not at all, and ends in a hash of its
/// content, so that a damaged one is never believed. Files may be deleted at any time.
///
/// Threads, processes: any number may use one folder at a time.
class ReferenceCache {
 public:
  /// @param folder made when something is stored; empty: nothing is ever found or stored.
  explicit ReferenceCache(std::filesystem::path folder) : folder_(std::move(folder)) {}

  /// $XDG_CACHE_HOME/transillum, or ~/.cache/transillum; empty where neither is known.
  static std::filesystem::path default_folder();

  /// W/m², one a patch; none where there is no file, or one that is damaged.
  std::optional<std::vector<Rgb>> find(const Scene& scene, const SolveOptions& options) const;
  /// @throws std::runtime_error where the file cannot be written.
  void store(const Scene& scene, const SolveOptions& options,
             const std::vector<Rgb>& radiosity) const;
  /// The file that holds it, or would; empty where the folder is.
  std::filesystem::path file_of(const Scene& scene, const SolveOptions& options) const;

 private:
  std::filesystem::path folder_;
};

/// The solution that a study compares its series with.
struct ReferenceSolution {
  std::vector<Rgb> radiosity;  ///< B, W/m², one per patch
  bool from_cache = false;
  std::string
      store_error;  ///< why it could not be stored in the cache; empty if there was no error
};

/// The reference solution for `options` (StudyOptions::reference()): from `cache` if found there,
/// otherwise computed by solve_reference() and stored. A cache that cannot be written is no error
/// (ReferenceSolution::store_error).
/// @param observer called during the solve, on the calling thread
/// @throws InputError, Canceled, std::runtime_error
ReferenceSolution find_or_solve_reference(
    const ReferenceCache& cache, const std::shared_ptr<const Scene>& scene,
    const std::shared_ptr<const BspTree>& tree, const SolveOptions& options,
    const std::function<void(const SolveProgress&)>& observer = {},
    const Cancellation& cancellation = {});

}  // namespace transillum
