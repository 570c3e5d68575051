// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Scenes from VTK files: the same cube from .vtp files in all encodings of VTK's writer and from
// legacy .vtk files of two versions, results as scenes, and the message for each refused file.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkUnsignedCharArray.h>
#include <vtkXMLPolyDataWriter.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <functional>
#include <random>

#include "scene_test_support.h"
#include "support/program_call.h"
#include "support/refusal.h"
#include "transillum/files.h"
#include "transillum/solution.h"
#include "transillum/solve_options.h"
#include "transillum/solve_session.h"

namespace transillum::testing::vtk_reader_test {
namespace {

using test::cube_corners;
using test::cube_squares;
using test::expect_cube;
using test::refusal;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::SizeIs;

vtkNew<vtkPolyData> cube() {
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  for (const Vec3& p : cube_corners) {
    points->InsertNextPoint(p.x, p.y, p.z);
  }
  vtkNew<vtkCellArray> polygons;
  for (const auto& square : cube_squares) {
    polygons->InsertNextCell(static_cast<int>(square.size()));
    for (const int p : square) {
      polygons->InsertCellPoint(p);
    }
  }
  vtkNew<vtkPolyData> mesh;
  mesh->SetPoints(points);
  mesh->SetPolys(polygons);
  return mesh;
}

/// An array of RGBA, 255 0 188 for all but the last.
vtkNew<vtkUnsignedCharArray> colors(int entries) {
  vtkNew<vtkUnsignedCharArray> array;
  array->SetName("color");
  array->SetNumberOfComponents(4);
  for (int k = 0; k < entries; ++k) {
    array->InsertNextTuple4(255, 0, k + 1 < entries ? 188 : 0, 255);
  }
  return array;
}

class VtkReader : public ::testing::Test {
 protected:
  std::string path(const char* name) const { return folder_ / name; }
  SceneDescription read(const char* name, const std::string& text,
                        const ReadOptions& options = {}) const {
    write_text(path(name), text);
    return describe_scene(path(name), options);
  }
  /// The message, without the folder.
  std::string refusal_of(const char* name, const std::string& text) const {
    write_text(path(name), text);
    const std::string message = refusal([&] { (void)describe_scene(path(name)); });
    EXPECT_EQ(message.find('\n'), std::string::npos);
    const std::size_t found = message.find(name);
    return found == std::string::npos ? message : message.substr(found);
  }
  void write(
      vtkPolyData& mesh,
      const std::function<void(vtkXMLPolyDataWriter&)>& set = [](auto&) {}) const {
    vtkNew<vtkXMLPolyDataWriter> writer;
    writer->SetInputData(&mesh);
    writer->SetFileName(path("cube.vtp").c_str());
    set(*writer);
    ASSERT_EQ(writer->Write(), 1);
  }

  TemporaryFolder folder_;
};

TEST_F(VtkReader, VtpIsReadInAllItsEncodings) {
  const auto mesh = cube();
  mesh->GetCellData()->SetScalars(colors(6));
  for (const int mode : {vtkXMLWriter::Ascii, vtkXMLWriter::Binary, vtkXMLWriter::Appended}) {
    for (const bool encode : {false, true}) {
      for (const bool pack : {false, true}) {
        for (const bool wide : {false, true}) {
          for (const bool big : {false, true}) {
            SCOPED_TRACE(::testing::Message() << mode << encode << pack << wide << big);
            write(*mesh, [&](vtkXMLPolyDataWriter& writer) {
              writer.SetDataMode(mode);
              writer.SetEncodeAppendedData(encode);
              writer.SetCompressorType(pack ? vtkXMLWriter::ZLIB : vtkXMLWriter::NONE);
              writer.SetHeaderType(wide ? vtkXMLWriter::UInt64 : vtkXMLWriter::UInt32);
              if (big) {
                writer.SetByteOrderToBigEndian();
              } else {
                writer.SetByteOrderToLittleEndian();
              }
            });
            const SceneDescription read = describe_scene(path("cube.vtp"));
            expect_cube(read);
            ASSERT_THAT(read.materials, SizeIs(2));
            // 188 of 255 is a half in linear light.
            EXPECT_NEAR(read.materials[0].reflectance.b, 0.5, 0.01);
            EXPECT_EQ(read.materials[1].reflectance.b, 0);
          }
        }
      }
    }
  }
}

TEST_F(VtkReader, VtpTakesColorsOfPointsAndOtherwiseTheDefault) {
  const auto mesh = cube();
  write(*mesh);
  const SceneDescription plain = describe_scene(path("cube.vtp"), {.default_reflectance = 0.25});
  EXPECT_EQ(plain.materials[0].reflectance, (Rgb{0.25, 0.25, 0.25}));
  EXPECT_THAT(plain.notes, Contains(HasSubstr("6 of 6 faces have no color; rho = 0.25")));
  mesh->GetPointData()->AddArray(colors(9));  // the last is not used
  mesh->GetPointData()->GetArray("color")->SetNumberOfTuples(8);
  write(*mesh);
  const SceneDescription colored = describe_scene(path("cube.vtp"));
  ASSERT_THAT(colored.materials, SizeIs(1));
  EXPECT_NEAR(colored.materials[0].reflectance.b, 0.5, 0.01);
}

/// A result is also a scene, with its materials and groups: solving it gives the same bits.
TEST_F(VtkReader, ResultsAreScenes) {
  SceneDescription description = describe_scene("cornell-box");
  description.groups = {"all", "some"};
  description.face_group.assign(description.face_count(), 0);
  description.face_group.back() = 1;
  for (const bool two_sided : {false, true}) {
    const SolveOptions options{.directions = 32, .first_shot = {}};
    const Solution solution = solve(
        std::make_shared<const Scene>(description, SceneOptions{.two_sided = two_sided}), options);
    write_result(path("r.vtp"), solution);
    EXPECT_TRUE(is_result_file(path("r.vtp")));
    const auto scene = load_scene(path("r.vtp"));
    ASSERT_EQ(scene->patch_count(), solution.scene->patch_count());
    for (PatchId i = 0; i < scene->patch_count(); ++i) {
      EXPECT_EQ(scene->exitance(i), solution.scene->exitance(i));
      EXPECT_EQ(scene->reflectance(i), solution.scene->reflectance(i));
      EXPECT_EQ(scene->material(i).name, solution.scene->material(i).name);
      EXPECT_EQ(scene->patch(i).group, solution.scene->patch(i).group);
      EXPECT_DOUBLE_EQ(scene->patch(i).area, solution.scene->patch(i).area);
    }
    EXPECT_EQ(scene->groups(), solution.scene->groups());
    EXPECT_EQ(solve(scene, options).radiosity, solution.radiosity);
  }
}

TEST_F(VtkReader, TellsScenesFromResults) {
  write(*cube());
  EXPECT_FALSE(is_result_file(path("cube.vtp")));
  EXPECT_TRUE(is_scene_file(path("cube.vtp")));
  EXPECT_TRUE(is_result_file(path("none.vtp")));
  EXPECT_FALSE(is_result_file(path("r.csv")));
}

// Legacy files ----------------------------------------------------------------------------------

template <class Number>
void put(std::string& bytes, Number number) {
  std::string raw(sizeof(Number), '\0');
  std::memcpy(raw.data(), &number, sizeof(Number));
  if constexpr (std::endian::native == std::endian::little) {
    std::reverse(raw.begin(), raw.end());
  }
  bytes += raw;
}

/// The cube in version 3 or 5, with a color for each square.
std::string legacy(int version, bool binary) {
  std::string text = "# vtk DataFile Version " + std::to_string(version) + ".1\na cube\n";
  const auto add = [&](auto number) {
    if (binary) {
      put(text, number);
    } else {
      text += std::to_string(number) + " ";
    }
  };
  text += binary ? "BINARY\n" : "ASCII\n";
  text += "DATASET POLYDATA\nPOINTS 8 double\n";
  for (const Vec3& p : cube_corners) {
    for (const double value : {p.x, p.y, p.z}) {
      add(value);
    }
  }
  text += "\nMETADATA\nINFORMATION 0\n\n";
  if (version < 5) {
    text += "POLYGONS 6 30\n";
    for (const auto& square : cube_squares) {
      add(std::int32_t{4});
      for (const int p : square) {
        add(std::int32_t{p});
      }
    }
  } else {
    text += "POLYGONS 7 24\nOFFSETS vtktypeint64\n";
    for (std::int64_t k = 0; k <= 6; ++k) {
      add(4 * k);
    }
    text += "\nCONNECTIVITY vtktypeint64\n";
    for (const auto& square : cube_squares) {
      for (const int p : square) {
        add(std::int64_t{p});
      }
    }
  }
  text += "\nCELL_DATA 6\nSCALARS id int 1\nLOOKUP_TABLE default\n";
  for (std::int32_t k = 0; k < 6; ++k) {
    add(k);
  }
  text += "\nCOLOR_SCALARS color 3\n";
  for (int k = 0; k < 6; ++k) {
    if (binary) {
      text += std::string("\xff\0\xbc", 3);
    } else {
      text += "1 0 0.737254902 ";
    }
  }
  return text + "\n";
}

TEST_F(VtkReader, LegacyFilesAreReadInBothFormsAndVersions) {
  for (const int version : {3, 5}) {
    for (const bool binary : {false, true}) {
      SCOPED_TRACE(::testing::Message() << version << binary);
      const SceneDescription description = read("cube.vtk", legacy(version, binary));
      expect_cube(description);
      ASSERT_THAT(description.materials, SizeIs(1));
      EXPECT_NEAR(description.materials[0].reflectance.b, 0.5, 0.01);
      EXPECT_THAT(description.notes, SizeIs(0));
    }
  }
}

const std::string head =
    "# vtk DataFile Version 3.0\n\nASCII\nDATASET POLYDATA\nPOINTS 4 float\n"
    "0 0 0  1 0 0  0 1 0  1 1 0\n";

TEST_F(VtkReader, LegacyFilesHaveFieldsStripsAndLines) {
  const SceneDescription d = read(
      "a.vtk", head +
                   "LINES 1 3\n2 0 1\nPOLYGONS 1 4\n3 0 1 2\nTRIANGLE_STRIPS 1 5\n4 0 1 2 3\n"
                   "CELL_DATA 3\nFIELD FieldData 4\nrho 3 3 double\n0 0 0 .5 .25 .125 .75 .75 .75\n"
                   "METADATA\nINFORMATION 0\n\nE 3 3 double\n0 0 0 0 0 0 7 8 9\n"
                   "material 1 3 int\n0 1 0\nmaterials 1 2 string\nlamp\nred%20wall\n");
  ASSERT_EQ(d.face_count(), 3U);
  EXPECT_THAT(d.outline(0), ElementsAre(0, 1, 2));
  EXPECT_THAT(d.outline(1), ElementsAre(0, 1, 2));
  EXPECT_THAT(d.outline(2), ElementsAre(1, 3, 2));  // the same side
  ASSERT_THAT(d.materials, SizeIs(2));
  EXPECT_EQ(d.materials[0].name, "red wall");
  EXPECT_EQ(d.materials[0].reflectance, (Rgb{0.5, 0.25, 0.125}));
  EXPECT_EQ(d.materials[1].exitance, (Rgb{7, 8, 9}));
  EXPECT_THAT(d.notes, Contains(HasSubstr("1 vertices and lines are no polygons")));
}

TEST_F(VtkReader, LegacyFilesAreRefusedWithAPlace) {
  const auto refused = [&](const std::string& text) { return refusal_of("a.vtk", text); };
  EXPECT_EQ(refused(""),
            "a.vtk:1: is not a VTK file: its first line must be `# vtk DataFile "
            "Version …`");
  EXPECT_EQ(refused("# vtk DataFile Version 3.0\nx\nTEXT\n"),
            "a.vtk:3: `TEXT` is neither ASCII nor BINARY");
  EXPECT_EQ(refused("# vtk DataFile Version 3.0\nx\nASCII\nDATASET UNSTRUCTURED_GRID\n"),
            "a.vtk:4: its data set is `UNSTRUCTURED_GRID`; only POLYDATA can be read: extract the "
            "surface, as by ParaView's filter Extract Surface, and save that");
  EXPECT_EQ(refused(head), "a.vtk: has no polygons");
  EXPECT_EQ(refused(head + "POLYGONS 1 4\n3 0 1 4\n"),
            "a.vtk: cell 0: point 4 does not exist; there are 4");
  EXPECT_EQ(refused(head + "POLYGONS 1 4\n4 0 1 2\n"),
            "a.vtk:7: cell 0 has 4 points, of 3 numbers that are left");
  EXPECT_EQ(refused(head + "POLYGONS 2 4\n3 0 1 2\n"), "a.vtk:7: has 1 cells, of 2 that it states");
  EXPECT_EQ(refused(head + "POLYGONS 1 4\n3 0 1 x\n"), "a.vtk:8: `x` is not a number");
  EXPECT_THAT(refused(head + "POLYGONS 1 999999999999\n"),
              HasSubstr("a.vtk:7: `999999999999` is "));
  EXPECT_EQ(refused(head + "POLYGONS 1 40\n3 0 1 2\n"),
            "a.vtk:7: 40 entries of 1 numbers do not fit into the file");
  EXPECT_EQ(refused(head + "POLYGONS 1 4\n3 0 1 2\nCELL_DATA 2\n"), "a.vtk:9: has data of 2 of 1");
  EXPECT_EQ(refused(head + "POLYGONS 1 4\n3 0 1 2\nCUBES 3\n"),
            "a.vtk:9: `CUBES` is not a keyword of a VTK file of polygons");
  EXPECT_THAT(refused(head + "POLYGONS 1 4\n3 0 1 2\nCELL_DATA 1\nFIELD f 1\nE 3 1 float\n"
                             "-1 0 0\n"),
              HasSubstr("a.vtk: cell 0: red exitance E (Ke) is -1"));
  EXPECT_THAT(refused(legacy(3, true).substr(0, 150)), HasSubstr("a.vtk: byte "));
}

// When they were rounded to 1/1024, dark colors became black.
TEST_F(VtkReader, ColorsInBytesAreNotRounded) {
  const SceneDescription d = read("a.vtk",
                                  "# vtk DataFile Version 3.0\nt\nASCII\nDATASET POLYDATA\n"
                                  "POINTS 3 float\n0 0 0 1 0 0 0 1 0\nPOLYGONS 1 4\n3 0 1 2\n"
                                  "CELL_DATA 1\nFIELD f 1\ncolor 3 1 unsigned_char\n1 2 254\n");
  const Rgb rho = d.materials[0].reflectance;
  EXPECT_NEAR(rho.r, 1 / 255.0 / 12.92, 1e-12);
  EXPECT_NEAR(rho.g, 2 / 255.0 / 12.92, 1e-12);
  EXPECT_NEAR(rho.b, std::pow((254 / 255.0 + 0.055) / 1.055, 2.4), 1e-12);
}

TEST_F(VtkReader, VtpIsRefusedWithAReason) {
  const auto mesh = cube();
  write(*mesh, [](vtkXMLPolyDataWriter& writer) {
    writer.SetDataModeToAscii();
    writer.SetCompressorType(vtkXMLWriter::NONE);
  });
  const std::string good = read_file(path("cube.vtp"));
  const auto with = [&](const std::string& from, const std::string& to) {
    std::string text = good;
    text.replace(text.find(from), from.size(), to);
    return refusal_of("a.vtp", text);
  };
  EXPECT_THAT(with("<Piece", "<Piece NumberOfPoints=\"1\"/><Piece"), HasSubstr("a.vtp"));
  EXPECT_THAT(with("type=\"PolyData\"", "type=\"ImageData\""), HasSubstr("is not a VTK file"));
  EXPECT_THAT(with("NumberOfPolys=\"6\"", "NumberOfPolys=\"7\""), HasSubstr("damaged"));
  EXPECT_THAT(with("</Polys>", "</Pols>"), HasSubstr("a.vtp:"));
  EXPECT_THAT(with("byte_order", "compressor=\"vtkLZ4DataCompressor\" byte_order"),
              HasSubstr("only vtkZLibDataCompressor can be read"));
  EXPECT_THAT(with("0 3 2 1", "0 3 2 8"), HasSubstr("a.vtp: cell 0: point 8 does not exist"));
  EXPECT_THAT(with("0 3 2 1", "0 3 2 x"), HasSubstr("a.vtp: `x` is not a number"));
}

/// Truncated files, and files with changed bytes, give a scene or one line.
TEST_F(VtkReader, DamagedFilesAreReadOrRefused) {
  const auto mesh = cube();
  mesh->GetCellData()->SetScalars(colors(6));
  std::vector<std::pair<const char*, std::string>> files;
  for (const bool binary : {false, true}) {
    files.emplace_back("a.vtk", legacy(3, binary));
    files.emplace_back("a.vtk", legacy(5, binary));
  }
  for (const int mode : {vtkXMLWriter::Ascii, vtkXMLWriter::Binary, vtkXMLWriter::Appended}) {
    write(*mesh, [&](vtkXMLPolyDataWriter& writer) {
      writer.SetDataMode(mode);
      writer.SetEncodeAppendedData(false);
    });
    files.emplace_back("a.vtp", read_file(path("cube.vtp")));
  }
  std::mt19937 random(7);  // NOLINT(cert-msc51-cpp): the same files each time
  for (const auto& [name, whole] : files) {
    for (std::size_t size = 0; size < whole.size(); size += 31) {
      refusal_of(name, whole.substr(0, size));
    }
    for (int k = 0; k < 200; ++k) {
      std::string text = whole;
      for (int n = 0; n <= k % 4; ++n) {
        text[random() % text.size()] = "0Az9\"<= \xff"[random() % 9];
      }
      refusal_of(name, text);
    }
  }
}

TEST_F(VtkReader, CanBeCanceled) {
  const Cancellation canceled;
  canceled.cancel();
  write(*cube());
  EXPECT_THROW(describe_scene(path("cube.vtp"), {}, canceled), Canceled);
  write_text(path("a.vtk"), legacy(3, false));
  EXPECT_THROW(describe_scene(path("a.vtk"), {}, canceled), Canceled);
}

}  // namespace
}  // namespace transillum::testing::vtk_reader_test
