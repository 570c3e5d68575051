// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
// `transillum picture`: a scene, which is solved first, or a result, as a camera sees it.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "cli/arguments/option_values.h"
#include "cli/arguments/scene_options.h"
#include "cli/commands/commands.h"
#include "cli/commands/solve_job.h"
#include "cli/commands/write_pictures.h"
#include "cli/interruption.h"
#include "cli/messages.h"
#include "cli/output_files.h"
#include "cli/reports/summaries.h"
#include "scene/read/scene_cameras.h"
#include "transillum/errors.h"
#include "transillum/files.h"
#include "transillum/glossy.h"

namespace transillum::cli {
namespace {

struct PictureCall {
  SceneInput scene;
  PictureRequest picture;  ///< all but the camera
  std::string camera;      ///< --camera
  std::optional<Vec3> eye, target, up;
  std::optional<double> field_of_view, height;
  bool panorama = false, orthographic = false;

  const SolveOptions& solve() const { return scene.run.solve; }
};

void parse_size(const std::string& text, PictureRequest& picture) {
  const std::size_t cross = text.find('x');
  if (cross == std::string::npos) {
    throw InputError(fmt::format(
        "--size: \"{}\" is not a width and a height, such as 1920x1080 or 16x12cm", text));
  }
  const bool printed = text.ends_with("cm");
  const std::string unit = printed ? "cm" : "";
  constexpr double pixel = 2.54 / printed_pixels_per_inch;
  const auto pixels = [&](const std::string& number) {
    const std::optional<double> length = parse_centimeters("--size", number);
    if (!length) {
      return static_cast<int>(
          parse_whole_number("--size", number, 1, PictureOptions::largest_size));
    }
    const double count = std::round(*length / pixel);
    if (count < 1 || count > PictureOptions::largest_size) {
      throw InputError(fmt::format("--size: \"{}\" must have sides of {:.2g} to {:.4g} cm", text,
                                   pixel, pixel * PictureOptions::largest_size));
    }
    return static_cast<int>(count);
  };
  picture.options.width = pixels(text.substr(0, cross) + unit);
  picture.options.height = pixels(text.substr(cross + 1));
  picture.size_text = text;
  picture.pixels_per_inch = printed ? printed_pixels_per_inch : PictureFigure::screen;
}

std::string names_of_cameras(const std::vector<SceneCamera>& cameras) {
  std::vector<std::string> names;
  for (const SceneCamera& camera : cameras) {
    names.push_back(camera.name);
  }
  return fmt::format("{}", fmt::join(names, ", "));
}

/// The camera of the scene's file that is asked for; none with an eye.
/// @throws InputError where there is no such camera, or neither an eye nor a single camera
std::optional<SceneCamera> file_camera(const PictureCall& call, const Cancellation& cancellation) {
  if (call.camera.empty() && call.eye) {
    return std::nullopt;
  }
  const std::vector<SceneCamera> cameras =
      read_cameras(call.scene.spec, call.scene.run.input.read.scale, cancellation);
  if (call.camera.empty()) {
    if (cameras.size() == 1) {
      return cameras.front();
    }
    throw InputError(cameras.empty()
                         ? std::string("a picture requires --eye X,Y,Z")
                         : fmt::format("a picture requires --eye X,Y,Z, or --camera with one of {}",
                                       names_of_cameras(cameras)));
  }
  const auto found = std::find_if(cameras.begin(), cameras.end(), [&](const SceneCamera& camera) {
    return camera.name == call.camera;
  });
  if (found == cameras.end()) {
    throw InputError(fmt::format(
        "--camera: {} has no camera \"{}\"{}", call.scene.spec, call.camera,
        cameras.empty() ? "; it has none" : "; choose one of " + names_of_cameras(cameras)));
  }
  return *found;
}

/// The camera of the file, with what options change of it, or the camera of the options.
Camera camera_of(const PictureCall& call, const Scene& scene,
                 const std::optional<SceneCamera>& given) {
  Camera camera;
  camera.target = scene.bounds().center();
  if (given) {
    camera.eye = given->eye;
    camera.target = given->eye + given->direction;
    camera.up = given->up;
    camera.field_of_view = given->field_of_view;
    if (!given->field_of_view) {
      camera.projection = CameraProjection::orthographic;
      camera.height = given->height;
    }
  }
  camera.eye = call.eye.value_or(camera.eye);
  camera.target = call.target.value_or(camera.target);
  camera.up = call.up ? call.up : camera.up;
  if (call.panorama || call.orthographic) {
    camera.projection = call.panorama ? CameraProjection::panorama : CameraProjection::orthographic;
  }
  camera.field_of_view = call.field_of_view ? call.field_of_view : camera.field_of_view;
  camera.height = call.height ? call.height : camera.height;
  const CLI::App& command = *call.scene.command;
  refuse_unless(camera.projection == CameraProjection::perspective, command, "--fov",
                "not used with a panorama or an orthographic picture");
  refuse_unless(camera.projection == CameraProjection::orthographic, command, "--height",
                "used only with an orthographic picture");
  return camera;
}

/// Refuses options that change nothing.
void check_options(const PictureCall& call) {
  const CLI::App& command = *call.scene.command;
  const std::vector<std::string>& files = call.picture.files;
  const auto shows_colors = [](const std::string& file) {
    return is_screen_picture(file) || is_figure_file(file);
  };
  const bool has_colors = std::any_of(files.begin(), files.end(), shows_colors);
  for (const char* option : {"--exposure", "--tone", "--false-color", "--title", "--transparent"}) {
    refuse_unless(has_colors, command, option, "used only with a .png, .svg or .pdf file");
  }
  refuse_unless(!call.picture.false_colors, command, "--tone", "not used with --false-color");
  refuse_unless(call.picture.false_colors, command, "--lux", "used only with --false-color");
  for (const char* option : {"--lux", "--transparent"}) {
    refuse_unless(std::all_of(files.begin(), files.end(), shows_colors), command, option,
                  "not used with .exr and .pfm files, which have radiance");
  }
}

/// Refuses options of a solve, which a result has behind it.
void check_result_options(const PictureCall& call) {
  for (const std::string& name : call.scene.given) {
    if (name != "threads") {
      throw InputError(fmt::format("--{}: not used with a result, which is solved already", name));
    }
  }
}

Solution read_solution(const PictureCall& call, const Cancellation& cancellation) {
  check_result_options(call);
  check_distinct(call.picture.files, {call.scene.spec});
  return read_result(call.scene.spec, cancellation);
}

Solution solve_scene(const PictureCall& call, const std::shared_ptr<const Scene>& scene,
                     ProgressDisplay& display, const Cancellation& cancellation) {
  const RunOptions& run = call.scene.run;
  std::optional<Checkpoint> no_checkpoint;
  std::optional<MeasuredErrors> errors;
  const SolveJob job{
      .scene = scene,
      .options = run.solve,
      .refine = run.refine.is_set() ? std::optional(run.refine.options()) : std::nullopt,
      .cancellation = cancellation,
      .display = display,
      .quiet = call.picture.quiet,
      .total = total_goal(run),
      .errors = run.total ? &errors : nullptr};
  Solution solution = run_job(job, no_checkpoint);
  display.clear();
  if (!solution.complete) {
    throw NothingToSave("the solve is not finished: no picture is made");
  }
  for (const std::string& warning : solve_warnings(solution)) {
    print_message("warning: " + warning);
  }
  return solution;
}

int run(PictureCall& call) {
  for (const std::string& file : call.picture.files) {
    check_figure_path(file);
  }
  check_output_files(call.picture.files);
  check_options(call);
  const Cancellation& cancellation = cancel_on_signals();
  ProgressDisplay display(call.picture.quiet);
  const std::optional<SceneCamera> given = file_camera(call, cancellation);
  const bool is_result = is_result_file(call.scene.spec);
  std::optional<Solution> solution;
  std::shared_ptr<const Scene> scene;
  if (is_result) {
    solution = read_solution(call, cancellation);
    scene = solution->scene;
  } else {
    call.scene.divides_few_faces = true;
    complete(call.scene);
    scene = load_input_scene(call.scene, call.picture.files, cancellation, Light::required);
  }
  call.picture.camera = camera_of(call, *scene, given);
  call.picture.options.threads = call.solve().threads;
  check_picture_request(call.picture, scene);
  if (!is_result) {
    solution = solve_scene(call, scene, display, cancellation);
  }
  write_pictures(call.picture, std::make_shared<const Solution>(*std::move(solution)), display,
                 cancellation);
  return success;
}

void add_camera_options(CLI::App& command, const std::shared_ptr<PictureCall>& call) {
  const auto add_point = [&](const char* name, const char* help, std::optional<Vec3>& point) {
    add_parsed_option(command, name, "X,Y,Z", help,
                      [name, &point](const std::string& text) { point = parse_point(name, text); });
  };
  add_point("--eye", "the point that the scene is seen from, in m", call->eye);
  add_point("--target",
            "the point in the middle of the picture, in m (default: the center of the scene)",
            call->target);
  add_point("--camera-up", "the direction that is up in the picture (default 0,0,1)", call->up);
  command
      .add_option("--camera", call->camera,
                  "a camera of a glTF file by its name, instead of --eye; a file's only camera "
                  "needs no name")
      ->type_name("CAMERA")
      ->excludes(command.get_option("--eye"));
  add_parsed_option(command, "--fov", "DEG",
                    "vertical angle of view, in degrees (default: the whole scene, up to 75)",
                    [call](const std::string& text) {
                      call->field_of_view = parse_positive("--fov", text, 180);
                    });
  auto* panorama =
      command.add_flag("--panorama", call->panorama,
                       "all directions: longitude across, latitude upward (equirectangular)");
  command
      .add_flag("--orthographic", call->orthographic,
                "parallel rays, from the plane through the eye")
      ->excludes(panorama);
  add_parsed_option(
      command, "--height", "H",
      "height that an orthographic picture shows, in m (default: the whole scene)",
      [call](const std::string& text) { call->height = parse_positive("--height", text); });
}

void add_picture_options(CLI::App& command, const std::shared_ptr<PictureCall>& call) {
  PictureRequest& picture = call->picture;
  PictureOptions& options = picture.options;
  add_parsed_option(
      command, "--size", "WxH",
      fmt::format(
          "width and height, in pixels, or in cm at {:.0f} pixels per inch, such as 16x12cm "
          "(default {}x{})",
          printed_pixels_per_inch, options.width, options.height),
      [&picture](const std::string& text) { parse_size(text, picture); });
  add_parsed_option(
      command, "--samples", "N",
      fmt::format("points at which each pixel is sampled (default {})", options.samples),
      [&options](const std::string& text) {
        options.samples = static_cast<int>(
            parse_whole_number("--samples", text, 1, PictureOptions::most_samples));
      });
  add_parsed_option(
      command, "--gather", "N",
      "rays from each sample that gather the reflected light (default 0: it is interpolated "
      "between points of the surfaces)",
      [&options](const std::string& text) {
        options.gather =
            static_cast<int>(parse_whole_number("--gather", text, 0, PictureOptions::most_rays));
      })
      ->group("Accuracy");
  add_parsed_option(command, "--exposure", "X|auto",
                    "B times X is the linear color on a screen, 1 is white; 1/X is the upper "
                    "end of false colors (default auto: 98 % of the area that does not emit is "
                    "below white)",
                    [&picture](const std::string& text) {
                      picture.exposure.reset();
                      if (text != "auto") {
                        picture.exposure = parse_positive("--exposure", text);
                      }
                    });
  add_parsed_option(
      command, "--tone", "NAME",
      fmt::format("tone curve of a .png, .svg or .pdf file: {} (default linear)",
                  fmt::join(names_of<ToneCurve>(), " | ")),
      [&picture](const std::string& text) { picture.tone = from_name<ToneCurve>(text); });
  command.add_flag("--false-color", picture.false_colors,
                   "B by a color map, with a scale in W/m2 beside the picture");
  command.add_flag(
      "--lux", picture.lux,
      "--false-color shows illuminance in lux, 683 lm/W of irradiance H, instead of B");
  add_figure_options(command, picture.title, options.transparent,
                     "nothing is drawn where no surface is: neither sky nor paper");
  command
      .add_option("-o,--out", picture.files,
                  "picture: .png for a screen; .svg, .pdf, a figure with the title and the scale "
                  "as vectors; or .exr, .pfm with radiance in W/(m2 sr); "
                  "may be given several times")
      ->type_name("FILE")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
      ->allow_extra_args(false)
      ->required();
  command.add_flag("-q,--quiet", picture.quiet, "no progress and no summary on standard error");
}

}  // namespace

Command add_picture_command(CLI::App& program) {
  auto call = std::make_shared<PictureCall>();
  CLI::App& command = *program.add_subcommand("picture",
                                              "Makes a picture of a scene or a result, with sharp "
                                              "shadows of direct light");
  add_scene_argument(command, call->scene);
  CLI::Option* scene = command.get_option("SCENE");
  scene->description(
      "a result, .vtp, or what is solved first, as `solve` does it, in 2,000 patches if it has "
      "fewer than 1,000 faces: " +
      scene->get_description());
  add_camera_options(command, call);
  add_picture_options(command, call);
  add_sections(command, call->scene,
               {"Directions", "Engine", "Iteration", "Accuracy", "Scene", "Patches", "Refinement",
                "Sky", "Machine"});
  for (const std::string& name : call->scene.offered) {
    command.get_option("--" + name)->group(option(name).section);
  }
  command.footer(
      "Ctrl-C ends the command at once, with exit status 130 and without a file.\n"
      "Example: transillum picture cornell-box --eye 0.278,0.27,-0.8 --camera-up 0,1,0 \\\n"
      "           --size 800x800 --out cornell.png");
  return [call] { return run(*call); };
}

}  // namespace transillum::cli
