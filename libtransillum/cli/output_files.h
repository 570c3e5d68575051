// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <functional>
#include <iosfwd>
#include <stdexcept>
#include <string>
#include <vector>

namespace transillum::cli {

/// Whether an output is standard output: its name is `-`.
bool is_standard_output(const std::string& name);

/// The files that have a name and are not standard output.
std::vector<std::string> given_files(std::vector<std::string> files);

/// Checks before a long computation that each file is writable and given once.
/// @throws InputError
void check_output_files(const std::vector<std::string>& files);

/// Writes to a file, or results to standard output where its name is empty or `-`.
void write_output(const std::string& file, const std::function<void(std::ostream&)>& write);

/// Runs all of these, even if some fail, then rethrows the first error: results that took long are
/// not lost because one of several files cannot be written. A pipe without a reader comes last.
void write_all(const std::vector<std::function<void()>>& writers);

/// Standard output cannot be written.
class StandardOutputError : public std::runtime_error {
 public:
  /// @param error_number errno of the failed write; 0 if not known
  explicit StandardOutputError(int error_number);
  /// Whether what reads a pipe, such as `head`, has closed it: that is no failure.
  bool no_reader() const noexcept { return no_reader_; }

 private:
  bool no_reader_;
};

/// Whether an output was a pipe, named as a file or not, that nothing reads any more.
bool is_closed_pipe(const std::exception& error);

/// Writes results to standard output, of several processes in the first only. All results that no
/// file gets go through these functions.
/// @throws StandardOutputError
void print_results(const std::function<void(std::ostream&)>& write);
void print_results(const std::string& text);
/// Writes what is buffered; before that, success is not certain.
/// @throws StandardOutputError
void flush_results();

}  // namespace transillum::cli
