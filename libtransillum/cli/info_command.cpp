// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
// `transillum info`: counts and sizes of a scene, what was repaired, and, measured along some
// directions, whether it is closed and which faces are seen from behind.
#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <memory>

#include "commands.h"
#include "interruption.h"
#include "messages.h"
#include "option_values.h"
#include "progress_display.h"
#include "report_text.h"
#include "scene_options.h"
#include "standard_output.h"
#include "transillum/at.h"
#include "transillum/coplanar_overlap.h"
#include "transillum/radiosity.h"

namespace transillum::cli {
namespace {

/// Enough to find any relevant hole or reversed face within seconds.
constexpr int probing_directions = 64;
/// Fractions of area below this are rounding (ALGORITHM.md, oracle 1).
constexpr double open_share = 1e-9;
/// Longest list of faces in the report.
constexpr std::size_t max_listed_faces = 20;
/// Largest number of overlaps to search for; coincident faces can have very many.
constexpr std::size_t max_overlaps = 10000;

struct InfoCall {
  SceneInput scene;
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
    print_row("warning", warning);
  }
}

/// A face whose back side is visible from other patches.
struct FaceSeenFromBehind {
  std::int32_t face;
  double share;  ///< visible fraction of its back; 1 if nothing occludes it
};

/// The faces seen from behind, by number, from the shares of their patches.
std::vector<FaceSeenFromBehind> faces_seen_from_behind(const Scene& scene,
                                                       const std::vector<double>& shares) {
  std::map<std::int32_t, std::pair<double, double>> by_face;  // visible and total area
  for (PatchId i = 0; i < scene.patch_count(); ++i) {
    auto& [seen, whole] = by_face[scene.patch(i).face];
    seen += scene.patch(i).area * at(shares, i);
    whole += scene.patch(i).area;
  }
  std::vector<FaceSeenFromBehind> faces;
  for (const auto& [face, areas] : by_face) {
    const double share = areas.first / areas.second;
    if (share > open_share) {
      faces.push_back({face, share});
    }
  }
  return faces;
}

void print_faces_seen(const std::vector<FaceSeenFromBehind>& faces) {
  if (faces.empty()) {
    print_row("seen from behind", "no face");
    return;
  }
  print_row(
      "seen from behind",
      fmt::format("{} face{}{}", faces.size(), faces.size() == 1 ? "" : "s",
                  faces.size() > max_listed_faces ? fmt::format("; the first {}:", max_listed_faces)
                                                  : ":"));
  for (std::size_t k = 0; k < std::min(faces.size(), max_listed_faces); ++k) {
    print_results(fmt::format("  face {:<11} {:.3g} % of its back visible\n", faces[k].face,
                              100 * faces[k].share));
  }
}

void print_overlaps(const Scene& scene, const std::vector<CoplanarOverlap>& overlaps) {
  if (overlaps.empty()) {
    return;
  }
  print_row("coplanar overlap", fmt::format("{}{} pair{} of patches{}",
                                            overlaps.size() < max_overlaps ? "" : "at least ",
                                            overlaps.size(), overlaps.size() == 1 ? "" : "s",
                                            overlaps.size() > max_listed_faces
                                                ? fmt::format("; the first {}:", max_listed_faces)
                                                : ":"));
  for (std::size_t k = 0; k < std::min(overlaps.size(), max_listed_faces); ++k) {
    const auto& [upper, lower, area] = overlaps[k];
    print_results(fmt::format("  face {:<11} overlaps face {}, {:.3g} m2\n",
                              scene.patch(upper).face, scene.patch(lower).face, area));
  }
}

/// Transilluminates the scene along some directions; prints whether it is closed, which faces are
/// seen from behind and which overlap.
void probe(const std::shared_ptr<const Scene>& scene, const Cancellation& cancellation) {
  SolveOptions options;
  options.directions = probing_directions;
  options.iterations = 1;
  ProgressDisplay display;
  const auto tree = build_tree(*scene, cancellation, display);
  RadiositySolver solver(scene, options, tree, cancellation);
  solver.advance(RadiositySolver::Until::finished, [&](const RadiositySolver& watched) {
    const SolveProgress progress = watched.progress();
    if (progress.direction > 0) {
      display.show("checking visibility",
                   static_cast<double>(progress.direction) / progress.passes);
    }
    return true;
  });
  display.clear();
  const SolveStatistics statistics = solver.statistics();
  print_row("BSP fragments", fmt::format("{}", statistics.fragments));
  print_row("closed", statistics.escaped < open_share
                          ? std::string("yes")
                          : fmt::format("no, {:.3g} % of the projected area sees no patch",
                                        100 * statistics.escaped));
  print_faces_seen(faces_seen_from_behind(*scene, solver.back_seen_shares()));
  print_overlaps(*scene, coplanar_overlaps(*scene, *tree, max_overlaps, cancellation));
}

int run(const InfoCall& call) {
  const Cancellation& cancellation = cancel_on_signals();
  const auto scene =
      make_input_scene(call.scene, describe_input(call.scene, cancellation), cancellation);
  print_counts(*scene);
  print_size_and_light(*scene);
  probe(scene, cancellation);
  print_repairs(scene->report());
  return success;
}

}  // namespace

Run add_info_command(CLI::App& program) {
  auto call = std::make_shared<InfoCall>();
  CLI::App& command = *program.add_subcommand(
      "info", "Prints counts, size, emitted power, closedness and problems of a scene");
  add_scene_argument(command, call->scene);
  add_scene_options(command, call->scene);
  command.footer(fmt::format(
      "Whether the scene is closed and which faces are seen from behind is measured along {}\n"
      "directions and their opposites. Faces are numbered from 0 in the order of the file.\n"
      "Faces seen from behind may be reversed, but they may also belong to a box without a bottom\n"
      "that stands on a floor: the floor inside the box sees their backs.\n"
      "Example: transillum info rooms",
      probing_directions));
  return [call] { return run(*call); };
}

}  // namespace transillum::cli
