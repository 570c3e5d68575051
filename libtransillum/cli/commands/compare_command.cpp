// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
// `transillum compare`: how much the radiosity of two result files differs, and where.
#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <optional>

#include "cli/arguments/option_values.h"
#include "cli/commands/commands.h"
#include "cli/interruption.h"
#include "cli/messages.h"
#include "cli/output_files.h"
#include "cli/reports/report_text.h"
#include "radiosity/analysis/function_comparison.h"
#include "radiosity/analysis/result_comparison.h"
#include "transillum/at.h"
#include "transillum/errors.h"
#include "transillum/files.h"

namespace transillum::cli {
namespace {

struct CompareCall {
  std::string first, second;
  std::optional<double> tolerance;
  bool functions = false;
};

Solution read(const std::string& file, const Cancellation& cancellation) {
  if (!is_result_file(file)) {
    throw InputError(
        fmt::format("{}: only results in .vtp files hold a scene and can be compared", file));
  }
  return read_result(file, cancellation);
}

std::string group_name(const Scene& scene, std::int32_t group) {
  return group == no_group ? "(no group)" : at(scene.groups(), group);
}

std::string place_text(const Scene& scene, const RadiosityDifference& difference) {
  const Patch& patch = scene.patch(difference.worst);
  return fmt::format("patch {} (face {}, material {}{})", difference.worst, patch.face,
                     scene.material(difference.worst).name,
                     patch.group == no_group ? "" : ", group " + at(scene.groups(), patch.group));
}

std::string comparison_text(const Scene& scene, const ResultComparison& comparison) {
  const RadiosityDifference& whole = comparison.whole;
  std::string text = report_row("patches", fmt::format("{}", scene.patch_count()));
  if (!comparison.sky_difference.empty()) {
    text += report_row("skies differ", comparison.sky_difference);
  }
  text += report_row("RMS", fmt::format("{:.4g} of the RMS of reflected light", whole.rms));
  text +=
      report_row("largest", fmt::format("{:.4g} of the largest reflected light", whole.largest));
  if (whole.worst != no_patch) {
    text += report_row("where", place_text(scene, whole));
    text += report_row("B there, W/m2", fmt::format("{} and {}", rgb_text(whole.first, 8),
                                                    rgb_text(whole.second, 8)));
  }
  if (comparison.groups.size() < 2) {
    return text;
  }
  std::size_t width = 5;
  for (const GroupDifference& group : comparison.groups) {
    width = std::max(width, group_name(scene, group.group).size());
  }
  text += fmt::format("\n{:<{}} {:>9} {:>11} {:>11}  {}\n", "group", width, "patches", "RMS",
                      "largest", "where");
  for (const GroupDifference& group : comparison.groups) {
    const RadiosityDifference& d = group.difference;
    text += fmt::format("{:<{}} {:>9} {:>11.4g} {:>11.4g}  {}\n", group_name(scene, group.group),
                        width, group.patches, d.rms, d.largest,
                        d.worst == no_patch ? "" : fmt::format("patch {}", d.worst));
  }
  return text;
}

std::string function_text(const FunctionDifference& difference) {
  return report_row("L2 of functions", fmt::format("{:.4g} of the L2 norm of A", difference.l2));
}

int exit_status(double worst, const CompareCall& call) {
  if (call.tolerance && worst > *call.tolerance) {
    flush_results();
    print_message(fmt::format("the results differ by {:.4g}, more than the tolerance of {}", worst,
                              *call.tolerance));
    return failure;
  }
  return success;
}

int run(const CompareCall& call) {
  const Cancellation& cancellation = cancel_on_signals();
  const Solution first = read(call.first, cancellation), second = read(call.second, cancellation);
  FunctionDifference difference;
  ResultComparison comparison;
  try {
    if (!call.functions) {
      comparison = compare_results(first, second);
    }
    difference = compare_functions(first, second);
  } catch (const InputError& error) {
    throw InputError(fmt::format("{} and {}: {}", call.first, call.second, error.what()));
  }
  if (call.functions) {
    print_results(report_row("patches", fmt::format("{} and {}", first.scene->patch_count(),
                                                    second.scene->patch_count())) +
                  function_text(difference));
    return exit_status(difference.l2, call);
  }
  print_results(comparison_text(*first.scene, comparison) + function_text(difference));
  return exit_status(std::max(comparison.whole.rms, comparison.whole.largest), call);
}

}  // namespace

Command add_compare_command(CLI::App& program) {
  auto call = std::make_shared<CompareCall>();
  CLI::App& command =
      *program.add_subcommand("compare", "Compares the radiosity of two results of a scene");
  command.add_option("A", call->first, "result file, .vtp: what differences are relative to")
      ->type_name("A.vtp")
      ->required();
  command.add_option("B", call->second, "result file, .vtp")->type_name("B.vtp")->required();
  add_parsed_option(command, "--tolerance", "T",
                    "exit with status 1 if the RMS or the largest difference exceeds this",
                    [call](const std::string& text) {
                      call->tolerance = parse_number("--tolerance", text);
                      if (*call->tolerance < 0) {
                        throw InputError(fmt::format("--tolerance: \"{}\" is less than 0", text));
                      }
                    });
  command.add_flag(
      "--functions", call->functions,
      "compare B as functions on the faces, also of scenes that differ in their patches "
      "only, as by --max-patch-area: the L2 norm of the difference");
  command.footer(
      "Differences of B, relative to the reflected light of A: B - E of patches that do not emit,\n"
      "or of all where the others reflect nothing. By group, they are relative to the group's "
      "light.\n"
      "With --basis linear, B of a patch is its mean, and L2 is the norm of the functions.\n"
      "Results of different scenes are refused.\n"
      "Example: transillum compare coarse.vtp fine.vtp --tolerance 0.01");
  return [call] { return run(*call); };
}

}  // namespace transillum::cli
