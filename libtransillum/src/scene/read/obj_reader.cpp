// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
// OBJ files: tinyobjloader splits them into vertices, faces and uses of materials, but each line is
// checked before, and all numbers are read here, as the nearest doubles.
#include "scene/read/scene_readers.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <functional>
#include <istream>
#include <set>

#include "base/did_you_mean.h"
#include "base/invariant.h"
#include "base/text_file.h"
#include "scene/build/description_check.h"
#include "scene/read/file_search.h"
#include "scene/read/mtl_reader.h"
#include "scene/read/tinyobj_parser.h"
#include "transillum/at.h"

namespace transillum {
namespace {

constexpr std::size_t max_vertices = 100'000'000;
constexpr std::size_t max_corners = 400'000'000;
constexpr std::size_t max_face_corners = 1'000'000;

/// Whether lines with this keyword are ignored without a warning.
bool is_ignored_silently(std::string_view keyword) {
  constexpr std::string_view known[] = {"vt",        "vn",       "vp",       "s",   "mg",
                                        "bevel",     "c_interp", "d_interp", "lod", "shadow_obj",
                                        "trace_obj", "maplib",   "usemap",   "vw",  "t"};
  return std::find(std::begin(known), std::end(known), keyword) != std::end(known);
}

/// The file names of an mtllib line. A name may have blanks, so it ends with its quotes or its
/// `.mtl`; names without either are in the last text.
std::vector<std::string_view> library_names(std::string_view rest) {
  std::vector<std::string_view> names;
  const std::string lower = lower_case(rest);
  while (!rest.empty()) {
    std::size_t end = rest.size();
    const std::size_t offset = lower.size() - rest.size();
    if (rest.front() == '"' || rest.front() == '\'') {
      end = std::min(rest.find(rest.front(), 1), rest.size() - 1) + 1;
    } else {
      constexpr std::string_view ending = ".mtl";
      for (std::size_t from = offset; end == rest.size();) {
        const std::size_t found = lower.find(ending, from);
        if (found == std::string::npos) {
          break;
        }
        from = found + ending.size();
        if (from < lower.size() && (lower[from] == ' ' || lower[from] == '\t')) {
          end = from - offset;
        }
      }
    }
    names.push_back(rest.substr(0, end));
    rest = trimmed(rest.substr(end));
  }
  return names;
}

/// Reads one file. tinyobjloader parses the lines, but it reads malformed numbers as 0, lets large
/// indices overflow, and does not round to nearest: so each line is checked before tinyobjloader
/// gets it, and coordinates come from std::from_chars, as the nearest doubles.
class ObjReader {
 public:
  ObjReader(const std::filesystem::path& path, const ReadOptions& options,
            const Cancellation& cancellation)
      : path_(path), options_(options), cancellation_(cancellation) {
    description_.name = path.string();
    description_.files = {path.string()};
  }

  SceneDescription read() {
    const std::string text = read_text_file(path_, largest_scene_file);
    LineFeed feed(
        text, [this](const TextLine& line) { return inspect(line); }, cancellation_);
    std::istream stream(&feed);
    // Without this the stream would swallow exceptions of inspect().
    stream.exceptions(std::ios::badbit);
    parse_obj(stream, {[this] { add_vertex(); },
                       [this](std::span<const int> corners) { add_face(corners); }});
    finish();
    return std::move(description_);
  }

 private:
  /// Returns whether to pass the line to tinyobjloader.
  bool inspect(const TextLine& line) {
    line_ = line.number;
    if (line.keyword == "v") {
      return read_vertex(line);
    }
    if (line.keyword == "f") {
      return check_face(line);
    }
    if (line.keyword == "usemtl") {
      use_material(std::string(unquoted(line.rest)));
    } else if (line.keyword == "g" || line.keyword == "o") {
      // The group that every face belongs to is named `default` in the format's description.
      group_name_ = line.rest == "default" ? std::string_view() : line.rest;
      group_ = no_group;
    } else if (line.keyword == "mtllib") {
      read_libraries(line.rest);
    } else if (!is_ignored_silently(line.keyword)) {
      notes_.add("lines with unsupported keywords, ignored",
                 fmt::format("{}keyword {} is not supported; line ignored", place(),
                             in_quotes(line.keyword)));
    }
    return false;
  }

  bool read_vertex(const TextLine& line) {
    split_words(line.rest, words_, 3);
    const std::size_t number = description_.points.size() + 1;
    if (number > max_vertices) {
      fail(fmt::format("more than {} vertices", max_vertices));
    }
    if (words_.size() < 3) {
      fail(fmt::format("vertex {}: three coordinates are required", number));
    }
    for (std::size_t i = 0; i < 3; ++i) {
      const std::optional<double> value = parse_number(words_[i]);
      if (!value) {
        fail(fmt::format("vertex {}: {} is not a number", number, in_quotes(words_[i])));
      }
      if (!(std::abs(*value) <= largest_coordinate)) {
        fail(fmt::format("vertex {}: {} is not a finite coordinate of at most {}", number,
                         in_quotes(words_[i]), largest_coordinate));
      }
      (i == 0 ? vertex_.x : i == 1 ? vertex_.y : vertex_.z) = *value;
    }
    return true;
  }

  bool check_face(const TextLine& line) {
    split_words(line.rest, words_, max_face_corners + 1);
    if (words_.size() > max_face_corners) {
      fail_face(fmt::format("more than {} corners", max_face_corners));
    }
    if (description_.corners.size() + words_.size() > max_corners) {
      fail(fmt::format("more than {} corners of faces", max_corners));
    }
    for (const std::string_view word : words_) {
      check_corner(word);
    }
    // tinyobjloader makes no callback for a face without corners.
    if (words_.empty()) {
      add_face({});
    }
    return !words_.empty();
  }

  /// v, v/vt, v//vn or v/vt/vn; only v is used, but the others must be numbers too.
  void check_corner(std::string_view word) {
    const std::size_t slash = std::min(word.find('/'), word.size());
    int index = 0;
    const char* const last = word.data() + slash;
    const auto [end, error] = std::from_chars(word.data(), last, index);
    const bool well_formed =
        end == last && slash > 0 &&
        word.find_first_not_of("0123456789-/", slash) == std::string_view::npos &&
        std::count(word.begin(), word.end(), '/') <= 2;
    if (error == std::errc::result_out_of_range) {
      fail_index(word.substr(0, slash));
    }
    if (!well_formed || error != std::errc()) {
      fail_face(in_quotes(word) + " is not a corner (v, v/vt, v//vn or v/vt/vn)");
    }
    const auto count = static_cast<std::int64_t>(description_.points.size());
    if (index == 0 || index < -count) {
      fail_index(word.substr(0, slash));
    }
  }

  void add_vertex() { description_.points.push_back(vertex_); }

  void add_face(std::span<const int> indices) {
    TRANSILLUM_INVARIANT(indices.size() == words_.size(),
                         "tinyobjloader finds the same corners as check_face()");
    outline_.clear();
    const auto count = static_cast<PointId>(description_.points.size());
    for (const int index : indices) {
      outline_.push_back(index > 0 ? index - 1 : count + index);
    }
    description_.add_face(outline_, current_name_, line_, current_group());
  }

  /// The group of the next face. Groups without faces are omitted.
  std::int32_t current_group() {
    if (group_ == no_group && !group_name_.empty()) {
      group_ = group_numbers_
                   .try_emplace(group_name_, static_cast<std::int32_t>(description_.groups.size()))
                   .first->second;
      if (static_cast<std::size_t>(group_) == description_.groups.size()) {
        description_.groups.push_back(group_name_);
      }
    }
    return group_;
  }

  /// Materials may be defined later in the file, so names are resolved at the end.
  void use_material(const std::string& name) {
    if (name.empty()) {
      notes_.add("uses of a material without a name",
                 fmt::format("{}usemtl has no name; its faces get no material", place()));
      current_name_ = no_name;
      return;
    }
    const auto [found, is_new] =
        name_numbers_.try_emplace(name, static_cast<std::int32_t>(used_names_.size()));
    if (is_new) {
      used_names_.push_back({name, line_});
    }
    current_name_ = found->second;
  }

  void read_libraries(std::string_view rest) {
    if (rest.empty()) {
      notes_.add("mtllib lines without a name", place() + "mtllib has no file name; line ignored");
      return;
    }
    // One name with blanks, or several names: the existing files decide.
    std::error_code ignored;
    if (std::filesystem::exists(path_.parent_path() / rest, ignored) && read_library(rest)) {
      return;
    }
    for (const std::string_view name : library_names(rest)) {
      if (read_library(name)) {
        continue;
      }
      split_words(name, words_);
      const bool any = words_.size() > 1 && std::any_of(words_.begin(), words_.end(), [&](auto w) {
                         return search_.find(path_.parent_path(), w).has_value();
                       });
      if (!any) {
        report_missing(name);
        continue;
      }
      for (const std::string_view word : words_) {
        if (!read_library(word)) {
          report_missing(word);
        }
      }
    }
  }
  /// Reads a file that exists; each once, however many lines name it, under however many names.
  bool read_library(std::string_view name) {
    if (library_names_.contains(name)) {
      return true;
    }
    const std::optional<std::filesystem::path> path = search_.find(path_.parent_path(), name);
    if (!path) {
      return false;
    }
    library_names_.emplace(name);
    std::error_code error;
    const std::filesystem::path file = std::filesystem::canonical(*path, error);
    if (error || library_files_.insert(file).second) {
      library_.read(*path, notes_, cancellation_);
      description_.files.push_back(path->string());
    }
    return true;
  }
  void report_missing(std::string_view name) {
    if (!library_names_.emplace(name).second) {
      return;
    }
    constexpr const char* kind = "missing MTL files";
    // Similar names are searched for in warnings that are shown.
    const std::string similar = notes_.count(kind) < Warnings::shown_of_a_kind
                                    ? search_.similar(path_.parent_path(), name)
                                    : std::string();
    notes_.add(kind,
               fmt::format("{}MTL file {} not found{}", place(), in_quotes(name),
                           similar.empty() ? "" : "; did you mean " + in_quotes(similar) + "?"));
  }

  void finish() {
    check_indices();
    resolve_materials();
    const std::vector<std::string>& textures = library_.textures();
    description_.files.insert(description_.files.end(), textures.begin(), textures.end());
    description_.notes = notes_.sentences();
  }

  /// Vertices may be defined later in the file, so indices are checked at the end.
  void check_indices() {
    const auto count = static_cast<PointId>(description_.points.size());
    if (count == 0) {
      throw InputError(description_.name + ": no vertices; is it an OBJ file?");
    }
    for (std::size_t f = 0; f < description_.face_count(); ++f) {
      for (const PointId p : description_.outline(f)) {
        if (p < count) {
          continue;
        }
        throw InputError(fmt::format("{}vertex index {} is out of range; there are {} vertices",
                                     face_place(description_, f), p + 1, count));
      }
    }
  }

  /// Replaces the numbers of used names by the numbers of materials.
  void resolve_materials() {
    std::vector<std::int64_t> faces(used_names_.size());
    std::int64_t without = 0;
    for (const std::int32_t name : description_.face_material) {
      ++(name == no_name ? without : at(faces, name));
    }
    std::vector<Material> assumed;
    std::vector<std::int32_t> resolved(used_names_.size());
    for (std::size_t n = 0; n < used_names_.size(); ++n) {
      resolved[n] = faces[n] > 0 ? resolve(used_names_[n], faces[n], assumed) : 0;
    }
    const auto nameless = static_cast<std::int32_t>(library_.materials().size() + assumed.size());
    for (std::int32_t& material : description_.face_material) {
      material = material == no_name ? nameless : at(resolved, material);
    }
    description_.materials = library_.take_materials();
    description_.materials.insert(description_.materials.end(), assumed.begin(), assumed.end());
    if (without > 0) {
      add_nameless_material(without);
    }
  }

  void add_nameless_material(std::int64_t faces) {
    std::string name = "no-material";
    while (library_.find(name) >= 0 || name_numbers_.contains(name)) {
      name += "-";
    }
    description_.materials.push_back({name, default_color(), {}});
    notes_.add("notes",
               fmt::format("{}: {} of {} faces have no material (usemtl); rho = {}, E = 0 assumed",
                           description_.name, faces, description_.face_count(),
                           options_.default_reflectance));
  }

  struct UsedName {
    std::string name;
    std::int32_t line;
  };
  /// The number of the material that a name means; of a new one in `assumed` if it is not defined.
  std::int32_t resolve(const UsedName& used, std::int64_t faces, std::vector<Material>& assumed) {
    const std::int32_t material = library_.find(used.name);
    if (material >= 0) {
      const auto m = static_cast<std::size_t>(material);
      if (completed_.insert(m).second) {
        library_.complete(m, options_, notes_, cancellation_);
      }
      return material;
    }
    constexpr const char* kind = "materials that are not defined";
    // Similar names are searched for in warnings that are shown.
    const std::string similar = notes_.count(kind) < Warnings::shown_of_a_kind
                                    ? did_you_mean(used.name, library_.names())
                                    : std::string();
    line_ = used.line;
    notes_.add(kind, fmt::format("{}material {} is not defined; rho = {}, E = 0 assumed for {} "
                                 "face{}{}",
                                 place(), in_quotes(used.name), options_.default_reflectance, faces,
                                 faces == 1 ? "" : "s", similar));
    assumed.push_back({used.name, default_color(), {}});
    return static_cast<std::int32_t>(library_.materials().size() + assumed.size() - 1);
  }
  Rgb default_color() const {
    const double rho = options_.default_reflectance;
    return {rho, rho, rho};
  }

  std::string place() const { return fmt::format("{}:{}: ", description_.name, line_); }
  [[noreturn]] void fail(const std::string& what) const { throw InputError(place() + what); }
  [[noreturn]] void fail_face(const std::string& what) const {
    fail(fmt::format("face {}: {}", description_.face_count(), what));
  }
  [[noreturn]] void fail_index(std::string_view index) const {
    fail_face(fmt::format("vertex index {} is out of range; there are {} vertices", index,
                          description_.points.size()));
  }

  static constexpr std::int32_t no_name = -1;

  const std::filesystem::path& path_;
  const ReadOptions& options_;
  const Cancellation& cancellation_;
  SceneDescription description_;
  FileSearch search_;
  MaterialLibrary library_{search_};
  std::set<std::size_t> completed_;                   ///< materials of the library that faces use
  std::set<std::string, std::less<>> library_names_;  ///< read or reported, as written
  std::set<std::filesystem::path> library_files_;     ///< the same, resolved
  Warnings notes_;
  std::int32_t line_ = 0;
  Vec3 vertex_;
  std::vector<std::string_view> words_;
  std::vector<PointId> outline_;
  std::map<std::string, std::int32_t> name_numbers_;
  std::vector<UsedName> used_names_;
  std::int32_t current_name_ = no_name;
  std::string group_name_;         ///< name in the last `g` or `o`; empty if there is none
  std::int32_t group_ = no_group;  ///< its number, once a face has it
  std::map<std::string, std::int32_t> group_numbers_;
};

}  // namespace

SceneDescription read_obj(const std::filesystem::path& path, const ReadOptions& options,
                          const Cancellation& cancellation) {
  return ObjReader(path, options, cancellation).read();
}

}  // namespace transillum
