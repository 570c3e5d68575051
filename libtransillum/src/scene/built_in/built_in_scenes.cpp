// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
// The table of the built-in scenes, and describe_scene(): from the text that names a scene to a
// built-in or a file.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "base/did_you_mean.h"
#include "base/text_file.h"
#include "scene/build/joining.h"
#include "scene/build/precision.h"
#include "scene/built_in/built_in_makers.h"
#include "scene/read/scene_readers.h"
#include "transillum/scene.h"

namespace transillum {
namespace {

struct BuiltIn {
  const char* name;
  const char* summary;
  std::vector<SceneParameter> parameters;
  void (*make)(SceneMaker&, const ParameterValues&, const Cancellation&);
};

const std::vector<BuiltIn>& registry() {
  static const std::vector<BuiltIn> all{
      {"sphere-flake",
       "A sphere with smaller spheres on it, each a third of its size, inside a sky of two colors.",
       {{"levels", 2, 0, 5}, {"slices", 17, 3, 4096}, {"stacks", 8, 2, 4096}},
       make_sphere_flake},
      {"cornell-box",
       "The measured room with a red and a green wall, two blocks and a light in the ceiling. "
       "Its open side is closed by a black wall, unless open=1.",
       {{"open", 0, 0, 1}},
       make_cornell_box},
      {"furnace",
       "A box inside a closed box, with E = 1 and ρ = 0.5 everywhere, so B = 2 everywhere.",
       {},
       make_furnace},
      {"boards",
       "A ring of boards in a room, each overlapping the next: a cyclic order.",
       {{"n", 5, 3, 24}},
       make_boards},
      {"rooms",
       "A row of rooms connected by doorways, with boxes on their floors.",
       {{"n", 24, 0, 2'000'000}, {"rooms", 3, 1, 1000}, {"seed", 1, 0, 1'000'000'000}},
       make_rooms},
      {"stars", "A room with small, bright light sources.", {{"n", 12, 1, 1000}}, make_stars},
      {"gallery",
       "A room with a glossy floor and a polished ball, lit by three colored lamps: for solves "
       "with lobes.",
       {{"tiles", 2, 1, 100}, {"slices", 24, 3, 1024}, {"stacks", 12, 2, 1024}},
       make_gallery},
      {"flatland",
       "A section of a room, 1 m deep, with two boards: small enough to compute by hand.",
       {},
       make_flatland},
  };
  return all;
}

/// The file name's ending in lower case if it consists of letters: ".obj", but not "=2.5".
std::string file_ending(const std::string& spec) {
  const std::string ending = lower_case_ending(spec);
  for (const char c : ending) {
    if (c != '.' && (c < 'a' || c > 'z')) {
      return {};
    }
  }
  return ending.size() > 1 ? ending : std::string();
}

/// "scene files end in .obj, .gltf, …".
std::string endings_text() {
  std::vector<std::string> endings;
  for (const SceneFormat& format : scene_formats()) {
    endings.push_back(format.ending);
  }
  return fmt::format("scene files end in {}", fmt::join(endings, ", "));
}

/// Whether `spec` is a path rather than the name of a built-in.
bool names_a_file(const std::string& spec) {
  std::error_code ignored;
  return spec.find('/') != std::string::npos || !file_ending(spec).empty() || is_scene_file(spec) ||
         std::filesystem::exists(spec, ignored);
}

SceneDescription read_file(const std::string& spec, const ReadOptions& read,
                           const Cancellation& cancellation) {
  std::error_code ignored;
  if (!std::filesystem::exists(spec, ignored)) {
    throw InputError(spec + ": no such file");
  }
  if (!is_scene_file(spec)) {
    throw InputError(fmt::format("{}: not a scene file; {}", spec, endings_text()));
  }
  return read_scene_file(spec, read, cancellation);
}

std::vector<std::string> built_in_names() {
  std::vector<std::string> names;
  for (const BuiltIn& b : registry()) {
    names.emplace_back(b.name);
  }
  return names;
}

SceneDescription make(const BuiltIn& built_in, const std::string& spec,
                      const std::string& parameters, const Cancellation& cancellation) {
  const ParameterValues values(built_in.name, parameters, built_in.parameters);
  SceneMaker maker;
  built_in.make(maker, values, cancellation);
  return maker.take(spec);
}

}  // namespace

const std::vector<BuiltInScene>& built_in_scenes() {
  static const std::vector<BuiltInScene> all = [] {
    std::vector<BuiltInScene> list;
    for (const BuiltIn& b : registry()) {
      list.push_back({b.name, b.summary, describe(b.parameters)});
    }
    return list;
  }();
  return all;
}

namespace {

SceneDescription describe_unscaled(const std::string& spec, const ReadOptions& read,
                                   const Cancellation& cancellation) {
  const std::size_t colon = std::min(spec.find(':'), spec.size());
  const std::string name = spec.substr(0, colon);
  for (const BuiltIn& b : registry()) {
    if (b.name != name) {
      continue;
    }
    SceneDescription made =
        make(b, spec, colon < spec.size() ? spec.substr(colon + 1) : "", cancellation);
    return read.join.value_or(false) ? join_faces(made, cancellation).description : made;
  }
  if (names_a_file(spec)) {
    return read_file(spec, read, cancellation);
  }
  const std::vector<std::string> names = built_in_names();
  throw InputError(fmt::format("{}: no such file or built-in scene{} Built-in scenes: {}.", spec,
                               nearest_name(name, names).empty() ? "." : did_you_mean(name, names),
                               fmt::join(names, ", ")));
}

}  // namespace

SceneDescription describe_scene(const std::string& spec, const ReadOptions& read,
                                const Cancellation& cancellation) {
  read.validate();
  SceneDescription description = describe_unscaled(spec, read, cancellation);
  if (read.scale != 1) {
    const double rounding = description.coordinate_rounding > 0
                                ? description.coordinate_rounding
                                : coordinate_rounding(description.points);
    description.coordinate_rounding = read.scale * rounding;
  }
  for (Vec3& point : description.points) {
    point = read.scale * point;
  }
  return description;
}

}  // namespace transillum
