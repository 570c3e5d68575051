// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <stdexcept>
#include <string>

#include "transillum/export.h"

namespace TRANSILLUM_API transillum {

/// Invalid input or an invalid argument. `what()` is one sentence for the user that names the place
/// (file, line, face), the value and the valid range. The programs print it and exit with status 2.
class InputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Thrown by a long operation after its Cancellation was set. Carries no message for the user.
class Canceled : public std::exception {
 public:
  /// Always "canceled".
  const char* what() const noexcept override { return "canceled"; }
};

/// The change that the caller can make so that a failed solve succeeds. A front end adds a hint
/// that names its own option or control for it.
enum class Remedy {
  none,                                   ///< no setting is known to help
  directions,                             ///< SolveOptions::directions, larger
  directions_or_row_normalization,        ///< that, or Normalization::rows
  directions_or_symmetric_normalization,  ///< that, or Normalization::symmetric
  memory,                                 ///< a larger limit, such as SolveOptions::memory
};

/// A valid solve, or a valid record of a direction, that fails. `what()` is one sentence for the
/// user, without a hint.
class SolveError : public std::runtime_error {
 public:
  /// @param what one sentence for the user.
  /// @param remedy what would avoid the failure.
  SolveError(const std::string& what, Remedy remedy) : std::runtime_error(what), remedy_(remedy) {}
  /// The change that would avoid the failure.
  Remedy remedy() const noexcept { return remedy_; }

 private:
  Remedy remedy_;
};

/// The iteration does not converge: too few directions for the scene's reflectance.
class NotConvergent : public SolveError {
 public:
  using SolveError::SolveError;
};

/// Form factors that must be kept, or the record of a direction, take more than the limit that was
/// given for them (SolveOptions::memory, HemicubeOptions::memory, record_local_map()).
class MemoryLimitExceeded : public SolveError {
 public:
  /// @param what one sentence for the user.
  explicit MemoryLimitExceeded(const std::string& what) : SolveError(what, Remedy::memory) {}
};

}  // namespace TRANSILLUM_API transillum
