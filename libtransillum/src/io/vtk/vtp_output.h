// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkIntArray.h>
#include <vtkNew.h>

#include <iosfwd>
#include <string>

class vtkPolyData;

namespace transillum {

// Field data arrays and output shared by the .vtp files of results and maps.

/// An array of `count` whole numbers, value_of(0) first.
template <typename ValueOf>
void add_integers(vtkFieldData& fields, const char* name, int count, ValueOf value_of) {
  vtkNew<vtkIntArray> array;
  array->SetName(name);
  array->SetNumberOfTuples(count);
  for (int i = 0; i < count; ++i) {
    array->SetValue(i, value_of(i));
  }
  fields.AddArray(array);
}

/// An array of `count` doubles, value_of(0) first.
template <typename ValueOf>
void add_numbers(vtkFieldData& fields, const char* name, int count, ValueOf value_of) {
  vtkNew<vtkDoubleArray> array;
  array->SetName(name);
  array->SetNumberOfTuples(count);
  for (int i = 0; i < count; ++i) {
    array->SetValue(i, value_of(i));
  }
  fields.AddArray(array);
}

/// An array of one entry.
void add_field(vtkFieldData& fields, const char* name, double value);
void add_field(vtkFieldData& fields, const char* name, const std::string& value);

/// Writes `mesh` as a .vtp file: well-formed XML that keeps all bits of the doubles.
/// @throws std::runtime_error if VTK cannot encode it
void write_polygons(std::ostream& out, vtkPolyData& mesh);

}  // namespace transillum
