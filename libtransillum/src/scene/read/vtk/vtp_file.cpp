// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// A reader of .vtp files: XML, with arrays as text, in base64 or appended behind it. Every size
// that the file states is checked against the file's own size before memory is allocated.
// (decisions/0036-results-read-back.md)
#include "scene/read/vtk/vtp_file.h"

#include <expat.h>
#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstring>
#include <memory>

#include "base/base64.h"
#include "base/text_file.h"
#include "transillum/errors.h"

namespace transillum {
namespace {

#if XML_MAJOR_VERSION == 2 && XML_MINOR_VERSION < 9
// The names that Expat 2.9 has for these.
// NOLINTBEGIN(readability-identifier-naming)
constexpr auto* XML_GetCurrentLineNumber64 = XML_GetCurrentLineNumber;
constexpr auto* XML_GetCurrentByteIndex64 = XML_GetCurrentByteIndex;
constexpr auto* XML_GetCurrentByteCount64 = XML_GetCurrentByteCount;
// NOLINTEND(readability-identifier-naming)
#endif

constexpr std::size_t max_arrays = 256, max_string_bytes = 16 << 20;
/// Upper bound of deflate's compression ratio.
constexpr std::size_t max_compression = 1032;
constexpr std::string_view xml_blanks = " \t\r\n\v\f";

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
  if (type == "Float64" || type == "Int64" || type == "UInt64") {
    return 8;
  }
  if (type == "Float32" || type == "Int32" || type == "UInt32") {
    return 4;
  }
  if (type == "Int16" || type == "UInt16") {
    return 2;
  }
  return type == "Int8" || type == "UInt8" ? 1 : 0;
}

/// A number of a file as a Value; whole numbers that it cannot hold, and what is not a number,
/// become -1, which is never valid.
template <class Value, class Stored>
Value value_of(Stored stored) {
  if constexpr (std::is_integral_v<Value> && std::is_floating_point_v<Stored>) {
    return std::abs(stored) <= Stored(0x1p53) ? static_cast<Value>(stored) : static_cast<Value>(-1);
  }
  return static_cast<Value>(stored);
}

/// Converts numbers of type Stored in `bytes` to the type of `values`, which sets their count.
template <class Stored, class Value>
void convert(const std::vector<unsigned char>& bytes, bool swapped, std::vector<Value>& values) {
  for (std::size_t k = 0; k < values.size(); ++k) {
    std::array<unsigned char, sizeof(Stored)> raw;
    std::memcpy(raw.data(), bytes.data() + k * sizeof(Stored), sizeof(Stored));
    if (swapped) {
      std::reverse(raw.begin(), raw.end());
    }
    values[k] = value_of<Value>(std::bit_cast<Stored>(raw));
  }
}

template <class Value>
void convert(const std::string& type, const std::vector<unsigned char>& bytes, bool swapped,
             std::vector<Value>& values) {
  if (type == "Float64") {
    convert<double>(bytes, swapped, values);
  } else if (type == "Float32") {
    convert<float>(bytes, swapped, values);
  } else if (type == "Int64") {
    convert<std::int64_t>(bytes, swapped, values);
  } else if (type == "UInt64") {
    convert<std::uint64_t>(bytes, swapped, values);
  } else if (type == "Int32") {
    convert<std::int32_t>(bytes, swapped, values);
  } else if (type == "UInt32") {
    convert<std::uint32_t>(bytes, swapped, values);
  } else if (type == "Int16") {
    convert<std::int16_t>(bytes, swapped, values);
  } else if (type == "UInt16") {
    convert<std::uint16_t>(bytes, swapped, values);
  } else if (type == "Int8") {
    convert<std::int8_t>(bytes, swapped, values);
  } else {
    convert<std::uint8_t>(bytes, swapped, values);
  }
}

std::size_t base64_size(std::size_t bytes) { return (bytes + 2) / 3 * 4; }

}  // namespace

/// Parses the XML elements up to the appended data with expat.
class VtpFile::HeaderParser {
 public:
  explicit HeaderParser(VtpFile& file)
      : file_(file), parser_(XML_ParserCreate(nullptr), XML_ParserFree) {
    XML_SetUserData(parser_.get(), this);
    XML_SetElementHandler(
        parser_.get(),
        [](void* self, const XML_Char* element, const XML_Char** attributes) {
          static_cast<HeaderParser*>(self)->begin(element, attributes);
        },
        [](void* self, const XML_Char* element) {
          static_cast<HeaderParser*>(self)->end(element);
        });
    // Stop at a document type: without one there are no entities to expand.
    XML_SetStartDoctypeDeclHandler(
        parser_.get(), [](void* self, const XML_Char*, const XML_Char*, const XML_Char*, int) {
          static_cast<HeaderParser*>(self)->stop();
        });
  }

  /// Sets the file's members. Returns the position of the end of the tag AppendedData, or the size
  /// of the file without one.
  std::size_t read() {
    constexpr std::size_t stride = 1 << 16;
    const std::string& text = file_.text_;
    for (std::size_t at = 0; at < text.size() && !stopped_; at += stride) {
      file_.cancellation_.throw_if_canceled();
      const std::size_t size = std::min(stride, text.size() - at);
      const int is_last = at + size == text.size() ? XML_TRUE : XML_FALSE;
      if (XML_Parse(parser_.get(), text.data() + at, static_cast<int>(size), is_last) ==
              XML_STATUS_ERROR &&
          !stopped_) {
        refuse_at_line();
      }
    }
    if (!error_.empty()) {
      file_.fail(error_);
    }
    if (!is_vtk_ || pieces_ != 1 || (stopped_ && !complete_)) {
      file_.refuse();
    }
    return complete_ ? std::min(text.find('>', tag_), text.size()) : text.size();
  }

 private:
  using Attributes = std::map<std::string, std::string>;

  [[noreturn]] void refuse_at_line() const {
    if (!is_vtk_) {
      file_.refuse();
    }
    throw InputError(fmt::format("{}:{}: is not a VTK file of polygons (.vtp), or is damaged",
                                 file_.name_, XML_GetCurrentLineNumber64(parser_.get())));
  }
  void stop(const std::string& error = {}) {
    if (stopped_) {
      return;
    }
    error_ = error;
    stopped_ = true;
    XML_StopParser(parser_.get(), XML_FALSE);
  }
  std::size_t position() const {
    return static_cast<std::size_t>(XML_GetCurrentByteIndex64(parser_.get()));
  }
  std::size_t tag_end() const {
    return position() + static_cast<std::size_t>(XML_GetCurrentByteCount64(parser_.get()));
  }

  void begin(const std::string& element, const XML_Char** pairs) {
    if (stopped_) {
      return;
    }
    end_of_text();
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
      is_raw_ = attributes["encoding"] == "raw";
      if (!is_raw_ && attributes["encoding"] != "base64") {
        stop("appended data must be in base64 or raw");
        return;
      }
      complete_ = true;
      tag_ = position();
      stop();
    } else if (std::count(sections.begin(), sections.end(), element) > 0) {
      section_ = element;
      if (attributes.contains("Scalars")) {
        file_.scalars_[element] = attributes["Scalars"];
      }
    }
  }

  void end(const std::string& element) {
    if (stopped_) {
      return;
    }
    end_of_text();
    if (element == "DataArray" || element == "Array") {
      array_ = nullptr;
    } else {
      text_begin_ = tag_end();
    }
  }

  /// The text of an array is what is between two tags and not blank.
  void end_of_text() {
    if (array_ == nullptr || array_->appended || array_->end > 0) {
      return;
    }
    const std::size_t end = std::min(position(), file_.text_.size());
    const std::size_t begin = std::min(file_.text_.find_first_not_of(xml_blanks, text_begin_), end);
    if (begin < end) {
      array_->begin = begin;
      array_->end = end;
    }
  }

  void check_format(Attributes& attributes) {
    is_vtk_ = attributes["type"] == "PolyData";
    if (!is_vtk_) {
      return;
    }
    const bool is_little = attributes["byte_order"] != "BigEndian";
    file_.swapped_ = is_little != (std::endian::native == std::endian::little);
    file_.header_bytes_ = attributes["header_type"] == "UInt64" ? 8 : 4;
    const std::string& compressor = attributes["compressor"];
    file_.packed_ = !compressor.empty();
    if (file_.packed_ && compressor != "vtkZLibDataCompressor") {
      stop(fmt::format("is packed by {}; only vtkZLibDataCompressor can be read",
                       in_quotes(compressor)));
    }
  }

  void count_piece(Attributes& attributes) {
    if (++pieces_ > 1) {
      stop("has more than one piece");
      return;
    }
    const auto optional_count = [&](const char* name) {
      return attributes.contains(name) ? count_of(attributes, name, max_items()) : 0;
    };
    file_.other_cells_ = optional_count("NumberOfVerts") + optional_count("NumberOfLines");
    file_.strips_ = optional_count("NumberOfStrips");
    file_.points_ = count_of(attributes, "NumberOfPoints", max_items());
    file_.polygons_ = optional_count("NumberOfPolys");
    if (file_.polygons_ + file_.strips_ == 0) {
      stop("has no polygons");
    }
  }

  void add_array(Attributes& attributes) {
    if (file_.arrays_.size() == max_arrays) {
      stop(fmt::format("has more than {} arrays", max_arrays));
      return;
    }
    Array array;
    array.kind.type = attributes["type"];
    if (attributes.contains("NumberOfComponents")) {
      array.kind.components = count_of(attributes, "NumberOfComponents", 9);
    }
    if (attributes.contains("NumberOfTuples")) {
      array.entries = count_of(attributes, "NumberOfTuples", max_items());
    }
    const std::string& format = attributes["format"];
    array.form = format == "ascii" ? Form::text : Form::base64;
    array.appended = format == "appended";
    if (array.appended) {
      array.begin = count_of(attributes, "offset", file_.text_.size());
    }
    array_ = &file_.arrays_[{section_, section_ == "Points" ? "Points" : attributes["Name"]}];
    *array_ = array;
    text_begin_ = tag_end();
  }

  std::size_t max_items() const { return file_.text_.size(); }

  std::size_t count_of(Attributes& attributes, const char* name, std::size_t max_count) {
    const std::optional<std::size_t> count = count_from(attributes[name]);
    if (count && *count <= max_count) {
      return *count;
    }
    stop(fmt::format("{} cannot be {} in a file of {} bytes", name, in_quotes(attributes[name]),
                     file_.text_.size()));
    return 0;
  }

 public:
  bool is_raw() const { return is_raw_; }

 private:
  VtpFile& file_;
  std::unique_ptr<XML_ParserStruct, decltype(&XML_ParserFree)> parser_;
  std::string section_, error_;
  Array* array_ = nullptr;      ///< whose element is open
  std::size_t text_begin_ = 0;  ///< begin of the text after the last tag in it
  std::size_t tag_ = 0;         ///< position of the tag AppendedData
  int pieces_ = 0;
  bool is_vtk_ = false, stopped_ = false, complete_ = false, is_raw_ = false;
};

VtpFile::VtpFile(const std::filesystem::path& path, const Cancellation& cancellation,
                 std::uintmax_t limit)
    : name_(path.string()), cancellation_(cancellation), text_(read_binary_file(path, limit)) {
  HeaderParser parser(*this);
  const std::size_t tag_end = parser.read();
  data_begin_ = std::min(text_.find('_', tag_end), text_.size() - 1) + 1;
  for (auto& [name, array] : arrays_) {
    if (array.appended) {
      array.form = parser.is_raw() ? Form::raw : Form::base64;
      array.begin = std::min(array.begin, text_.size() - data_begin_) + data_begin_;
      array.end = text_.size();
    }
  }
}

void VtpFile::fail(const std::string& what) const { throw InputError(name_ + ": " + what); }

void VtpFile::refuse() const { fail("is not a VTK file of polygons (.vtp), or is damaged"); }

bool VtpFile::has(const char* section, const std::string& name) const {
  return arrays_.contains({section, name});
}

std::vector<std::string> VtpFile::names(const char* section) const {
  std::vector<std::string> names;
  for (const auto& [key, array] : arrays_) {
    if (key.first == section) {
      names.push_back(key.second);
    }
  }
  return names;
}

std::string VtpFile::scalars(const char* section) const {
  const auto found = scalars_.find(section);
  return found == scalars_.end() ? std::string() : found->second;
}

VtpFile::Kind VtpFile::kind(const char* section, const std::string& name) const {
  return array(section, name).kind;
}

const VtpFile::Array& VtpFile::array(const char* section, const std::string& name) const {
  const auto found = arrays_.find({section, name});
  if (found == arrays_.end()) {
    fail(fmt::format("has no array \"{}\"", name));
  }
  return found->second;
}

std::size_t VtpFile::size_of_field(const std::string& name) const {
  return array("FieldData", name).entries;
}

std::vector<double> VtpFile::numbers(const char* section, const std::string& name,
                                     std::size_t components, std::size_t entries) const {
  const Array& stored = array(section, name);
  if (size_of_type(stored.kind.type) == 0 || stored.kind.components != components) {
    fail(fmt::format("array \"{}\" must have {} number{} per entry", name, components,
                     components == 1 ? "" : "s"));
  }
  return values<double>(stored, components * entries);
}

std::vector<std::int64_t> VtpFile::whole_numbers(const char* section, const std::string& name,
                                                 std::size_t entries) const {
  const Array& stored = array(section, name);
  if (size_of_type(stored.kind.type) == 0 || stored.kind.components != 1) {
    fail(fmt::format("array \"{}\" must have one whole number per entry", name));
  }
  return values<std::int64_t>(stored, entries);
}

std::vector<std::string> VtpFile::strings(const std::string& name) const {
  const Array& stored = array("FieldData", name);
  if (stored.kind.type != "String") {
    fail(fmt::format("array \"{}\" must be of type String, not {}", name,
                     in_quotes(stored.kind.type)));
  }
  std::vector<std::string> strings;
  if (stored.entries == 0) {
    return strings;
  }
  const auto bytes = stored.form == Form::text
                         ? values_in_text<unsigned char>(stored, max_string_bytes)
                         : decode(stored, max_string_bytes, false);
  std::string text;
  for (const unsigned char c : bytes) {
    if (c != 0) {
      text += static_cast<char>(c);
    } else {
      strings.push_back(std::move(text));
      text.clear();
    }
  }
  return strings;
}

template <class Value>
std::vector<Value> VtpFile::values(const Array& array, std::size_t count) const {
  if (array.form == Form::text) {
    std::vector<Value> values = values_in_text<Value>(array, count);
    if (values.size() != count) {
      refuse();
    }
    return values;
  }
  const std::vector<unsigned char> bytes =
      decode(array, size_of_type(array.kind.type) * count, true);
  std::vector<Value> values(count);
  convert(array.kind.type, bytes, swapped_, values);
  return values;
}

/// The numbers between the tags of an array, at most `most`.
template <class Value>
std::vector<Value> VtpFile::values_in_text(const Array& array, std::size_t most) const {
  const std::string_view text =
      std::string_view(text_).substr(array.begin, array.end - array.begin);
  std::vector<Value> values;
  std::size_t begin = std::min(text.find_first_not_of(xml_blanks), text.size());
  while (begin < text.size()) {
    if (values.size() % 65536 == 0) {
      cancellation_.throw_if_canceled();
    }
    const std::size_t end = std::min(text.find_first_of(xml_blanks, begin), text.size());
    const std::string_view word = text.substr(begin, end - begin);
    const std::optional<double> number = parse_number(word);
    if (!number || values.size() == most) {
      fail(number ? fmt::format("an array has more than {} numbers", most)
                  : fmt::format("{} is not a number", in_quotes(word)));
    }
    if constexpr (std::is_same_v<Value, unsigned char>) {
      values.push_back(static_cast<unsigned char>(std::clamp(*number, 0.0, 255.0)));
    } else {
      values.push_back(value_of<Value>(*number));
    }
    begin = std::min(text.find_first_not_of(xml_blanks, end), text.size());
  }
  return values;
}

std::vector<unsigned char> VtpFile::bytes_at(const Array& array, std::size_t begin,
                                             std::size_t count) const {
  const std::size_t left = array.end - std::min(begin, array.end);
  const char* const from = text_.data() + begin;
  if (array.form == Form::raw) {
    if (count > left) {
      refuse();
    }
    return {from, from + count};
  }
  if (count > left / 4 * 3) {
    refuse();
  }
  std::vector<unsigned char> decoded(count);
  if (!from_base64({from, base64_size(count)}, decoded)) {
    refuse();
  }
  return decoded;
}

std::vector<std::uint64_t> VtpFile::header(const Array& array, std::size_t count) const {
  const std::vector<unsigned char> bytes = bytes_at(array, array.begin, header_bytes_ * count);
  std::vector<std::uint64_t> numbers(count);
  convert(header_bytes_ == 8 ? "UInt64" : "UInt32", bytes, swapped_, numbers);
  return numbers;
}

/// An array that is not packed is its size in bytes and these bytes, in one sequence of base64.
std::vector<unsigned char> VtpFile::decode(const Array& array, std::size_t expected,
                                           bool exactly) const {
  if (exactly && expected == 0) {
    return {};
  }
  if (packed_) {
    return unpack(array, expected, exactly);
  }
  const std::uint64_t size = header(array, 1).front();
  if (exactly ? size != expected : size > expected) {
    refuse();
  }
  std::vector<unsigned char> bytes =
      bytes_at(array, array.begin, header_bytes_ + static_cast<std::size_t>(size));
  bytes.erase(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(header_bytes_));
  return bytes;
}

/// A packed array is two sequences. The first has numbers: the number of blocks, the size of a
/// block when unpacked, the size of the last block if it is smaller (else 0), and the packed size
/// of each. The second has the packed blocks.
std::vector<unsigned char> VtpFile::unpack(const Array& array, std::size_t expected,
                                           bool exactly) const {
  const std::vector<std::uint64_t> first = header(array, 3);
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
  const std::vector<std::uint64_t> numbers = header(array, head);
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
  const std::size_t head_bytes = header_bytes_ * head;
  const std::vector<unsigned char> packed = bytes_at(
      array, array.begin + (array.form == Form::raw ? head_bytes : base64_size(head_bytes)),
      packed_size);
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
