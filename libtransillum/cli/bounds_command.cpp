// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include <fmt/format.h>

#include <memory>

#include "bounds_report.h"
#include "commands.h"
#include "interruption.h"
#include "messages.h"
#include "option_values.h"
#include "output_files.h"
#include "sequence_options.h"
#include "transillum/errors.h"
#include "transillum/files.h"

namespace transillum::cli {
namespace {

struct BoundsCall {
  std::string scene;
  SceneOptions scene_options;
  SequenceOptions sequence;
  BoundsQuestion question;
  bool one_way = false;
  std::string out;
};

int run(const BoundsCall& call) {
  if (!call.out.empty()) {
    check_statistics_path(call.out);
  }
  check_output_files(call.out.empty() ? std::vector<std::string>() : std::vector{call.out},
                     call.scene);
  const Cancellation& cancellation = cancel_on_signals();
  BoundsQuestion question = call.question;
  question.directions = call.sequence.directions;
  question.sets = {call.sequence.sampling, call.sequence.seed, call.sequence.rotation,
                   !call.one_way};
  if (!call.scene.empty()) {
    question.scene = load_scene(call.scene, call.scene_options, cancellation);
    print_warnings(*question.scene);
  }
  const BoundsReport report = answer(question, cancellation);
  if (call.out.empty()) {
    fmt::print("{}", text_of(report));
  } else {
    write_bounds_report(call.out, report);
  }
  return success;
}

/// A number between 0 and `high`, neither included unless `zero` is.
double parse_between(const std::string& option, const std::string& text, bool zero, double high) {
  const double number = parse_number(option, text);
  if (!(zero ? number >= 0 : number > 0) || !(number < high)) {
    throw InputError(fmt::format("{}: \"{}\" is not {} and below {}", option, text,
                                 zero ? "0 or more" : "above 0", high));
  }
  return number;
}

void add_question(CLI::App& command, BoundsQuestion& question) {
  add_parsed_option(command, "--reflectance", "R",
                    "the largest reflectance (default: the scene's, or the paper's 0.2 to 0.9)",
                    [&question](const std::string& text) {
                      question.rho = parse_between("--reflectance", text, true, 1);
                    });
  add_parsed_option(
      command, "--accuracy", "A",
      fmt::format("the error of B to stay below, of the largest B (default {})", question.accuracy),
      [&question](const std::string& text) {
        question.accuracy = parse_between("--accuracy", text, false, 1);
      });
  add_parsed_option(command, "--size-ratio", "Q",
                    "R2/A, the square of the scene's extent over the smallest patch's area "
                    "(default: the scene's, or the paper's 150)",
                    [&question](const std::string& text) {
                      question.size_ratio = parse_between("--size-ratio", text, false, 1e30);
                    });
  add_parsed_option(command, "--tolerance", "T",
                    fmt::format("of the iteration (default {})", question.tolerance),
                    [&question](const std::string& text) {
                      question.tolerance = parse_between("--tolerance", text, false, 1);
                    });
}

}  // namespace

Run add_bounds_command(CLI::App& program) {
  auto call = std::make_shared<BoundsCall>();
  CLI::App& command = *program.add_subcommand(
      "bounds", "Tells how many directions the paper's bounds ask for, and how many it takes");
  command.add_option("SCENE", call->scene, "whose reflectance and R2/A to take")->type_name("");
  add_question(command, call->question);
  add_sequence_options(command, call->sequence);
  command.add_flag("--one-way", call->one_way,
                   "measure each direction alone, not with its opposite");
  add_scene_options(command, call->scene_options);
  command
      .add_option("--run", call->question.run,
                  "what solve --stats wrote, with --replicas: estimates M from its error")
      ->type_name("STATS.json");
  command.add_option("-o,--out", call->out, "JSON instead of the text on standard output")
      ->type_name("FILE.json");
  command.footer(
      "Prints Tables 1, 2 and 3 of the paper: its figures, those its formulas give, and what the "
      "sets of\nthe chosen sampling need. For one reflectance, or a scene, also what M directions "
      "promise.\n"
      "Example: transillum bounds cornell-box --accuracy 0.005");
  return [call] { return run(*call); };
}

}  // namespace transillum::cli
