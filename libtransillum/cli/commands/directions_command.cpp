// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>
#include <ostream>
#include <string>
#include <utility>

#include "cli/arguments/scene_options.h"
#include "cli/commands/commands.h"
#include "cli/interruption.h"
#include "cli/messages.h"
#include "cli/output_files.h"
#include "cli/reports/report_text.h"
#include "sampling/discrepancy.h"
#include "transillum/bounds.h"
#include "transillum/errors.h"
#include "transillum/files.h"
#include "transillum/scene.h"
#include "transillum/solve_options.h"

namespace transillum::cli {
namespace {

/// Quality measures of a set of directions, to compare with the bounds for Hammersley points.
struct DirectionStatistics {
  SolveOptions set;
  double star = 0, star_two_way = 0;  ///< two_way: of the directions and their opposites
  CapDiscrepancy cap, cap_two_way;
  std::shared_ptr<const Scene> scene;  ///< scene whose normals were used; null if all normals were
  std::vector<double> one_way, two_way;  ///< eps_i(M) of eq. 17, one per normal
};

using OrderedJson = nlohmann::ordered_json;

/// Number of normals that represent all directions if there is no scene.
constexpr int spread_normal_count = 2048;

std::vector<Vec3> normals_of(const Scene& scene) {
  std::vector<Vec3> normals;
  for (const Patch& patch : scene.patches()) {
    normals.push_back(patch.normal);
  }
  return normals;
}

std::string errors_text(const DirectionStatistics& s, const std::vector<double>& errors) {
  const QuadratureErrors summary = summary_of(errors);
  std::string text = fmt::format("{:.2e} RMS, {:.2e} largest", summary.rms, summary.max);
  if (s.scene) {
    const auto worst = std::max_element(
        errors.begin(), errors.end(), [](double a, double b) { return std::abs(a) < std::abs(b); });
    text += fmt::format(", patch {}", worst - errors.begin());
  }
  return text;
}

OrderedJson errors_json(const DirectionStatistics& s, const std::vector<double>& errors) {
  const QuadratureErrors summary = summary_of(errors);
  OrderedJson json{{"rms", summary.rms}, {"max", summary.max}};
  if (s.scene) {
    json["patches"] = errors;
  }
  return json;
}

DirectionStatistics measure_directions(const SolveOptions& set,
                                       const std::vector<DirectionSample>& samples,
                                       std::shared_ptr<const Scene> scene,
                                       const Cancellation& cancellation) {
  DirectionStatistics s;
  s.set = set;
  s.star = star_discrepancy(samples, cancellation);
  s.cap = cap_discrepancy(samples, cancellation);
  const auto both = with_opposites(samples);
  s.star_two_way = star_discrepancy(both, cancellation);
  s.cap_two_way = cap_discrepancy(both, cancellation);
  const std::vector<Vec3> normals =
      scene ? normals_of(*scene) : spread_normals(spread_normal_count);
  s.one_way = quadrature_errors(normals, samples, false, cancellation);
  s.two_way = quadrature_errors(normals, samples, true, cancellation);
  s.scene = std::move(scene);
  return s;
}

std::string text_of(const DirectionStatistics& s) {
  const int m = s.set.directions;
  std::string text =
      report_row("directions", fmt::format("{}, {}{}", m, name_of(s.set.used_sampling()),
                                           s.set.rotation ? ", rotated" : ""));
  text += report_row("star discrepancy",
                     fmt::format("{:.3e} on the unit square, exact (eq. 3)", s.star));
  text += report_row(
      "", fmt::format("at most {:.3e} for hammersley (eq. 20)", star_discrepancy_bound(m)));
  text += report_row("", fmt::format("{:.3e} with the opposites", s.star_two_way));
  text += report_row("cap discrepancy", fmt::format("{:.3e} on the sphere, {}", s.cap.value,
                                                    s.cap.exact ? "exact" : "a lower bound"));
  text += report_row("", fmt::format("{:.3e} with the opposites, {}", s.cap_two_way.value,
                                     s.cap_two_way.exact ? "exact" : "a lower bound"));
  text += fmt::format(
      "\nQuadrature error eps(M) of the integral of the cosine, exact value pi (eq. 17), over {} "
      "{}:\n",
      s.one_way.size(),
      s.scene ? "patches of " + s.scene->name() : std::string("normals over the sphere"));
  text += report_row("  one-way", errors_text(s, s.one_way));
  text += report_row("  two-way", errors_text(s, s.two_way));
  text += report_row(
      "  bound", fmt::format("{:.2e} for hammersley, one-way (eq. 21)", quadrature_error_bound(m)));
  return text;
}

void write_direction_statistics(const std::string& path, const DirectionStatistics& s) {
  OrderedJson json;
  json["program"] = "transillum " TRANSILLUM_VERSION;
  json["directions"] = s.set.directions;
  json["sampling"] = name_of(s.set.used_sampling());
  json["seed"] = s.set.seed;
  json["rotation"] = s.set.rotation ? OrderedJson(*s.set.rotation) : OrderedJson();
  json["star_discrepancy"] = {{"value", s.star},
                              {"two_way", s.star_two_way},
                              {"bound", star_discrepancy_bound(s.set.directions)}};
  json["cap_discrepancy"] = {{"value", s.cap.value},
                             {"exact", s.cap.exact},
                             {"two_way", s.cap_two_way.value},
                             {"two_way_exact", s.cap_two_way.exact}};
  json["scene"] = s.scene ? OrderedJson(s.scene->name()) : OrderedJson();
  json["eps"] = {{"normals", s.one_way.size()},
                 {"bound", quadrature_error_bound(s.set.directions)},
                 {"one_way", errors_json(s, s.one_way)},
                 {"two_way", errors_json(s, s.two_way)}};
  const std::string text = json.dump(2, ' ', false, OrderedJson::error_handler_t::replace);
  write_file_whole(path, [&](std::ostream& out) { out << text << '\n'; });
}

/// Limit of --stats; more directions take minutes.
constexpr int max_measured = 1 << 20;

struct DirectionsCall {
  std::string out;
  CLI::Option* stats = nullptr;
  std::string stats_file;
  SceneInput scene;

  const SolveOptions& set() const { return scene.run.solve; }
};

std::vector<std::string> checked_outputs(const DirectionsCall& call) {
  check_seed(call.scene);
  if (is_standard_output(call.out) && call.stats->count() > 0 && call.stats_file.empty()) {
    throw InputError("--out: standard output takes the text of --stats; name a file");
  }
  if (!call.stats_file.empty()) {
    check_statistics_path(call.stats_file);
  }
  std::vector<std::string> files = given_files({call.out, call.stats_file});
  check_output_files(files);
  const bool measured = call.stats->count() > 0;
  if (!call.scene.spec.empty() && !measured) {
    throw InputError("--scene requires --stats");
  }
  if (measured && call.set().directions > max_measured) {
    throw InputError(fmt::format("--stats: {} directions exceed the limit of {}",
                                 call.set().directions, max_measured));
  }
  return files;
}

void measure(const DirectionsCall& call, const std::vector<DirectionSample>& samples,
             const std::vector<std::string>& outputs) {
  const Cancellation& cancellation = cancel_on_signals();
  std::shared_ptr<const Scene> scene;
  if (!call.scene.spec.empty()) {
    scene = load_input_scene(call.scene, outputs, cancellation);
  }
  const auto statistics = measure_directions(call.set(), samples, scene, cancellation);
  if (call.stats_file.empty()) {
    print_results(text_of(statistics));
  } else {
    write_direction_statistics(call.stats_file, statistics);
  }
}

int run(const DirectionsCall& call) {
  const std::vector<std::string> outputs = checked_outputs(call);
  const SolveOptions& set = call.set();
  auto samples = make_directions(set.used_sampling(), set.directions, set.seed);
  if (set.rotation) {
    samples = rotated(std::move(samples), *set.rotation);
  }
  if (call.stats->count() > 0) {
    measure(call, samples, outputs);
  }
  if (call.stats->count() == 0 || !call.out.empty()) {
    write_output(call.out, [&](std::ostream& out) { write_directions_csv(out, samples); });
  }
  return success;
}

}  // namespace

Command add_directions_command(CLI::App& program) {
  auto call = std::make_shared<DirectionsCall>();
  CLI::App& command = *program.add_subcommand(
      "directions", "Writes the points and directions of a sequence, or measures their quality");
  call->scene.command = &command;
  add_options(command, call->scene, {"directions", "sampling", "seed", "rotate"});
  command.add_option("-o,--out", call->out, "CSV: u,v,x,y,z (default: standard output)")
      ->type_name("FILE.csv");
  call->stats =
      command
          .add_option("--stats", call->stats_file,
                      "instead of the points, their discrepancies and quadrature errors eps(M) of "
                      "the cosine, with the paper's bounds; as text on standard output, or as JSON "
                      "in a file")
          ->type_name("[FILE.json]")
          ->expected(0, 1);
  command
      .add_option(
          "--scene", call->scene.spec,
          "with --stats: eps(M) for the normals of this scene's patches instead of all normals")
      ->type_name("SCENE");
  command.footer(
      "A solve takes the same directions in another order, which spreads the first ones evenly: "
      "row\n"
      "37 is not pass 37.\n"
      "Example: transillum directions --sampling hammersley -m 64 --out points.csv\n"
      "         transillum directions -m 1024 --stats --scene cornell-box");
  return [call] { return run(*call); };
}

}  // namespace transillum::cli
