// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <cstddef>
#include <cstdint>
#include <iosfwd>
#include <string>
#include <vector>

#include "transillum/vec3.h"

namespace transillum {

/// An array of a .vtp file.
struct VtpArray {
  std::string element;     ///< beginning of its XML element
  std::size_t tuples = 0;  ///< number of entries
  std::string data;        ///< packed by zlib, in base64
};
using VtpArrays = std::vector<VtpArray>;

/// The kind of an array's entries.
enum class VtpEntries { numbers, vectors, colors };

/// Appends an array. Names are valid in XML attributes.
void add_array(VtpArrays& arrays, const std::string& name, const std::vector<std::int32_t>& values);
void add_array(VtpArrays& arrays, const std::string& name, const std::vector<std::int64_t>& values);
void add_array(VtpArrays& arrays, const std::string& name, const std::vector<std::string>& values);
/// @param entries  vectors and colors are three values each
void add_array(VtpArrays& arrays, const std::string& name, const std::vector<double>& values,
               VtpEntries entries = VtpEntries::numbers);

/// Appends an array of `count` whole numbers, value_of(0) first.
template <typename ValueOf>
void add_integers(VtpArrays& arrays, const std::string& name, int count, ValueOf value_of) {
  std::vector<std::int32_t> values;
  for (int i = 0; i < count; ++i) {
    values.push_back(value_of(i));
  }
  add_array(arrays, name, values);
}

/// Appends an array of `count` numbers, value_of(0) first.
template <typename ValueOf>
void add_numbers(VtpArrays& arrays, const std::string& name, int count, ValueOf value_of) {
  std::vector<double> values;
  for (int i = 0; i < count; ++i) {
    values.push_back(value_of(i));
  }
  add_array(arrays, name, values);
}

/// Polygons with their arrays.
struct VtpPolygons {
  VtpArrays fields;                   ///< arrays of the whole file
  VtpArrays point_data;               ///< an entry per point
  VtpArrays cell_data;                ///< an entry per polygon
  std::string scalars;                ///< the array of cell_data that programs show first
  std::vector<double> points;         ///< three coordinates each
  std::vector<std::int64_t> corners;  ///< points of all polygons
  std::vector<std::int64_t> ends;     ///< end of each polygon in `corners`

  /// Appends a point; returns its index.
  std::int64_t add_point(const Vec3& point);
};

/// Writes polygons as VTK does: PolyData in XML, arrays appended in base64, which keeps the file
/// well-formed XML, and all bits of the doubles.
/// @throws std::runtime_error if zlib fails
void write_polygons(std::ostream& out, const VtpPolygons& polygons);

}  // namespace transillum
