// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <functional>
#include <iosfwd>
#include <optional>
#include <string>

#include "model/run_options.h"
#include "transillum/scene.h"
#include "transillum/solution.h"
#include "transillum/solve_options.h"

namespace CLI {
class App;
}

namespace transillum::viewer {

/// The parsed arguments.
struct CommandLine {
  std::string scene;           ///< file or built-in; empty if none is given
  RunOptions options;          ///< options of the run
  bool reading_given = false;  ///< whether the options say how the scene is read
  bool first_look = true;      ///< nothing says how faces become patches (first_look.h)
  std::optional<Vec3> up;      ///< the vertical, if it is given
  std::string lesson;          ///< number of a built-in lesson, or a file; empty if none is given
  int page = 1;                ///< page of the lesson, from 1
  std::string screenshot;      ///< path of a PNG; empty if none is given
  int after = 0;               ///< directions before the screenshot; 0 for a converged solve
  std::string lesson_file;     ///< path of an HTML file for the lesson; empty if none is given
};

/// Either a command line to run, or the status to exit with at once.
struct ParsedCommandLine {
  CommandLine command_line;
  bool exit_now = false;
  int exit_status = 0;
};

/// Writes help to `out`, and an error in the arguments as one line to `error` (status 2).
ParsedCommandLine parse_command_line(int argc, const char* const* argv, std::ostream& out,
                                     std::ostream& error);

/// Passes the definitions of the options on, for the manual page and completions.
void with_definitions(const std::function<void(const CLI::App&)>& use);

}  // namespace transillum::viewer
