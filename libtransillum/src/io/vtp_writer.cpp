// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "io/vtp_writer.h"

#include <fmt/format.h>
#include <zlib.h>

#include <bit>
#include <ostream>
#include <span>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "base/base64.h"

namespace transillum {
namespace {

/// The block size of VTK's writer.
constexpr std::size_t block_bytes = 32768;

std::string bytes_of(std::span<const std::uint64_t> numbers) {
  return {reinterpret_cast<const char*>(numbers.data()), numbers.size_bytes()};
}

/// A header (number of blocks, size of a block, size of a last smaller block, packed sizes), then
/// the packed blocks, each in base64.
std::string encoded(std::string_view bytes) {
  std::vector<std::uint64_t> header{0, block_bytes, bytes.size() % block_bytes};
  std::string packed;
  for (std::size_t begin = 0; begin < bytes.size(); begin += block_bytes) {
    const std::string_view block = bytes.substr(begin, block_bytes);
    uLongf size = compressBound(block.size());
    const std::size_t at = packed.size();
    packed.resize(at + size);
    if (compress(reinterpret_cast<Bytef*>(packed.data() + at), &size,
                 reinterpret_cast<const Bytef*>(block.data()), block.size()) != Z_OK) {
      throw std::runtime_error("VTP: zlib could not pack an array");
    }
    packed.resize(at + size);
    header.push_back(size);
    ++header.front();
  }
  return to_base64(bytes_of(header)) + to_base64(packed);
}

template <class Value>
void add_values(VtpArrays& arrays, std::string element, const std::vector<Value>& values,
                std::size_t tuples) {
  const auto* bytes = reinterpret_cast<const char*>(values.data());
  arrays.push_back({std::move(element), tuples, encoded({bytes, values.size() * sizeof(Value)})});
}

std::string element_of(const char* type, const std::string& name) {
  return fmt::format("DataArray type=\"{}\" Name=\"{}\"", type, name);
}

}  // namespace

void add_array(VtpArrays& arrays, const std::string& name,
               const std::vector<std::int32_t>& values) {
  add_values(arrays, element_of("Int32", name), values, values.size());
}

void add_array(VtpArrays& arrays, const std::string& name,
               const std::vector<std::int64_t>& values) {
  add_values(arrays, element_of("Int64", name), values, values.size());
}

void add_array(VtpArrays& arrays, const std::string& name, const std::vector<double>& values,
               VtpEntries entries) {
  std::string element = element_of("Float64", name);
  if (entries == VtpEntries::numbers) {
    add_values(arrays, element, values, values.size());
    return;
  }
  element += " NumberOfComponents=\"3\"";
  if (entries == VtpEntries::colors) {
    element += " ComponentName0=\"r\" ComponentName1=\"g\" ComponentName2=\"b\"";
  }
  add_values(arrays, element, values, values.size() / 3);
}

void add_array(VtpArrays& arrays, const std::string& name, const std::vector<std::string>& values) {
  std::vector<char> bytes;
  for (const std::string& value : values) {
    bytes.insert(bytes.end(), value.c_str(), value.c_str() + value.size() + 1);
  }
  add_values(arrays, fmt::format("Array type=\"String\" Name=\"{}\"", name), bytes, values.size());
}

std::int64_t VtpPolygons::add_point(const Vec3& point) {
  points.insert(points.end(), {point.x, point.y, point.z});
  return static_cast<std::int64_t>(points.size() / 3) - 1;
}

void write_polygons(std::ostream& out, const VtpPolygons& polygons) {
  VtpArrays points, cells, no_cells;
  add_array(points, "Points", polygons.points, VtpEntries::vectors);
  for (VtpArrays* arrays : {&cells, &no_cells}) {
    const bool none = arrays == &no_cells;
    add_array(*arrays, "connectivity", none ? std::vector<std::int64_t>() : polygons.corners);
    add_array(*arrays, "offsets", none ? std::vector<std::int64_t>() : polygons.ends);
  }
  std::vector<const VtpArray*> written;
  std::size_t offset = 0;
  const auto write_section = [&](const std::string& name, const VtpArrays& arrays) {
    out << "    <" << name << ">\n";
    for (const VtpArray& array : arrays) {
      out << "      <" << array.element;
      if (&arrays == &polygons.fields) {
        out << fmt::format(" NumberOfTuples=\"{}\"", array.tuples);
      }
      out << fmt::format(" format=\"appended\" offset=\"{}\"/>\n", offset);
      offset += array.data.size();
      written.push_back(&array);
    }
    out << "    </" << name.substr(0, name.find(' ')) << ">\n";
  };
  out << "<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\""
      << (std::endian::native == std::endian::little ? "LittleEndian" : "BigEndian")
      << "\" header_type=\"UInt64\" compressor=\"vtkZLibDataCompressor\">\n  <PolyData>\n";
  write_section("FieldData", polygons.fields);
  out << fmt::format(
      "    <Piece NumberOfPoints=\"{}\" NumberOfVerts=\"0\" NumberOfLines=\"0\" "
      "NumberOfStrips=\"0\" NumberOfPolys=\"{}\">\n",
      polygons.points.size() / 3, polygons.ends.size());
  write_section("PointData", polygons.point_data);
  write_section("CellData Scalars=\"" + polygons.scalars + "\"", polygons.cell_data);
  write_section("Points", points);
  for (const char* name : {"Verts", "Lines", "Strips"}) {
    write_section(name, no_cells);
  }
  write_section("Polys", cells);
  out << "    </Piece>\n  </PolyData>\n  <AppendedData encoding=\"base64\">\n   _";
  for (const VtpArray* array : written) {
    out << array->data;
  }
  out << "\n  </AppendedData>\n</VTKFile>\n";
}

}  // namespace transillum
