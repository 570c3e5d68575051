// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// A legacy VTK file is lines, each a keyword with counts, and after some of them numbers: as text,
// or in binary with the most significant byte first. Every count is checked against what is left of
// the file before memory is allocated. (decisions/0059-vtk-files.md)
#include "scene/read/scene_readers.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstring>
#include <optional>

#include "base/text_file.h"
#include "scene/read/vtk/vtk_polygons.h"
#include "transillum/errors.h"

namespace transillum {
namespace {

constexpr std::string_view blanks = " \t\r\n\v\f";

/// The size of a number, and how its bytes become a double.
struct Type {
  std::string_view name;
  std::size_t size;
  double (*decode)(const unsigned char*);
};

template <class Number>
double decode(const unsigned char* bytes) {
  std::array<unsigned char, sizeof(Number)> raw;
  std::memcpy(raw.data(), bytes, sizeof(Number));
  if constexpr (std::endian::native == std::endian::little) {
    std::reverse(raw.begin(), raw.end());
  }
  return static_cast<double>(std::bit_cast<Number>(raw));
}

constexpr Type types[] = {
    {"unsigned_char", 1, decode<std::uint8_t>},
    {"char", 1, decode<std::int8_t>},
    {"signed_char", 1, decode<std::int8_t>},
    {"unsigned_short", 2, decode<std::uint16_t>},
    {"short", 2, decode<std::int16_t>},
    {"unsigned_int", 4, decode<std::uint32_t>},
    {"int", 4, decode<std::int32_t>},
    {"vtkidtype", 4, decode<std::int32_t>},
    {"unsigned_long", 8, decode<std::uint64_t>},
    {"long", 8, decode<std::int64_t>},
    {"vtktypeuint64", 8, decode<std::uint64_t>},
    {"vtktypeint64", 8, decode<std::int64_t>},
    {"unsigned_long_long", 8, decode<std::uint64_t>},
    {"long_long", 8, decode<std::int64_t>},
    {"float", 4, decode<float>},
    {"double", 8, decode<double>},
};

/// %41 becomes A: names contain no blanks.
std::string decoded_name(std::string_view text) {
  std::string name;
  for (std::size_t k = 0; k < text.size(); ++k) {
    int code = 0;
    if (text[k] == '%' && k + 2 < text.size() &&
        std::from_chars(text.data() + k + 1, text.data() + k + 3, code, 16).ptr ==
            text.data() + k + 3) {
      name += static_cast<char>(code);
      k += 2;
    } else {
      name += text[k];
    }
  }
  return name;
}

class VtkReader {
 public:
  VtkReader(const std::filesystem::path& path, const Cancellation& cancellation)
      : cancellation_(cancellation), bytes_(read_binary_file(path, largest_scene_file)) {
    file_.name = path.string();
  }

  VtkPolygons read() {
    read_head();
    while (next_line()) {
      cancellation_.throw_if_canceled();
      if (!read_geometry() && !read_attribute()) {
        fail(in_quotes(words_[0]) + " is not a keyword of a VTK file of polygons");
      }
    }
    if (!has_points_) {
      fail("the file has no points");
    }
    return std::move(file_);
  }

 private:
  enum class Data { none, of_points, of_cells };

  // Lines -----------------------------------------------------------------------------------

  std::string_view line() {
    const std::string_view rest = std::string_view(bytes_).substr(position_);
    const std::size_t end = std::min(rest.find('\n'), rest.size());
    position_ = std::min(position_ + end + 1, bytes_.size());
    std::string_view found = rest.substr(0, std::min<std::size_t>(end, 4096));
    return found.ends_with('\r') ? found.substr(0, found.size() - 1) : found;
  }
  void skip_blanks() {
    position_ = std::min(bytes_.find_first_not_of(blanks, position_), bytes_.size());
  }
  /// The words of the next line that is not empty; false at the end of the file.
  bool next_line() {
    skip_blanks();
    line_begin_ = position_;
    split_words(line(), words_, 8);
    if (!words_.empty()) {
      keyword_ = lower_case(words_[0]);
    }
    return !words_.empty();
  }
  void require_line(const char* what) {
    if (!next_line()) {
      fail(fmt::format("the file ends before {}", what));
    }
  }

  void read_head() {
    if (lower_case(line()).find("vtk datafile version") == std::string::npos) {
      fail("is not a VTK file: its first line must be `# vtk DataFile Version …`");
    }
    line();  // a title
    require_line("ASCII or BINARY");
    is_binary_ = keyword_ == "binary";
    if (!is_binary_ && keyword_ != "ascii") {
      fail(in_quotes(words_[0]) + " is neither ASCII nor BINARY");
    }
    require_line("DATASET");
    if (keyword_ == "field") {  // fields of the whole file
      read_field();
      require_line("DATASET");
    }
    const std::string_view kind = words_.size() > 1 ? words_[1] : std::string_view();
    if (keyword_ != "dataset" || lower_case(kind) != "polydata") {
      fail(
          fmt::format("its data set is {}; only POLYDATA can be read: extract the surface, as by "
                      "ParaView's filter Extract Surface, and save that",
                      in_quotes(kind)));
    }
  }

  // Numbers ---------------------------------------------------------------------------------

  /// A count in the header of a section; every counted number has a byte at least.
  std::size_t count(std::size_t word) const {
    std::size_t number = 0;
    if (word < words_.size()) {
      const std::string_view text = words_[word];
      const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
      if (error == std::errc() && end == text.data() + text.size() && number <= bytes_.size()) {
        return number;
      }
    }
    fail(fmt::format("{} is not a count in a file of {} bytes",
                     in_quotes(word < words_.size() ? words_[word] : ""), bytes_.size()));
  }

  const Type& type(std::size_t word) const {
    const std::string name = word < words_.size() ? lower_case(words_[word]) : std::string();
    const auto* const found = std::find_if(std::begin(types), std::end(types),
                                           [&](const Type& known) { return known.name == name; });
    if (found == std::end(types)) {
      fail(in_quotes(word < words_.size() ? words_[word] : "") + " is not a type of numbers");
    }
    return *found;
  }

  /// The next numbers, in a file that may have fewer.
  std::vector<double> numbers(const Type& type, std::size_t count, std::size_t components = 1) {
    const std::size_t left = bytes_.size() - position_;
    const std::size_t least = is_binary_ ? type.size : 1;
    if (components > 0 && count > left / least / components + 1) {
      fail(fmt::format("{} entries of {} numbers do not fit into the file", count, components));
    }
    return is_binary_ ? binary_numbers(type, count * components)
                      : numbers_in_text(count * components);
  }
  std::vector<double> binary_numbers(const Type& type, std::size_t count) {
    if (count > (bytes_.size() - position_) / type.size) {
      fail(fmt::format("the file ends before the last of {} numbers", count));
    }
    std::vector<double> values(count);
    const auto* from = reinterpret_cast<const unsigned char*>(bytes_.data()) + position_;
    for (std::size_t k = 0; k < count; ++k, from += type.size) {
      values[k] = type.decode(from);
    }
    position_ += count * type.size;
    return values;
  }
  std::vector<double> numbers_in_text(std::size_t count) {
    std::vector<double> values;
    const std::string_view all = bytes_;
    for (std::size_t k = 0; k < count; ++k) {
      if (k % 65536 == 0) {
        cancellation_.throw_if_canceled();
      }
      skip_blanks();
      const std::size_t end = std::min(all.find_first_of(blanks, position_), all.size());
      const std::string_view word = all.substr(position_, end - position_);
      if (word.empty()) {
        fail(fmt::format("the file ends after {} of {} numbers", k, count));
      }
      const std::optional<double> value = parse_number(word);
      if (!value) {
        line_begin_ = position_;
        fail(in_quotes(word) + " is not a number");
      }
      values.push_back(*value);
      position_ = end;
    }
    return values;
  }

  std::vector<std::int64_t> whole_numbers(const Type& type, std::size_t count) {
    std::vector<std::int64_t> whole;
    for (const double value : numbers(type, count)) {
      whole.push_back(std::abs(value) <= 0x1p53 ? static_cast<std::int64_t>(value) : -1);
    }
    return whole;
  }

  // Geometry --------------------------------------------------------------------------------

  bool read_geometry() {
    if (keyword_ == "points") {
      file_.points = numbers(type(2), count(1), 3);
      has_points_ = true;
      points_ = file_.points.size() / 3;
    } else if (keyword_ == "vertices" || keyword_ == "lines") {
      file_.other_cells += read_cells().ends.size();
    } else if (keyword_ == "polygons") {
      file_.polygons = read_cells();
    } else if (keyword_ == "triangle_strips") {
      file_.strips = read_cells();
    } else if (keyword_ == "metadata") {
      skip_metadata();
    } else {
      return false;
    }
    return true;
  }

  /// Files of version 5: OFFSETS and CONNECTIVITY. Before: the number of points of each cell,
  /// followed by them.
  VtkCells read_cells() {
    const std::size_t cells = count(1), size = count(2);
    const std::size_t begin = position_, header_begin = line_begin_;
    if (next_line() && keyword_ == "offsets") {
      VtkCells read;
      read.ends = whole_numbers(type(1), cells);
      require_line("CONNECTIVITY");
      if (keyword_ != "connectivity") {
        fail("CONNECTIVITY must follow OFFSETS");
      }
      read.points = whole_numbers(type(1), size);
      if (!read.ends.empty()) {
        read.ends.erase(read.ends.begin());  // which is 0
      }
      return read;
    }
    position_ = begin;
    line_begin_ = header_begin;
    const std::vector<std::int64_t> list = whole_numbers(types[6], size);
    VtkCells read;
    for (std::size_t at = 0; at < list.size();) {
      const std::int64_t points = list[at++];
      if (points < 0 || static_cast<std::size_t>(points) > list.size() - at) {
        fail(fmt::format("cell {} has {} points, of {} numbers that are left", read.ends.size(),
                         points, list.size() - at));
      }
      const auto first = list.begin() + static_cast<std::ptrdiff_t>(at);
      read.points.insert(read.points.end(), first, first + points);
      read.ends.push_back(std::ssize(read.points));
      at += static_cast<std::size_t>(points);
    }
    if (read.ends.size() != cells) {
      fail(fmt::format("has {} cells, of {} that it states", read.ends.size(), cells));
    }
    return read;
  }

  /// To the next empty line.
  void skip_metadata() {
    while (position_ < bytes_.size() && !trimmed(line()).empty()) {
    }
  }

  // Attributes ------------------------------------------------------------------------------

  bool read_attribute() {
    if (keyword_ == "cell_data" || keyword_ == "point_data") {
      data_ = keyword_ == "cell_data" ? Data::of_cells : Data::of_points;
      entries_ = count(1);
      const std::size_t expected =
          data_ == Data::of_points
              ? points_
              : file_.other_cells + file_.polygons.ends.size() + file_.strips.ends.size();
      if (entries_ != expected) {
        fail(fmt::format("has data of {} of {}", entries_, expected));
      }
      return true;
    }
    if (keyword_ == "field") {
      read_field();
      return true;
    }
    if (keyword_ == "lookup_table") {
      numbers(types[0], count(2), 4);
      return true;
    }
    const std::optional<std::size_t> components = components_of_attribute();
    if (!components) {
      return false;
    }
    read_array(*components);
    return true;
  }

  /// The components of an attribute; empty where the keyword is none.
  std::optional<std::size_t> components_of_attribute() const {
    if (keyword_ == "scalars") {
      return words_.size() > 3 ? count(3) : 1;
    }
    if (keyword_ == "color_scalars" || keyword_ == "texture_coordinates") {
      return count(2);
    }
    if (keyword_ == "vectors" || keyword_ == "normals") {
      return 3;
    }
    if (keyword_ == "tensors" || keyword_ == "tensors6") {
      return keyword_ == "tensors" ? 9 : 6;
    }
    if (keyword_ == "global_ids" || keyword_ == "pedigree_ids" || keyword_ == "edge_flags") {
      return 1;
    }
    return {};
  }

  void read_array(std::size_t components) {
    const std::string name = words_.size() > 1 ? decoded_name(words_[1]) : std::string();
    const bool is_scalars = keyword_ == "scalars", is_color = keyword_ == "color_scalars";
    const Type& kind = is_color ? types[0] : keyword_ == "texture_coordinates" ? type(3) : type(2);
    if (is_scalars) {
      const std::size_t begin = position_, header_begin = line_begin_;
      if (!next_line() || keyword_ != "lookup_table") {
        position_ = begin;
        line_begin_ = header_begin;
      }
    }
    VtkArray array{name, components, is_color || &kind == types, {}};
    array.values = numbers(kind, entries_, components);
    if (is_color && !is_binary_) {
      for (double& value : array.values) {
        value = std::round(255 * value);
      }
    }
    if (is_scalars || is_color) {
      (data_ == Data::of_cells ? file_.cell_scalars : file_.point_scalars) = name;
    }
    keep(std::move(array));
  }

  void keep(VtkArray&& array) {
    if (is_read_by_scenes(array.name, array.components, array.has_bytes)) {
      if (data_ == Data::of_cells) {
        file_.of_cells.push_back(std::move(array));
      } else if (data_ == Data::of_points) {
        file_.of_points.push_back(std::move(array));
      }
    }
  }

  void read_field() {
    const std::size_t arrays = count(2);
    for (std::size_t k = 0; k < arrays; ++k) {
      require_line("the last array of a field");
      while (keyword_ == "metadata") {
        skip_metadata();
        require_line("the last array of a field");
      }
      const std::string name = decoded_name(words_[0]);
      const std::size_t components = count(1), entries = count(2);
      if (words_.size() > 3 && lower_case(words_[3]) == "string") {
        read_strings(name, entries);
        continue;
      }
      const Type& kind = type(3);
      VtkArray array{name, components, &kind == types, numbers(kind, entries, components)};
      if (data_ != Data::none && entries == entries_) {
        keep(std::move(array));
      }
    }
  }

  /// One per line, or in a binary file with its length in one or more bytes before it.
  void read_strings(const std::string& name, std::size_t entries) {
    std::vector<std::string> strings;
    for (std::size_t k = 0; k < entries; ++k) {
      if (position_ >= bytes_.size()) {
        fail(fmt::format("the file ends after {} of {} names", k, entries));
      }
      strings.push_back(is_binary_ ? binary_string() : decoded_name(trimmed(line())));
    }
    if (name == "materials") {
      file_.materials = strings;
    } else if (name == "groups") {
      file_.groups = strings;
    }
  }
  /// The first two bits tell how many bytes the length has: 11 one, 10 two, 01 four, 00 eight.
  std::string binary_string() {
    const auto first = static_cast<unsigned char>(bytes_[position_]);
    const std::size_t bytes = std::size_t{1} << (3 - (first >> 6));
    std::size_t length = first & 0x3f;
    if (bytes > bytes_.size() - position_) {
      fail("the file ends within a name");
    }
    for (std::size_t k = 1; k < bytes; ++k) {
      length = length << 8 | static_cast<unsigned char>(bytes_[position_ + k]);
    }
    position_ += bytes;
    if (length > bytes_.size() - position_) {
      fail(fmt::format("a name of {} bytes does not fit into the file", length));
    }
    position_ += length;
    return bytes_.substr(position_ - length, length);
  }

  [[noreturn]] void fail(const std::string& what) const {
    if (is_binary_) {
      throw InputError(fmt::format("{}: byte {}: {}", file_.name, line_begin_, what));
    }
    const auto lines =
        std::count(bytes_.begin(), bytes_.begin() + static_cast<std::ptrdiff_t>(line_begin_), '\n');
    throw InputError(fmt::format("{}:{}: {}", file_.name, lines + 1, what));
  }

  const Cancellation& cancellation_;
  const std::string bytes_;
  std::size_t position_ = 0, line_begin_ = 0;
  std::vector<std::string_view> words_;
  std::string keyword_;  ///< the first of them in lower case
  bool is_binary_ = false, has_points_ = false;
  std::size_t points_ = 0;
  Data data_ = Data::none;
  std::size_t entries_ = 0;  ///< number of entries in each array of data_
  VtkPolygons file_;
};

}  // namespace

SceneDescription read_vtk(const std::filesystem::path& path, const ReadOptions& options,
                          const Cancellation& cancellation) {
  return scene_of(VtkReader(path, cancellation).read(), options, cancellation);
}

}  // namespace transillum
