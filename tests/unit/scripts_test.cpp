// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
// ./demo and ./check refuse a wrong argument before they build. They run in a separate folder,
// where a build fails at once.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>

#include "support/program_call.h"
#include "transillum/scene.h"

namespace transillum::scripts_test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

namespace fs = std::filesystem;

const fs::path source = fs::path(TRANSILLUM_DATA_DIR).parent_path();

/// The scripts without packages to install and without a project to build.
class Scripts : public ::testing::Test {
 protected:
  void SetUp() override {
    for (const char* name : {"demo", "check", ".setup.sh"}) {
      fs::copy_file(source / name, folder_ / name);
    }
    testing::write_text(folder_ / ".packages", "");
  }
  /// The output of a script that fails; without a display, it fails in any case.
  std::string output(const std::string& call) const {
    const std::string log = folder_ / "log";
    const std::string command =
        "cd '" + folder_.path().string() + "' && timeout 60 ./" + call + " > '" + log + "' 2>&1";
    EXPECT_NE(std::system(command.c_str()), 0)
        << call;  // NOLINT(cert-env33-c,concurrency-mt-unsafe)
    return testing::read_file(log);
  }
  void expect_refused(const std::string& call, const std::string& expected) const {
    const std::string text = output(call);
    EXPECT_THAT(text, HasSubstr(expected)) << call;
    EXPECT_THAT(text, Not(HasSubstr("cmake"))) << call;
  }
  void expect_build(const std::string& call) const {
    EXPECT_THAT(output(call), HasSubstr("command failed: cmake --preset")) << call;
  }
  testing::TemporaryFolder folder_;
};

TEST_F(Scripts, DemoRefusesAnUnknownSceneBeforeTheBuild) {
  expect_refused("demo no-such-scene", "demo: no-such-scene: no such file or built-in scene");
  expect_refused("demo room.obj", "demo: room.obj: no such file");
  testing::write_text(folder_ / "room.txt", "");
  expect_refused("demo room.txt", "demo: room.txt: not a scene file");
}

TEST_F(Scripts, DemoKnowsAllScenes) {
  for (const BuiltInScene& scene : built_in_scenes()) {
    expect_build("demo " + scene.name);
  }
  expect_build("demo rooms:n=5");
  for (const SceneFormat& format : scene_formats()) {
    testing::write_text(folder_ / ("room" + format.ending), "");
    expect_build("demo room" + format.ending);
  }
}

TEST_F(Scripts, CheckRefusesWhatIsNoOptionOfCtestBeforeTheBuild) {
  expect_refused("check --no-such-option", "check: --no-such-option: ctest has no such option");
  expect_refused("check unit", "check: \"unit\" is no option of ctest");
  expect_refused("check -L unit -R", "check: -R: the value is missing");
  for (const char* options : {"", "-L unit", "-R cli -j4", "--output-on-failure --timeout 60",
                              "--repeat until-fail:3 -VV", "--test-dir=x", "-I 1,3"}) {
    expect_build(std::string("check ") + options);
  }
}

}  // namespace
}  // namespace transillum::scripts_test
