// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
// Output files: no command overwrites a file that it reads, or writes a file twice; links, pipes
// and files that cannot be written.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>

#include "support/program_call.h"

namespace transillum::testing {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

namespace fs = std::filesystem;

/// A folder with a.obj, which uses mats.mtl, and the statistics s.json of a solve.
class CliOutputs : public ::testing::Test {
 protected:
  void SetUp() override {
    expect_success({"scene", "furnace", "--out", "mats.obj"}, folder_.path());
    fs::rename(folder_ / "mats.obj", folder_ / "a.obj");
    expect_success({"solve", "furnace", "-m", "64", "--replicas", "4", "--stats", "s.json"},
                   folder_.path());
    names_ = folder_.names();
    for (const std::string& name : names_) {
      contents_.push_back(read_file(folder_ / name));
    }
  }

  ProgramResult run(const std::vector<std::string>& arguments) const {
    return run_program(arguments, {}, {}, folder_.path().string());
  }

  /// Exit status 2, one line, and all files unchanged.
  void expect_refused(const Arguments& arguments, const std::string& expected) {
    testing::expect_refused(arguments, expected, folder_.path());
    for (std::size_t k = 0; k < names_.size(); ++k) {
      EXPECT_EQ(read_file(folder_ / names_[k]), contents_[k]) << names_[k];
    }
  }

  TemporaryFolder folder_;
  std::vector<std::string> names_, contents_;
};

TEST_F(CliOutputs, NoCommandOverwritesAFileThatItReads) {
  fs::create_symlink("a.obj", folder_ / "link.obj");
  fs::create_hard_link(folder_ / "mats.mtl", folder_ / "hard.csv");
  fs::create_hard_link(folder_ / "mats.mtl", folder_ / "hard.svg");
  fs::create_hard_link(folder_ / "mats.mtl", folder_ / "hard.json");
  fs::create_hard_link(folder_ / "mats.mtl", folder_ / "hard.png");
  fs::create_symlink(folder_.path(), folder_ / "folder");
  const std::string obj = "would overwrite the input file a.obj";
  const std::string mtl = "would overwrite the input file mats.mtl";
  expect_refused({"scene", "a.obj", "--out", "a.obj"}, obj);
  expect_refused({"scene", "a.obj", "--out", "./folder/./a.obj"}, obj);
  expect_refused({"scene", "a.obj", "--out", "link.obj"}, obj);
  expect_refused({"scene", "a.obj", "--out", "mats.obj"}, "mats.mtl: " + mtl);
  expect_refused({"solve", "a.obj", "-m", "8", "--out", "hard.csv"}, mtl);
  expect_refused({"solve", "a.obj", "-m", "8", "--stats", "hard.json"}, mtl);
  expect_refused({"factors", "a.obj", "-m", "8", "-o", "hard.csv"}, mtl);
  fs::create_symlink("a.obj", folder_ / "to-a.csv");
  expect_refused({"factors", "link.obj", "-m", "8", "-o", "to-a.csv"}, "input file link.obj");
  expect_refused({"transfers", "a.obj", "--direction", "0,0,1", "-o", "mats.mtl"}, mtl);
  expect_refused({"map", "a.obj", "--direction", "0,0,1", "-o", "hard.svg"}, mtl);
  expect_refused({"picture", "a.obj", "--eye", "0.2,0.3,0.4", "-o", "hard.png"}, mtl);
  expect_refused({"study", "a.obj", "-m", "8", "--no-cache", "-o", "folder/mats.mtl"}, mtl);
  expect_refused({"study", "a.obj", "-m", "8", "--no-cache", "--plot", "hard.svg"}, mtl);
  expect_refused({"directions", "-m", "8", "--stats", "--scene", "a.obj", "-o", "a.obj"}, obj);
  expect_refused({"bounds", "a.obj", "-o", "hard.json"}, mtl);
  expect_refused({"bounds", "--run", "s.json", "-o", "./s.json"}, "input file s.json");
}

TEST_F(CliOutputs, NoCommandWritesAFileTwice) {
  write_text(folder_ / "old.csv", "old");
  fs::create_hard_link(folder_ / "old.csv", folder_ / "again.csv");
  fs::create_symlink("new.csv", folder_ / "to-new.csv");
  const std::string twice = "given twice as an output file";
  expect_refused({"solve", "furnace", "-m", "8", "-o", "old.csv", "-o", "again.csv"}, twice);
  expect_refused({"solve", "furnace", "-m", "8", "-o", "to-new.csv", "-o", "new.csv"}, twice);
  expect_refused({"study", "furnace", "-m", "8", "-o", "new.svg", "--plot", "./new.svg"}, twice);
  fs::create_symlink("b.mtl", folder_ / "b.obj");
  expect_refused({"scene", "furnace", "-o", "b.obj"}, twice);
  expect_success({"directions", "-m", "8", "-o", "/dev/null", "--stats"}, folder_.path());
}

TEST_F(CliOutputs, ALoopOfLinksIsRefused) {
  fs::create_symlink("y.csv", folder_ / "x.csv");
  fs::create_symlink("x.csv", folder_ / "y.csv");
  expect_refused({"solve", "furnace", "-m", "8", "-o", "x.csv"},
                 "x.csv: cannot be written: Too many levels of symbolic links");
  EXPECT_TRUE(fs::is_symlink(folder_ / "x.csv"));
}

TEST_F(CliOutputs, ALinkToNothingIsWrittenThrough) {
  fs::create_directory(folder_ / "results");
  fs::create_symlink("results/r.csv", folder_ / "r.csv");
  EXPECT_EQ(run({"directions", "-m", "4", "-o", "r.csv"}).status, 0);
  EXPECT_TRUE(fs::is_symlink(folder_ / "r.csv"));
  EXPECT_EQ(line_count(read_file(folder_ / "results/r.csv")), 5U);
  fs::create_symlink("missing/r.csv", folder_ / "s.csv");
  expect_refused({"directions", "-m", "4", "-o", "s.csv"}, "there is no folder");
}

TEST_F(CliOutputs, EmptyNamesAreRefused) {
  expect_refused({"directions", "-m", "4", "-o", ""}, "--out: the value is empty");
  expect_refused({"solve", "furnace", "-m", "4", "--stats", ""}, "--stats: the value is empty");
  expect_refused({"study", "furnace", "-m", "4", "--plot", ""}, "--plot: the value is empty");
  expect_refused({"bounds", "--run", ""}, "--run: the value is empty");
}

TEST_F(CliOutputs, UnusualNamesAreWritten) {
  for (const std::string name :
       {"two words.csv", "two\nlines.csv", "\xff\xfe.csv", "-x.csv", "=.csv"}) {
    SCOPED_TRACE(name);
    EXPECT_EQ(run({"solve", "furnace", "-q", "-m", "8", "--out=" + name}).status, 0);
    EXPECT_EQ(line_count(read_file(folder_ / name)), 13U);
  }
}

/// If one file cannot be written, the other files and the summary are not lost.
TEST_F(CliOutputs, TheOtherFilesAreWrittenIfOneFails) {
  fs::create_symlink("/dev/full", folder_ / "full.csv");
  fs::create_symlink("/dev/full", folder_ / "full.svg");
  const std::string full = ": cannot be written: No space left on device";
  const ProgramResult solve = run({"solve", "furnace", "-m", "8", "-o", "full.csv", "-o", "b.csv"});
  EXPECT_EQ(solve.status, 1);
  EXPECT_THAT(solve.err, HasSubstr("full.csv" + full));
  EXPECT_THAT(solve.err, HasSubstr("B mean, W/m2"));
  EXPECT_EQ(line_count(read_file(folder_ / "b.csv")), 13U);

  const ProgramResult study = run({"study", "furnace", "-m", "8", "--sampling", "fibonacci",
                                   "--no-cache", "-o", "full.csv", "--plot", "p.svg"});
  EXPECT_EQ(study.status, 1);
  EXPECT_THAT(study.err, HasSubstr("full.csv" + full));
  EXPECT_THAT(study.err, HasSubstr("fibonacci"));
  EXPECT_THAT(read_file(folder_ / "p.svg"), HasSubstr("</svg>"));

  const ProgramResult map =
      run({"map", "furnace", "--direction", "1,2,3", "-o", "full.svg", "-o", "m.svg"});
  EXPECT_EQ(map.status, 1);
  EXPECT_THAT(map.err, HasSubstr("full.svg" + full));
  EXPECT_THAT(read_file(folder_ / "m.svg"), HasSubstr("</svg>"));
}

/// Sets the limit of the size of files; programs inherit it.
class FileSizeLimit {
 public:
  explicit FileSizeLimit(rlim_t bytes) {
    ::getrlimit(RLIMIT_FSIZE, &before_);
    const rlimit limit{bytes, before_.rlim_max};
    ::setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~FileSizeLimit() { ::setrlimit(RLIMIT_FSIZE, &before_); }
  FileSizeLimit(const FileSizeLimit&) = delete;
  FileSizeLimit& operator=(const FileSizeLimit&) = delete;

 private:
  rlimit before_{};
};

/// Otherwise SIGXFSZ would end the program, and a temporary file would stay.
TEST_F(CliOutputs, AFileBeyondTheSizeLimitIsAnErrorAndLeavesNothing) {
  ProgramResult result;
  {
    const FileSizeLimit limit(20000);
    result = run({"directions", "-m", "1000", "-o", "d.csv"});
  }
  EXPECT_EQ(result.status, 1);
  EXPECT_EQ(result.err, "transillum: d.csv: cannot be written: File too large\n");
  EXPECT_EQ(folder_.names(), names_);
}

/// A series has files in addition to the one that is named.
TEST_F(CliOutputs, FilesOfASeriesAreNotWrittenTwice) {
  const Arguments solve{"solve", "a.obj", "-m", "8", "--series", "r.pvd"};
  expect_refused(solve + Arguments{"--out", "r-0002.vtp"},
                 "r-0002.vtp: the series r.pvd writes this file too");
  expect_refused(solve + Arguments{"--out", "./r-12345.vtp"}, "./r-12345.vtp: the series r.pvd");
  expect_refused(solve + Arguments{"--checkpoint", "r-0001.vtp"}, "r-0001.vtp: the series");
  ASSERT_EQ(run({"solve", "a.obj", "-m", "8", "--out", "r-0003.vtp"}).status, 0);
  names_ = folder_.names();
  EXPECT_THAT(run({"solve", "r-0003.vtp", "-m", "8", "--series", "r.pvd"}).err,
              HasSubstr("r-0003.vtp: the series r.pvd"));
  EXPECT_EQ(folder_.names(), names_);
  for (const std::string name : {"r-002.vtp", "r-00x2.vtp", "q-0002.vtp", "r.vtp"}) {
    EXPECT_EQ(run(solve + Arguments{"--out", name}).status, 0) << name;
  }
}

/// Once, the program found this only after the solve, when other files had been written.
TEST_F(CliOutputs, APictureFromThePointInItsMiddleIsRefusedBeforeTheSolve) {
  const Arguments solve{"solve", "a.obj", "-m", "8", "--out", "b.csv", "--out", "b.png"};
  expect_refused(solve + Arguments{"--eye", "0.2,0.3,0.4", "--target", "0.2,0.3,0.4"},
                 "a.obj: the eye of the picture, 0.2 0.3 0.4, is the point in its middle");
  expect_refused(solve + Arguments{"--eye", "1,1,1"}, "the eye of the picture, 1 1 1, is");
}

TEST(CliOutputOrder, AFileMayBeNamedBeforeTheScene) {
  const TemporaryFolder folder;
  expect_success({"solve", "-q", "-m", "8", "--out", folder / "a.csv", "cornell-box"});
  expect_success(
      {"study", "-q", "--no-cache", "-m", "8", "--plot", folder / "a.svg", "cornell-box"});
  EXPECT_EQ(folder.names(), (std::vector<std::string>{"a.csv", "a.svg"}));
}

}  // namespace
}  // namespace transillum::testing
