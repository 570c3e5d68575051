// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "window/command_line.h"

#include <CLI/CLI.hpp>
#include <filesystem>
#include <ostream>

#include "model/run_options.h"
#include "transillum/errors.h"

namespace transillum::viewer {

namespace {

// As the command line keeps them, before names become enumerators.
struct Words {
  std::string sampling, engine, normalize, scheme, first_shot = "none";
  bool one_way = false, two_way = false;
};

// The names that a setting takes, and its sentence.
std::string described(const char* setting, const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) {
    text += (text.empty() ? "" : " | ") + name;
  }
  return text + ": " + description_of(setting);
}

void add_solve_options(CLI::App& app, CommandLine& line, Words& words) {
  SolveOptions& solve = line.solve_options;
  app.add_option("-m,--directions", solve.directions, description_of("directions"))
      ->capture_default_str();
  app.add_option("--sampling", words.sampling, described("sampling", sampling_names()))
      ->capture_default_str();
  app.add_option("--seed", solve.seed, description_of("seed"))->capture_default_str();
  app.add_option("--rotate", solve.rotation, description_of("rotate"));
  app.add_option("--engine", words.engine, described("engine", engine_names()))
      ->capture_default_str();
  app.add_option("--resolution", solve.engine_options.resolution, description_of("resolution"))
      ->check(CLI::Range(1, EngineOptions::largest_resolution));
  auto* one_way =
      app.add_flag("--one-way", words.one_way, "use each direction alone, as the paper does");
  app.add_flag("--two-way", words.two_way, description_of("two-way"))->excludes(one_way);
  app.add_option("--normalize", words.normalize, described("normalize", normalization_names()))
      ->capture_default_str();
  app.add_option("--scheme", words.scheme, described("scheme", scheme_names()))
      ->capture_default_str();
  app.add_option("--first-shot", words.first_shot,
                 described("first-shot", {"none", "auto", "a number"}))
      ->capture_default_str();
  app.add_option("--burn-in", solve.burn_in, description_of("burn-in"))->capture_default_str();
  app.add_option("--replicas", solve.replicas, description_of("replicas"))->capture_default_str();
  auto* iterations = app.add_option("--iterations", solve.iterations, description_of("iterations"))
                         ->check(CLI::PositiveNumber);
  app.add_option("--tolerance", solve.tolerance, description_of("tolerance"))
      ->capture_default_str()
      ->excludes(iterations);
  app.add_flag("--two-sided", line.scene_options.two_sided, description_of("two-sided"));
  app.add_option("--max-patch-area", line.scene_options.max_patch_area,
                 description_of("max-patch-area"))
      ->check(CLI::PositiveNumber);
  app.add_option("--memory", solve.memory, description_of("memory"))
      ->transform(CLI::AsSizeValue(false));
  app.add_option("--threads", solve.threads, description_of("threads"))
      ->check(CLI::NonNegativeNumber);
}

void finish(CommandLine& line, const Words& words, const CLI::App& app) {
  SolveOptions& solve = line.solve_options;
  solve.sampling = sampling_from_name(words.sampling);
  solve.engine = engine_from_name(words.engine);
  solve.two_way = !words.one_way;
  solve.normalize = normalization_from_name(words.normalize);
  solve.scheme = scheme_from_name(words.scheme);
  solve.first_shot = first_shot_from_name(words.first_shot);
  solve.validate();
  if (app.count("--screenshot") > 0) {
    if (line.scene.empty() && line.lesson.empty()) {
      throw InputError("--screenshot needs a SCENE or a --lesson");
    }
    const std::filesystem::path path(line.screenshot);
    if (path.extension() != ".png") {
      throw InputError("--screenshot: \"" + line.screenshot + "\" does not end in .png");
    }
    const std::filesystem::path folder = path.has_parent_path() ? path.parent_path() : ".";
    if (!std::filesystem::is_directory(folder)) {
      throw InputError("--screenshot: there is no folder \"" + folder.string() + "\"");
    }
  }
}

}  // namespace

ParsedCommandLine parse_command_line(int argc, const char* const* argv, std::ostream& out,
                                     std::ostream& error) {
  ParsedCommandLine parsed;
  CommandLine& line = parsed.command_line;
  Words words;
  words.sampling = name_of(line.solve_options.sampling);
  words.engine = name_of(line.solve_options.engine);
  words.normalize = name_of(line.solve_options.normalize);
  words.scheme = name_of(line.solve_options.scheme);

  CLI::App app("Watch diffuse light settle in a scene, direction by direction.",
               "transillum-viewer");
  app.set_version_flag("--version", "transillum-viewer " TRANSILLUM_VERSION);
  app.add_option("SCENE", line.scene,
                 "an .obj file or a built-in scene, solved at once (default: sphere-flake); or a "
                 "result (.vtp), "
                 "a session or a lesson (.json)");
  add_solve_options(app, line, words);
  auto* lesson = app.add_option("--lesson", line.lesson,
                                "a lesson's file, or the number of one that comes along");
  app.add_option("--page", line.page, "the lesson's page to begin with")
      ->needs(lesson)
      ->check(CLI::PositiveNumber);
  auto* screenshot =
      app.add_option("--screenshot", line.screenshot, "write the whole window as PNG, then exit");
  app.add_option(
         "--after", line.after,
         "directions to take before the screenshot (default: the first full iteration; of a result "
         "none)")
      ->needs(screenshot)
      ->check(CLI::PositiveNumber);
  try {
    app.parse(argc, argv);
    finish(line, words, app);
  } catch (const CLI::Success& wish) {  // --help, --version
    parsed.exit_now = true;
    parsed.exit_status = app.exit(wish, out, error);
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
