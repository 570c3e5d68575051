// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include <fmt/format.h>

#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "commands.h"
#include "interruption.h"
#include "messages.h"
#include "option_values.h"
#include "output_files.h"
#include "progress_display.h"
#include "transillum/errors.h"
#include "transillum/map_files.h"

namespace transillum::cli {
namespace {

struct MapCall {
  std::string scene;
  SceneOptions scene_options;
  Vec3 direction;
  PatchId receiver = no_patch;
  MapPictureOptions picture;
  std::vector<std::string> out;
};

void check_receiver(const MapCall& call, const Scene& scene) {
  if (call.receiver < scene.patch_count()) return;
  throw InputError(fmt::format("--receiver: there is no patch {} of {}: they are 0 to {}",
                               call.receiver, scene.patch_count(), scene.patch_count() - 1));
}

VisibilityMap make_map(const MapCall& call, const Scene& scene, const Cancellation& cancellation) {
  ProgressDisplay progress;
  const BspTree tree(scene, cancellation, [&](double share) { progress.show("sorting", share); });
  const RecordedDirection direction = record_local_map(scene, tree, call.direction, cancellation);
  return call.receiver == no_patch ? map_from_below(direction)
                                   : map_of_receiver(direction, call.receiver);
}

int run(const MapCall& call) {
  const Cancellation& cancellation = cancel_on_signals();
  for (const std::string& file : call.out) check_map_path(file);
  check_output_files(call.out, call.scene);
  const auto scene = load_scene(call.scene, call.scene_options, cancellation);
  check_receiver(call, *scene);
  print_warnings(*scene);
  const VisibilityMap map = make_map(call, *scene, cancellation);
  const std::string reason = why_empty(*scene, map);
  if (!reason.empty()) print_message("note: the map is empty, since " + reason);
  for (const std::string& file : call.out) {
    cancellation.throw_if_cancelled();
    write_map(file, *scene, map, call.picture);
  }
  return success;
}

}  // namespace

Run add_map_command(CLI::App& program) {
  auto call = std::make_shared<MapCall>();
  CLI::App& command =
      *program.add_subcommand("map", "Writes or draws one direction's visibility map");
  add_scene_argument(command, call->scene);
  add_direction_option(command, call->direction);
  add_parsed_option(command, "--receiver", "I",
                    "what patch I sees (default: what is seen from below the whole scene)",
                    [call](const std::string& text) {
                      call->receiver = static_cast<PatchId>(parse_whole_number(
                          "--receiver", text, 0, std::numeric_limits<PatchId>::max()));
                    });
  add_parsed_option(
      command, "--size", "PIXELS",
      fmt::format("longer side of .svg and .png (default {})", call->picture.size),
      [call](const std::string& text) {
        call->picture.size = static_cast<int>(parse_whole_number(
            "--size", text, MapPictureOptions::least_size, MapPictureOptions::largest_size));
      });
  add_scene_options(command, call->scene_options);
  command
      .add_option(
          "-o,--out", call->out,
          "a picture (.svg, .png) or the polygons in the plane's coordinates (.vtp, .json); "
          "may be given several times")
      ->type_name("FILE")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
      ->required();
  command.footer("Example: transillum map cornell-box --direction 1,2,3 --out map.svg");
  return [call] { return run(*call); };
}

}  // namespace transillum::cli
