// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
// `transillum picture`: scenes and results, cameras of files, files and what is refused.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "gltf_test_file.h"
#include "support/program_call.h"
#include "transillum/picture.h"

namespace transillum::testing::cli_picture_test {
namespace {

using ::testing::ContainsRegex;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

/// A camera in the Cornell box, and few pixels.
const Arguments view{"--eye", "0.278,0.27,-0.8", "--target", "0.278,0.27,0.3", "--size", "48x32"};
/// Whole faces: few patches.
const Arguments method{"-m", "64", "-q", "--max-patch-area", "1"};

Arguments picture_of(const std::string& scene) { return Arguments{"picture", scene} + view; }

/// "48 32", the numbers of pixels in the header of a PFM file.
std::string size_in(const std::string& pfm) { return lines_of(pfm).at(1); }

/// A scene whose pictures take little time: a lamp above a floor.
std::string lamp_and_floor(const TemporaryFolder& folder) {
  folder.write("two.mtl", "newmtl floor\nKd .5 .4 .3\nnewmtl lamp\nKd 0 0 0\nKe 1 1 1\n");
  return folder.write("two.obj",
                      "mtllib two.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\n"
                      "v 1 1 1\nv 0 1 1\nusemtl floor\nf 1 2 3 4\nusemtl lamp\nf 8 7 6 5\n");
}

TEST(CliPicture, IsTheSameOfASceneAndOfItsResult) {
  const TemporaryFolder folder;
  const Arguments up{"--camera-up", "0,1,0"};
  expect_success(picture_of("cornell-box") + method + up +
                 Arguments{"-o", folder / "scene.pfm", "-o", folder / "scene.png"});
  expect_success(Arguments{"solve", "cornell-box"} + method + Arguments{"--out", folder / "r.vtp"});
  expect_success(picture_of(folder / "r.vtp") + up +
                 Arguments{"-q", "-o", folder / "result.pfm", "-o", folder / "result.png"});
  EXPECT_EQ(read_file(folder / "scene.pfm"), read_file(folder / "result.pfm"));
  EXPECT_EQ(read_file(folder / "scene.png"), read_file(folder / "result.png"));
}

TEST(CliPicture, IsWhatSolveWrites) {
  const TemporaryFolder folder;
  const std::string scene = lamp_and_floor(folder);
  const Arguments eye{"--eye", "0.5,-2,0.7"};
  expect_success(Arguments{"solve", scene, "--up", "0,1,1"} + method + eye +
                 Arguments{"--out", folder / "solve.png", "--out", folder / "solve.exr"});
  expect_success(Arguments{"picture", scene, "--camera-up", "0,1,1"} + method + eye +
                 Arguments{"--out", folder / "picture.png", "--out", folder / "picture.exr"});
  EXPECT_EQ(read_file(folder / "solve.png"), read_file(folder / "picture.png"));
  EXPECT_EQ(read_file(folder / "solve.exr"), read_file(folder / "picture.exr"));
}

TEST(CliPicture, DoesNotDependOnTheNumberOfThreads) {
  const TemporaryFolder folder;
  for (const std::string threads : {"1", "2"}) {
    expect_success(picture_of("cornell-box") + method +
                   Arguments{"--threads", threads, "--samples", "2", "--gather", "8", "-o",
                             folder / (threads + ".pfm")});
  }
  EXPECT_EQ(read_file(folder / "1.pfm"), read_file(folder / "2.pfm"));
}

TEST(CliPicture, SaysWhatItWrote) {
  const TemporaryFolder folder;
  const Arguments call{"picture", "furnace", "--eye",      "0.2,0.3,0.4", "-m", "16",
                       "--size",  "32x16",   "--panorama", "--samples",   "3",  "--out"};
  const ProgramResult result = expect_success(call + Arguments{folder / "p.png"});
  EXPECT_THAT(result.err,
              ContainsRegex("p.png: 32 x 16 pixels, 3 samples each, in .* s; exposure 0\\.[0-9]+"));
  EXPECT_EQ(result.out, "");
  EXPECT_EQ(expect_success(call + Arguments{folder / "q.pfm", "-q"}).err, "");
  EXPECT_EQ(size_in(read_file(folder / "q.pfm")), "32 16");
}

TEST(CliPicture, OptionsOfColorsChangePngFiles) {
  const TemporaryFolder folder;
  expect_success(Arguments{"solve", lamp_and_floor(folder), "-o", folder / "r.vtp"} + method);
  const Arguments call{"picture", folder / "r.vtp", "-q", "--eye", "0.5,-2,0.7", "--size", "48x32"};
  std::vector<std::string> files;
  for (const Arguments& options :
       {Arguments{}, Arguments{"--exposure", "auto"}, Arguments{"--exposure", "0.01"},
        Arguments{"--tone", "aces"}, Arguments{"--tone", "filmic"}, Arguments{"--false-color"},
        Arguments{"--false-color", "--lux"}, Arguments{"--orthographic"},
        Arguments{"--orthographic", "--height", "0.3"}, Arguments{"--fov", "20"}}) {
    expect_success(call + options + Arguments{"-o", folder / "p.png"});
    files.push_back(read_file(folder / "p.png"));
  }
  EXPECT_EQ(files[0], files[1]);
  for (std::size_t k = 1; k < files.size(); ++k) {
    for (std::size_t other = k + 1; other < files.size(); ++other) {
      EXPECT_NE(files[k], files[other]) << k << ' ' << other;
    }
  }
}

TEST(CliPicture, FiguresHaveTheSizeInPixelsOrCentimeters) {
  const TemporaryFolder folder;
  const Arguments call{"picture", lamp_and_floor(folder), "-q", "--eye", "0.5,-2,0.7"};
  expect_success(call + method +
                 Arguments{"--size", "80x60", "-o", folder / "p.svg", "-o", folder / "p.png"});
  EXPECT_THAT(read_file(folder / "p.svg"), HasSubstr("width=\"80\" height=\"60\" preserve"));
  expect_success(call + method +
                 Arguments{"--size", "5.08x2.54cm", "--false-color", "-o", folder / "c.svg", "-o",
                           folder / "c.pdf", "-o", folder / "c.pfm"});
  EXPECT_EQ(size_in(read_file(folder / "c.pfm")), "600 300");
  const std::string svg = read_file(folder / "c.svg"), pdf = read_file(folder / "c.pdf");
  EXPECT_THAT(svg, HasSubstr("width=\"192\" height=\"96\" preserve"));
  EXPECT_THAT(svg, HasSubstr("two.obj</title>"));
  EXPECT_THAT(svg, HasSubstr(">radiosity B, W/m\u00b2</text>"));
  EXPECT_THAT(pdf, HasSubstr("/Width 600"));
  EXPECT_THAT(pdf, HasSubstr("/ToUnicode"));
}

/// A room of one wall that emits, and cameras.
class CliPictureCameras : public ::testing::Test {
 protected:
  CliPictureCameras() {
    file_.root["materials"] = {{{"emissiveFactor", {1, 1, 1}}}};
    file_.add(test::square_in(file_, 0));
    file_.root["cameras"] = {
        {{"type", "perspective"}, {"perspective", {{"yfov", 1.0}, {"znear", 0.1}}}}};
    add_camera("door", {0.5, 0.5, 2});
  }
  void add_camera(const std::string& name, const std::vector<double>& eye) {
    file_.root["nodes"].push_back({{"name", name}, {"camera", 0}, {"translation", eye}});
    file_.root["scenes"][0]["nodes"].push_back(file_.root["nodes"].size() - 1);
    folder_.write("scene.glb", file_.glb());
  }
  Arguments call(const std::string& out) const {
    return {"picture", folder_ / "scene.glb", "-m", "8", "-q", "--size", "24x16",
            "--out",   folder_ / out};
  }

  test::GltfText file_;
  TemporaryFolder folder_;
};

TEST_F(CliPictureCameras, AreTakenByName) {
  expect_success(call("one.pfm"));
  expect_success(call("named.pfm") + Arguments{"--camera", "door"});
  expect_success(call("eye.pfm") + Arguments{"--eye", "0.5,0.5,2", "--target", "0.5,0.5,1",
                                             "--camera-up", "0,1,0", "--fov", "57.29577951308232"});
  EXPECT_EQ(read_file(folder_ / "one.pfm"), read_file(folder_ / "named.pfm"));
  EXPECT_EQ(read_file(folder_ / "one.pfm"), read_file(folder_ / "eye.pfm"));
  add_camera("window", {0.2, 0.5, 2});
  expect_success(call("other.pfm") + Arguments{"--camera", "window"});
  EXPECT_NE(read_file(folder_ / "one.pfm"), read_file(folder_ / "other.pfm"));
}

TEST_F(CliPictureCameras, ThatDoNotExistAreRefused) {
  expect_refused(call("p.png") + Arguments{"--camera", "roof"},
                 "scene.glb has no camera \"roof\"; choose one of door");
  add_camera("window", {0.2, 0.5, 2});
  expect_refused(call("p.png"), "requires --eye X,Y,Z, or --camera with one of door, window");
  expect_refused({"picture", "furnace", "--camera", "roof", "-o", folder_ / "p.png"},
                 "furnace has no camera \"roof\"; it has none");
  EXPECT_THAT(folder_.names(), ElementsAre("scene.glb"));
}

TEST(CliPicture, BadCallsAreRefused) {
  const TemporaryFolder folder;
  expect_success({"solve", "furnace", "-m", "8", "-q", "--out", folder / "r.vtp"});
  const std::string png = folder / "p.png", pfm = folder / "p.pfm";
  expect_all_refused(
      {"picture", "cornell-box"},
      {
          {{"-o", png}, "a picture requires --eye X,Y,Z"},
          {{"--eye", "1,2,3"}, "--out is required"},
          {{"--eye", "1,2", "-o", png}, "three finite numbers X,Y,Z"},
          {{"--eye", "1,2,3", "-o", folder / "p.jpg"}, "must end in .png, .svg, .pdf, .exr or"},
          {{"--eye", "1,2,3", "-o", "/no/such/folder/p.png"}, "/no/such/folder"},
          {{"--eye", "1,2,3", "-o", png, "-o", png}, "given twice"},
          {{"--eye", "1,2,3", "--camera", "a", "-o", png}, "excludes"},
      });
  expect_all_refused(
      picture_of("cornell-box") + Arguments{"-o", pfm},
      {
          {{"--exposure", "2"}, "--exposure: used only with a .png, .svg or .pdf file"},
          {{"--tone", "aces"}, "--tone: used only with a .png, .svg or .pdf"},
          {{"--false-color"}, "--false-color: used only with a .png, .svg or .pdf"},
          {{"--lux"}, "--lux: used only with --false-color"},
          {{"--false-color", "--lux", "-o", folder / "p.png"},
           "--lux: not used with .exr and .pfm files"},
          {{"--height", "2"}, "--height: used only with an orthographic picture"},
          {{"--panorama", "--fov", "50"}, "--fov: not used with a panorama"},
          {{"--panorama", "--orthographic"}, "excludes"},
          {{"--fov", "180"}, "--fov: \"180\" is not between 0 and 180"},
          {{"--fov", "0"}, "--fov: \"0\" is not between 0 and 180"},
          {{"--orthographic", "--height", "0"}, "--height: \"0\" is not greater than 0"},
          {{"--samples", "0"}, "--samples: \"0\""},
          {{"--gather", "-1"}, "--gather: \"-1\""},
          {{"--resolution", "8"}, "--resolution: used only with"},
          {{"--camera-up", "0,0,0"}, "up not 0"},
          {{"--engine", "none"}, "engine"},
      });
  const Arguments eye{"picture", "cornell-box", "--eye", "0.2,0.2,0.2", "-o", png};
  for (const std::string size : {"0x10", "10x0", "100000x10", "10x100000", "10", "x", "10x10x10",
                                 "0x1cm", "9cm", "9cmx9cm", "9x900cm"}) {
    expect_refused(eye + Arguments{"--size", size}, "--size: \"");
  }
  expect_refused(eye + Arguments{"--exposure", "0"}, "--exposure: \"0\" is not greater than 0");
  expect_refused(eye + Arguments{"--tone", "aces", "--false-color"}, "--tone: not used with");
  expect_refused(eye + Arguments{"--tone", "sepia"}, "choose one of linear, aces, filmic");
  expect_refused(eye + Arguments{"--target", "0.2,0.2,0.2"}, "is the point in its middle");
  // Inside of the box in the box.
  expect_refused({"picture", "furnace", "--eye", "0.6,0.8,0.7", "-o", png},
                 "is inside a wall or a solid");
  expect_refused(picture_of(folder / "r.vtp") + Arguments{"-m", "8", "-o", png},
                 "--directions: not used with a result");
  expect_refused(picture_of(folder / "r.vtp") + Arguments{"-o", folder / "r.vtp"}, "must end in");
  EXPECT_THAT(folder.names(), ElementsAre("r.vtp"));
}

TEST(CliPicture, HelpShowsAtMostTwentyOptions) {
  const std::vector<std::string> lines = lines_of(run_program({"picture", "--help"}).out);
  const auto is_option = [](const std::string& line) { return line.starts_with("  -"); };
  EXPECT_LE(std::count_if(lines.begin(), lines.end(), is_option), 20);
  EXPECT_THAT(run_program({"picture", "--help"}).out, HasSubstr("--help-all shows"));
}

TEST(CliPicture, AnInterruptionLeavesNoFile) {
  const TemporaryFolder folder;
  const auto before = ::signal(SIGINT, SIG_DFL);  // programs inherit an ignored signal
  RunningProgram program({"picture", "cornell-box", "-m", "16", "--eye", "0.278,0.27,-0.8",
                          "--size", "4000x4000", "--samples", "64", "--out", folder / "p.png"});
  ::signal(SIGINT, before);
  ASSERT_TRUE(program.reports("pixels/s")) << program.err_so_far();
  program.send(SIGINT);
  const ProgramResult result = program.wait();
  EXPECT_EQ(result.status, 130);
  EXPECT_THAT(result.err, HasSubstr("interrupted; the picture is not finished"));
  EXPECT_THAT(folder.names(), IsEmpty());
}

}  // namespace
}  // namespace transillum::testing::cli_picture_test
