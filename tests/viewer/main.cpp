// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// `transillum_viewer_tests NAME [OPTIONS OF QTEST]` runs tests/viewer/NAME_test.cpp, beside the
// window manager whose path is in TRANSILLUM_WINDOW_MANAGER, if it is set.
#include <cstdio>
#include <map>
#include <optional>
#include <string>

#include "registered.h"
#include "window_manager.h"

namespace transillum::viewer::test {

namespace {

// A function, since the files register their tests before main() in any order.
std::map<std::string, TestMain>& tests() {
  static std::map<std::string, TestMain> by_name;
  return by_name;
}

}  // namespace

Registered::Registered(const char* name, TestMain run) { tests().emplace(name, run); }

}  // namespace transillum::viewer::test

int main(int argc, char** argv) {
  const auto& tests = transillum::viewer::test::tests();
  const auto found = argc > 1 ? tests.find(argv[1]) : tests.end();
  if (found == tests.end()) {
    std::fprintf(stderr, "%s: expected the name of a test, one of:\n", argv[0]);
    for (const auto& test : tests) {
      std::fprintf(stderr, "  %s\n", test.first.c_str());
    }
    return 2;
  }
  std::optional<transillum::viewer::test::WindowManager> manager;
  if (const QString program = qEnvironmentVariable("TRANSILLUM_WINDOW_MANAGER");
      !program.isEmpty()) {
    manager.emplace(program);
    if (!manager->runs()) {
      std::fprintf(stderr, "%s: %s does not start\n", argv[0], qPrintable(program));
      return 2;
    }
  }
  argv[1] = argv[0];  // the test's options follow
  return found->second(argc - 1, argv + 1);
}
