// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "io/vtk/vtp_output.h"

#include <vtkPolyData.h>
#include <vtkStringArray.h>
#include <vtkXMLPolyDataWriter.h>

#include <ostream>
#include <stdexcept>

namespace transillum {

void add_field(vtkFieldData& fields, const char* name, double value) {
  add_numbers(fields, name, 1, [&](int) { return value; });
}

void add_field(vtkFieldData& fields, const char* name, const std::string& value) {
  vtkNew<vtkStringArray> array;
  array->SetName(name);
  array->InsertNextValue(value);
  fields.AddArray(array);
}

void write_polygons(std::ostream& out, vtkPolyData& mesh) {
  // Base64 keeps the file well-formed XML, and all bits of the doubles.
  vtkNew<vtkXMLPolyDataWriter> writer;
  writer->SetInputData(&mesh);
  writer->SetDataModeToAppended();
  writer->EncodeAppendedDataOn();
  writer->SetHeaderTypeToUInt64();
  writer->WriteToOutputStringOn();
  if (writer->Write() == 0) {
    throw std::runtime_error("VTP: VTK could not encode the polygons");
  }
  const std::string text = writer->GetOutputString();
  out.write(text.data(), static_cast<std::streamsize>(text.size()));
}

}  // namespace transillum
