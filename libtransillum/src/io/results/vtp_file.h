// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "transillum/cancellation.h"

namespace transillum {

/// The arrays of a .vtp file that write_polygons() wrote, decoded on request. VTK's own reader may
/// end the program on a damaged file and allocates whatever sizes the file states.
///
/// All functions throw InputError naming the file.
class VtpFile {
 public:
  /// @throws also Canceled
  VtpFile(const std::filesystem::path& path, const Cancellation& cancellation);

  const std::string& name() const { return name_; }
  std::size_t points() const { return points_; }
  std::size_t polygons() const { return polygons_; }
  [[noreturn]] void fail(const std::string& what) const;

  /// @param section FieldData, CellData, Points or Polys
  bool has(const char* section, const std::string& name) const;
  /// Number of entries of a field data array.
  std::size_t size_of_field(const std::string& name) const;
  /// All numbers of an array, which must have this many components and entries.
  std::vector<double> numbers(const char* section, const std::string& name, std::size_t components,
                              std::size_t entries) const;
  std::vector<std::int64_t> whole_numbers(const char* section, const std::string& name,
                                          std::size_t entries) const;
  /// The strings of a field data array.
  std::vector<std::string> strings(const std::string& name) const;

 private:
  struct Array {
    std::string type;
    std::size_t components = 1, entries = 0;  ///< entries: of field data only
    std::size_t offset = 0;                   ///< in the appended data
  };
  class HeaderParser;

  const Array& array(const char* section, const std::string& name) const;
  /// The bytes of an array: `expected` of them, or at most that many if not `exactly`.
  std::vector<unsigned char> decode(const Array& array, std::size_t expected, bool exactly) const;
  std::vector<unsigned char> from_base64(std::size_t at, std::size_t bytes) const;
  [[noreturn]] void refuse() const;

  std::string name_;
  const Cancellation& cancellation_;
  std::string text_;
  std::size_t data_begin_ = 0;  ///< of the appended data in text_
  std::size_t points_ = 0, polygons_ = 0;
  std::map<std::pair<std::string, std::string>, Array> arrays_;  ///< by section and name
};

}  // namespace transillum
