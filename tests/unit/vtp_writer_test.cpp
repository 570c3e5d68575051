// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Arrays of .vtp files, read and written again by VTK.
#include "io/vtp_writer.h"

#include <gmock/gmock.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkStringArray.h>
#include <vtkXMLPolyDataReader.h>
#include <vtkXMLPolyDataWriter.h>

#include <sstream>

namespace transillum::testing::vtp_writer_test {
namespace {

using ::testing::StartsWith;

/// Triangles with values of every kind. 4096 numbers fill a block of compression.
VtpPolygons triangles(int count) {
  VtpPolygons mesh;
  for (int k = 0; k < count; ++k) {
    for (const Vec3& point : {Vec3{0, 0, 1.0 * k}, Vec3{1.0 / 3, 0, 1.0 * k}, Vec3{0, 1, 0.1}}) {
      mesh.corners.push_back(mesh.add_point(point));
    }
    mesh.ends.push_back(std::ssize(mesh.corners));
  }
  mesh.scalars = "number";
  add_numbers(mesh.cell_data, "number", count, [](int k) { return 1.0 / (k + 1); });
  add_integers(mesh.cell_data, "whole", count, [](int k) { return -k; });
  add_array(mesh.cell_data, "color", std::vector<double>(3 * count, 0.25), VtpEntries::colors);
  add_array(mesh.fields, "names", std::vector<std::string>{"first", "", "\u03c9 < 1"});
  add_array(mesh.fields, "none", std::vector<std::string>());
  add_array(mesh.fields, "up", std::vector{0.0, 0.5, 1.0}, VtpEntries::vectors);
  return mesh;
}

std::string written(const VtpPolygons& mesh) {
  std::ostringstream out;
  write_polygons(out, mesh);
  return out.str();
}

std::string data_of(const std::string& vtp) {
  const std::size_t begin = vtp.find('_', vtp.find("<AppendedData"));
  return vtp.substr(begin, vtp.find('\n', begin) - begin);
}

TEST(VtpWriter, VtkReadsAllValuesAndWritesTheSameData) {
  for (const int count : {0, 1, 4096, 5000}) {
    const std::string vtp = written(triangles(count));
    vtkNew<vtkXMLPolyDataReader> reader;
    reader->ReadFromInputStringOn();
    reader->SetInputString(vtp);
    reader->Update();
    vtkPolyData& mesh = *reader->GetOutput();
    ASSERT_EQ(mesh.GetNumberOfPolys(), count);
    ASSERT_EQ(mesh.GetNumberOfPoints(), 3 * count);
    EXPECT_STREQ(mesh.GetCellData()->GetScalars()->GetName(), "number");
    EXPECT_STREQ(mesh.GetCellData()->GetArray("color")->GetComponentName(2), "b");
    for (int k = 0; k < count; ++k) {
      ASSERT_EQ(mesh.GetCellData()->GetArray("number")->GetTuple1(k), 1.0 / (k + 1));
      ASSERT_EQ(mesh.GetCellData()->GetArray("whole")->GetTuple1(k), -k);
    }
    auto* names = vtkStringArray::SafeDownCast(mesh.GetFieldData()->GetAbstractArray("names"));
    ASSERT_NE(names, nullptr);
    ASSERT_EQ(names->GetNumberOfValues(), 3);
    EXPECT_EQ(mesh.GetFieldData()->GetArray("up")->GetNumberOfTuples(), 1);

    vtkNew<vtkXMLPolyDataWriter> writer;
    writer->SetInputData(&mesh);
    writer->SetHeaderTypeToUInt64();
    writer->WriteToOutputStringOn();
    ASSERT_NE(writer->Write(), 0);
    EXPECT_TRUE(data_of(writer->GetOutputString()) == data_of(vtp)) << count << " triangles";
  }
}

}  // namespace
}  // namespace transillum::testing::vtp_writer_test
