// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "window/command_line.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <memory>
#include <ostream>
#include <set>
#include <string>

#include "cli/arguments/help_format.h"
#include "cli/arguments/option_arguments.h"
#include "transillum/errors.h"
#include "transillum/files.h"
#include "window/files/first_look.h"

namespace transillum::viewer {

namespace {

/// Directions of a solve for a screenshot. They give an error of about a percent within seconds.
constexpr int screenshot_directions = 128;
/// Directions with linear functions, where light that single directions miss appears as wrong
/// slopes.
constexpr int soft_directions = 1024;

/// @throws InputError where the file has another ending, or its folder does not exist
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

/// Whether no options other than these are given.
bool has_only(const CLI::App& app, const std::set<std::string>& names) {
  const auto options = app.get_options();
  return std::all_of(options.begin(), options.end(), [&](const CLI::Option* option) {
    return option->count() == 0 || names.count(option->get_name()) > 0;
  });
}

/// Chooses the solve of a screenshot unless options say otherwise.
void choose_look(CommandLine& line, const CLI::App& app) {
  SolveOptions& solve = line.options.solve;
  if (app.count("--accuracy") + app.count("--seconds") + app.count("--directions") == 0) {
    solve.goal = {};
    if (app.count("--after") == 0) {
      solve.directions = screenshot_directions;
    }
  }
  line.first_look = has_only(app, {"SCENE", "--screenshot", "--threads", "--memory", "--up"});
  if (line.first_look && has_first_look(line.scene)) {
    solve.directions = soft_directions;
  }
}

void finish(CommandLine& line, const cli::GivenOptions& given, const CLI::App& app) {
  line.options = given.run;
  for (const char* choice : {"max-patch-area", "patches", "basis", "refine-by", "total", "paper"}) {
    line.first_look = line.first_look && given.given.count(choice) == 0;
  }
  if (given.given.count("up") > 0) {
    line.up = line.options.solve.sky.up;
  }
  if (app.count("--screenshot") > 0) {
    choose_look(line, app);
  }
  line.options.validate();
  line.reading_given = std::any_of(
      given.given.begin(), given.given.end(),
      [](const std::string& name) { return option(name).reads_scene && !option(name).repeats; });
  if (is_result_file(line.scene) && !(line.options.input == SceneInput{})) {
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

/// Adds the options of the lesson, its export, and the screenshot.
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
  for (const char* option : {"--page", "--export-lesson", "--after"}) {
    app.get_option(option)->group("Lessons and pictures");
  }
}

/// The definitions, and the members that receive the parsed values.
struct Definitions {
  CLI::App app{"Shows how the light in a diffuse scene converges, direction by direction.",
               "transillum-viewer"};
  CommandLine line;
  cli::GivenOptions options;

  Definitions() {
    app.formatter(std::make_shared<cli::HelpFormat>());
    app.set_help_all_flag("--help-all", "show all options, by group");
    app.set_version_flag("--version", "transillum-viewer " TRANSILLUM_VERSION);
    app.add_option("SCENE", line.scene,
                   "a scene file or a built-in scene, solved at once; or a "
                   "result (.vtp), a session or a lesson (.json)");
    cli::add_sections(app, options,
                      {"Directions", "Engine", "Iteration", "Accuracy", "Scene", "Patches",
                       "Refinement", "Sky", "Machine"});
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
    cli::complete(definitions.options);
    finish(definitions.line, definitions.options, app);
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
