// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
// MTL files: tinyobjloader parses them, but each line is checked before, and Kd and Ke are read
// here as the nearest doubles.
#include "scene/read/mtl_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <istream>

#include "base/invariant.h"
#include "base/text_file.h"
#include "scene/read/tinyobj_parser.h"

namespace transillum {
namespace {

struct Definition {
  Material material;
  std::int32_t line = 0;
  bool has_reflectance = false;
};

/// Inspects each line before tinyobjloader gets it, and keeps Kd and Ke as the nearest doubles.
class MtlScan {
 public:
  MtlScan(const std::string& file, Warnings& notes) : file_(file), notes_(notes) {}

  /// Returns whether to pass the line to tinyobjloader.
  bool inspect(const TextLine& line) {
    if (line.keyword == "newmtl") {
      return begin(line);
    }
    const bool reflectance = line.keyword == "Kd", exitance = line.keyword == "Ke";
    if (reflectance || exitance) {
      if (definitions_.empty()) {
        fail(line, "comes before any newmtl");
      }
      Material& material = definitions_.back().material;
      (reflectance ? material.reflectance : material.exitance) = color(line);
      definitions_.back().has_reflectance |= reflectance;
      return true;
    }
    if (line.keyword.starts_with("map_K")) {
      notes_.add("texture maps, ignored",
                 fmt::format("{}:{}: texture map {} is ignored", file_, line.number, line.keyword));
    }
    return false;
  }
  std::vector<Definition>& definitions() { return definitions_; }

 private:
  bool begin(const TextLine& line) {
    if (line.rest.empty()) {
      fail(line, "has no name");
    }
    Definition& definition = definitions_.emplace_back();
    definition.material.name = line.rest;
    definition.line = line.number;
    return true;
  }
  Rgb color(const TextLine& line) {
    split_words(line.rest, words_);
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
        definitions_.empty()
            ? ""
            : fmt::format("material {}: ", in_quotes(definitions_.back().material.name));
    throw InputError(
        fmt::format("{}:{}: {}{} {}", file_, line.number, material, line.keyword, what));
  }

  const std::string& file_;
  Warnings& notes_;
  std::vector<Definition> definitions_;
  std::vector<std::string_view> words_;
};

}  // namespace

void MaterialLibrary::read(const std::filesystem::path& path, Warnings& notes,
                           const Cancellation& cancellation) {
  const std::string file = path.string();
  const std::string text = read_text_file(path, largest_scene_file);
  MtlScan scan(file, notes);
  LineFeed feed(
      text, [&](const TextLine& line) { return scan.inspect(line); }, cancellation);
  std::istream stream(&feed);
  // Without this the stream would swallow exceptions of inspect().
  stream.exceptions(std::ios::badbit);
  const std::vector<std::string> parsed = parse_mtl(stream);
  // tinyobjloader adds a material without a name if there is none.
  TRANSILLUM_INVARIANT(parsed.size() == std::max<std::size_t>(1, scan.definitions().size()),
                       "tinyobjloader finds the same materials as the scan");
  for (Definition& d : scan.definitions()) {
    const std::string place = fmt::format("{}:{}: ", file, d.line);
    if (numbers_.contains(d.material.name)) {
      notes.add("repeated material definitions, ignored",
                fmt::format("{}material {} is already defined; the first definition is used", place,
                            in_quotes(d.material.name)));
      continue;
    }
    if (!d.has_reflectance) {
      notes.add("materials without Kd", fmt::format("{}material {} has no Kd; its reflectance is 0",
                                                    place, in_quotes(d.material.name)));
    }
    numbers_[d.material.name] = static_cast<std::int32_t>(materials_.size());
    materials_.push_back(std::move(d.material));
    places_.push_back(place);
  }
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
