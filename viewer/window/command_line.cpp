// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "window/command_line.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <ostream>
#include <set>
#include <string>
#include <utility>

#include "model/run_options.h"
#include "transillum/errors.h"
#include "transillum/files.h"
#include "transillum/material_changes.h"
#include "window/first_look.h"

namespace transillum::viewer {

namespace {

/// Directions of a solve for a screenshot: an error of about a percent, within seconds.
constexpr int screenshot_directions = 128;
/// With linear functions, which show what single directions miss as wrong slopes.
constexpr int soft_directions = 1024;

// As the command line keeps them, before names become enumerators.
struct Names {
  std::string sampling, engine, normalize, scheme, basis, first_shot, burn_in = "auto";
  std::string accuracy, accuracy_of = "rms", refine_until;
  bool one_way = false, two_way = false;
};

// The choices of an option, and what it is.
std::string with_choices(const std::vector<std::string>& choices, const std::string& meaning) {
  std::string text;
  for (const std::string& name : choices) {
    text += (text.empty() ? "" : " | ") + name;
  }
  return text + ": " + meaning;
}
std::string described(const char* setting, const std::vector<std::string>& choices) {
  return with_choices(choices, description_of(setting));
}

/// @param chosen options that an accuracy or a time limit chooses
void add_goal_options(CLI::App& app, AccuracyGoal& goal, Names& names,
                      const std::vector<CLI::Option*>& chosen) {
  auto* accuracy =
      app.add_option("--accuracy", names.accuracy, description_of("accuracy"))->type_name("P%|X");
  auto* seconds = app.add_option("--seconds", goal.seconds, description_of("seconds"))
                      ->check(CLI::PositiveNumber);
  for (CLI::Option* option : chosen) {
    accuracy->excludes(option);
    seconds->excludes(option);
  }
  app.add_option("--accuracy-of", names.accuracy_of,
                 described("accuracy-of", {"rms", "max", "patch:I", "mean"}))
      ->capture_default_str();
}

void add_sky_options(CLI::App& app, Sky& sky) {
  app.add_option_function<std::string>(
         "--sky",
         [&sky](const std::string& text) {
           sky.exitance = *exitance_change("sky=" + text).exitance;
         },
         "what an unobstructed patch turned upward receives from a sky, in W/m² (default: no sky)")
      ->type_name("E[,E,E]");
  app.add_option_function<std::string>(
         "--sky-model", [&sky](const std::string& name) { sky.model = sky_model_from_name(name); },
         with_choices(sky_model_names(), "distribution of the sky's light (default: uniform)"))
      ->needs("--sky");
  app.add_option_function<std::vector<double>>(
         "--up",
         [&sky](const std::vector<double>& up) {
           sky.up = normalized({up.at(0), up.at(1), up.at(2)});
         },
         "zenith of the sky cie-overcast (default: 0,0,1)")
      ->type_name("X,Y,Z")
      ->delimiter(',')
      ->expected(3)
      ->needs("--sky");
}

void add_solve_options(CLI::App& app, CommandLine& line, Names& names) {
  SolveOptions& solve = line.solve_options;
  auto* directions =
      app.add_option("-m,--directions", solve.directions, description_of("directions"))
          ->capture_default_str();
  app.add_option("--sampling", names.sampling, described("sampling", sampling_names()))
      ->default_str(name_of(default_sampling(true)));
  app.add_option("--seed", solve.seed, description_of("seed"))->capture_default_str();
  app.add_option("--rotate", solve.rotation, description_of("rotate"));
  app.add_option("--engine", names.engine, described("engine", engine_names()))
      ->capture_default_str();
  app.add_option("--resolution", solve.engine_options.resolution, description_of("resolution"))
      ->check(CLI::Range(1, EngineOptions::largest_resolution));
  auto* one_way =
      app.add_flag("--one-way", names.one_way, "use each direction alone, as the paper does");
  app.add_flag("--two-way", names.two_way, description_of("two-way"))->excludes(one_way);
  app.add_option("--normalize", names.normalize, described("normalize", normalization_names()))
      ->capture_default_str();
  app.add_option("--scheme", names.scheme, described("scheme", scheme_names()))
      ->capture_default_str();
  app.add_option("--basis", names.basis, described("basis", basis_names()))->capture_default_str();
  app.add_flag("--glossy", solve.glossy, description_of("glossy"));
  app.add_option("--first-shot", names.first_shot,
                 described("first-shot", {"none", "auto", "a number"}))
      ->default_str("none");
  app.add_option("--burn-in", names.burn_in, description_of("burn-in"))
      ->check(CLI::IsMember({"auto"}) | CLI::Range(0, 1'000'000))
      ->capture_default_str();
  auto* replicas = app.add_option("--replicas", solve.replicas, description_of("replicas"))
                       ->capture_default_str();
  add_goal_options(app, solve.goal, names, {directions, replicas});
  auto* iterations = app.add_option("--iterations", solve.iterations, description_of("iterations"))
                         ->check(CLI::PositiveNumber);
  app.add_option("--tolerance", solve.tolerance, description_of("tolerance"))
      ->capture_default_str()
      ->excludes(iterations);
  add_sky_options(app, solve.sky);
  app.add_option("--memory", solve.memory, description_of("memory"))
      ->transform(CLI::AsSizeValue(false));
  app.add_option("--threads", solve.threads, description_of("threads"))
      ->check(CLI::NonNegativeNumber);
}

/// An option NAME=V or NAME=V,V,V that may be given several times; changes apply in the order of
/// the command line.
void add_change_option(CLI::App& app, const std::string& name, const std::string& form,
                       const std::string& help, std::vector<MaterialChange>& changes,
                       MaterialChange (*parse)(const std::string&)) {
  app.add_option_function<std::vector<std::string>>(
         name,
         [&changes, parse](const std::vector<std::string>& texts) {
           for (const std::string& text : texts) {
             changes.push_back(parse(text));
           }
         },
         help)
      ->type_name(form)
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
}

void add_scene_options(CLI::App& app, CommandLine& line, Names& names) {
  ReadOptions& read = line.input.read;
  app.add_option("--default-reflectance", read.default_reflectance,
                 "reflectance where a file defines none")
      ->capture_default_str();
  app.add_option("--max-reflectance", read.max_reflectance,
                 "lower larger reflectances of a file to this (default: only those of 1 and more)");
  auto* scale = app.add_option("--scale", read.scale, "meters per unit of the scene's coordinates")
                    ->capture_default_str();
  app.add_option_function<std::string>(
         "--units", [&read](const std::string& name) { read.scale = length_unit_from_name(name); },
         with_choices(length_unit_names(), "unit of the scene's coordinates (default: m)"))
      ->excludes(scale);
  app.add_flag_function(
      "--join,!--no-join", [&read](std::int64_t count) { read.join = count > 0; },
      "join faces of one plane, material and group that share edges (default: only for "
      "glTF and STL)");
  app.add_flag("--photometric", read.photometric,
               "glTF: emissive colors are luminances in cd/m² instead of radiances");
  app.add_option_function<std::string>(
         "--orient", [&line](const std::string& choice) { line.input.orient = choice == "auto"; },
         "keep | auto: turn faces so that what is seen is the lit side (default: keep)")
      ->check(CLI::IsMember({"keep", "auto"}));
  add_change_option(
      app, "--emission", "NAME=E[,E,E]",
      "exitance of a material, a group or face:N, in W/m²; may be given several times",
      line.input.changes, exitance_change);
  add_change_option(app, "--reflectance", "NAME=R[,R,R]",
                    "reflectance of a material, a group or face:N; may be given several times",
                    line.input.changes, reflectance_change);
  add_change_option(app, "--lobe", "NAME=K,N",
                    "lobe of a material, a group or face:N, for --glossy: the share K of the light "
                    "that it reflects, or three, and its exponent N; may be given several times",
                    line.input.changes, lobe_change);
  app.add_flag("--two-sided", line.scene_options.two_sided, description_of("two-sided"));
  auto* area = app.add_option("--max-patch-area", line.scene_options.max_patch_area,
                              description_of("max-patch-area"))
                   ->check(CLI::PositiveNumber);
  app.add_option("--patches", line.input.patches,
                 "divide faces into about this number of patches, by a limit of their area; with "
                 "--refine-by: the most patches to make")
      ->check(CLI::Range(1, 1 << 26))
      ->excludes(area);
  auto* by =
      app.add_option_function<std::string>(
             "--refine-by",
             [&line](const std::string& name) { line.refine.by = refine_by_from_name(name); },
             described("refine-by", refine_by_names()))
          ->needs("--patches");
  app.add_option("--refine-until", names.refine_until, description_of("refine-until"))
      ->type_name("P%|X")
      ->needs(by);
}

/// @throws InputError where the file has another ending, or no folder
void check_output(const std::string& option, const std::string& file, const std::string& ending) {
  const std::filesystem::path path(file);
  if (path.extension() != ending) {
    throw InputError(option + ": \"" + file + "\" does not end in " + ending);
  }
  const std::filesystem::path folder = path.has_parent_path() ? path.parent_path() : ".";
  if (!std::filesystem::is_directory(folder)) {
    throw InputError(option + ": there is no folder \"" + folder.string() + "\"");
  }
}

/// Whether none but these options is given.
bool has_only(const CLI::App& app, const std::set<std::string>& names) {
  const auto options = app.get_options();
  return std::all_of(options.begin(), options.end(), [&](const CLI::Option* option) {
    return option->count() == 0 || names.count(option->get_name()) > 0;
  });
}

/// What a screenshot shows unless options say otherwise.
void choose_look(CommandLine& line, const CLI::App& app) {
  SolveOptions& solve = line.solve_options;
  if (app.count("--directions") + app.count("--after") == 0) {
    solve.directions = screenshot_directions;
  }
  const std::int64_t patches = soft_patches(line.scene);
  if (patches > 0 && has_only(app, {"SCENE", "--screenshot", "--threads", "--memory"})) {
    line.input.patches = patches;
    solve.basis = Basis::linear;
    solve.directions = soft_directions;
  }
}

void finish(CommandLine& line, const Names& names, const CLI::App& app) {
  SolveOptions& solve = line.solve_options;
  solve.engine = engine_from_name(names.engine);
  solve.two_way = !names.one_way;
  if (!names.sampling.empty()) {
    solve.sampling = unless_default(sampling_from_name(names.sampling), solve.two_way);
  }
  solve.normalize = normalization_from_name(names.normalize);
  solve.scheme = scheme_from_name(names.scheme);
  solve.basis = basis_from_name(names.basis);
  if (!names.accuracy.empty()) {
    solve.goal.accuracy = accuracy_from_text(names.accuracy);
  }
  const AccuracyGoal of = accuracy_of_from_name(names.accuracy_of);
  solve.goal.of = of.of;
  solve.goal.patch = of.patch;
  if (!names.first_shot.empty()) {
    solve.first_shot = first_shot_from_name(names.first_shot);
  } else if (solve.goal.set() && solve.basis == Basis::constant) {
    solve.first_shot = first_shot_where_it_pays;
  }
  if (names.burn_in != "auto") {
    solve.burn_in = std::stoi(names.burn_in);
  }
  if (app.count("--screenshot") > 0) {
    choose_look(line, app);
  }
  solve.validate();
  if (line.refine.set()) {
    line.refine.patches = static_cast<int>(std::exchange(line.input.patches, 0));
    line.refine.until = names.refine_until.empty() ? 0 : accuracy_from_text(names.refine_until);
    line.refine.options().validate();
    if (solve.goal.seconds > 0) {
      throw InputError("--seconds: not used with --refine-by");
    }
  }
  line.input.read.validate();
  for (const char* option : {"--default-reflectance", "--max-reflectance", "--scale", "--units",
                             "--join", "--photometric", "--orient"}) {
    line.reading_given = line.reading_given || app.count(option) > 0;
  }
  if (is_result_file(line.scene) && !(line.input == SceneInput{})) {
    throw InputError(
        "options of scenes, such as --emission and --scale, do not apply to the result \"" +
        line.scene + "\"");
  }
  if (app.count("--screenshot") > 0) {
    if (line.scene.empty() && line.lesson.empty()) {
      throw InputError("--screenshot needs a SCENE or a --lesson");
    }
    check_output("--screenshot", line.screenshot, ".png");
  }
  if (app.count("--export-lesson") > 0) {
    check_output("--export-lesson", line.lesson_file, ".html");
  }
}

/// The lesson, its export, and the screenshot.
void add_window_options(CLI::App& app, CommandLine& line) {
  auto* lesson =
      app.add_option("--lesson", line.lesson, "a lesson file, or the number of a built-in lesson")
          ->type_name("FILE.json|N");
  app.add_option("--page", line.page, "page of the lesson to start at")
      ->needs(lesson)
      ->check(CLI::PositiveNumber);
  auto* screenshot =
      app.add_option("--screenshot", line.screenshot, "write the whole window as PNG, then exit")
          ->type_name("FILE.png");
  app.add_option("--export-lesson", line.lesson_file, "write the lesson as HTML, then exit")
      ->type_name("FILE.html")
      ->needs(lesson)
      ->excludes(screenshot);
  app.add_option(
         "--after", line.after,
         "number of directions before the screenshot (default: until the solve has converged, "
         "with 128 directions if -m is not given; none for a result)")
      ->needs(screenshot)
      ->check(CLI::PositiveNumber);
}

/// The definitions, and where they put what they parse.
struct Definitions {
  CLI::App app{"Shows how the light in a diffuse scene converges, direction by direction.",
               "transillum-viewer"};
  CommandLine line;
  Names names;

  Definitions() {
    names.engine = name_of(line.solve_options.engine);
    names.normalize = name_of(line.solve_options.normalize);
    names.scheme = name_of(line.solve_options.scheme);
    names.basis = name_of(line.solve_options.basis);
    app.set_version_flag("--version", "transillum-viewer " TRANSILLUM_VERSION);
    app.add_option("SCENE", line.scene,
                   "a scene file or a built-in scene, solved at once (default: sphere-flake); or a "
                   "result (.vtp), a session or a lesson (.json)");
    add_solve_options(app, line, names);
    add_scene_options(app, line, names);
    add_window_options(app, line);
  }
};

}  // namespace

void with_definitions(const std::function<void(const CLI::App&)>& use) { use(Definitions().app); }

ParsedCommandLine parse_command_line(int argc, const char* const* argv, std::ostream& out,
                                     std::ostream& error) {
  ParsedCommandLine parsed;
  Definitions definitions;
  CLI::App& app = definitions.app;
  try {
    app.parse(argc, argv);
    finish(definitions.line, definitions.names, app);
    parsed.command_line = definitions.line;
  } catch (const CLI::Success& request) {  // --help, --version
    parsed.exit_now = true;
    parsed.exit_status = app.exit(request, out, error);
  } catch (const CLI::ParseError& wrong) {
    error << "transillum-viewer: " << wrong.what() << '\n';
    parsed.exit_now = true;
    parsed.exit_status = 2;
  } catch (const InputError& wrong) {
    error << "transillum-viewer: " << wrong.what() << '\n';
    parsed.exit_now = true;
    parsed.exit_status = 2;
  }
  return parsed;
}

}  // namespace transillum::viewer
