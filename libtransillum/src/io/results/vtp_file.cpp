// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// A reader of .vtp files as write_polygons() writes them: XML, then appended arrays in base64,
// packed by zlib in blocks. Every size that the file states is checked against the file's own size
// before memory is allocated.
#include "io/results/vtp_file.h"

#include <expat.h>
#include <fmt/format.h>
#include <vtkBase64Utilities.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cstring>
#include <memory>
#include <optional>

#include "base/text_file.h"
#include "transillum/errors.h"

namespace transillum {
namespace {

constexpr std::uintmax_t largest_file = std::uintmax_t{4} << 30;
constexpr std::size_t max_arrays = 256, max_string_bytes = 16 << 20;
/// Lower bound of the compressed size of a point or polygon, bytes.
constexpr std::size_t min_bytes_per_item = 4;
/// Upper bound of deflate's compression ratio.
constexpr std::size_t max_compression = 1032;

constexpr std::array<std::string_view, 8> sections{"FieldData", "PointData", "CellData", "Points",
                                                   "Verts",     "Lines",     "Strips",   "Polys"};

std::optional<std::size_t> count_from(const std::string& text) {
  const std::string_view digits = trimmed(text);
  std::size_t count = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), count);
  if (error != std::errc() || end != digits.data() + digits.size()) {
    return std::nullopt;
  }
  return count;
}

std::size_t size_of_type(const std::string& type) {
  if (type == "Float64" || type == "Int64") {
    return 8;
  }
  return type == "Float32" || type == "Int32" ? 4 : 0;
}

/// Converts numbers of type Stored in `bytes` to the type of `values`, which sets their count.
template <class Stored, class Value>
void convert(const std::vector<unsigned char>& bytes, std::vector<Value>& values) {
  for (std::size_t k = 0; k < values.size(); ++k) {
    Stored stored;
    std::memcpy(&stored, bytes.data() + k * sizeof(Stored), sizeof(Stored));
    values[k] = static_cast<Value>(stored);
  }
}

}  // namespace

/// Parses the XML elements up to the appended data with expat.
class VtpFile::HeaderParser {
 public:
  explicit HeaderParser(VtpFile& file)
      : file_(file), parser_(XML_ParserCreate(nullptr), XML_ParserFree) {
    XML_SetUserData(parser_.get(), this);
    XML_SetStartElementHandler(
        parser_.get(), [](void* self, const XML_Char* element, const XML_Char** attributes) {
          static_cast<HeaderParser*>(self)->begin(element, attributes);
        });
    // Stop at a document type: without one there are no entities to expand.
    XML_SetStartDoctypeDeclHandler(
        parser_.get(), [](void* self, const XML_Char*, const XML_Char*, const XML_Char*, int) {
          static_cast<HeaderParser*>(self)->stop();
        });
  }

  /// Sets the file's members. Returns the position of the end of the tag AppendedData.
  std::size_t read() {
    constexpr std::size_t stride = 1 << 16;
    const std::string& text = file_.text_;
    for (std::size_t at = 0; at < text.size() && !stopped_; at += stride) {
      file_.cancellation_.throw_if_canceled();
      const std::size_t size = std::min(stride, text.size() - at);
      if (XML_Parse(parser_.get(), text.data() + at, static_cast<int>(size), XML_FALSE) ==
              XML_STATUS_ERROR &&
          !stopped_) {
        file_.refuse();
      }
    }
    if (!error_.empty()) {
      file_.fail(error_);
    }
    if (!complete_) {
      file_.refuse();
    }
    return std::min(text.find('>', tag_), text.size());
  }

 private:
  using Attributes = std::map<std::string, std::string>;

  void stop(const std::string& error = {}) {
    if (stopped_) {
      return;
    }
    error_ = error;
    stopped_ = true;
    XML_StopParser(parser_.get(), XML_FALSE);
  }

  void begin(const std::string& element, const XML_Char** pairs) {
    if (stopped_) {
      return;
    }
    Attributes attributes;
    for (; pairs[0] != nullptr; pairs += 2) {
      attributes[pairs[0]] = pairs[1];
    }
    if (element == "VTKFile") {
      check_format(attributes);
    } else if (element == "Piece") {
      count_piece(attributes);
    } else if (element == "DataArray" || element == "Array") {
      add_array(attributes);
    } else if (element == "AppendedData") {
      complete_ = is_vtk_ && pieces_ == 1 && attributes["encoding"] == "base64";
      tag_ = static_cast<std::size_t>(XML_GetCurrentByteIndex(parser_.get()));
      stop();
    } else if (std::count(sections.begin(), sections.end(), element) > 0) {
      section_ = element;
    }
  }

  void check_format(Attributes& attributes) {
    is_vtk_ = attributes["type"] == "PolyData";
    const char* order = std::endian::native == std::endian::little ? "LittleEndian" : "BigEndian";
    if (is_vtk_ && (attributes["byte_order"] != order || attributes["header_type"] != "UInt64" ||
                    attributes["compressor"] != "vtkZLibDataCompressor")) {
      stop(
          "does not have the encoding of transillum (UInt64 headers, zlib, native byte order); "
          "other "
          "encodings cannot be read");
    }
  }

  void count_piece(Attributes& attributes) {
    ++pieces_;
    for (const char* others : {"NumberOfVerts", "NumberOfLines", "NumberOfStrips"}) {
      if (count_from(attributes[others]) != 0) {
        stop("must contain polygons only");
      }
    }
    file_.points_ = count_of(attributes, "NumberOfPoints", max_items());
    file_.polygons_ = count_of(attributes, "NumberOfPolys", max_items());
    if (file_.polygons_ == 0) {
      stop("has no polygons");
    }
  }

  void add_array(Attributes& attributes) {
    if (file_.arrays_.size() == max_arrays) {
      stop(fmt::format("has more than {} arrays", max_arrays));
      return;
    }
    Array array{attributes["type"]};
    if (attributes.contains("NumberOfComponents")) {
      array.components = count_of(attributes, "NumberOfComponents", 9);
    }
    if (attributes.contains("NumberOfTuples")) {
      array.entries = count_of(attributes, "NumberOfTuples", max_items());
    }
    array.offset = count_of(attributes, "offset", file_.text_.size());
    file_.arrays_[{section_, attributes["Name"]}] = array;
  }

  std::size_t max_items() const { return file_.text_.size() / min_bytes_per_item; }

  std::size_t count_of(Attributes& attributes, const char* name, std::size_t max_count) {
    const std::optional<std::size_t> count = count_from(attributes[name]);
    if (count && *count <= max_count) {
      return *count;
    }
    stop(fmt::format("{} cannot be {} in a file of {} bytes", name, in_quotes(attributes[name]),
                     file_.text_.size()));
    return 0;
  }

  VtpFile& file_;
  std::unique_ptr<XML_ParserStruct, decltype(&XML_ParserFree)> parser_;
  std::string section_, error_;
  std::size_t tag_ = 0;  ///< position of the tag AppendedData
  int pieces_ = 0;
  bool is_vtk_ = false, stopped_ = false, complete_ = false;
};

VtpFile::VtpFile(const std::filesystem::path& path, const Cancellation& cancellation)
    : name_(path.string()), cancellation_(cancellation), text_(read_text_file(path, largest_file)) {
  data_begin_ = text_.find('_', HeaderParser(*this).read());
  if (data_begin_ == std::string::npos) {
    refuse();
  }
  ++data_begin_;
}

void VtpFile::fail(const std::string& what) const { throw InputError(name_ + ": " + what); }

void VtpFile::refuse() const { fail("is not a VTK file of polygons (.vtp), or is damaged"); }

bool VtpFile::has(const char* section, const std::string& name) const {
  return arrays_.contains({section, name});
}

const VtpFile::Array& VtpFile::array(const char* section, const std::string& name) const {
  const auto found = arrays_.find({section, name});
  if (found == arrays_.end()) {
    fail(fmt::format("has no array \"{}\", so it is not the result of a solve", name));
  }
  return found->second;
}

std::size_t VtpFile::size_of_field(const std::string& name) const {
  return array("FieldData", name).entries;
}

std::vector<double> VtpFile::numbers(const char* section, const std::string& name,
                                     std::size_t components, std::size_t entries) const {
  const Array& stored = array(section, name);
  const std::size_t bytes = size_of_type(stored.type);
  if (bytes == 0 || stored.components != components) {
    fail(fmt::format("array \"{}\" must have {} number{} per entry", name, components,
                     components == 1 ? "" : "s"));
  }
  std::vector<double> values(components * entries);
  const std::vector<unsigned char> raw = decode(stored, bytes * values.size(), true);
  if (stored.type == "Float64") {
    convert<double>(raw, values);
  }
  if (stored.type == "Float32") {
    convert<float>(raw, values);
  }
  if (stored.type == "Int64") {
    convert<std::int64_t>(raw, values);
  }
  if (stored.type == "Int32") {
    convert<std::int32_t>(raw, values);
  }
  return values;
}

std::vector<std::int64_t> VtpFile::whole_numbers(const char* section, const std::string& name,
                                                 std::size_t entries) const {
  const Array& stored = array(section, name);
  const bool wide = stored.type == "Int64";
  if ((!wide && stored.type != "Int32") || stored.components != 1) {
    fail(fmt::format("array \"{}\" must have one whole number per entry", name));
  }
  const std::vector<unsigned char> raw = decode(stored, (wide ? 8 : 4) * entries, true);
  std::vector<std::int64_t> values(entries);
  if (wide) {
    convert<std::int64_t>(raw, values);
  } else {
    convert<std::int32_t>(raw, values);
  }
  return values;
}

std::vector<std::string> VtpFile::strings(const std::string& name) const {
  const Array& stored = array("FieldData", name);
  if (stored.type != "String") {
    fail(fmt::format("array \"{}\" must be of type String, not {}", name, stored.type));
  }
  std::vector<std::string> strings;
  if (stored.entries == 0) {
    return strings;
  }
  std::string text;
  for (const unsigned char c : decode(stored, max_string_bytes, false)) {
    if (c != 0) {
      text += static_cast<char>(c);
    } else {
      strings.push_back(std::move(text));
      text.clear();
    }
  }
  return strings;
}

std::vector<unsigned char> VtpFile::from_base64(std::size_t at, std::size_t bytes) const {
  const std::size_t left = text_.size() - std::min(at, text_.size());
  if (bytes > left / 4 * 3) {
    refuse();
  }
  const std::size_t letters = (bytes + 2) / 3 * 4;
  std::vector<unsigned char> decoded(letters / 4 * 3);
  const auto* begin = reinterpret_cast<const unsigned char*>(text_.data()) + at;
  if (vtkBase64Utilities::DecodeSafely(begin, letters, decoded.data(), decoded.size()) < bytes) {
    refuse();
  }
  decoded.resize(bytes);
  return decoded;
}

/// An array is two runs of base64. The first has 64-bit numbers: the number of blocks, the size of
/// a block when unpacked, that of the last block if it is smaller (else 0), and the packed size of
/// each. The second has the packed blocks.
std::vector<unsigned char> VtpFile::decode(const Array& array, std::size_t expected,
                                           bool exactly) const {
  if (exactly && expected == 0) {
    return {};
  }
  const auto numbers_at = [this](std::size_t at, std::size_t count) {
    const std::vector<unsigned char> bytes = from_base64(at, 8 * count);
    std::vector<std::uint64_t> numbers(count);
    std::memcpy(numbers.data(), bytes.data(), bytes.size());
    return numbers;
  };
  const std::size_t begin = data_begin_ + array.offset;
  const std::vector<std::uint64_t> first = numbers_at(begin, 3);
  const std::uint64_t blocks = first[0], block_size = first[1], last = first[2];
  const std::uint64_t max_size = max_compression * text_.size();
  if (blocks == 0 || blocks > text_.size() || block_size == 0 || block_size > max_size ||
      last > block_size || blocks > max_size / block_size + 1) {
    refuse();
  }
  const std::uint64_t size = last > 0 ? (blocks - 1) * block_size + last : blocks * block_size;
  if (exactly ? size != expected : size > expected) {
    refuse();
  }

  const std::size_t head = 3 + static_cast<std::size_t>(blocks);
  const std::vector<std::uint64_t> numbers = numbers_at(begin, head);
  std::size_t packed_size = 0;
  for (std::size_t b = 3; b < head; ++b) {
    if (numbers[b] > text_.size() - packed_size) {
      refuse();
    }
    packed_size += numbers[b];
  }
  if (size > max_compression * packed_size) {
    refuse();
  }
  const std::vector<unsigned char> packed =
      from_base64(begin + (8 * head + 2) / 3 * 4, packed_size);
  std::vector<unsigned char> bytes(size);
  std::size_t from = 0, to = 0;
  for (std::size_t b = 3; b < head; ++b) {
    cancellation_.throw_if_canceled();
    const std::size_t expected_size = std::min<std::size_t>(block_size, size - to);
    uLongf unpacked = expected_size;
    if (::uncompress(bytes.data() + to, &unpacked, packed.data() + from, numbers[b]) != Z_OK ||
        unpacked != expected_size) {
      refuse();
    }
    from += numbers[b];
    to += expected_size;
  }
  return bytes;
}

}  // namespace transillum
