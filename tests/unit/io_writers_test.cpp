// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Files of results, statistics and transfers, and writing files completely or not at all.
#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkXMLPolyDataReader.h>

#include <bit>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <nlohmann/json.hpp>
#include <ostream>
#include <sstream>

#include "support/program_call.h"
#include "support/refusal.h"
#include "support/scenes.h"
#include "transillum/at.h"
#include "transillum/errors.h"
#include "transillum/files.h"

namespace transillum::testing::io_writers_test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr double smallest = std::numeric_limits<double>::denorm_min();

/// Three patches, one of them concave, with values that rounded decimal output would change.
Solution awkward_solution() {
  Sketch sketch("awkward");
  const int gray = sketch.material(1.0 / 3, 0.1);
  sketch.face({{0, 0, 0}, {1.0 / 3, 0, 0}, {0.1, 0.7, 0}}, gray);
  sketch.face({{0, 0, 1}, {0, 1, 1}, {1, 1, 1}, {1, 0, 1}}, gray);
  sketch.face({{0, 0, 2}, {2, 0, 2}, {2, 2, 2}, {1, 0.5, 2}}, gray);
  Solution solution;
  solution.scene = sketch.scene();
  solution.radiosity = {{0.1 + 0.2, 1.0 / 3, 1e-17}, {smallest, 1e300, 0}, {M_PI, 2, 1e22}};
  solution.irradiance = {{1, 2, 3}, {4, 5, 6}, {7, 8, 9}};
  solution.statistics.patches = 3;
  solution.complete = true;
  return solution;
}

std::vector<std::vector<std::string>> cells(const std::string& text, char separator) {
  std::vector<std::vector<std::string>> rows;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    rows.emplace_back();
    std::istringstream in(line);
    for (std::string cell; std::getline(in, cell, separator);) {
      rows.back().push_back(cell);
    }
  }
  return rows;
}

void expect_same_bits(const std::string& text, double value) {
  EXPECT_EQ(std::bit_cast<std::uint64_t>(std::strtod(text.c_str(), nullptr)),
            std::bit_cast<std::uint64_t>(value))
      << text;
}

/// Columns from `first`: area, E, rho, B of patch i, and `more` others.
void expect_patch_values(const std::vector<std::string>& row, std::size_t first,
                         const Solution& solution, PatchId i, std::size_t more = 0) {
  ASSERT_EQ(row.size(), first + 10 + more);
  const Scene& scene = *solution.scene;
  expect_same_bits(row[first], scene.patch(i).area);
  std::size_t column = first + 1;
  for (const Rgb& rgb : {scene.exitance(i), scene.reflectance(i), at(solution.radiosity, i)}) {
    for (const double value : {rgb.r, rgb.g, rgb.b}) {
      expect_same_bits(row[column++], value);
    }
  }
}

class IoWriters : public ::testing::Test {
 protected:
  std::string written(const std::string& name) {
    write_result(folder_ / name, solution_);
    EXPECT_THAT(folder_.names(), ElementsAre(name));
    return read_file(folder_ / name);
  }

  TemporaryFolder folder_;
  Solution solution_ = awkward_solution();
};

TEST_F(IoWriters, CsvReadsBackBitForBit) {
  const auto rows = cells(written("a.csv"), ',');
  ASSERT_EQ(rows.size(), 4U);
  for (PatchId i = 0; i < 3; ++i) {
    const auto& row = rows[static_cast<std::size_t>(i) + 1];
    EXPECT_EQ(row[0], std::to_string(i));
    EXPECT_EQ(row[1], std::to_string(i));
    expect_patch_values(row, 2, solution_, i, 5);
    expect_same_bits(row[12], at(solution_.irradiance, i).r);
    expect_same_bits(row[14], at(solution_.irradiance, i).b);
    EXPECT_EQ(row[15], "");  // no group
    EXPECT_EQ(row[16], solution_.scene->material(i).name);
  }
}

TEST_F(IoWriters, CsvHasWhatIsKnownOfTheSkyAndQuotesNames) {
  SceneDescription description;
  description.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  description.materials = {{"red, \"matt\"", {0.5, 0.5, 0.5}, {1, 1, 1}}};
  description.groups = {"wall"};
  description.add_face(std::vector<PointId>{0, 1, 2}, 0, 0, 0);
  solution_ = {};
  solution_.scene = std::make_shared<const Scene>(description);
  solution_.radiosity = {{1, 1, 1}};
  solution_.irradiance = {{}};
  solution_.form_factor_sums = {0.25};
  solution_.sky_fractions = {0.75};
  const std::string text = written("a.csv");
  EXPECT_THAT(text, HasSubstr(",H_r,H_g,H_b,F_sum,sky,group,material\n"));
  EXPECT_THAT(text, HasSubstr(",0,0,0,0.25,0.75,wall,\"red, \"\"matt\"\"\"\n"));
}

TEST_F(IoWriters, PlyReadsBackBitForBit) {
  const std::string text = written("a.PLY");
  EXPECT_EQ(text.rfind("ply\nformat ascii 1.0\n", 0), 0U);
  const auto rows = cells(text.substr(text.find("end_header\n") + 11), ' ');
  std::size_t corners = 0, row = 0;
  for (PatchId i = 0; i < 3; ++i) {
    for (const PointId p : solution_.scene->outline(i)) {
      const Vec3& point = solution_.scene->point(p);
      ASSERT_EQ(rows[row].size(), 6U);
      expect_same_bits(rows[row][0], point.x);
      expect_same_bits(rows[row][1], point.y);
      expect_same_bits(rows[row++][2], point.z);
    }
  }
  for (PatchId i = 0; i < 3; ++i, ++row) {
    const auto outline = solution_.scene->outline(i);
    ASSERT_EQ(rows[row][0], std::to_string(outline.size()));
    for (std::size_t k = 0; k < outline.size(); ++k) {
      EXPECT_EQ(rows[row][1 + k], std::to_string(corners++));
    }
    expect_patch_values(rows[row], outline.size() + 3, solution_, i);
  }
  EXPECT_EQ(row, rows.size());
}

TEST_F(IoWriters, VtpReadsBackBitForBit) {
  written("a.vtp");
  vtkNew<vtkXMLPolyDataReader> reader;
  reader->SetFileName((folder_ / "a.vtp").c_str());
  reader->Update();
  vtkPolyData& mesh = *reader->GetOutput();
  ASSERT_EQ(mesh.GetNumberOfPolys(), 3);
  vtkCellData& fields = *mesh.GetCellData();
  for (const char* name : {"face", "patch", "area", "E", "rho", "B", "H"}) {
    ASSERT_NE(fields.GetArray(name), nullptr) << name;
  }
  EXPECT_EQ(fields.GetArray("B")->GetDataType(), VTK_DOUBLE);
  vtkNew<vtkIdList> corners;
  for (PatchId i = 0; i < 3; ++i) {
    const Rgb& b = at(solution_.radiosity, i);
    double read[3];
    fields.GetArray("B")->GetTuple(i, read);
    EXPECT_EQ(read[0], b.r);
    EXPECT_EQ(read[1], b.g);
    EXPECT_EQ(read[2], b.b);
    EXPECT_EQ(fields.GetArray("area")->GetTuple1(i), solution_.scene->patch(i).area);
    mesh.GetPolys()->GetCellAtId(i, corners);
    const auto outline = solution_.scene->outline(i);
    ASSERT_EQ(corners->GetNumberOfIds(), static_cast<vtkIdType>(outline.size()));
    for (std::size_t k = 0; k < outline.size(); ++k) {
      double point[3];
      mesh.GetPoint(corners->GetId(static_cast<vtkIdType>(k)), point);
      EXPECT_EQ((Vec3{point[0], point[1], point[2]}), solution_.scene->point(outline[k]));
    }
  }
  EXPECT_NE(mesh.GetFieldData()->GetAbstractArray("scene"), nullptr);
  EXPECT_EQ(mesh.GetFieldData()->GetArray("complete")->GetTuple1(0), 1);
}

TEST_F(IoWriters, StatisticsWriteNullForNonFiniteNumbers) {
  solution_.statistics.iterations = 1;
  solution_.statistics.energy_defect = std::nan("");
  solution_.statistics.closure_defect_max = HUGE_VAL;
  solution_.statistics.iteration_records = {{0.1 + 0.2, 0, 1e-3}};
  write_statistics(folder_ / "s.json", RunOptions{}, solution_);
  const auto json = read_json(folder_ / "s.json");
  EXPECT_TRUE(json.at("energy_defect").is_null());
  EXPECT_TRUE(json.at("closure_defect_max").is_null());
  EXPECT_EQ(json.at("change").at(0).get<double>(), 0.1 + 0.2);
  EXPECT_EQ(json.at("scene"), "awkward");
}

TEST_F(IoWriters, TransfersOfAReceiverSumToItsProjectedArea) {
  Transfers transfers;
  transfers.exchanges = {{0, 1, 0.25}, {0, 2, 0.5}, {2, 1, 1.0 / 3}};
  transfers.forward = {{1.0, 0.75}, {0, 0}, {1.0 / 3, 1.0 / 3}};
  std::ostringstream out;
  write_transfers_csv(out, transfers);
  EXPECT_EQ(out.str(),
            "receiver,source,area\n0,-1,0.25\n0,1,0.25\n0,2,0.5\n2,1,0.3333333333333333\n");
}

TEST(IoWholeFiles, NothingIsLeftBehindIfWritingFails) {
  const TemporaryFolder folder;
  const std::string path = folder / "a.csv";
  const auto fail = [&] {
    write_file_whole(path, [](std::ostream& out) {
      out << "half";
      throw std::runtime_error("no more");
    });
  };
  EXPECT_THROW(fail(), std::runtime_error);
  EXPECT_THAT(folder.names(), IsEmpty());

  write_text(path, "as it was");
  EXPECT_THROW(fail(), std::runtime_error);
  EXPECT_THAT(folder.names(), ElementsAre("a.csv"));
  EXPECT_EQ(read_file(path), "as it was");
}

TEST(IoWholeFiles, ReplacesAFileAndKeepsItsPermissions) {
  const TemporaryFolder folder;
  const std::string path = folder / "a.csv";
  write_text(path, "old");
  ::chmod(path.c_str(), 0640);
  write_file_whole(path, [](std::ostream& out) { out << "new"; });
  EXPECT_EQ(read_file(path), "new");
  struct stat status {};
  ASSERT_EQ(::stat(path.c_str(), &status), 0);
  EXPECT_EQ(status.st_mode & 0777, 0640U);
  EXPECT_THAT(folder.names(), ElementsAre("a.csv"));
}

TEST(IoWholeFiles, ASymbolicLinkIsKept) {
  const TemporaryFolder folder;
  write_text(folder / "target", "old");
  std::filesystem::create_symlink("target", folder / "link");
  write_file_whole(folder / "link", [](std::ostream& out) { out << "new"; });
  EXPECT_TRUE(std::filesystem::is_symlink(folder / "link"));
  EXPECT_EQ(read_file(folder / "target"), "new");
}

std::string failure_of(const std::string& path) {
  try {
    write_file_whole(path, [](std::ostream& out) { out << std::string(100000, 'x'); });
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return {};
}

TEST(IoWholeFiles, ALinkToNothingIsWrittenThrough) {
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder / "results");
  std::filesystem::create_symlink("results/second", folder / "first");
  std::filesystem::create_symlink("target", folder / "results/second");
  write_file_whole(folder / "first", [](std::ostream& out) { out << "new"; });
  EXPECT_TRUE(std::filesystem::is_symlink(folder / "first"));
  EXPECT_TRUE(std::filesystem::is_symlink(folder / "results/second"));
  EXPECT_EQ(read_file(folder / "results/target"), "new");
}

TEST(IoWholeFiles, ALoopOfLinksIsAnError) {
  const TemporaryFolder folder;
  const std::string a = folder / "a", b = folder / "b";
  std::filesystem::create_symlink(a, b);
  std::filesystem::create_symlink(b, a);
  EXPECT_THAT(failure_of(a), HasSubstr("Too many levels of symbolic links"));
  EXPECT_THROW(check_writable(a), InputError);
  EXPECT_TRUE(std::filesystem::is_symlink(a));
  EXPECT_THAT(folder.names(), ElementsAre("a", "b"));
}

/// A file has no name before it is complete, where the file system supports that.
TEST(IoWholeFiles, AKilledProgramLeavesNoTemporaryFile) {
  const TemporaryFolder folder;
  const int unnamed = ::open(folder.path().c_str(), O_TMPFILE | O_WRONLY, 0600);
  if (unnamed < 0) {
    GTEST_SKIP() << "the file system has no unnamed files";
  }
  ::close(unnamed);
  write_file_whole(folder / "a.csv", [&](std::ostream& out) {
    out << "new" << std::flush;
    EXPECT_THAT(folder.names(), IsEmpty());
  });
  EXPECT_THAT(folder.names(), ElementsAre("a.csv"));
}

TEST(IoWholeFiles, OpenFilesAreWrittenAtTheirPosition) {
  const TemporaryFolder folder;
  write_text(folder / "log", "as it was, ");
  const int log = ::open((folder / "log").c_str(), O_WRONLY | O_APPEND);
  int ends[2];
  ASSERT_EQ(::pipe(ends), 0);
  for (const int descriptor : {log, ends[1]}) {
    for (const std::string name : {"/dev/fd/", "/proc/self/fd/"}) {
      EXPECT_NO_THROW(check_writable(name + std::to_string(descriptor)));
      write_file_whole(name + std::to_string(descriptor), [](std::ostream& out) { out << "new "; });
    }
    ::close(descriptor);
  }
  EXPECT_EQ(read_file(folder / "log"), "as it was, new new ");
  std::string read(100, ' ');
  read.resize(static_cast<std::size_t>(::read(ends[0], read.data(), read.size())));
  EXPECT_EQ(read, "new new ");
  EXPECT_THROW(check_writable("/dev/fd/" + std::to_string(ends[0])), InputError);
  ::close(ends[0]);
  EXPECT_THAT(folder.names(), ElementsAre("log"));
}

TEST(IoWholeFiles, WriteProtectedFilesAreKept) {
  if (::geteuid() == 0) {
    GTEST_SKIP() << "nothing is write-protected for root";
  }
  const TemporaryFolder folder;
  write_text(folder / "a.csv", "old");
  ::chmod((folder / "a.csv").c_str(), 0444);
  EXPECT_THROW(check_writable(folder / "a.csv"), InputError);
  EXPECT_THAT(failure_of(folder / "a.csv"), HasSubstr("Permission denied"));
  EXPECT_EQ(read_file(folder / "a.csv"), "old");
}

TEST(IoWholeFiles, FilesOfASceneAreNotOverwritten) {
  const TemporaryFolder folder;
  write_text(folder / "m.mtl", "newmtl a\nKd 0.5 0.5 0.5\n");
  write_text(folder / "a.obj", "mtllib m.mtl\nusemtl a\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  const SceneDescription description = describe_scene(folder / "a.obj");
  EXPECT_THAT(description.files, ElementsAre(folder / "a.obj", folder / "m.mtl"));
  EXPECT_THROW(write_obj(folder / "a.obj", description), InputError);
  EXPECT_THROW(write_obj(folder / "m.obj", description), InputError);
  EXPECT_NO_THROW(write_obj(folder / "b.obj", description));
  EXPECT_THAT(read_file(folder / "m.mtl"), HasSubstr("newmtl a\nKd 0.5 0.5 0.5\n"));
}

TEST(IoWholeFiles, LongNamesAreWritten) {
  const TemporaryFolder folder;
  const std::string name(255, 'n');
  write_file_whole(folder / name, [](std::ostream& out) { out << "x"; });
  EXPECT_THAT(folder.names(), ElementsAre(name));
}

TEST(IoWholeFiles, FailuresNameTheFileAndTheReason) {
  const TemporaryFolder folder;
  EXPECT_THAT(failure_of(folder / "none/a.csv"),
              ::testing::AllOf(HasSubstr("none/a.csv"), HasSubstr("No such file")));
  EXPECT_THAT(failure_of(folder.path().string()), HasSubstr("directory"));
  EXPECT_THAT(failure_of("/dev/full"), HasSubstr("No space left"));
}

TEST(IoWholeFiles, PathsAreCheckedInAdvance) {
  const TemporaryFolder folder;
  EXPECT_NO_THROW(check_result_path(folder / "a.csv"));
  EXPECT_NO_THROW(check_result_path(folder / "A.VTP"));
  EXPECT_THROW(check_result_path(folder / "a.gif"), InputError);
  EXPECT_THROW(check_result_path(folder / "csv"), InputError);
  EXPECT_THROW(check_result_path(folder / "none/a.csv"), InputError);
  std::filesystem::create_directory(folder / "b.csv");
  EXPECT_THROW(check_result_path(folder / "b.csv"), InputError);
  // Once, this was found after the solve, and the status was 1.
  const std::string long_name = std::string(300, 'a') + ".csv";
  EXPECT_THAT(test::refusal([&] { check_result_path(folder / long_name); }),
              HasSubstr("File name too long"));
  const std::string series = std::string(250, 'a') + ".pvd";
  EXPECT_THAT(test::refusal([&] { ResultSeries(folder / series); }),
              HasSubstr("File name too long"));
  if (::geteuid() != 0) {
    std::filesystem::create_directory(folder / "closed");
    ::chmod((folder / "closed").c_str(), 0500);
    EXPECT_THROW(check_result_path(folder / "closed/a.csv"), InputError);
  }
}

/// Opening a pipe for writing blocks until a reader opens it, and no signal ends the wait.
TEST(IoFiles, RefusesPipesInAdvance) {
  const TemporaryFolder folder;
  const std::string pipe = folder / "pipe.csv";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  EXPECT_THAT(test::refusal([&] { check_writable(pipe); }), HasSubstr("it is a pipe"));
}

}  // namespace
}  // namespace transillum::testing::io_writers_test
