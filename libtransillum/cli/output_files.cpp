// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "cli/output_files.h"

#include <exception>

#include "cli/standard_output.h"
#include "transillum/files.h"

namespace transillum::cli {

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
