// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <string>
#include <vector>

#include "transillum/solve_options.h"

namespace transillum::viewer {

/// Runs of one scene whose errors are compared.
struct ErrorRuns {
  struct Run {
    std::string label;
    SolveOptions solve;

    friend bool operator==(const Run&, const Run&) = default;
  };
  std::vector<Run> runs;
  int reference = 0;  ///< passes of the reference

  friend bool operator==(const ErrorRuns&, const ErrorRuns&) = default;
};

}  // namespace transillum::viewer
