// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <sys/types.h>

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <utility>
#include <vector>

#include "support/temporary_folder.h"

namespace transillum::testing {

/// Arguments of the program, without its name.
using Arguments = std::vector<std::string>;
inline Arguments operator+(Arguments a, const Arguments& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

/// The result of a run of the program `transillum`.
struct ProgramResult {
  int status = -1;  ///< exit status; 128 + signal number if a signal ended it
  std::string out, err;
};

/// Where a stream of the program goes, besides files.
inline const std::string closed_stream = "(closed)";
inline const std::string pipe_without_reader = "(pipe without a reader)";

/// A process of the program `transillum`; its output is stored in files.
class RunningProgram {
 public:
  /// @param out file to which standard output is appended, or one of the above; ProgramResult::out
  /// if it is empty
  /// @param err the same for standard error and ProgramResult::err
  /// @param folder where the program runs; the current folder if it is empty
  /// @param shell commands of the shell that starts it, such as `ulimit -v 200000`; without
  /// commands, no shell runs
  explicit RunningProgram(const Arguments& arguments, const std::string& out = {},
                          const std::string& err = {}, const std::string& folder = {},
                          const std::string& shell = {});
  void send(int signal) const;
  pid_t pid() const { return process_; }
  /// Whether the process has installed a handler for the signal.
  bool catches(int signal) const;
  /// The text on stderr so far.
  std::string err_so_far() const;
  /// Whether the program has ended; wait() then returns at once.
  bool ended() const;
  /// Waits until stderr has `text`. @returns false if the program has ended without it, or two
  /// minutes have passed
  [[nodiscard]] bool reports(const std::string& text) const;
  ProgramResult wait();

 private:
  TemporaryFolder streams_;
  pid_t process_ = -1;
};

inline ProgramResult run_program(const Arguments& arguments, const std::string& out = {},
                                 const std::string& err = {}, const std::string& folder = {}) {
  return RunningProgram(arguments, out, err, folder).wait();
}

/// Runs the program, which must exit with status 0.
ProgramResult expect_success(const Arguments& arguments, const std::string& folder = {});

/// Exit status 2, nothing on stdout, and one line on stderr that contains `expected`.
void expect_refused(const Arguments& arguments, const std::string& expected,
                    const std::string& folder = {});

/// Arguments, and a part of the message that refuses them.
using Refusal = std::pair<Arguments, std::string>;
/// expect_refused() with each of `refusals` after `call`.
void expect_all_refused(const Arguments& call, const std::vector<Refusal>& refusals);

nlohmann::json read_json(const std::string& path);

/// The lines of a text, without their ends.
std::vector<std::string> lines_of(const std::string& text);
std::size_t line_count(const std::string& text);

}  // namespace transillum::testing
