// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <functional>
#include <iosfwd>
#include <stdexcept>
#include <string>

namespace transillum::cli {

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
