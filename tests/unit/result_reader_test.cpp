// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Reading .vtp results: everything written is read back, and damaged files give error messages.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkStringArray.h>
#include <vtkXMLPolyDataReader.h>
#include <vtkXMLPolyDataWriter.h>

#include <array>
#include <functional>
#include <limits>
#include <random>

#include "support/program_call.h"
#include "support/refusal.h"
#include "support/scenes.h"
#include "transillum/files.h"
#include "transillum/solution.h"
#include "transillum/solve_options.h"
#include "transillum/solve_session.h"

namespace transillum::testing::result_reader_test {
namespace {

using test::refusal;
using ::testing::HasSubstr;
using ::testing::StartsWith;

void expect_same(const Solution& read, const Solution& written) {
  const Scene &a = *read.scene, &b = *written.scene;
  EXPECT_EQ(a.name(), b.name());
  EXPECT_EQ(a.groups(), b.groups());
  EXPECT_EQ(a.options().two_sided, b.options().two_sided);
  ASSERT_EQ(a.patch_count(), b.patch_count());
  for (PatchId i = 0; i < a.patch_count(); ++i) {
    EXPECT_EQ(a.patch(i).normal, b.patch(i).normal);
    EXPECT_EQ(a.patch(i).area, b.patch(i).area);
    EXPECT_EQ(a.patch(i).face, b.patch(i).face);
    EXPECT_EQ(a.patch(i).group, b.patch(i).group);
    EXPECT_EQ(a.exitance(i), b.exitance(i));
    EXPECT_EQ(a.reflectance(i), b.reflectance(i));
    EXPECT_EQ(a.material(i).name, b.material(i).name);
    ASSERT_EQ(a.outline(i).size(), b.outline(i).size());
    for (std::size_t k = 0; k < a.outline(i).size(); ++k) {
      EXPECT_EQ(a.point(a.outline(i)[k]), b.point(b.outline(i)[k]));
    }
  }
  EXPECT_EQ(read.radiosity, written.radiosity);
  EXPECT_EQ(read.irradiance, written.irradiance);
  EXPECT_EQ(read.form_factor_sums, written.form_factor_sums);
  EXPECT_EQ(read.sky_fractions, written.sky_fractions);
  EXPECT_EQ(read.sky_irradiance, written.sky_irradiance);
  EXPECT_EQ(read.sky, written.sky);
  EXPECT_EQ(read.complete, written.complete);
  EXPECT_EQ(read.error.standard_error, written.error.standard_error);
  EXPECT_EQ(read.error.rms, written.error.rms);
  const SolveStatistics &s = read.statistics, &t = written.statistics;
  EXPECT_EQ(s.patches, t.patches);
  EXPECT_EQ(s.directions, t.directions);
  EXPECT_EQ(s.passes_made, t.passes_made);
  EXPECT_EQ(s.transfers, t.transfers);
  EXPECT_EQ(s.kept_form_factors, t.kept_form_factors);
  EXPECT_EQ(s.energy_defect, t.energy_defect);
  ASSERT_EQ(s.iteration_records.size(), t.iteration_records.size());
  for (std::size_t k = 0; k < s.iteration_records.size(); ++k) {
    EXPECT_EQ(s.iteration_records[k].change, t.iteration_records[k].change);
    EXPECT_EQ(s.iteration_records[k].contraction, t.iteration_records[k].contraction);
  }
}

class ResultReader : public ::testing::Test {
 protected:
  /// A solved scene of two triangles and a concave quadrilateral, written.
  ResultReader() {
    Sketch sketch("awkward");
    const int gray = sketch.material(1.0 / 3, 0.1), bright = sketch.material(0.7, 5);
    sketch.face({{0, 0, 0}, {1.0 / 3, 0, 0}, {0.1, 0.7, 0}}, gray);
    sketch.face({{0, 0, 1}, {0, 1, 1}, {1, 1, 1}}, bright);
    sketch.face({{0, 0, 2}, {2, 0, 2}, {2, 2, 2}, {1, 0.5, 2}}, gray);
    solution_ = solve(sketch.scene(), {.directions = 16});
    write_result(path_, solution_);
  }

  /// Reads the file with VTK, applies `edit`, and writes it back.
  void change(const std::function<void(vtkPolyData&)>& edit) const {
    vtkNew<vtkXMLPolyDataReader> reader;
    reader->SetFileName(path_.c_str());
    reader->Update();
    edit(*reader->GetOutput());
    vtkNew<vtkXMLPolyDataWriter> writer;
    writer->SetFileName(path_.c_str());
    writer->SetInputData(reader->GetOutput());
    writer->SetHeaderTypeToUInt64();
    writer->Write();
  }
  void replace(const std::string& from, const std::string& to) const {
    std::string text = read_file(path_);
    const std::size_t at = text.find(from);
    ASSERT_NE(at, std::string::npos) << from;
    write_text(path_, text.replace(at, from.size(), to));
  }
  void expect_refused(const std::string& what) const {
    std::string sentence = refusal([&] { read_result(path_); });
    EXPECT_THAT(sentence, StartsWith(path_ + ": "));
    EXPECT_THAT(sentence, HasSubstr(what));
    EXPECT_EQ(sentence.find('\n'), std::string::npos);
  }

  TemporaryFolder folder_;
  const std::string path_ = folder_ / "r.vtp";
  Solution solution_;
};

TEST_F(ResultReader, ReadsBackWhatWasWritten) { expect_same(read_result(path_), solution_); }

// Each side has its own points, since B differs: once, the other side was not found by its points.
TEST_F(ResultReader, ReadsTwoSidedResultsOfLinearFunctions) {
  SceneDescription box = describe_scene("cornell-box");
  const auto scene = std::make_shared<const Scene>(box, SceneOptions{.two_sided = true});
  const Solution linear = solve(scene, {.directions = 16, .basis = Basis::linear});
  write_result(path_, linear);
  const Solution again = read_result(path_);
  expect_same(again, linear);
  ASSERT_EQ(again.linear_terms.size(), linear.linear_terms.size());
  for (std::size_t i = 0; i < again.linear_terms.size(); ++i) {
    EXPECT_EQ(again.linear_terms[i].first, linear.linear_terms[i].first);
    EXPECT_EQ(again.linear_terms[i].second, linear.linear_terms[i].second);
  }
}

TEST_F(ResultReader, ChecksTheNumbersOfFaces) {
  const auto with_faces = [&](std::array<double, 3> faces) {
    change([&](vtkPolyData& mesh) {
      for (vtkIdType i = 0; i < 3; ++i) {
        mesh.GetCellData()->GetArray("face")->SetComponent(i, 0,
                                                           faces[static_cast<std::size_t>(i)]);
      }
    });
  };
  with_faces({2, 2, 700});
  const Solution parts = read_result(path_);
  EXPECT_EQ(parts.scene->patch(1).face, 2);
  EXPECT_EQ(parts.scene->patch(2).face, 700);
  with_faces({0, 2, 1});
  expect_refused("patch 2 is of face 1, which is not in the range 2 to");
  with_faces({-1, 0, 1});
  expect_refused("patch 0 is of face -1");
  with_faces({0, 1, 2e9});
  expect_refused("patch 2 is of face 2000000000");
  change([](vtkPolyData& mesh) { mesh.GetCellData()->RemoveArray("face"); });
  EXPECT_EQ(read_result(path_).scene->patch(2).face, 2);
}

TEST_F(ResultReader, ReadsBothSidesOfRefinedFacesAndTheErrorEstimate) {
  const auto scene = load_scene("boards", {.two_sided = true, .max_patch_area = 0.4});
  ASSERT_GT(scene->patch_count(), 2 * scene->report().faces);
  solution_ = solve(scene, {.directions = 16, .replicas = 2});
  ASSERT_EQ(solution_.error.replicas, 2);
  write_result(path_, solution_);
  const Solution read = read_result(path_);
  expect_same(read, solution_);
  EXPECT_EQ(read.error.replicas, 2);
  EXPECT_EQ(read.scene->patch(2).face, 0);  // a part of the first face, which is divided
  // A result that was read can be written and read again.
  write_result(path_, read);
  expect_same(read_result(path_), solution_);
}

TEST_F(ResultReader, ReadsGroupsAndTheLightOfTheSky) {
  SceneDescription description = describe_scene("boards");
  description.groups = {"first", "last"};
  description.face_group.assign(description.face_count(), no_group);
  description.face_group.front() = 0;
  description.face_group.back() = 1;
  solution_ =
      solve(std::make_shared<const Scene>(description),
            {.directions = 16,
             .sky = {.exitance = {1, 2, 3}, .model = SkyModel::cie_overcast, .up = {0, 1, 0}}});
  ASSERT_FALSE(solution_.sky_irradiance.empty());
  write_result(path_, solution_);
  expect_same(read_result(path_), solution_);
  const auto set = [&](const char* array, double value) {
    write_result(path_, solution_);
    change(
        [&](vtkPolyData& mesh) { mesh.GetCellData()->GetArray(array)->SetComponent(1, 0, value); });
  };
  set("group", 2);
  expect_refused("patch 1 is of group 2, which is not in the range -1 to 1");
  set("group", -2);
  expect_refused("patch 1 is of group -2");
  set("sky", -0.5);
  expect_refused("sky of patch 1 is -0.5");
  write_result(path_, solution_);
  change([&](vtkPolyData& mesh) {
    mesh.GetFieldData()->GetArray("sky_exitance")->SetComponent(0, 1, -2);
  });
  expect_refused("sky: an exitance of -2");
  set("F_sum", std::numeric_limits<double>::infinity());
  expect_refused("F_sum of patch 1 is inf");
}

TEST_F(ResultReader, NeedsNeitherMaterialsNorValues) {
  change([](vtkPolyData& mesh) {
    mesh.GetCellData()->RemoveArray("material");
    mesh.GetFieldData()->Initialize();
  });
  const Solution read = read_result(path_);
  EXPECT_EQ(read.radiosity, solution_.radiosity);
  EXPECT_EQ(read.scene->name(), path_);
  ASSERT_EQ(read.scene->materials().size(), 2U);
  EXPECT_EQ(read.scene->material(1).exitance, solution_.scene->material(1).exitance);
}

TEST_F(ResultReader, DistinguishesMaterialsByNumberAndValues) {
  // Patches 0 and 2 share a material.
  change([](vtkPolyData& mesh) {
    for (int c = 0; c < 3; ++c) {
      mesh.GetCellData()->GetArray("rho")->SetComponent(2, c, 0.25);
    }
  });
  Solution read = read_result(path_);
  EXPECT_EQ(read.scene->reflectance(0), (Rgb{1.0 / 3, 1.0 / 3, 1.0 / 3}));
  EXPECT_EQ(read.scene->reflectance(2), (Rgb{0.25, 0.25, 0.25}));
  EXPECT_EQ(read.scene->material(0).name, read.scene->material(2).name);
  write_result(path_, solution_);
  change([](vtkPolyData& mesh) { mesh.GetCellData()->GetArray("material")->SetTuple1(2, 1); });
  read = read_result(path_);
  EXPECT_EQ(read.scene->material(2).name, read.scene->material(1).name);
  EXPECT_NE(read.scene->material(2).name, read.scene->material(0).name);
  EXPECT_EQ(read.scene->reflectance(2), read.scene->reflectance(0));
}

TEST_F(ResultReader, RemovesControlCharactersFromNames) {
  change([](vtkPolyData& mesh) {
    vtkNew<vtkStringArray> names;
    names->SetName("materials");
    names->InsertNextValue("red\n\x1b[31m");
    names->InsertNextValue("plain");
    mesh.GetFieldData()->AddArray(names);
  });
  const Solution read = read_result(path_);
  EXPECT_EQ(read.scene->material(0).name.find_first_of("\n\x1b"), std::string::npos);
  EXPECT_THAT(read.scene->material(0).name, StartsWith("red"));
  EXPECT_EQ(read.scene->material(1).name, "plain");
}

TEST_F(ResultReader, RefusesPairsThatAreNotSidesOfOneFace) {
  solution_ = solve(load_scene("boards", {.two_sided = true}), {.directions = 16});
  for (const bool materials : {true, false}) {
    SCOPED_TRACE(materials);
    write_result(path_, solution_);
    change([&](vtkPolyData& mesh) {
      if (materials) {
        auto& array = *mesh.GetCellData()->GetArray("material");
        array.SetTuple1(1, array.GetTuple1(1) + 1);
      } else {
        auto& corners = *mesh.GetPolys()->GetConnectivityArray();
        const auto first = static_cast<vtkIdType>(solution_.scene->outline(0).size());
        const double moved = corners.GetTuple1(first);
        corners.SetTuple1(first, corners.GetTuple1(first + 1));
        corners.SetTuple1(first + 1, moved);
      }
    });
    expect_refused("patch 0 is not followed by its other side");
  }
}

TEST_F(ResultReader, RefusesOtherFiles) {
  EXPECT_THAT(refusal([&] { read_result(folder_ / "none.vtp"); }), HasSubstr("no such file"));
  EXPECT_THAT(refusal([&] { read_result(folder_.path()); }), HasSubstr("not a regular file"));
  for (const char* text : {"", "v 0 0 0\n", "<a><AppendedData", "<VTKFile/><AppendedData/>",
                           "<VTKFile type=\"ImageData\"><AppendedData encoding=\"raw\">_"}) {
    write_text(path_, text);
    expect_refused("is not a VTK file");
  }
}

TEST_F(ResultReader, RefusesOtherPolygons) {
  change([](vtkPolyData& mesh) { mesh.GetCellData()->RemoveArray("B"); });
  expect_refused("has no array \"B\"");
}

TEST_F(ResultReader, RefusesImpossibleValues) {
  struct Case {
    const char* what;
    std::function<void(vtkPolyData&)> edit;
  };
  const auto set = [](const char* name, double value) {
    return
        [=](vtkPolyData& mesh) { mesh.GetCellData()->GetArray(name)->SetComponent(1, 2, value); };
  };
  const auto field = [](const char* name, double value) {
    return [=](vtkPolyData& mesh) { mesh.GetFieldData()->GetArray(name)->SetTuple1(0, value); };
  };
  const Case cases[] = {
      {"B of patch 1 is not a finite number", set("B", std::nan(""))},
      {"H of patch 1 is not a finite number", set("H", HUGE_VAL)},
      {"reflectance rho (Kd) is 1", set("rho", 1)},
      {"exitance E (Ke) is -1", set("E", -1)},
      {"passes is -1, not a whole number from 0 to 1073741824", field("passes", -1)},
      {"passes is 1e+300", field("passes", 1e300)},
      {"transfers is 0.5", field("transfers", 0.5)},
      {"patch 0 is not followed by its other side", field("two_sided", 1)},
      {"two_sided is 7, not a whole number from 0 to 1", field("two_sided", 7)},
      {"a polygon's corner is point 99",
       [](vtkPolyData& mesh) { mesh.GetPolys()->GetConnectivityArray()->SetTuple1(1, 99); }},
      {"a polygon's corner is point 10, not in the range 0 to 9",
       [](vtkPolyData& mesh) { mesh.GetPolys()->GetConnectivityArray()->SetTuple1(1, 10); }},
      {"a polygon's corner is point -1",
       [](vtkPolyData& mesh) { mesh.GetPolys()->GetConnectivityArray()->SetTuple1(1, -1); }},
      {"face 1: no area",
       [](vtkPolyData& mesh) { mesh.GetPoints()->SetPoint(3, mesh.GetPoint(4)); }},
      {"not planar", [](vtkPolyData& mesh) { mesh.GetPoints()->SetPoint(7, 2, 2, 3); }},
      {"coordinate is not a finite number",
       [](vtkPolyData& mesh) { mesh.GetPoints()->SetPoint(7, 2, std::nan(""), 3); }},
      {"must contain polygons only", [](vtkPolyData& mesh) { mesh.SetLines(mesh.GetPolys()); }},
      {"has no polygons", [](vtkPolyData& mesh) { mesh.SetPolys(vtkNew<vtkCellArray>()); }},
      {"array \"E\" must have 3 numbers per entry",
       [](vtkPolyData& mesh) {
         vtkNew<vtkDoubleArray> gray;
         gray->SetName("E");
         gray->SetNumberOfTuples(3);
         mesh.GetCellData()->AddArray(gray);
       }},
  };
  for (const Case& wrong : cases) {
    SCOPED_TRACE(wrong.what);
    write_result(path_, solution_);
    change(wrong.edit);
    expect_refused(wrong.what);
  }
}

TEST_F(ResultReader, AllocatesNoMoreThanAFileCanHold) {
  for (const char* claim : {"1000000000000", "-1", "99999999999999999999999", "x"}) {
    write_result(path_, solution_);
    replace("NumberOfPolys=\"3\"", "NumberOfPolys=\"" + std::string(claim) + "\"");
    expect_refused("NumberOfPolys cannot be");
  }
  write_result(path_, solution_);
  replace("NumberOfComponents=\"3\"", "NumberOfComponents=\"1000\"");
  expect_refused("NumberOfComponents cannot be `1000`");
}

/// Truncated files give an error message; files with a few changed bytes give one, or a scene.
TEST_F(ResultReader, RejectsOrReadsDamagedFiles) {
  const std::string whole = read_file(path_);
  const auto error_of = [&](const std::string& text) {
    write_text(path_, text);
    std::string sentence = refusal([&] { read_result(path_); });
    EXPECT_EQ(sentence.find('\n'), std::string::npos) << sentence;
    return sentence;
  };
  for (std::size_t size = 0; size < whole.find("AppendedData>\n</"); size += 397) {
    EXPECT_NE(error_of(whole.substr(0, size)), "") << size;
  }
  std::mt19937 random(7);  // NOLINT(cert-msc51-cpp): the same files each time
  for (int k = 0; k < 150; ++k) {
    std::string text = whole;
    for (int n = 0; n <= k % 4; ++n) {
      text[random() % text.size()] = "0AzM\"<=9"[random() % 8];
    }
    error_of(text);
  }
}

TEST_F(ResultReader, CanBeCanceled) {
  const Cancellation canceled;
  canceled.cancel();
  EXPECT_THROW(read_result(path_, canceled), Canceled);
}

TEST(CliResult, DamagedOnesAreNamed) {
  const ProgramResult result = run_program({"solve", "r.vtp"});
  EXPECT_EQ(result.status, 2);
  EXPECT_THAT(result.err, HasSubstr("r.vtp: no such file"));
  const TemporaryFolder folder;
  write_text(folder / "r.vtp", "");
  EXPECT_THAT(run_program({"info", folder / "r.vtp"}).err,
              HasSubstr("r.vtp: is not a VTK file of polygons (.vtp), or is damaged"));
}

}  // namespace
}  // namespace transillum::testing::result_reader_test
