// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "support/program_call.h"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <sstream>
#include <stdexcept>

#include "support/wait_until.h"

namespace transillum::testing {

namespace {

/// Makes a process start with stream `number` going to `target`.
void redirect(posix_spawn_file_actions_t& actions, int number, const std::string& target) {
  if (target == closed_stream) {
    posix_spawn_file_actions_addclose(&actions, number);
  } else if (target == pipe_without_reader) {
    int ends[2];
    if (::pipe2(ends, O_CLOEXEC) != 0) {
      throw std::runtime_error("no pipe");
    }
    posix_spawn_file_actions_adddup2(&actions, ends[1], number);
    ::close(ends[0]);
  } else {
    posix_spawn_file_actions_addopen(&actions, number, target.c_str(),
                                     O_WRONLY | O_CREAT | O_APPEND, 0600);
  }
}

}  // namespace

RunningProgram::RunningProgram(const Arguments& arguments, const std::string& out,
                               const std::string& err, const std::string& folder,
                               const std::string& shell) {
  std::vector<std::string> starter;
  if (!shell.empty()) {
    starter = {"/bin/sh", "-c", shell + "; exec \"$0\" \"$@\""};
  }
  starter.emplace_back(TRANSILLUM_PROGRAM);
  std::vector<char*> argv;
  for (std::string& word : starter) {
    argv.push_back(word.data());
  }
  for (const std::string& argument : arguments) {
    argv.push_back(const_cast<char*>(argument.c_str()));
  }
  argv.push_back(nullptr);
  posix_spawn_file_actions_t streams;
  posix_spawn_file_actions_init(&streams);
  posix_spawn_file_actions_addopen(&streams, 0, "/dev/null", O_RDONLY, 0);
  redirect(streams, 1, out.empty() ? streams_ / "out" : out);
  redirect(streams, 2, err.empty() ? streams_ / "err" : err);
  if (!folder.empty()) {
    posix_spawn_file_actions_addchdir_np(&streams, folder.c_str());
  }
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

bool RunningProgram::ended() const {
  siginfo_t change{};
  // The process stays, for wait().
  return ::waitid(P_PID, static_cast<id_t>(process_), &change, WEXITED | WNOHANG | WNOWAIT) != 0 ||
         change.si_pid == process_;
}

bool RunningProgram::reports(const std::string& text) const {
  bool reported = false;
  const bool known = wait_until([&] {
    const bool last = ended();  // before its text is read
    reported = err_so_far().find(text) != std::string::npos;
    return reported || last;
  });
  return known && reported;
}

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

ProgramResult expect_success(const Arguments& arguments, const std::string& folder) {
  ProgramResult result = run_program(arguments, {}, {}, folder);
  EXPECT_EQ(result.status, 0) << ::testing::PrintToString(arguments) << result.err;
  return result;
}

void expect_refused(const Arguments& arguments, const std::string& expected,
                    const std::string& folder) {
  SCOPED_TRACE(::testing::PrintToString(arguments));
  ASSERT_NE(expected, "") << "any message would do";
  const ProgramResult result = run_program(arguments, {}, {}, folder);
  EXPECT_EQ(result.status, 2);
  EXPECT_EQ(result.out, "");
  EXPECT_EQ(line_count(result.err), 1U) << result.err;
  EXPECT_THAT(result.err, ::testing::StartsWith("transillum: "));
  EXPECT_THAT(result.err, ::testing::HasSubstr(expected));
}

void expect_all_refused(const Arguments& call, const std::vector<Refusal>& refusals) {
  for (const auto& [options, expected] : refusals) {
    expect_refused(call + options, expected);
  }
}

nlohmann::json read_json(const std::string& path) { return nlohmann::json::parse(read_file(path)); }

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) {
    lines.push_back(line);
  }
  return lines;
}

std::size_t line_count(const std::string& text) {
  return static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
}

}  // namespace transillum::testing
