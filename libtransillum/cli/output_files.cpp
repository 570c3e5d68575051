// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "cli/output_files.h"

#include <cerrno>
#include <cstdio>
#include <exception>
#include <iostream>
#include <system_error>

#include "cli/processes.h"
#include "transillum/files.h"

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

bool is_standard_output(const std::string& name) { return name == "-"; }

std::vector<std::string> given_files(std::vector<std::string> files) {
  std::erase_if(files,
                [](const std::string& file) { return file.empty() || is_standard_output(file); });
  return files;
}

void check_output_files(const std::vector<std::string>& files) {
  for (const std::string& file : files) {
    check_writable(file);
  }
  check_distinct(files, {});
}

void write_output(const std::string& file, const std::function<void(std::ostream&)>& write) {
  if (file.empty() || is_standard_output(file)) {
    print_results(write);
  } else {
    write_file_whole(file, write);
  }
}

namespace {

void keep_first(std::exception_ptr& kept) {
  if (!kept) {
    kept = std::current_exception();
  }
}

}  // namespace

void write_all(const std::vector<std::function<void()>>& writers) {
  std::exception_ptr first_failure, closed_pipe;
  for (const auto& write : writers) {
    try {
      write();
    } catch (const std::exception& error) {
      keep_first(is_closed_pipe(error) ? closed_pipe : first_failure);
    }
  }
  if (first_failure || closed_pipe) {
    std::rethrow_exception(first_failure ? first_failure : closed_pipe);
  }
}

}  // namespace transillum::cli
