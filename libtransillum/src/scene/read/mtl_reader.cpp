// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
// MTL files. Their lines are few and simple, so they are read here, in memory proportional to the
// number of different names; Kd and Ke become the nearest doubles.
#include "scene/read/mtl_reader.h"

#include <fmt/format.h>

#include <utility>

#include "base/text_file.h"

namespace transillum {
namespace {

/// Reads the lines of one file and reports each definition when it is complete.
class MtlReader {
 public:
  struct Definition {
    Material material;
    std::int32_t line = 0;
    bool has_reflectance = false;
  };

  MtlReader(const std::string& file, Warnings& notes) : file_(file), notes_(notes) {}

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
    } else if (line.keyword.starts_with("map_K")) {
      notes_.add("texture maps, ignored", fmt::format("{}:{}: texture map {} is ignored", file_,
                                                      line.number, in_quotes(line.keyword)));
    }
    return {};
  }
  /// The definition that the end of the file ends, if any.
  std::optional<Definition> finish() { return std::exchange(current_, std::nullopt); }

 private:
  std::optional<Definition> begin(const TextLine& line) {
    if (line.rest.empty()) {
      fail(line, "has no name");
    }
    return std::exchange(current_, Definition{{std::string(line.rest), {}, {}}, line.number});
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
  MtlReader reader(files_.back(), notes);
  const auto define = [&](std::optional<MtlReader::Definition> definition) {
    if (definition) {
      add(std::move(definition->material), definition->line, definition->has_reflectance, notes);
    }
  };
  while (const std::optional<TextLine> line = lines.next()) {
    define(reader.read(*line));
  }
  define(reader.finish());
}

/// Adds a definition of the last file.
void MaterialLibrary::add(Material material, std::int32_t line, bool has_reflectance,
                          Warnings& notes) {
  const Place place{files_.size() - 1, line};
  const bool is_new =
      numbers_.try_emplace(material.name, static_cast<std::int32_t>(materials_.size())).second;
  if (!is_new) {
    notes.add("repeated material definitions, ignored",
              fmt::format("{}material {} is already defined; the first definition is used",
                          text_of(place), in_quotes(material.name)));
    return;
  }
  if (!has_reflectance) {
    notes.add("materials without Kd", fmt::format("{}material {} has no Kd; its reflectance is 0",
                                                  text_of(place), in_quotes(material.name)));
  }
  materials_.push_back(std::move(material));
  places_.push_back(place);
}

std::string MaterialLibrary::text_of(const Place& place) const {
  return fmt::format("{}:{}: ", files_[place.file], place.line);
}

std::int32_t MaterialLibrary::find(const std::string& name) const {
  const auto found = numbers_.find(name);
  return found == numbers_.end() ? -1 : found->second;
}

std::vector<std::string> MaterialLibrary::names() const {
  std::vector<std::string> names;
  for (const Material& m : materials_) {
    names.push_back(m.name);
  }
  return names;
}

}  // namespace transillum
