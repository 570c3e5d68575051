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

std::string place_text(const Scene& scene, PatchId i) {
  const Patch& patch = scene.patch(i);
  return fmt::format("patch {} (face {}, material {}{})", i, patch.face, scene.material(i).name,
                     patch.group == no_group ? "" : ", group " + at(scene.groups(), patch.group));
}

std::string sky_text(const std::string& difference) {
  return difference.empty() ? "" : report_row("skies differ", difference);
}

std::string percent(double fraction) { return fmt::format("{:.4g} %", 100 * fraction); }

std::string worst_text(const Scene& scene, const SurfaceDifference& worst) {
  if (worst.worst == no_patch) {
    return report_row("worst surface", "none: all have the same B");
  }
  return report_row("worst surface", fmt::format("{}: {} RMS{}", worst.name, percent(worst.rms),
                                                 dark_text(worst.is_dark))) +
         report_row("largest there",
                    fmt::format("{}, {}", percent(worst.largest), place_text(scene, worst.worst))) +
         report_row("B there, W/m2",
                    fmt::format("{} and {}", rgb_text(worst.first, 8), rgb_text(worst.second, 8)));
}

std::string table_text(const std::vector<SurfaceDifference>& surfaces) {
  std::size_t width = 7;
  for (const SurfaceDifference& surface : surfaces) {
    width = std::max(width, surface.name.size());
  }
  std::string text = fmt::format("\n{:<{}} {:>9} {:>11} {:>11}  {}\n", "surface", width, "patches",
                                 "RMS", "largest", "where");
  bool any_dark = false;
  for (const SurfaceDifference& surface : surfaces) {
    const std::string where =
        surface.worst == no_patch ? std::string() : fmt::format("patch {}", surface.worst);
    text += fmt::format("{:<{}} {:>9} {:>11} {:>11}  {}{}\n", surface.name, width, surface.patches,
                        percent(surface.rms), percent(surface.largest), where,
                        surface.is_dark ? " (dark)" : "");
    any_dark = any_dark || surface.is_dark;
  }
  if (any_dark) {
    text += "(dark): relative to a thousandth of the level of the brightest surface\n";
  }
  return text + "\n";
}

std::string comparison_text(const Scene& scene, const ResultComparison& comparison) {
  std::string text = report_row("patches", fmt::format("{}", scene.patch_count()));
  text += sky_text(comparison.sky_difference);
  text += worst_text(scene, comparison.surfaces.front());
  if (comparison.surfaces.size() > 1) {
    text += table_text(comparison.surfaces);
  }
  return text;
}

std::string function_text(const FunctionDifference& difference) {
  return report_row("L2 of functions", fmt::format("{:.4g} of the L2 norm of A", difference.l2));
}

std::string whole_text(double rms) {
  return report_row("RMS over all", fmt::format("{} of the RMS of reflected light", percent(rms)));
}

/// @param what differs: "the results", or a surface of them
int exit_status(const std::string& what, double difference, const CompareCall& call) {
  if (call.tolerance && difference > *call.tolerance) {
    flush_results();
    print_message(fmt::format("{} differ by {}, more than the tolerance of {}", what,
                              percent(difference), percent(*call.tolerance)));
    return failure;
  }
  return success;
}

/// A hint at --functions where two results differ in their patches only; else empty.
std::string hint(const Solution& first, const Solution& second) {
  try {
    if (first.scene->patch_count() != second.scene->patch_count()) {
      compare_functions(first, second);
      return "; --functions compares results whose patches alone differ";
    }
  } catch (const InputError&) {
    // --functions refuses them, too.
  }
  return {};
}

double parse_tolerance(const std::string& text) {
  const bool is_percentage = text.ends_with('%');
  const std::string number = is_percentage ? text.substr(0, text.size() - 1) : text;
  const double tolerance = parse_number("--tolerance", number);
  if (tolerance < 0) {
    throw InputError(fmt::format("--tolerance: \"{}\" is less than 0", text));
  }
  return is_percentage ? tolerance / 100 : tolerance;
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
    throw InputError(fmt::format("{} and {}: {}{}", call.first, call.second, error.what(),
                                 call.functions ? "" : hint(first, second)));
  }
  if (call.functions) {
    print_results(report_row("patches", fmt::format("{} and {}", first.scene->patch_count(),
                                                    second.scene->patch_count())) +
                  sky_text(sky_difference(first, second)) + function_text(difference));
    return exit_status("the results", difference.l2, call);
  }
  print_results(comparison_text(*first.scene, comparison) + function_text(difference) +
                whole_text(comparison.rms));
  const SurfaceDifference& worst = comparison.surfaces.front();
  return exit_status(fmt::format("the results of surface \"{}\"", worst.name), worst.rms, call);
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
                    "exit with status 1 if the RMS of the worst surface exceeds this, as 0.01 or "
                    "1%; with --functions, the L2 norm",
                    [call](const std::string& text) { call->tolerance = parse_tolerance(text); });
  command.add_flag(
      "--functions", call->functions,
      "compare B as functions on the faces, also of scenes that differ in their patches "
      "only, as by --max-patch-area: the L2 norm of the difference");
  command.footer(
      "Differences of B by surface: group, else material, else connected component; the worst\n"
      "first. They are relative to the surface's own level, the RMS of its B - E in A, or to a\n"
      "thousandth of the brightest surface's level where that is larger (dark). Patches that emit\n"
      "or reflect nothing are omitted, unless all do. The RMS over all patches comes last.\n"
      "The color channel that differs the most gives each number.\n"
      "With --basis linear, B of a patch is its mean, and L2 is the norm of the functions.\n"
      "Results of different scenes are refused.\n"
      "Example: transillum compare coarse.vtp fine.vtp --tolerance 0.01");
  return [call] { return run(*call); };
}

}  // namespace transillum::cli
