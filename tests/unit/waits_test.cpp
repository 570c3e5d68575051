// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Tests and programs wait for conditions, not for times: a fixed pause is too short on a busy
// machine and too long on any other. Two helpers sleep between two checks of a condition; no other
// file of the repository calls a function that sleeps.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

namespace transillum::waits_test {
namespace {

namespace fs = std::filesystem;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

const fs::path repository = fs::path(TRANSILLUM_DATA_DIR).parent_path();

/// The helpers, which take a condition.
const std::set<std::string> helpers{"tests/support/wait_until.h",
                                    "libtransillum/mpi/mpi_waiting.h"};
const std::string this_file = "tests/unit/waits_test.cpp";

/// The lines that call a function that sleeps, with their numbers from 1. QtTest's input functions
/// sleep where their last argument is a number of milliseconds.
std::vector<std::string> pauses_in(const std::string& text) {
  static const std::regex sleeps(
      R"(\b(qWait|qSleep|msleep|usleep|nanosleep|sleep_for|sleep_until|sleep)\s*\()");
  static const std::regex input(R"(QTest::(key|mouse)\w+\()");
  static const std::regex delay(R"(,\s*\d+\)$)");
  std::vector<std::string> found;
  std::istringstream lines(text);
  std::string line, statement;
  for (int number = 1; std::getline(lines, line); ++number) {
    const auto has = [&line](const char* word) { return line.find(word) != std::string::npos; };
    bool pauses = (has("leep") || has("Wait")) && std::regex_search(line, sleeps);
    // An input function's call may have several lines.
    if (!statement.empty() || (has("QTest::") && std::regex_search(line, input))) {
      statement += line;
      if (const std::size_t end = statement.find(';'); end != std::string::npos) {
        pauses = pauses || std::regex_search(statement.substr(0, end), delay);
        statement.clear();
      }
    }
    if (pauses) {
      found.push_back(std::to_string(number) + ": " + line.substr(line.find_first_not_of(' ')));
    }
  }
  return found;
}

std::vector<fs::path> sources_below(const fs::path& root) {
  std::vector<fs::path> files;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(root)) {
    if (entry.path().extension() == ".h" || entry.path().extension() == ".cpp") {
      files.push_back(entry.path());
    }
  }
  std::sort(files.begin(), files.end());
  return files;
}

TEST(Waits, AreForConditions) {
  std::vector<std::string> found;
  std::set<std::string> pausing_helpers;
  for (const char* folder : {"libtransillum", "viewer", "tests"}) {
    for (const fs::path& file : sources_below(repository / folder)) {
      std::ostringstream text;
      text << std::ifstream(file).rdbuf();
      const std::string name = file.lexically_relative(repository).generic_string();
      if (name == this_file) {
        continue;
      }
      for (const std::string& pause : pauses_in(text.str())) {
        if (helpers.contains(name)) {
          pausing_helpers.insert(name);
        } else {
          found.push_back(fmt::format("{}:{}", name, pause));
        }
      }
    }
  }
  EXPECT_THAT(found, IsEmpty());
  EXPECT_EQ(pausing_helpers, helpers) << "a helper no longer sleeps: take it off the list";
}

TEST(Waits, ForATimeAreFound) {
  EXPECT_THAT(
      pauses_in("int main() {\n"
                "  QTest::qWait(50);\n"
                "  QThread::msleep(400);\n"
                "  std::this_thread::sleep_for(1ms);\n"
                "  QTest::qWaitFor([] { return true; });\n"
                "  usleep(pause);\n"
                "  ::sleep(1);\n"
                "}\n"),
      ElementsAre("2: QTest::qWait(50);", "3: QThread::msleep(400);",
                  "4: std::this_thread::sleep_for(1ms);", "6: usleep(pause);", "7: ::sleep(1);"));
}

TEST(Waits, BetweenInputsAreFound) {
  EXPECT_THAT(pauses_in("QTest::mouseMove(canvas, place + QPoint(1, 0));\n"
                        "QTest::keyClick(window, Qt::Key_A);\n"),
              IsEmpty());
  EXPECT_THAT(
      pauses_in("QTest::mouseMove(canvas, place + QPoint(1, 0), "
                "10);\nQTest::mouseClick(canvas, Qt::LeftButton, {},\n  place, 20);\n"),
      ElementsAre("1: QTest::mouseMove(canvas, place + QPoint(1, 0), 10);", "3: place, 20);"));
}

}  // namespace
}  // namespace transillum::waits_test
