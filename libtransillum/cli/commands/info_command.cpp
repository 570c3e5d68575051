// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
// `transillum info`: counts and sizes of a scene, what was repaired, and, by random rays and, if
// asked for, exactly along some directions, whether it is closed and what is seen from behind.
#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <memory>
#include <set>

#include "cli/arguments/option_values.h"
#include "cli/arguments/scene_options.h"
#include "cli/commands/commands.h"
#include "cli/interruption.h"
#include "cli/messages.h"
#include "cli/output_files.h"
#include "cli/progress_display.h"
#include "cli/reports/report_text.h"
#include "transillum/at.h"
#include "transillum/orientation.h"
#include "transillum/radiosity_solver.h"
#include "transillum/solids.h"
#include "transillum/solve_options.h"
#include "visibility/bsp/coplanar_overlap.h"

namespace transillum::cli {
namespace {

/// Fractions of area below this are rounding (ALGORITHM.md, oracle 1).
constexpr double open_fraction = 1e-9;
/// Longest list in the report.
constexpr std::size_t max_listed = 20;
/// Largest number of overlaps to search for; coincident faces can have very many.
constexpr std::size_t max_overlaps = 10000;

struct InfoCall {
  SceneInput scene;
  int directions = 0;  ///< 0 means rays only
};

void print_row(const std::string& name, const std::string& value) {
  print_results(report_row(name, value));
}

std::string point_text(const Vec3& p) {
  return fmt::format("({:.6g}, {:.6g}, {:.6g})", p.x, p.y, p.z);
}

void print_counts(const Scene& scene) {
  const SceneReport& report = scene.report();
  print_row("scene", scene.name());
  print_row("faces", fmt::format("{}", report.faces));
  print_row("patches", fmt::format("{}", scene.patch_count()));
  print_row("convex pieces", fmt::format("{}", scene.pieces().size()));
  print_row("points", fmt::format("{}", scene.points().size()));
  print_row("materials", fmt::format("{}", scene.materials().size()));
}

void print_size_and_light(const Scene& scene) {
  double area = 0, smallest = HUGE_VAL, largest = 0, rho_max = 0;
  Rgb power;
  for (PatchId i = 0; i < scene.patch_count(); ++i) {
    const double a = scene.patch(i).area;
    area += a;
    smallest = std::min(smallest, a);
    largest = std::max(largest, a);
    rho_max = std::max(rho_max, max_abs(scene.reflectance(i)));
    power += a * scene.exitance(i);
  }
  print_row("bounding box",
            point_text(scene.bounds().low) + " to " + point_text(scene.bounds().high) + " m");
  print_row("area", fmt::format("{:.6g} m2; patches {:.3g} to {:.3g} m2", area, smallest, largest));
  print_row("rho max", fmt::format("{:.6g}", rho_max));
  print_row("emitted power", rgb_text(power, 6) + " W (red, green, blue)");
}

void print_repairs(const SceneReport& report) {
  const std::pair<const char*, std::int64_t> counts[] = {
      {"no area, removed", report.removed_degenerate},
      {"not planar, split", report.cut_non_planar},
      {"too large, divided", report.refined},
      {"unused points", report.unused_points},
      {"coincident faces", report.coincident_faces}};
  for (const auto& [name, count] : counts) {
    if (count > 0) {
      print_row(name, fmt::format("{}", count));
    }
  }
  for (const std::string& warning : report.warnings) {
    print_row("warning", warning_text(warning));
  }
}

/// Prints backs seen, by group if the scene has groups, else by material.
void print_backs(const BackFraction& backs) {
  if (backs.fraction == 0) {
    print_row("seen from behind", "no face");
    return;
  }
  print_row("seen from behind", fraction_text(backs.fraction) + " of what light meets are backs");
  const bool by_group = !backs.groups.empty();
  const std::vector<BackCount>& counts = by_group ? backs.groups : backs.materials;
  for (std::size_t k = 0; k < std::min(counts.size(), max_listed); ++k) {
    print_results(fmt::format("  {} \"{}\": {} of what light meets of it, {} of all\n",
                              by_group ? "group" : "material", counts[k].name,
                              fraction_text(counts[k].fraction), fraction_text(counts[k].of_all)));
  }
  if (counts.size() > max_listed) {
    print_results(fmt::format("  and {} more\n", counts.size() - max_listed));
  }
}

/// Faces of one material or group whose backs other patches see.
struct BacksOfKind {
  std::set<std::int32_t> faces;
  double seen = 0, whole = 0;  ///< visible area of their backs, and area, m2
};

/// Prints the faces seen from behind, in sums by group if the scene has groups, else by material.
void print_backs_along_directions(const Scene& scene, const std::vector<double>& fractions) {
  const bool by_group = !scene.groups().empty();
  std::map<std::int32_t, BacksOfKind> kinds;
  std::set<std::int32_t> faces;
  for (PatchId i = 0; i < scene.patch_count(); ++i) {
    const Patch& patch = scene.patch(i);
    if (at(fractions, i) > open_fraction) {
      BacksOfKind& kind = kinds[by_group ? patch.group : patch.material];
      kind.faces.insert(patch.face);
      kind.seen += patch.area * at(fractions, i);
      kind.whole += patch.area;
      faces.insert(patch.face);
    }
  }
  print_row("along directions",
            fmt::format("{} face{} seen from behind", faces.size(), faces.size() == 1 ? "" : "s"));
  for (const auto& [number, kind] : kinds) {
    const std::string name = !by_group            ? at(scene.materials(), number).name
                             : number == no_group ? std::string()
                                                  : at(scene.groups(), number);
    print_results(fmt::format("  {} \"{}\": {} face{}, {} of their backs visible\n",
                              by_group ? "group" : "material", name, kind.faces.size(),
                              kind.faces.size() == 1 ? "" : "s",
                              fraction_text(kind.seen / kind.whole)));
  }
}

void print_overlaps(const Scene& scene, const Cancellation& cancellation) {
  ProgressDisplay display;
  display.begin("searching overlaps");
  const auto overlaps = coplanar_overlaps(scene, max_overlaps, cancellation);
  display.clear();
  if (overlaps.empty()) {
    return;
  }
  print_row(
      "coplanar overlap",
      fmt::format("{}{} pair{} of patches{}", overlaps.size() < max_overlaps ? "" : "at least ",
                  overlaps.size(), overlaps.size() == 1 ? "" : "s",
                  overlaps.size() > max_listed ? fmt::format("; the first {}:", max_listed) : ":"));
  for (std::size_t k = 0; k < std::min(overlaps.size(), max_listed); ++k) {
    const auto& [upper, lower, area] = overlaps[k];
    print_results(fmt::format("  face {:<11} overlaps face {}, {:.3g} m2\n",
                              scene.patch(upper).face, scene.patch(lower).face, area));
  }
}

/// Prints the findings of random rays: whether the scene is closed, and which materials are seen
/// from behind.
BackFraction print_rays(const Scene& scene, int threads, const Cancellation& cancellation) {
  ProgressDisplay display;
  display.begin("checking what light meets");
  BackFraction backs = back_fraction(scene, threads, cancellation);
  display.clear();
  print_row("closed", backs.open == 0
                          ? std::string("yes: no ray from a lit side leaves")
                          : fmt::format("no, {} of the rays from lit sides meet no patch",
                                        fraction_text(backs.open)));
  print_backs(backs);
  return backs;
}

/// Transilluminates the scene along some directions; prints, exactly for these, how much of it is
/// open and how many faces are seen from behind.
void print_directions(const std::shared_ptr<const Scene>& scene, const InfoCall& call,
                      const Cancellation& cancellation) {
  SolveOptions options;
  options.first_shot.reset();
  options.directions = call.directions;
  options.iterations = 1;
  options.threads = call.scene.run.solve.threads;
  ProgressDisplay display;
  const auto tree = build_tree(*scene, cancellation, display, call.scene.run.solve.threads);
  RadiositySolver solver(scene, options, {.tree = tree}, cancellation);
  display.expect_passes("checking visibility, ", call.directions);
  solver.advance(RadiositySolver::Until::finished, [&](const RadiositySolver& watched) {
    if (watched.progress().direction > 0) {
      display.show_passes("checking visibility, ", watched.progress());
    }
    return true;
  });
  display.clear();
  const double escaped = solver.statistics().escaped;
  print_row("BSP fragments", fmt::format("{}", tree->fragments().size()));
  print_row("along directions",
            fmt::format("{} of the projected area sees no patch ({} directions)",
                        fraction_text(escaped), 2 * call.directions));
  print_backs_along_directions(*scene, solver.back_seen_fractions());
}

void print_inside_solids(const SceneDescription& description, const Cancellation& cancellation) {
  constexpr double worth_a_hint = 0.05;
  const double share = share_inside_solids(description, cancellation);
  if (share > 0) {
    print_row(
        "inside solids",
        fmt::format("about {} of the area lies inside or against another closed part{}",
                    fraction_text(share), share > worth_a_hint ? " (try --solids union)" : ""));
  }
}

int run(const InfoCall& call) {
  const Cancellation& cancellation = cancel_on_signals();
  const SceneDescription description = describe_input(call.scene, cancellation);
  const auto scene = make_input_scene(call.scene, description, cancellation);
  print_counts(*scene);
  print_size_and_light(*scene);
  const BackFraction backs = print_rays(*scene, call.scene.run.solve.threads, cancellation);
  if (call.directions > 0) {
    print_directions(scene, call, cancellation);
  }
  print_overlaps(*scene, cancellation);
  print_inside_solids(description, cancellation);
  print_repairs(scene->report());
  if (const std::string advice = orientation_advice(call.scene, backs); !advice.empty()) {
    print_row("warning", advice);
  }
  return success;
}

}  // namespace

Command add_info_command(CLI::App& program) {
  auto call = std::make_shared<InfoCall>();
  CLI::App& command = *program.add_subcommand(
      "info", "Prints counts, size, emitted power, closedness and problems of a scene");
  add_scene_argument(command, call->scene);
  add_scene_options(command, call->scene);
  add_parsed_option(command, "-m,--directions", "M",
                    "also measure exactly along M directions and their opposites what is open and "
                    "which faces are seen from behind (default: by random rays only)",
                    [call = call.get()](const std::string& text) {
                      call->directions =
                          static_cast<int>(parse_whole_number("--directions", text, 1, 1 << 20));
                    });
  add_options(command, call->scene, {"threads"});
  command.footer(
      "Whether the scene is closed and what is seen from behind is measured by random rays from\n"
      "the lit sides, which miss holes smaller than about 1e-4 of the area; with --directions "
      "also\n"
      "exactly along some. What is seen from behind may be turned, which --orient auto\n"
      "repairs, but it may also be the inside of a box without a bottom that stands on a floor:\n"
      "the floor inside the box sees its backs.\n"
      "Example: transillum info rooms");
  return [call] { return run(*call); };
}

}  // namespace transillum::cli
