// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
// The argument SCENE and its options: parsing, and the steps from them to a Scene: reading, changes
// of materials, the limit of patch areas, checks and warnings.
#include "scene_options.h"

#include <fmt/format.h>

#include <algorithm>

#include "messages.h"
#include "option_values.h"
#include "progress_display.h"
#include "report_text.h"
#include "transillum/errors.h"
#include "transillum/files.h"
#include "transillum/patch_count.h"

namespace transillum::cli {
namespace {

constexpr std::int64_t most_patches_asked_for = 50'000'000;

/// A number, in the range that `valid` describes to the user.
double parse_in_range(const std::string& option, const std::string& text, const std::string& valid,
                      bool (*is_valid)(double)) {
  const double number = parse_number(option, text);
  if (!is_valid(number)) {
    throw InputError(fmt::format("{}: \"{}\" is not {}", option, text, valid));
  }
  return number;
}

double parse_reflectance(const std::string& option, const std::string& text) {
  return parse_in_range(option, text, "at least 0 and below 1",
                        [](double r) { return r >= 0 && r < 1; });
}

double parse_positive(const std::string& option, const std::string& text) {
  return parse_in_range(option, text, "greater than 0", [](double x) { return x > 0; });
}

/// An option NAME=V or NAME=V,V,V that may be given several times.
void add_change_option(CLI::App& command, const std::string& name, const std::string& type,
                       const std::string& help, std::vector<MaterialChange>& changes,
                       MaterialChange (*parse)(const std::string&)) {
  command
      .add_option_function<std::vector<std::string>>(
          name,
          [=, &changes](const std::vector<std::string>& texts) {
            for (const std::string& text : texts) {
              try {
                changes.push_back(parse(text));
              } catch (const InputError& error) {
                throw InputError(fmt::format("{}: {}", name, error.what()));
              }
            }
          },
          help)
      ->type_name(type)
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
}

/// "12345 patches of at most 0.01 m2; about 24 MB of memory", before they are made.
std::string patches_text(std::int64_t count, double max_area, bool keeps_factors) {
  return fmt::format("{} patches of at most {:.4g} m2; about {:.3g} MB of memory{}", count,
                     max_area, 1e-6 * static_cast<double>(expected_memory(count)),
                     keeps_factors ? " without form factors, which --memory limits" : "");
}

bool has_option(const CLI::App& command, const std::string& name) {
  return command.get_option_no_throw(name) != nullptr;
}

/// The value of --threads; 0: not given.
int threads_of(const CLI::App& command) {
  const CLI::Option* threads = command.get_option_no_throw("--threads");
  return threads == nullptr || threads->count() == 0
             ? 0
             : parse_thread_count("--threads", threads->results().back());
}

bool is_quiet(const CLI::App& command) {
  const CLI::Option* quiet = command.get_option_no_throw("--quiet");
  return quiet != nullptr && quiet->count() > 0;
}

/// The group or material that most of the backs are of, for a message.
std::string most_backs(const BackShare& backs) {
  const bool by_group = !backs.groups.empty();
  const std::vector<BackCount>& counts = by_group ? backs.groups : backs.materials;
  return counts.empty() ? std::string()
                        : fmt::format(" ({} of {} \"{}\")", share_text(counts.front().of_all),
                                      by_group ? "group" : "material", counts.front().name);
}

/// Turns parts of the scene and prints what was done, and what is still seen from behind.
void orient_input(const SceneInput& input, SceneDescription& description,
                  const Cancellation& cancellation) {
  ProgressDisplay display(is_quiet(*input.command));
  display.begin("turning faces");
  const OrientationReport report =
      orient(description, threads_of(*input.command), cancellation,
             [&](double share) { display.show("turning faces", share); });
  display.clear();
  if (!is_quiet(*input.command)) {
    for (const std::string& sentence : report.sentences) {
      print_message("orientation: " + sentence);
    }
  }
  if (input.options.two_sided) {
    return;
  }
  const BackShare backs =
      back_share(Scene(description, {}, cancellation), threads_of(*input.command), cancellation);
  if (backs.share > BackShare::worth_a_warning) {
    print_message(
        fmt::format("warning: {} of what light meets are backs of faces, which absorb it, also "
                    "after turning faces{} (try --two-sided)",
                    share_text(backs.share), most_backs(backs)));
  }
}

/// One line that says that a sky lights nothing where all lit sides are shut in; else empty.
std::string sky_advice(const SceneInput& input, const Scene& scene, const BackShare& backs) {
  // A room of two-sided faces is closed, but the sky lights it outside.
  if (backs.open > 0 || has_two_sided_faces(scene)) {
    return {};
  }
  return fmt::format(
      "the sky lights no face: no ray from a lit side leaves the scene, and backs of faces absorb "
      "its light (try --two-sided{})",
      input.orient ? ", or --orient keep" : " or --orient auto");
}

/// The options of the scene with the limit of patch areas that --patches asks for. Prints what the
/// division will make.
SceneOptions division(const SceneInput& input, const SceneDescription& description,
                      const Cancellation& cancellation) {
  SceneOptions options = input.options;
  if (input.in_rounds || (input.patches == 0 && options.max_patch_area == 0)) {
    return options;
  }
  options.max_patch_area = 0;
  const Scene whole(description, options, cancellation);
  options.max_patch_area = input.patches > 0
                               ? max_patch_area_for(whole, input.patches, cancellation)
                               : input.options.max_patch_area;
  if (whole.patch_count() > input.patches && input.patches > 0) {
    print_message(fmt::format("warning: --patches: the faces make {} patches already, more than {}",
                              whole.patch_count(), input.patches));
  } else if (options.max_patch_area > 0) {
    const std::int64_t count = count_patches(whole, options.max_patch_area);
    if (!is_quiet(*input.command)) {
      print_message(
          patches_text(count, options.max_patch_area, has_option(*input.command, "--memory")));
    }
    check_memory(whole.name(), count);
  }
  return options;
}

/// ".obj, .gltf, …", all formats of scenes.
std::string scene_endings() {
  std::vector<std::string> endings;
  for (const SceneFormat& format : scene_formats()) {
    endings.push_back(format.ending);
  }
  return fmt::format("{}", fmt::join(endings, ", "));
}

}  // namespace

void add_scene_argument(CLI::App& command, SceneInput& input) {
  input.command = &command;
  command
      .add_option("SCENE", input.spec,
                  fmt::format("a scene file ({}; OBJ: in its .mtl, Kd = reflectance, Ke = exitance "
                              "in W/m2), or a built-in scene with parameters, such as "
                              "sphere-flake:levels=1",
                              scene_endings()))
      ->required()
      ->type_name("");
}

void add_reading_options(CLI::App& command, SceneInput& input) {
  add_parsed_option(command, "--default-reflectance", "R",
                    fmt::format("reflectance where a file defines none: missing, undefined or "
                                "nameless materials, unreadable textures (default {})",
                                input.read.default_reflectance),
                    [&input](const std::string& text) {
                      input.read.default_reflectance =
                          parse_reflectance("--default-reflectance", text);
                    });
  add_parsed_option(command, "--max-reflectance", "R",
                    fmt::format("lower larger reflectances of a file to R (default: lower only "
                                "those of 1 and more, to {})",
                                ReadOptions::default_max_reflectance),
                    [&input](const std::string& text) {
                      input.read.max_reflectance = parse_reflectance("--max-reflectance", text);
                    });
  auto* scale = add_parsed_option(
      command, "--scale", "X", "meters per unit of the scene's coordinates (default 1)",
      [&input](const std::string& text) { input.read.scale = parse_positive("--scale", text); });
  add_parsed_option(
      command, "--units", "NAME",
      fmt::format("unit of the scene's coordinates: {} (default m)",
                  fmt::join(length_unit_names(), " | ")),
      [&input](const std::string& text) { input.read.scale = length_unit_from_name(text); })
      ->excludes(scale);
  command.add_flag_function(
      "--join,!--no-join", [&input](std::int64_t count) { input.read.join = count > 0; },
      "join faces of one plane, material and group that share edges (default: only "
      "for glTF and STL, which have triangles alone)");
  command.add_flag("--photometric", input.read.photometric,
                   "glTF: emissive colors are luminances in cd/m2 instead of radiances: divide by "
                   "683 lm/W");
}

void add_material_options(CLI::App& command, SceneInput& input) {
  add_change_option(command, "--emission", "NAME=E[,E,E]",
                    "exitance of a material, a group or face:N, in W/m2; may be given several "
                    "times",
                    input.changes, exitance_change);
  add_change_option(command, "--reflectance", "NAME=R[,R,R]",
                    "reflectance of a material, a group or face:N; may be given several times",
                    input.changes, reflectance_change);
  add_change_option(command, "--lobe", "NAME=K,N",
                    "lobe of a material, a group or face:N, for --glossy: the share K of the light "
                    "that it reflects (or R,G,B,N) and the exponent N of Phong's cosine; may be "
                    "given several times",
                    input.changes, lobe_change);
}

void add_orientation_option(CLI::App& command, SceneInput& input) {
  add_parsed_option(
      command, "--orient", "NAME",
      "auto: turn parts of the scene so that what is seen is the lit side, and make "
      "open sheets two-sided; keep: as in the file (default keep)",
      [&input](const std::string& text) {
        if (text != "keep" && text != "auto") {
          throw InputError(fmt::format("--orient: \"{}\" is neither keep nor auto", text));
        }
        input.orient = text == "auto";
      });
}

void add_patch_options(CLI::App& command, SceneInput& input) {
  command.add_flag("--two-sided", input.options.two_sided, description_of("two-sided"));
  auto* area =
      add_parsed_option(command, "--max-patch-area", "A", help_of("max-patch-area", "no limit"),
                        [&input](const std::string& text) {
                          input.options.max_patch_area = parse_positive("--max-patch-area", text);
                        });
  add_parsed_option(command, "--patches", "N",
                    "divide faces into about N patches, by a limit of their area that is chosen "
                    "for it",
                    [&input](const std::string& text) {
                      input.patches =
                          parse_whole_number("--patches", text, 1, most_patches_asked_for);
                    })
      ->excludes(area);
}

void add_scene_options(CLI::App& command, SceneInput& input) {
  add_reading_options(command, input);
  add_material_options(command, input);
  add_orientation_option(command, input);
  add_patch_options(command, input);
}

SceneDescription describe_input(const SceneInput& input, const Cancellation& cancellation) {
  SceneDescription description = describe_scene(input.spec, input.read, cancellation);
  change_materials(description, input.changes);
  if (input.orient) {
    orient_input(input, description, cancellation);
  }
  return description;
}

std::shared_ptr<const Scene> make_input_scene(const SceneInput& input,
                                              const SceneDescription& description,
                                              const Cancellation& cancellation) {
  return std::make_shared<const Scene>(description, division(input, description, cancellation),
                                       cancellation);
}

bool has_two_sided_faces(const Scene& scene) {
  const auto& patches = scene.patches();
  return std::adjacent_find(patches.begin(), patches.end(), [](const Patch& a, const Patch& b) {
           return a.face == b.face && a.center == b.center;
         }) != patches.end();
}

std::string orientation_advice(const SceneInput& input, const BackShare& backs) {
  if (backs.share <= BackShare::worth_a_warning || input.orient) {
    return {};
  }
  return fmt::format(
      "{} of what light meets are backs of faces, which absorb it (try --orient "
      "auto)",
      share_text(backs.share));
}

std::shared_ptr<const Scene> load_input_scene(const SceneInput& input,
                                              const std::vector<std::string>& outputs,
                                              const Cancellation& cancellation, Light light) {
  const SceneDescription description = describe_input(input, cancellation);
  check_distinct(outputs, description.files);
  check_memory(description.name, static_cast<std::int64_t>(description.face_count()));
  auto scene = make_input_scene(input, description, cancellation);
  print_warnings(*scene);
  if (light == Light::required && !scene->has_light()) {
    throw InputError(fmt::format(
        "{}: nothing emits light, so B would be 0 everywhere; give a material, a group or a face "
        "an exitance in W/m2, such as --emission '{}=10'",
        scene->name(), suggested_light(description)));
  }
  if (light == Light::sky || (light == Light::required && !input.orient)) {
    const BackShare backs = back_share(*scene, threads_of(*input.command), cancellation);
    const std::string advice = light == Light::required ? orientation_advice(input, backs)
                                                        : sky_advice(input, *scene, backs);
    if (!advice.empty()) {
      print_message("warning: " + advice);
    }
  }
  return scene;
}

}  // namespace transillum::cli
