// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <filesystem>
#include <memory>
#include <span>
#include <vector>

#include "transillum/scene.h"
#include "transillum/study.h"

namespace transillum {

/// A file with the points of a study so far, from which run_study() can continue. It is replaced as
/// a whole, and goes with the same version of the library, scene, series, values of M, options and
/// reference. Not thread-safe.
class StudyCheckpoint {
 public:
  /// @param file created when something is saved.
  /// @param scene the scene.
  /// @param options of the study.
  /// @param reference options of the reference solve.
  StudyCheckpoint(std::filesystem::path file, const Scene& scene, const StudyOptions& options,
                  const SolveOptions& reference);
  ~StudyCheckpoint();
  StudyCheckpoint(const StudyCheckpoint&) = delete;
  StudyCheckpoint& operator=(const StudyCheckpoint&) = delete;

  /// Saves points.
  /// @param points as in StudyProgress.
  /// @throws std::runtime_error if the file cannot be written; the one before is kept then.
  void save(std::span<const StudyPoint> points) const;
  /// The points in the file, for run_study().
  /// @throws InputError naming the file and why it cannot be used: it is damaged or of another
  /// study
  std::vector<StudyPoint> resume() const;

 private:
  struct Impl;
  std::unique_ptr<const Impl> impl_;
};

}  // namespace transillum
