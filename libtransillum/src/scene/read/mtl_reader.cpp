// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
// MTL files. Their lines are few and simple, so they are read here, in memory proportional to the
// number of different names; Kd and Ke become the nearest doubles.
#include "scene/read/mtl_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "base/text_file.h"
#include "scene/build/description_check.h"
#include "scene/read/face_materials.h"

namespace transillum {
namespace {

bool is_black(const Rgb& color) { return color == Rgb{}; }

/// Whether a word can be the value of an option of map_Kd: a number, on or off.
bool is_option_value(std::string_view word) {
  return word == "on" || word == "off" || parse_number(word).has_value();
}

/// The file name of a map_Kd line, which options such as `-s 1 1 1` or `-clamp on` may precede.
std::string_view texture_name(std::string_view rest) {
  std::vector<std::string_view> words;
  while (rest.starts_with('-')) {
    split_words(rest, words, 5);
    // Options with a word as value; all others have numbers, on or off.
    std::size_t used = words[0] == "-imfchan" || words[0] == "-type" ? 2 : 1;
    while (used < std::min<std::size_t>(words.size(), 4) && is_option_value(words[used])) {
      ++used;
    }
    if (used >= words.size()) {
      return {};
    }
    rest.remove_prefix(static_cast<std::size_t>(words[used].data() - rest.data()));
  }
  return rest;
}

/// Reads the lines of one file and reports each definition when it is complete.
class MtlDefinitions {
 public:
  struct Definition {
    Material material;
    std::int32_t line = 0;
    bool has_reflectance = false;
    std::string texture;
    std::int32_t texture_line = 0;
    std::optional<double> roughness;  ///< Pr
    bool without_lobe = false;        ///< illum 0 or 1: no highlights
  };

  MtlDefinitions(const std::string& file, Warnings& notes) : file_(file), notes_(notes) {}

  /// Returns the definition that the line ends, if any.
  std::optional<Definition> read(const TextLine& line) {
    if (line.keyword == "newmtl") {
      return begin(line);
    }
    const bool reflectance = line.keyword == "Kd", exitance = line.keyword == "Ke";
    if (reflectance || exitance) {
      if (!current_) {
        fail(line, "comes before any newmtl");
      }
      (reflectance ? current_->material.reflectance : current_->material.exitance) = color(line);
      current_->has_reflectance |= reflectance;
    } else if (current_ && (line.keyword == "Ks" || line.keyword == "Ns" || line.keyword == "Pr" ||
                            line.keyword == "illum")) {
      read_lobe(line);
    } else if (line.keyword == "map_Kd" && current_) {
      current_->texture = texture_name(line.rest);
      current_->texture_line = line.number;
    } else if (line.keyword.starts_with("map_K")) {
      ignore_texture(line.number, line.keyword);
    }
    return {};
  }
  /// The definition that the end of the file ends, if any.
  std::optional<Definition> finish() { return completed(std::exchange(current_, std::nullopt)); }

 private:
  std::optional<Definition> begin(const TextLine& line) {
    const std::string name(unquoted(line.rest));
    if (name.empty()) {
      notes_.add(
          "definitions of materials without a name, ignored",
          fmt::format("{}:{}: newmtl has no name; the definition is ignored", file_, line.number));
    }
    return completed(
        std::exchange(current_, Definition{{name, {}, {}}, line.number, false, {}, 0, {}, false}));
  }
  /// A line about the lobe. Diffuse solves do not need it, so what cannot be read is omitted.
  void read_lobe(const TextLine& line) {
    split_words(line.rest, words_, 4);
    std::vector<double> values;
    for (const std::string_view word : words_) {
      const std::optional<double> number = parse_number(word);
      if (!number || !(*number >= 0) || !(*number <= largest_exponent)) {
        break;
      }
      values.push_back(*number);
    }
    Lobe& lobe = current_->material.lobe;
    const bool colors = line.keyword == "Ks";
    if (values.size() != words_.size() || (values.size() != 1 && !(colors && values.size() == 3))) {
      notes_.add("lines of lobes that cannot be read, ignored",
                 fmt::format("{}:{}: material {}: {} is ignored", file_, line.number,
                             in_quotes(current_->material.name), line.keyword));
    } else if (colors) {
      lobe.reflectance = {values[0], values[values.size() / 2], values.back()};
    } else if (line.keyword == "Ns") {
      lobe.exponent = values[0];
    } else if (line.keyword == "Pr") {
      current_->roughness = std::min(values[0], 1.0);
    } else {
      current_->without_lobe = values[0] < 2;
    }
  }
  /// Without the texture of a material that has a color of its own.
  std::optional<Definition> completed(std::optional<Definition> definition) {
    if (definition && !definition->texture.empty() && !is_black(definition->material.reflectance)) {
      ignore_texture(definition->texture_line, "map_Kd");
      definition->texture.clear();
    }
    if (definition && definition->without_lobe) {
      definition->material.lobe = {};
    } else if (definition && definition->roughness) {
      definition->material.lobe.shape = LobeShape::ggx;
      definition->material.lobe.roughness = *definition->roughness;
    }
    return definition;
  }
  void ignore_texture(std::int32_t line, std::string_view keyword) {
    notes_.add("texture maps, ignored",
               fmt::format("{}:{}: texture map {} is ignored", file_, line, in_quotes(keyword)));
  }
  Rgb color(const TextLine& line) {
    split_words(line.rest, words_, 4);
    if (words_.size() != 1 && words_.size() != 3) {
      fail(line, "requires three numbers");
    }
    std::array<double, 3> value{};
    for (std::size_t i = 0; i < 3; ++i) {
      // A single number applies to all three channels.
      const std::string_view word = words_[words_.size() == 1 ? 0 : i];
      const std::optional<double> number = parse_number(word);
      if (!number) {
        fail(line, in_quotes(word) + " is not a number");
      }
      value[i] = *number;
    }
    return {value[0], value[1], value[2]};
  }
  [[noreturn]] void fail(const TextLine& line, const std::string& what) const {
    const std::string material =
        current_ ? fmt::format("material {}: ", in_quotes(current_->material.name)) : "";
    throw InputError(
        fmt::format("{}:{}: {}{} {}", file_, line.number, material, line.keyword, what));
  }

  const std::string& file_;
  Warnings& notes_;
  std::optional<Definition> current_;
  std::vector<std::string_view> words_;
};

}  // namespace

void MaterialLibrary::read(const std::filesystem::path& path, Warnings& notes,
                           const Cancellation& cancellation) {
  files_.push_back(path.string());
  const std::string text = read_text_file(path, largest_scene_file);
  LineReader lines(text, cancellation);
  MtlDefinitions reader(files_.back(), notes);
  const auto define = [&](std::optional<MtlDefinitions::Definition> definition) {
    if (definition && !definition->material.name.empty()) {
      add(std::move(definition->material),
          {files_.size() - 1, definition->line, std::move(definition->texture)},
          definition->has_reflectance, notes);
    }
  };
  while (const std::optional<TextLine> line = lines.next()) {
    define(reader.read(*line));
  }
  define(reader.finish());
}

/// Adds a definition of the last file.
void MaterialLibrary::add(Material material, Place place, bool has_reflectance, Warnings& notes) {
  const auto number = static_cast<std::int32_t>(materials_.size());
  if (!numbers_.try_emplace(material.name, number).second) {
    notes.add("repeated material definitions, ignored",
              fmt::format("{}material {} is already defined; the first definition is used",
                          text_of(place), in_quotes(material.name)));
    return;
  }
  lower_case_numbers_.try_emplace(lower_case(material.name), number);
  if (!has_reflectance && place.texture.empty()) {
    notes.add("materials without Kd", fmt::format("{}material {} has no Kd; its reflectance is 0",
                                                  text_of(place), in_quotes(material.name)));
  }
  materials_.push_back(std::move(material));
  places_.push_back(std::move(place));
}

void MaterialLibrary::complete(std::size_t material, const ReadOptions& options, Warnings& notes,
                               const Cancellation& cancellation) {
  Material& completed = materials_[material];
  const Place& place = places_[material];
  if (!place.texture.empty()) {
    replace_by_texture(completed, place, options, notes, cancellation);
  }
  lower_reflectance(completed, place, options, notes);
  check_material(completed, text_of(place));
}

void MaterialLibrary::replace_by_texture(Material& material, const Place& place,
                                         const ReadOptions& options, Warnings& notes,
                                         const Cancellation& cancellation) {
  const TextureAverage texture = average(place, cancellation);
  if (texture.color) {
    material.reflectance = *texture.color;
    notes.add(
        "textured materials, whose reflectance is their texture's average",
        fmt::format("{}material {}: Kd is 0; rho = {:.3g}, {:.3g}, {:.3g}, the average of "
                    "texture {} in linear light",
                    text_of(place), in_quotes(material.name), material.reflectance.r,
                    material.reflectance.g, material.reflectance.b, in_quotes(place.texture)));
    return;
  }
  const double rho = options.default_reflectance;
  material.reflectance = {rho, rho, rho};
  notes.add(
      "textured materials without a readable texture",
      fmt::format("{}material {}: Kd is 0, and texture {} {}; rho = {} assumed", text_of(place),
                  in_quotes(material.name), in_quotes(place.texture), texture.problem, rho));
}

TextureAverage MaterialLibrary::average(const Place& place, const Cancellation& cancellation) {
  const auto path =
      search_.find(std::filesystem::path(files_[place.file]).parent_path(), place.texture);
  if (!path) {
    return {{}, "is not found"};
  }
  const auto [known, is_new] = averages_.try_emplace(*path);
  if (is_new) {
    known->second = average_of_texture(*path, cancellation);
    textures_.push_back(path->string());
  }
  return known->second;
}

void MaterialLibrary::lower_reflectance(Material& material, const Place& place,
                                        const ReadOptions& options, Warnings& notes) const {
  const Rgb given = material.reflectance;
  const double lowered = transillum::lower_reflectance(material.reflectance, options);
  if (lowered == 0 || std::isnan(given.r + given.g + given.b)) {
    return;
  }
  notes.add(
      "materials, whose reflectance is lowered",
      fmt::format("{}material {}: reflectance rho (Kd) {} {} {} is lowered to {}", text_of(place),
                  in_quotes(material.name), given.r, given.g, given.b, lowered));
}

std::string MaterialLibrary::text_of(const Place& place) const {
  return fmt::format("{}:{}: ", files_[place.file], place.line);
}

std::int32_t MaterialLibrary::find(const std::string& name) const {
  if (const auto exact = numbers_.find(name); exact != numbers_.end()) {
    return exact->second;
  }
  const auto found = lower_case_numbers_.find(lower_case(name));
  return found == lower_case_numbers_.end() ? -1 : found->second;
}

std::vector<std::string> MaterialLibrary::names() const {
  std::vector<std::string> names;
  for (const Material& m : materials_) {
    names.push_back(m.name);
  }
  return names;
}

}  // namespace transillum
