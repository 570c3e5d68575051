// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "program_run.h"

#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <sstream>
#include <stdexcept>

namespace transillum::testing {

namespace fs = std::filesystem;

TemporaryFolder::TemporaryFolder() {
  std::string name = (fs::temp_directory_path() / "transillum-test-XXXXXX").string();
  if (::mkdtemp(name.data()) == nullptr) {
    throw std::runtime_error("no temporary folder");
  }
  path_ = name;
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
}

std::vector<std::string> TemporaryFolder::names() const {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(path_)) {
    names.push_back(entry.path().filename().string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

std::string read_file(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

void write_text(const std::string& path, const std::string& text) {
  std::ofstream(path, std::ios::binary) << text;
}

RunningProgram::RunningProgram(const std::vector<std::string>& arguments, const std::string& out) {
  std::vector<char*> argv{const_cast<char*>(TRANSILLUM_PROGRAM)};
  for (const std::string& argument : arguments) {
    argv.push_back(const_cast<char*>(argument.c_str()));
  }
  argv.push_back(nullptr);
  const std::string out_file = out.empty() ? streams_ / "out" : out;
  const std::string err_file = streams_ / "err";
  constexpr int writing = O_WRONLY | O_CREAT | O_TRUNC;
  posix_spawn_file_actions_t streams;
  posix_spawn_file_actions_init(&streams);
  posix_spawn_file_actions_addopen(&streams, 0, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_addopen(&streams, 1, out_file.c_str(), writing, 0600);
  posix_spawn_file_actions_addopen(&streams, 2, err_file.c_str(), writing, 0600);
  const int error = ::posix_spawn(&process_, argv[0], &streams, nullptr, argv.data(), environ);
  posix_spawn_file_actions_destroy(&streams);
  if (error != 0) {
    throw std::runtime_error("transillum does not start");
  }
}

void RunningProgram::send(int signal) const { ::kill(process_, signal); }

bool RunningProgram::catches(int signal) const {
  const std::string status = read_file("/proc/" + std::to_string(process_) + "/status");
  const std::string key = "SigCgt:";
  const std::size_t at = status.find(key);
  if (at == std::string::npos) {
    return false;
  }
  return std::stoull(status.substr(at + key.size()), nullptr, 16) >> (signal - 1) & 1;
}

std::string RunningProgram::err_so_far() const { return read_file(streams_ / "err"); }

ProgramResult RunningProgram::wait() {
  int status = 0;
  if (::waitpid(process_, &status, 0) != process_) {
    throw std::runtime_error("no such process");
  }
  ProgramResult result;
  result.status = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  result.out = read_file(streams_ / "out");
  result.err = err_so_far();
  return result;
}

std::size_t line_count(const std::string& text) {
  return static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
}

}  // namespace transillum::testing
