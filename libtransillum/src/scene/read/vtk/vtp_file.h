// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "transillum/cancellation.h"

namespace transillum {

/// The arrays of a .vtp file of one piece, decoded on request: as text, in base64 or raw, packed by
/// zlib or not, in either byte order. VTK's own reader may end the program on a damaged file and
/// allocates whatever sizes the file states.
///
/// All functions throw InputError naming the file.
class VtpFile {
 public:
  /// The type of an array, as the file states it.
  struct Kind {
    std::string type;  ///< such as "Float64"
    std::size_t components = 1;
  };

  /// Largest file of a result, bytes.
  static constexpr std::uintmax_t largest_result = std::uintmax_t{4} << 30;

  /// @param limit most bytes of the file
  /// @throws also Canceled
  VtpFile(const std::filesystem::path& path, const Cancellation& cancellation,
          std::uintmax_t limit = largest_result);

  const std::string& name() const { return name_; }
  std::size_t bytes() const { return text_.size(); }
  std::size_t points() const { return points_; }
  std::size_t polygons() const { return polygons_; }
  std::size_t strips() const { return strips_; }
  /// Number of vertices and lines, whose cell data come before the data of polygons.
  std::size_t other_cells() const { return other_cells_; }
  std::size_t cells() const { return other_cells_ + polygons_ + strips_; }
  [[noreturn]] void fail(const std::string& what) const;

  /// @param section FieldData, PointData, CellData, Points, Polys or Strips; the array of Points is
  /// called "Points", whatever its name in the file
  bool has(const char* section, const std::string& name) const;
  /// Names of the arrays of a section, sorted.
  std::vector<std::string> names(const char* section) const;
  /// The array named as the scalars of a section; empty if there is none.
  std::string scalars(const char* section) const;
  Kind kind(const char* section, const std::string& name) const;
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
  enum class Form { text, base64, raw };
  struct Array {
    Kind kind;
    std::size_t entries = 0;  ///< for field data only
    Form form = Form::text;
    bool appended = false;
    std::size_t begin = 0;  ///< in the file, or in the appended data
    std::size_t end = 0;    ///< in the file, of arrays that are not appended
  };
  class HeaderParser;

  const Array& array(const char* section, const std::string& name) const;
  /// The numbers of an array, whatever its type.
  template <class Value>
  std::vector<Value> values(const Array& array, std::size_t count) const;
  template <class Value>
  std::vector<Value> values_in_text(const Array& array, std::size_t count) const;
  /// The bytes of an array: `expected` of them, or at most that many if not `exactly`.
  std::vector<unsigned char> decode(const Array& array, std::size_t expected, bool exactly) const;
  std::vector<unsigned char> unpack(const Array& array, std::size_t expected, bool exactly) const;
  /// `count` bytes at `begin`, which are in base64 or raw.
  std::vector<unsigned char> bytes_at(const Array& array, std::size_t begin,
                                      std::size_t count) const;
  /// The first numbers of the header of an array.
  std::vector<std::uint64_t> header(const Array& array, std::size_t count) const;
  [[noreturn]] void refuse() const;

  std::string name_;
  const Cancellation& cancellation_;
  std::string text_;
  std::size_t data_begin_ = 0;    ///< begin of the appended data in text_
  std::size_t header_bytes_ = 4;  ///< size of a number in a header
  bool packed_ = false;           ///< by zlib
  bool swapped_ = false;          ///< its byte order is not this machine's
  std::size_t points_ = 0, polygons_ = 0, strips_ = 0, other_cells_ = 0;
  std::map<std::pair<std::string, std::string>, Array> arrays_;  ///< by section and name
  std::map<std::string, std::string> scalars_;                   ///< by section
};

}  // namespace transillum
