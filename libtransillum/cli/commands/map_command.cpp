// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/memory_limit.h"
#include "cli/arguments/option_values.h"
#include "cli/arguments/scene_options.h"
#include "cli/commands/commands.h"
#include "cli/interruption.h"
#include "cli/messages.h"
#include "cli/output_files.h"
#include "cli/progress_display.h"
#include "io/drawing/picture_figure.h"
#include "transillum/errors.h"
#include "transillum/files.h"
#include "transillum/map_files.h"
#include "visibility/pixels/pixel_map.h"

namespace transillum::cli {
namespace {

struct MapCall {
  const CLI::App* command = nullptr;
  SceneInput scene;
  Vec3 direction;
  PatchId receiver = no_patch;
  std::optional<std::int32_t> step;  ///< number of steps done; unset means all
  bool difference = false;
  MapPictureOptions picture;
  std::optional<double> centimeters;  ///< size of pictures, instead of pixels
  std::vector<std::string> out;

  MapCall() { scene.run.solve.engine = Engine::local; }
  Engine engine() const { return scene.run.solve.engine; }
  bool is_exact() const { return engine() == Engine::local; }
  /// Options of a file. Figures have the pixels of a screen with scale 1, as in CSS.
  MapPictureOptions picture_of(const std::string& file) const {
    MapPictureOptions options = picture;
    if (centimeters && is_map_picture(file)) {
      const bool has_pixels = is_screen_picture(file);
      const double pixels_per_inch = has_pixels ? printed_pixels_per_inch : PictureFigure::screen;
      options.size = static_cast<int>(std::lround(*centimeters / 2.54 * pixels_per_inch));
      options.pixels_per_inch = has_pixels ? pixels_per_inch : 0;
    }
    return options;
  }
};

void check_receiver(const MapCall& call, const Scene& scene) {
  if (call.receiver < scene.patch_count()) {
    return;
  }
  throw InputError(fmt::format("--receiver: no patch {}; patches are numbered 0 to {}",
                               call.receiver, scene.patch_count() - 1));
}

VisibilityMap exact_map(const MapCall& call, const Scene& scene, const BspTree& tree,
                        const Cancellation& cancellation) {
  const RecordedDirection direction =
      record_local_map(scene, tree, call.direction, cancellation, call.scene.run.solve.memory);
  const std::int32_t steps = direction.record.step_count();
  if (call.step.value_or(0) > steps) {
    throw InputError(fmt::format("--step: no step {}; the steps of this direction are 0 to {}",
                                 *call.step, steps));
  }
  return call.receiver == no_patch ? map_after(direction, call.step.value_or(steps) - 1)
                                   : map_of_receiver(direction, call.receiver);
}

VisibilityMap make_map(const MapCall& call, const std::shared_ptr<const Scene>& scene,
                       const Cancellation& cancellation) {
  ProgressDisplay progress;
  const auto tree = build_tree(*scene, cancellation, progress);
  if (call.is_exact()) {
    return exact_map(call, *scene, *tree, cancellation);
  }
  const PixelMap pixels = pixel_map({call.engine(), call.scene.run.solve.engine_options}, *scene,
                                    *tree, call.direction, call.receiver, cancellation);
  VisibilityMap map = drawn_in_pixels(*scene, pixels);
  if (call.difference) {
    mark_differences(pixels, exact_map(call, *scene, *tree, cancellation), map, cancellation);
  }
  return map;
}

/// A hint for engines whose results only the viewer can show.
std::string viewer_hint(Engine engine) {
  using Picture = EngineTraits::Picture;
  const Picture picture = traits_of(engine).picture;
  const bool has_view = picture == Picture::corrected || picture == Picture::hemicube;
  return has_view ? " (the viewer can show it)" : "";
}

void add_pixel_options(CLI::App& command, MapCall& call) {
  add_parsed_option(
      command, "--engine", "NAME",
      "local (default): exact map; zbuffer | painter | rays: map from the pixels of this engine",
      [&call](const std::string& text) {
        call.scene.run.solve.engine = from_name<Engine>(text);
        if (!call.is_exact() && !has_pixels(call.engine())) {
          throw InputError(
              fmt::format("--engine: {} has no map that can be written; choose local, zbuffer, "
                          "painter or rays{}",
                          text, viewer_hint(call.engine())));
        }
      });
  add_parsed_option(command, "--resolution", "R",
                    fmt::format("pixels along the longer side of the projected scene (default {})",
                                PixelMap::default_resolution),
                    [&call](const std::string& text) {
                      call.scene.run.solve.engine_options.resolution =
                          static_cast<int>(parse_whole_number("--resolution", text, 1,
                                                              PixelMap::largest_resolution));
                      call.scene.given.insert("resolution");
                    });
  add_options(command, call.scene, {"order"});
  command.add_flag("--difference", call.difference, "mark pixels that differ from the exact map");
}

/// Three digits of a number, rounded up or down, so that a limit that is printed keeps the limit.
std::string three_digits(double x, bool up) {
  const double unit = std::pow(10.0, std::floor(std::log10(x)) - 2);
  return fmt::format("{:.3g}", unit * (up ? std::ceil(x / unit) : std::floor(x / unit)));
}

/// The title and the legend of a figure take 470 pixels, or 600 with the legend of pixels.
void check_centimeters(const MapCall& call, const std::string& file) {
  if (!call.centimeters || !is_map_picture(file)) {
    return;
  }
  const bool is_figure = !is_screen_picture(file);
  const double pixel = 2.54 / (is_figure ? PictureFigure::screen : printed_pixels_per_inch);
  const int least = !is_figure ? MapPictureOptions::smallest_size : call.is_exact() ? 470 : 600;
  const int most = MapPictureOptions::largest_size;
  const double size = std::round(*call.centimeters / pixel);
  if (size < least) {
    throw InputError(fmt::format("--size: {:g}cm is too small for {}: {} {}cm", *call.centimeters,
                                 file, is_figure ? "its title and legend take" : "the least is",
                                 three_digits(pixel * least, true)));
  }
  if (size > most) {
    throw InputError(fmt::format("--size: {:g}cm is too large for {}: the most is {}cm",
                                 *call.centimeters, file, three_digits(pixel * most, false)));
  }
}

/// Memory that the pixels of a .png file may take.
void check_pixel_memory(const MapCall& call, const std::string& file) {
  constexpr double bytes_of_pixel = 40;
  const double size = call.picture_of(file).size;
  const double taken = bytes_of_pixel * size * size;
  const auto free = static_cast<double>(free_memory());
  if (is_screen_picture(file) && taken > free) {
    throw InputError(fmt::format(
        "--size: {} takes up to {:.3g} GB of memory with {:.0f} pixels along each side, but "
        "{:.3g} GB are free",
        file, 1e-9 * taken, size, 1e-9 * free));
  }
}

void check_options(const MapCall& call) {
  refuse_unused(call.scene, {call.scene.run});
  refuse_unless(!call.is_exact(), *call.command, "--difference",
                "used only with engine zbuffer, painter or rays");
  refuse_unless(call.is_exact() && call.receiver == no_patch, *call.command, "--step",
                "used only with engine local, without --receiver");
  refuse_unless(call.is_exact() || call.difference, *call.command, "--memory",
                "used only with engine local, or with --difference");
  const bool pictures = std::any_of(call.out.begin(), call.out.end(), is_map_picture);
  for (const char* option : {"--size", "--title", "--transparent"}) {
    refuse_unless(pictures, *call.command, option, "used only with .svg, .pdf and .png files");
  }
  for (const std::string& file : call.out) {
    check_centimeters(call, file);
    call.picture_of(file).validate();
    check_pixel_memory(call, file);
  }
}

int run(const MapCall& call) {
  const Cancellation& cancellation = cancel_on_signals();
  check_options(call);
  for (const std::string& file : call.out) {
    check_map_path(file);
  }
  check_output_files(call.out);
  const auto scene = load_input_scene(call.scene, call.out, cancellation);
  check_receiver(call, *scene);
  const VisibilityMap map = make_map(call, scene, cancellation);
  const std::string reason = empty_map_reason(*scene, map);
  if (!reason.empty()) {
    print_message("note: the map is empty: " + reason);
  }
  std::vector<std::function<void()>> writers;
  for (const std::string& file : call.out) {
    writers.emplace_back([&] {
      cancellation.throw_if_canceled();
      write_map(file, *scene, map, call.picture_of(file));
    });
  }
  write_all(writers);
  return success;
}

}  // namespace

Command add_map_command(CLI::App& program) {
  auto call = std::make_shared<MapCall>();
  CLI::App& command =
      *program.add_subcommand("map", "Writes or draws the visibility map of one direction");
  call->command = &command;
  add_scene_argument(command, call->scene);
  add_direction_option(command, call->direction);
  add_parsed_option(command, "--receiver", "I",
                    "only what patch I sees (default: the map seen from below the whole scene)",
                    [call](const std::string& text) {
                      call->receiver = static_cast<PatchId>(parse_whole_number(
                          "--receiver", text, 0, std::numeric_limits<PatchId>::max()));
                    });
  add_parsed_option(
      command, "--step", "K",
      "V after the first K fragments in BSP order, as the viewer steps through them (default: all)",
      [call](const std::string& text) {
        call->step = static_cast<std::int32_t>(
            parse_whole_number("--step", text, 0, std::numeric_limits<std::int32_t>::max()));
      });
  add_pixel_options(command, *call);
  add_options(command, call->scene, {"memory"});
  command.get_option("--memory")
      ->description(
          "memory limit for the record of the map's making, such as 2G or 800M (default: a "
          "quarter of the machine's)");
  add_parsed_option(
      command, "--size", "PIXELS|Ncm",
      fmt::format("length of the longer side of .svg, .pdf and .png, in pixels, or in cm, such as "
                  "16cm, of .png at {:.0f} pixels per inch (default {})",
                  printed_pixels_per_inch, call->picture.size),
      [call](const std::string& text) {
        call->centimeters = parse_centimeters("--size", text);
        if (call->centimeters) {
          return;
        }
        call->picture.size = static_cast<int>(parse_whole_number(
            "--size", text, MapPictureOptions::smallest_size, MapPictureOptions::largest_size));
      });
  add_figure_options(command, call->picture.title, call->picture.transparent,
                     "no paper and no dark background behind the map");
  add_scene_options(command, call->scene);
  command
      .add_option("-o,--out", call->out,
                  "picture (.svg, .pdf, .png) or polygons in coordinates of the plane (.vtp, "
                  ".json); may be "
                  "given several times")
      ->type_name("FILE")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
      ->required();
  command.footer(
      "Example: transillum map cornell-box --direction 1,2,3 --out map.svg\n"
      "         transillum map cornell-box --direction 1,2,3 --receiver 26 --engine zbuffer \\\n"
      "           --resolution 64 --difference --out pixels.png");
  return [call] { return run(*call); };
}

}  // namespace transillum::cli
