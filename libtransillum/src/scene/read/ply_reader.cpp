// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// A PLY file is a header, which names elements and their properties, and then their values. Every
// count that it states is checked against what is left of the file before memory is allocated.
// (decisions/0056-readers-of-formats.md)
#include "scene/read/scene_readers.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cstring>
#include <optional>

#include "base/text_file.h"
#include "scene/build/description_check.h"
#include "scene/build/warnings.h"
#include "scene/read/face_materials.h"
#include "scene/read/texture_average.h"
#include "transillum/at.h"

namespace transillum {
namespace {

enum class Type { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

std::optional<Type> type_named(std::string_view name) {
  struct Named {
    std::string_view name;
    Type type;
  };
  static constexpr std::array<Named, 16> names{{{"char", Type::int8},
                                                {"int8", Type::int8},
                                                {"uchar", Type::uint8},
                                                {"uint8", Type::uint8},
                                                {"short", Type::int16},
                                                {"int16", Type::int16},
                                                {"ushort", Type::uint16},
                                                {"uint16", Type::uint16},
                                                {"int", Type::int32},
                                                {"int32", Type::int32},
                                                {"uint", Type::uint32},
                                                {"uint32", Type::uint32},
                                                {"float", Type::float32},
                                                {"float32", Type::float32},
                                                {"double", Type::float64},
                                                {"float64", Type::float64}}};
  for (const Named& named : names) {
    if (named.name == name) {
      return named.type;
    }
  }
  return {};
}

std::size_t size_of(Type type) {
  constexpr std::array<std::size_t, 8> sizes{1, 1, 2, 2, 4, 4, 4, 8};
  return sizes[static_cast<std::size_t>(type)];
}

bool is_whole(Type type) { return type != Type::float32 && type != Type::float64; }

template <class Number>
double value_of(std::array<unsigned char, 8> bytes) {
  Number number;
  std::memcpy(&number, bytes.data(), sizeof(Number));
  return static_cast<double>(number);
}

double decode(Type type, const std::array<unsigned char, 8>& bytes) {
  switch (type) {
    case Type::int8:
      return value_of<std::int8_t>(bytes);
    case Type::uint8:
      return value_of<std::uint8_t>(bytes);
    case Type::int16:
      return value_of<std::int16_t>(bytes);
    case Type::uint16:
      return value_of<std::uint16_t>(bytes);
    case Type::int32:
      return value_of<std::int32_t>(bytes);
    case Type::uint32:
      return value_of<std::uint32_t>(bytes);
    case Type::float32:
      return value_of<float>(bytes);
    case Type::float64:
      break;
  }
  return value_of<double>(bytes);
}

struct Property {
  std::string name;
  Type type = Type::float32;
  std::optional<Type> count;  ///< type of the counts of lists
};

struct Element {
  std::string name;
  std::size_t count = 0;
  std::vector<Property> properties;

  /// The position of the first property with one of these names, or -1.
  int find(std::initializer_list<std::string_view> names, bool is_list = false) const {
    for (std::size_t k = 0; k < properties.size(); ++k) {
      const bool named = std::find(names.begin(), names.end(), properties[k].name) != names.end();
      if (named && properties[k].count.has_value() == is_list) {
        return static_cast<int>(k);
      }
    }
    return -1;
  }
};

/// Three properties of an element that make a color.
struct ColorProperties {
  std::array<int, 3> at{-1, -1, -1};
  std::array<bool, 3> is_whole{};

  ColorProperties() = default;
  ColorProperties(const Element& element, std::array<std::string_view, 3> names,
                  std::array<std::string_view, 3> others = {}) {
    for (std::size_t c = 0; c < 3; ++c) {
      at[c] = element.find({names[c], others[c]});
      is_whole[c] =
          at[c] >= 0 && transillum::is_whole(transillum::at(element.properties, at[c]).type);
    }
  }
  explicit operator bool() const { return at[0] >= 0 && at[1] >= 0 && at[2] >= 0; }
  /// Whether they are bytes by the transfer function of sRGB.
  bool in_bytes() const { return is_whole[0] && is_whole[1] && is_whole[2]; }

  Rgb color(const std::vector<double>& values) const {
    const auto channel = [&](std::size_t c) {
      const double v = transillum::at(values, at[c]);
      if (!is_whole[c]) {
        return v;
      }
      return linear_of_srgb(static_cast<std::uint8_t>(std::clamp(v, 0.0, 255.0)));
    };
    return {channel(0), channel(1), channel(2)};
  }
};

class PlyReader {
 public:
  PlyReader(const std::filesystem::path& path, const ReadOptions& options,
            const Cancellation& cancellation)
      : cancellation_(cancellation), bytes_(read_binary_file(path, largest_scene_file)) {
    description_.name = path.string();
    description_.files = {path.string()};
    materials_.emplace(description_, options);
  }

  SceneDescription read() {
    skip_byte_order_mark();
    read_header();
    for (const Element& element : elements_) {
      if (element.name == "vertex") {
        read_vertices(element);
      } else if (element.name == "face") {
        read_faces(element);
      } else if (element.name == "tristrips") {
        read_strips(element);
      } else {
        for_each_entry(element, [](std::size_t) {});
      }
    }
    check_indices();
    materials_->note(notes_, "");
    description_.notes = notes_.sentences();
    return std::move(description_);
  }

 private:
  enum class Form { ascii, little, big };

  // Header ----------------------------------------------------------------------------------

  void skip_byte_order_mark() {
    constexpr std::string_view mark = "\xef\xbb\xbf";
    position_ = std::string_view(bytes_).starts_with(mark) ? mark.size() : 0;
  }

  std::string_view header_line() {
    ++line_;
    const std::string_view rest = std::string_view(bytes_).substr(position_);
    const std::size_t end = rest.find('\n');
    if (end == std::string_view::npos || end > 65536) {
      fail("the header has no end (end_header)");
    }
    position_ += end + 1;
    std::string_view line = rest.substr(0, end);
    if (line.ends_with('\r')) {
      line.remove_suffix(1);
    }
    return line;
  }

  void read_header() {
    if (trimmed(header_line()) != "ply") {
      fail("is not a PLY file: its first line must be `ply`");
    }
    bool has_form = false;
    for (;;) {
      split_words(header_line(), words_, 6);
      if (words_.empty() || words_[0] == "comment" || words_[0] == "obj_info") {
        continue;
      }
      if (words_[0] == "end_header") {
        break;
      }
      if (words_[0] == "format") {
        read_form();
        has_form = true;
      } else if (words_[0] == "element") {
        add_element();
      } else if (words_[0] == "property") {
        add_property();
      } else {
        notes_.add("unknown lines of the header, ignored",
                   fmt::format("{}:{}: {} is not a keyword of a PLY header; line ignored",
                               description_.name, line_, in_quotes(words_[0])));
      }
    }
    if (!has_form) {
      fail("the header has no format");
    }
    // If each entry has a line, text after its values on the line is ignored.
    std::size_t entries = 0;
    for (const Element& element : elements_) {
      entries += element.count;
    }
    const auto lines =
        std::count(bytes_.begin() + static_cast<std::ptrdiff_t>(position_), bytes_.end(), '\n');
    has_lines_ = form_ == Form::ascii && static_cast<std::size_t>(lines) + 1 >= entries;
    for (const Element& element : elements_) {
      if (element.properties.empty() && element.count > 0) {
        fail(fmt::format("element {} has no properties", in_quotes(element.name)));
      }
    }
  }

  void read_form() {
    const std::string_view form = words_.size() > 1 ? words_[1] : std::string_view();
    if (form == "ascii") {
      form_ = Form::ascii;
    } else if (form == "binary_little_endian") {
      form_ = Form::little;
    } else if (form == "binary_big_endian") {
      form_ = Form::big;
    } else {
      fail(fmt::format("format {} is not ascii, binary_little_endian or binary_big_endian",
                       in_quotes(form)));
    }
  }

  void add_element() {
    std::size_t count = 0;
    if (words_.size() == 3) {
      const auto [end, error] =
          std::from_chars(words_[2].data(), words_[2].data() + words_[2].size(), count);
      // Every entry has a byte at least.
      if (error == std::errc() && end == words_[2].data() + words_[2].size() &&
          count <= bytes_.size()) {
        elements_.push_back({std::string(words_[1]), count, {}});
        return;
      }
    }
    fail(fmt::format("an element must have a name and a count of at most {}, the size of the file",
                     bytes_.size()));
  }

  void add_property() {
    const bool is_list = words_.size() == 5 && words_[1] == "list";
    const auto type = type_named(words_.size() < 3 ? std::string_view() : words_[is_list ? 3 : 1]);
    const auto count = is_list ? type_named(words_[2]) : std::nullopt;
    if (elements_.empty() || !type ||
        (is_list ? !count || !is_whole(*count) : words_.size() != 3)) {
      fail("a property must be `TYPE NAME` or `list TYPE TYPE NAME`, after an element");
    }
    elements_.back().properties.push_back({std::string(words_.back()), *type, count});
  }

  // Values ----------------------------------------------------------------------------------

  /// Calls visit(k) with the single values of entry k in values_, and its lists in lists_.
  template <class Visit>
  void for_each_entry(const Element& element, Visit visit) {
    entry_name_ = element.name;
    values_.assign(element.properties.size(), 0);
    lists_.resize(element.properties.size());
    for (entry_ = 0; entry_ < element.count; ++entry_) {
      if (entry_ % 4096 == 0) {
        cancellation_.throw_if_canceled();
      }
      for (std::size_t p = 0; p < element.properties.size(); ++p) {
        const Property& property = element.properties[p];
        if (property.count) {
          read_list(property, lists_[p]);
        } else {
          values_[p] = number(property.type);
        }
      }
      visit(entry_);
      if (has_lines_) {
        position_ = std::min(bytes_.find('\n', position_), bytes_.size());
      }
    }
  }

  void read_list(const Property& property, std::vector<double>& list) {
    const double count = number(*property.count);
    const std::size_t least = form_ == Form::ascii ? 1 : size_of(property.type);
    const std::size_t left = bytes_.size() - position_;
    if (!(count >= 0 && count <= static_cast<double>(left / least))) {
      fail_entry(fmt::format("a list of {} numbers does not fit into the file", count));
    }
    list.clear();
    for (double k = 0; k < count; ++k) {
      list.push_back(number(property.type));
    }
  }

  double number(Type type) {
    if (form_ == Form::ascii) {
      return number_in_text();
    }
    const std::size_t size = size_of(type);
    if (bytes_.size() - position_ < size) {
      fail_entry("the file ends before it");
    }
    std::array<unsigned char, 8> bytes{};
    std::memcpy(bytes.data(), bytes_.data() + position_, size);
    position_ += size;
    const bool is_big = std::endian::native == std::endian::big;
    if ((form_ == Form::big) != is_big) {
      std::reverse(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(size));
    }
    return decode(type, bytes);
  }

  double number_in_text() {
    constexpr std::string_view blanks = " \t\r\n\v\f";
    const std::string_view all = bytes_;
    const std::size_t begin = std::min(all.find_first_not_of(blanks, position_), all.size());
    const std::size_t end = std::min(all.find_first_of(blanks, begin), all.size());
    if (begin == end) {
      fail_entry("the file ends before it");
    }
    position_ = end;
    const std::string_view word = all.substr(begin, end - begin);
    const std::optional<double> value = parse_number(word);
    if (!value) {
      fail_entry(in_quotes(word) + " is not a number");
    }
    return *value;
  }

  // Elements --------------------------------------------------------------------------------

  void read_vertices(const Element& element) {
    const std::array<int, 3> position{element.find({"x"}), element.find({"y"}),
                                      element.find({"z"})};
    if (*std::min_element(position.begin(), position.end()) < 0) {
      fail("element `vertex` must have properties x, y and z");
    }
    vertex_color_ = ColorProperties(element, {"red", "green", "blue"}, {"r", "g", "b"});
    for_each_entry(element, [&](std::size_t) {
      const Vec3 p{at(values_, position[0]), at(values_, position[1]), at(values_, position[2])};
      if (!is_finite(p) || max_abs(p) > largest_coordinate) {
        fail_entry(fmt::format("not a finite point of at most {}", largest_coordinate));
      }
      description_.points.push_back(p);
      if (vertex_color_) {
        vertex_colors_.push_back(vertex_color_.color(values_));
      }
    });
  }

  /// The position of the list of an element's vertices.
  int corners_of(const Element& element) const {
    const int corners = element.find({"vertex_indices", "vertex_index"}, true);
    if (corners < 0 || !is_whole(at(element.properties, corners).type)) {
      fail(fmt::format("element {} must have a list of whole numbers, vertex_indices",
                       in_quotes(element.name)));
    }
    return corners;
  }

  PointId point_of(double index) const {
    if (!(index >= 0 && index <= 2147483646)) {
      fail_entry(fmt::format("vertex {} does not exist", index));
    }
    return static_cast<PointId>(index);
  }

  /// Strips of triangles, one after the other in each list, with -1 between them. The first of each
  /// is counter-clockwise, the others alternate.
  void read_strips(const Element& element) {
    const int corners = corners_of(element);
    for_each_entry(element, [&](std::size_t) {
      const std::vector<double>& list = at(lists_, corners);
      std::size_t begin = 0;
      for (std::size_t k = 0; k < list.size(); ++k) {
        if (list[k] == -1) {
          begin = k + 1;
          continue;
        }
        const PointId last = point_of(list[k]);
        if (k < begin + 2) {
          continue;
        }
        const PointId first = point_of(list[k - 2]), second = point_of(list[k - 1]);
        const bool odd = (k - begin) % 2 == 1;
        const std::array<PointId, 3> triangle{odd ? second : first, odd ? first : second, last};
        description_.add_face(triangle, no_color);
      }
    });
  }

  void read_faces(const Element& element) {
    const int corners = corners_of(element);
    const ColorProperties color(element, {"red", "green", "blue"}, {"r", "g", "b"});
    const ColorProperties rho(element, {"rho_r", "rho_g", "rho_b"});
    const ColorProperties exitance(element, {"E_r", "E_g", "E_b"});
    for_each_entry(element, [&](std::size_t) {
      outline_.clear();
      for (const double index : at(lists_, corners)) {
        outline_.push_back(point_of(index));
      }
      const Rgb light = exitance ? exitance.color(values_) : Rgb{};
      check_exitance(light, place());
      std::int32_t material = 0;
      if (rho) {
        material = materials_->of_numbers(rho.color(values_), light, place(), notes_);
      } else if (color) {
        const Rgb shown = color.color(values_);
        material = color.in_bytes() ? materials_->of_color(shown, light)
                                    : materials_->of_numbers(shown, light, place(), notes_);
      } else {
        material = no_color;
      }
      description_.add_face(outline_, material);
    });
  }

  /// Vertices may come after faces; so indices and colors of vertices are looked up at the end.
  void check_indices() {
    if (description_.face_count() == 0) {
      throw InputError(description_.name + ": has no faces");
    }
    const auto count = static_cast<PointId>(description_.points.size());
    for (std::size_t f = 0; f < description_.face_count(); ++f) {
      const std::span<const PointId> outline = description_.outline(f);
      for (const PointId p : outline) {
        if (p >= count) {
          throw InputError(fmt::format("{}vertex {} does not exist; there are {}",
                                       face_place(description_, f), p, count));
        }
      }
      if (description_.face_material[f] == no_color) {
        description_.face_material[f] = vertex_colors_.empty() || outline.empty()
                                            ? materials_->without_color()
                                            : material_of_vertices(f);
      }
    }
  }

  std::int32_t material_of_vertices(std::size_t face) {
    const Rgb mean = mean_color(description_.outline(face));
    return vertex_color_.in_bytes()
               ? materials_->of_mean_color(mean)
               : materials_->of_numbers(mean, {}, face_place(description_, face), notes_);
  }

  Rgb mean_color(std::span<const PointId> outline) const {
    Rgb sum;
    for (const PointId p : outline) {
      sum += at(vertex_colors_, p);
    }
    return 1 / static_cast<double>(outline.size()) * sum;
  }

  std::string place() const {
    return fmt::format("{}: {} {}: ", description_.name, entry_name_, entry_);
  }
  [[noreturn]] void fail(const std::string& what) const {
    throw InputError(fmt::format("{}:{}: {}", description_.name, line_, what));
  }
  [[noreturn]] void fail_entry(const std::string& what) const { throw InputError(place() + what); }

  static constexpr std::int32_t no_color = -1;

  const Cancellation& cancellation_;
  const std::string bytes_;
  std::size_t position_ = 0;
  std::int32_t line_ = 0;  ///< line in the header
  Form form_ = Form::ascii;
  bool has_lines_ = false;  ///< in an ASCII file, every entry has a line
  std::vector<Element> elements_;
  SceneDescription description_;
  std::optional<FaceMaterials> materials_;
  Warnings notes_;
  ColorProperties vertex_color_;
  std::vector<Rgb> vertex_colors_;
  std::vector<std::string_view> words_;
  // The entry that is read.
  std::string entry_name_;
  std::size_t entry_ = 0;
  std::vector<double> values_;
  std::vector<std::vector<double>> lists_;
  std::vector<PointId> outline_;
};

}  // namespace

SceneDescription read_ply(const std::filesystem::path& path, const ReadOptions& options,
                          const Cancellation& cancellation) {
  return PlyReader(path, options, cancellation).read();
}

}  // namespace transillum
