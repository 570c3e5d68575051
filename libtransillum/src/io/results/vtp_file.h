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

/// A .vtp file as write_polygons() writes it: its arrays, decoded as they are asked for. VTK's own
/// reader ends the program where a file is damaged, and believes whatever sizes it tells.
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
  /// How many entries an array of field data has.
  std::size_t size_of_field(const std::string& name) const;
  /// All numbers of an array, which has to have so many components and entries.
  std::vector<double> numbers(const char* section, const std::string& name, std::size_t components,
                              std::size_t entries) const;
  std::vector<std::int64_t> whole_numbers(const char* section, const std::string& name,
                                          std::size_t entries) const;
  /// The words of an array of field data.
  std::vector<std::string> words(const std::string& name) const;

 private:
  struct Array {
    std::string type;
    std::size_t components = 1, entries = 0;  ///< entries: of field data only
    std::size_t offset = 0;                   ///< in the appended data
  };
  class Head;

  const Array& array(const char* section, const std::string& name) const;
  /// The bytes of an array; as many as `expected`, or at most so many where not `exactly`.
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
