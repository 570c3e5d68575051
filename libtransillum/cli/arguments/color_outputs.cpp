// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "cli/arguments/color_outputs.h"

#include <algorithm>
#include <filesystem>
#include <initializer_list>

#include "cli/arguments/option_values.h"
#include "transillum/engine.h"
#include "transillum/errors.h"
#include "transillum/files.h"

namespace transillum::cli {
namespace {

bool is_any_of(const std::vector<std::string>& files, std::initializer_list<const char*> endings) {
  return std::any_of(files.begin(), files.end(), [&](const std::string& file) {
    std::string ending = std::filesystem::path(file).extension().string();
    std::transform(ending.begin(), ending.end(), ending.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return std::find(endings.begin(), endings.end(), ending) != endings.end();
  });
}

}  // namespace

void add_color_outputs(CLI::App& command, ColorOutputs& colors) {
  add_parsed_option(command, "--exposure", "X",
                    "colors in .ply, .glb, .gltf and .png files: B times X is the linear color, 1 "
                    "is white (default: "
                    "98 % of the area that does not emit is below white)",
                    [&colors](const std::string& text) {
                      colors.display.exposure = parse_positive("--exposure", text);
                    });
  add_parsed_option(
      command, "--target", "X,Y,Z",
      "the point in the middle of a picture, in m (default: the center of the scene)",
      [&colors](const std::string& text) { colors.target = parse_point("--target", text); });
  command.add_flag("--light-map", colors.display.light_map,
                   "colors in .glb and .gltf files as a picture with texture coordinates, a square "
                   "of it per patch, instead of a color per corner");
  command.add_flag("--sharp", colors.sharp,
                   "--light-map has exact direct light with its shadows, on grids of points of "
                   "whole faces");
  add_parsed_option(
      command, "--texels", "N",
      "points of --sharp per meter (default: 1,024 along the diagonal of the scene)",
      [&colors](const std::string& text) { colors.texels = parse_positive("--texels", text); });
  command
      .add_option(
          "--series", colors.series,
          "the result after each iteration: files STEM-0001.vtp and so on, and this list of "
          "them for ParaView")
      ->type_name("STEM.pvd");
  add_parsed_option(
      command, "--series-every", "N",
      "iteration (default), direction, or a number of directions: --series has the estimate after "
      "that many directions of an iteration too",
      [&colors](const std::string& text) {
        colors.series_every =
            text == "iteration" ? 0
            : text == "direction"
                ? 1
                : static_cast<int>(parse_whole_number("--series-every", text, 1, 1 << 30));
      });
}

void set_up_of_display(const CLI::App& command, const Sky& sky, ColorOutputs& colors) {
  if (command.get_option("--up")->count() > 0) {
    colors.display.up = sky.up;
  }
}

void check_color_outputs(const CLI::App& command, const ColorOutputs& colors,
                         const std::vector<std::string>& out, const SolveOptions& options) {
  refuse_unless(is_any_of(out, {".ply", ".glb", ".gltf", ".png"}), command, "--exposure",
                "used only with a .ply, .glb, .gltf or .png file");
  const bool has_picture = std::any_of(out.begin(), out.end(), is_picture_file);
  refuse_unless(has_picture, command, "--target", "used only with a .png, .exr or .pfm file");
  if (has_picture && command.get_option("--eye")->count() == 0) {
    throw InputError("a picture requires --eye X,Y,Z");
  }
  refuse_unless(is_any_of(out, {".glb", ".gltf"}), command, "--light-map",
                "used only with a .glb or .gltf file");
  refuse_unless(colors.display.light_map, command, "--sharp", "used only with --light-map");
  refuse_unless(colors.sharp, command, "--texels", "used only with --sharp");
  refuse_unless(!colors.series.empty(), command, "--series-every", "used only with --series");
  const bool sky_has_zenith = options.sky.is_bright() && options.sky.model != SkyModel::uniform;
  const bool has_sun = options.sky.sun.is_set() || options.sky.sun.below_horizon;
  refuse_unless(
      sky_has_zenith || has_sun || has_picture || is_any_of(out, {".glb", ".gltf"}), command,
      "--up",
      "used only with --sky and --sky-model cie-overcast, a sun, a .glb or .gltf file, or "
      "a picture");
  const bool has_factors = command.get_option("--factors")->count() > 0;
  refuse_unless(takes_directions(options.engine) && !options.goal.is_set() && !has_factors, command,
                "--series",
                "not used with engine hemicube or pairs, an accuracy, a time limit or --factors");
}

void check_series(const ColorOutputs& colors, const std::vector<std::string>& files) {
  if (!colors.series.empty()) {
    ResultSeries(colors.series).check_apart_from(files);
  }
}

}  // namespace transillum::cli
