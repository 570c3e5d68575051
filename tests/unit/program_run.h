// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <string>
#include <vector>

namespace transillum::testing {

/// A folder of its own for one test, gone with it.
class TemporaryFolder {
 public:
  TemporaryFolder();
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }
  std::string operator/(const std::string& name) const { return (path_ / name).string(); }
  /// The names of what is in it, sorted; hidden files too.
  std::vector<std::string> names() const;

 private:
  std::filesystem::path path_;
};

std::string read_file(const std::string& path);
void write_text(const std::string& path, const std::string& text);

/// What a run of the program `transillum` left.
struct ProgramResult {
  int status = -1;  ///< exit status; 128 + signal where one ended it
  std::string out, err;
};

/// A running program `transillum`, its streams kept in files.
class RunningProgram {
 public:
  /// @param out where standard output goes; empty: kept for the result
  explicit RunningProgram(const std::vector<std::string>& arguments, const std::string& out = {});
  void send(int signal) const;
  /// Whether it has got so far as to take a signal as a wish, not as its end.
  bool catches(int signal) const;
  /// Text on stderr so far.
  std::string err_so_far() const;
  ProgramResult wait();

 private:
  TemporaryFolder streams_;
  pid_t process_ = -1;
};

inline ProgramResult run_program(const std::vector<std::string>& arguments,
                                 const std::string& out = {}) {
  return RunningProgram(arguments, out).wait();
}

std::size_t line_count(const std::string& text);

}  // namespace transillum::testing
