// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include <fmt/format.h>

#include <memory>

#include "cli/arguments/option_values.h"
#include "cli/arguments/scene_options.h"
#include "cli/commands/commands.h"
#include "cli/interruption.h"
#include "cli/messages.h"
#include "cli/output_files.h"
#include "cli/progress_display.h"
#include "cli/reports/bounds_report.h"
#include "transillum/errors.h"
#include "transillum/files.h"

namespace transillum::cli {
namespace {

struct BoundsCall {
  SceneInput scene;
  BoundsOptions options;
  std::string out;
};

void check_options(const BoundsCall& call) {
  check_seed(call.scene);
  for (const char* option :
       {"--two-sided", "--max-patch-area", "--patches", "--default-reflectance",
        "--max-reflectance", "--scale", "--units", "--join", "--photometric"}) {
    refuse_unless(!call.scene.spec.empty(), *call.scene.command, option, "used only with a SCENE");
  }
  for (const char* option : {"--directions", "--tolerance"}) {
    refuse_unless(!call.scene.spec.empty() || call.options.rho, *call.scene.command, option,
                  "used only with a SCENE or --reflectance, for the prediction");
  }
}

int run(const BoundsCall& call) {
  check_options(call);
  if (!call.out.empty()) {
    check_statistics_path(call.out);
  }
  const std::vector<std::string> outputs = given_files({call.out});
  check_output_files(outputs);
  if (!call.options.run.empty()) {
    check_distinct(outputs, {call.options.run});
  }
  const Cancellation& cancellation = cancel_on_signals();
  BoundsOptions options = call.options;
  const SolveOptions& set = call.scene.run.solve;
  options.directions = set.directions;
  options.sets = {set.used_sampling(), set.seed, set.rotation, set.two_way};
  if (!call.scene.spec.empty()) {
    options.scene = load_input_scene(call.scene, outputs, cancellation);
  }
  ProgressDisplay display;
  const BoundsReport report = make_bounds_report(
      options, [&display](const std::string& task) { display.begin(task); }, cancellation);
  display.clear();
  if (call.out.empty()) {
    print_results(text_of(report));
  } else {
    write_bounds_report(call.out, report);
  }
  return success;
}

/// A number between 0 and `high`, both excluded; 0 is valid if `zero`.
double parse_between(const std::string& option, const std::string& text, bool zero, double high) {
  const double number = parse_number(option, text);
  if (!(zero ? number >= 0 : number > 0) || !(number < high)) {
    throw InputError(fmt::format("{}: \"{}\" is not {} and below {}", option, text,
                                 zero ? "0 or more" : "above 0", high));
  }
  return number;
}

void add_bounds_options(CLI::App& command, BoundsOptions& options) {
  add_parsed_option(command, "--reflectance", "R",
                    "largest reflectance (default: the scene's, or the paper's 0.2 to 0.9)",
                    [&options](const std::string& text) {
                      options.rho = parse_between("--reflectance", text, true, 1);
                    });
  add_parsed_option(
      command, "--accuracy", "A",
      fmt::format("largest error of B, relative to the largest B (default {})", options.accuracy),
      [&options](const std::string& text) {
        options.accuracy = parse_between("--accuracy", text, false, 1);
      });
  add_parsed_option(command, "--size-ratio", "Q",
                    "R2/A, the square of the scene's extent divided by the smallest patch's area "
                    "(default: the scene's, or the paper's 150)",
                    [&options](const std::string& text) {
                      options.size_ratio = parse_between("--size-ratio", text, false, 1e30);
                    });
  add_parsed_option(command, "--tolerance", "T",
                    fmt::format("tolerance of the iteration (default {})", options.tolerance),
                    [&options](const std::string& text) {
                      options.tolerance = parse_between("--tolerance", text, false, 1);
                    });
}

}  // namespace

Command add_bounds_command(CLI::App& program) {
  auto call = std::make_shared<BoundsCall>();
  CLI::App& command = *program.add_subcommand(
      "bounds", "Prints how many directions an accuracy requires, guaranteed and estimated");
  command
      .add_option("SCENE", call->scene.spec, "scene that defines the largest reflectance and R2/A")
      ->type_name("");
  call->scene.command = &command;
  add_bounds_options(command, call->options);
  add_sections(command, call->scene, {"Directions", "Patches"});
  add_options(command, call->scene,
              {"default-reflectance", "max-reflectance", "scale", "units", "join", "photometric"});
  command
      .add_option("--run", call->options.run,
                  "file of solve --stats with --replicas; M is estimated from its error")
      ->type_name("STATS.json");
  command.add_option("-o,--out", call->out, "write JSON instead of text on standard output")
      ->type_name("FILE.json");
  command.footer(
      "Prints Tables 1, 2 and 3 of the paper: as printed, by its formulas, and the numbers of\n"
      "directions that the chosen sampling requires. For one reflectance, or a scene, also\n"
      "predicts the convergence and errors with M directions.\n"
      "Example: transillum bounds cornell-box --accuracy 0.005");
  return [call] { return run(*call); };
}

}  // namespace transillum::cli
