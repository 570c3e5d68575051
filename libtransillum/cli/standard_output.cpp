// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "cli/standard_output.h"

#include <cerrno>
#include <cstdio>
#include <iostream>
#include <system_error>

#include "cli/processes.h"

namespace transillum::cli {

StandardOutputError::StandardOutputError(int error_number)
    : std::runtime_error(
          "standard output: cannot be written" +
          (error_number ? ": " + std::generic_category().message(error_number) : std::string())),
      no_reader_(error_number == EPIPE) {}

bool is_closed_pipe(const std::exception& error) {
  if (const auto* output = dynamic_cast<const StandardOutputError*>(&error)) {
    return output->no_reader();
  }
  const auto* system = dynamic_cast<const std::system_error*>(&error);
  return system != nullptr && system->code() == std::errc::broken_pipe;
}

void print_results(const std::function<void(std::ostream&)>& write) {
  if (!is_first_process()) {
    return;
  }
  errno = 0;
  write(std::cout);
  if (!std::cout) {
    throw StandardOutputError(errno);
  }
}

void print_results(const std::string& text) {
  print_results([&text](std::ostream& out) { out << text; });
}

void flush_results() {
  print_results([](std::ostream& out) {
    out.flush();
    if (std::fflush(stdout) != 0) {
      out.setstate(std::ios::badbit);
    }
  });
}

}  // namespace transillum::cli
