// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// A Radiance file is a sequence of words: each primitive has a modifier, a type, a name and three
// lists of arguments, each after its length: texts, whole numbers (always 0) and numbers. A word
// that begins with a quote ends with the same quote and may hold blanks; one that begins with #
// begins a comment, which ends with its line.
#include "scene/read/scene_readers.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>

#include "base/text_file.h"
#include "scene/build/description_check.h"
#include "scene/build/warnings.h"
#include "scene/read/face_materials.h"
#include "transillum/errors.h"

namespace transillum {
namespace {

constexpr std::string_view between_words = " \t\v\f\r\n";
constexpr std::array<std::string_view, 4> opaque_types{"plastic", "metal", "plastic2", "metal2"};
constexpr std::array<std::string_view, 4> light_types{"light", "glow", "illum", "spotlight"};
constexpr std::array<std::string_view, 11> surface_types{
    "sphere", "bubble",   "cone", "cup",    "cylinder",  "tube",
    "ring",   "instance", "mesh", "source", "spotsource"};

template <std::size_t n>
bool is_one_of(std::string_view type, const std::array<std::string_view, n>& types) {
  return std::find(types.begin(), types.end(), type) != types.end();
}

class RadianceReader {
 public:
  RadianceReader(const std::filesystem::path& path, const ReadOptions& options,
                 const Cancellation& cancellation)
      : options_(options),
        cancellation_(cancellation),
        text_(read_text_file(path, largest_scene_file)) {
    constexpr std::string_view byte_order_mark = "\xef\xbb\xbf";
    position_ = std::string_view(text_).starts_with(byte_order_mark) ? byte_order_mark.size() : 0;
    description_.name = path.string();
    description_.files = {path.string()};
  }

  SceneDescription read() {
    while (find_word()) {
      if (text_[position_] == '!') {
        fail(in_quotes(rest_of_line()) +
             " is a command, which is not run; expand the scene by `xform -e` of Radiance first");
      }
      read_primitive();
    }
    if (description_.face_count() == 0) {
      throw InputError(description_.name + ": has no polygons");
    }
    description_.notes = notes_.sentences();
    return std::move(description_);
  }

 private:
  // Words -----------------------------------------------------------------------------------

  /// Moves to the next word, past blanks and comments; false at the end of the file.
  bool find_word() {
    for (; position_ < text_.size(); ++position_) {
      const char c = text_[position_];
      if (c == '#') {
        position_ += rest_of_line().size();
      } else if (between_words.find(c) == std::string_view::npos) {
        line_ = 1 + lines_ended_;
        return true;
      }
      if (position_ < text_.size() && is_end_of_line(position_)) {
        ++lines_ended_;
        cancellation_.throw_if_canceled();
      }
    }
    return false;
  }
  /// Lines end with \n, \r\n or \r.
  bool is_end_of_line(std::size_t p) const {
    return text_[p] == '\n' ||
           (text_[p] == '\r' && (p + 1 == text_.size() || text_[p + 1] != '\n'));
  }
  std::string_view rest_of_line() const {
    const std::string_view rest = std::string_view(text_).substr(position_);
    return rest.substr(0, rest.find_first_of("\r\n"));
  }
  std::string take() {
    if (!find_word()) {
      fail("the file ends within a primitive");
    }
    const std::string_view line = rest_of_line();
    const char quote = line.front();
    if (quote != '"' && quote != '\'') {
      const std::string_view word = line.substr(0, line.find_first_of(between_words));
      position_ += word.size();
      return std::string(word);
    }
    const std::size_t end = line.find(quote, 1);
    if (end == std::string_view::npos) {
      fail(fmt::format("the quotes of {} do not end on their line", in_quotes(line.substr(1))));
    }
    position_ += end + 1;
    return std::string(line.substr(1, end - 1));
  }

  /// The length of a list of arguments.
  std::size_t take_count() {
    const std::string text = take();
    std::size_t count = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), count);
    if (error != std::errc() || end != text.data() + text.size() || count > text_.size()) {
      fail(fmt::format("{} is not a number of arguments", in_quotes(text)));
    }
    return count;
  }

  // Primitives ------------------------------------------------------------------------------

  void read_primitive() {
    const std::string modifier = take(), type = take(), name = take();
    if (type == "alias" || modifier == "alias") {
      define(name, find(take()));
      return;
    }
    for (std::size_t texts = take_count(); texts > 0; --texts) {
      take();
    }
    for (std::size_t wholes = take_count(); wholes > 0; --wholes) {
      take();
    }
    numbers_.clear();
    for (std::size_t numbers = take_count(); numbers > 0; --numbers) {
      const std::string text = take();
      const std::optional<double> value = parse_number(text);
      if (!value) {
        fail(in_quotes(text) + " is not a number");
      }
      numbers_.push_back(*value);
    }
    use(modifier, type, name);
  }

  void use(const std::string& modifier, const std::string& type, const std::string& name) {
    if (type == "polygon") {
      add_polygon(modifier, name);
    } else if (is_one_of(type, surface_types)) {
      notes_.add("surfaces other than polygons, omitted",
                 fmt::format("{}{} {} is not a polygon; omitted", place(), type, in_quotes(name)));
    } else if (is_one_of(type, light_types)) {
      const Rgb radiance = color(type, name);
      define(name, add_material({name, {}, std::numbers::pi * radiance}));
    } else if (is_one_of(type, opaque_types) || type == "trans" || type == "trans2") {
      const double specular = numbers_.size() > 3 ? std::clamp(numbers_[3], 0.0, 1.0) : 0;
      define(name, add_material({name, (1 - specular) * color(type, name), {}}));
    } else if (type.starts_with("mirror") || type.starts_with("prism") ||
               type.find("glass") != std::string::npos || type == "dielectric" ||
               type == "interface") {
      notes_.add("materials that are not diffuse",
                 fmt::format("{}{} {} has no diffuse reflectance; rho = 0, opaque", place(), type,
                             in_quotes(name)));
      define(name, add_material({name, {}, {}}));
    } else {
      // A pattern, a texture or a mixture: it has the material of its modifier.
      notes_.add("patterns and other modifiers, ignored",
                 fmt::format("{}{} {} is ignored", place(), type, in_quotes(name)));
      define(name, find(modifier));
    }
  }

  Rgb color(const std::string& type, const std::string& name) const {
    if (numbers_.size() < 3) {
      fail(fmt::format("{} {} must have three numbers at least", type, in_quotes(name)));
    }
    for (std::size_t k = 0; k < 3; ++k) {
      if (!std::isfinite(numbers_[k]) || numbers_[k] < 0) {
        fail(fmt::format("{} {}: {} is not a color", type, in_quotes(name), numbers_[k]));
      }
    }
    return {numbers_[0], numbers_[1], numbers_[2]};
  }

  std::int32_t add_material(Material material) {
    const std::string named = fmt::format("{}material {}: ", place(), in_quotes(material.name));
    lower_reflectance(material.reflectance, options_, named, notes_);
    check_material(material, named);
    description_.materials.push_back(std::move(material));
    return static_cast<std::int32_t>(description_.materials.size() - 1);
  }

  /// A later definition of a name replaces the earlier, for what follows.
  void define(const std::string& name, std::int32_t material) { materials_[name] = material; }

  /// The material that a name means.
  std::int32_t find(const std::string& name) {
    if (const auto found = materials_.find(name); found != materials_.end()) {
      return found->second;
    }
    if (name != "void") {
      notes_.add("materials that are not defined",
                 fmt::format("{}material {} is not defined; rho = {}, E = 0 assumed", place(),
                             in_quotes(name), options_.default_reflectance));
    }
    const double rho = options_.default_reflectance;
    const std::int32_t assumed = add_material({name, {rho, rho, rho}, {}});
    define(name, assumed);
    return assumed;
  }

  void add_polygon(const std::string& modifier, const std::string& name) {
    if (numbers_.size() < 9 || numbers_.size() % 3 != 0) {
      fail(
          fmt::format("polygon {} has {} numbers; three for each of three corners or more are "
                      "required",
                      in_quotes(name), numbers_.size()));
    }
    std::vector<PointId> outline;
    for (std::size_t k = 0; k < numbers_.size(); k += 3) {
      const Vec3 p{numbers_[k], numbers_[k + 1], numbers_[k + 2]};
      if (!is_finite(p) || max_abs(p) > largest_coordinate) {
        fail(fmt::format("polygon {}: corner {} is not a finite point of at most {}",
                         in_quotes(name), k / 3, largest_coordinate));
      }
      outline.push_back(static_cast<PointId>(description_.points.size()));
      description_.points.push_back(p);
    }
    const auto next = static_cast<std::int32_t>(description_.groups.size());
    const std::int32_t group = groups_.try_emplace(name, next).first->second;
    if (group == next) {
      description_.groups.push_back(name);
    }
    description_.add_face(outline, find(modifier), line_, group);
  }

  std::string place() const { return fmt::format("{}:{}: ", description_.name, line_); }
  [[noreturn]] void fail(const std::string& what) const { throw InputError(place() + what); }

  const ReadOptions& options_;
  const Cancellation& cancellation_;
  const std::string text_;
  std::size_t position_ = 0;
  std::int32_t lines_ended_ = 0;  ///< before position_
  std::int32_t line_ = 1;         ///< line of the last word
  SceneDescription description_;
  Warnings notes_;
  std::vector<double> numbers_;
  std::map<std::string, std::int32_t> materials_;  ///< by name
  std::map<std::string, std::int32_t> groups_;
};

}  // namespace

SceneDescription read_radiance(const std::filesystem::path& path, const ReadOptions& options,
                               const Cancellation& cancellation) {
  return RadianceReader(path, options, cancellation).read();
}

}  // namespace transillum
