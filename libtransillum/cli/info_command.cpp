// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <memory>

#include "commands.h"
#include "interruption.h"
#include "messages.h"
#include "option_values.h"
#include "progress_display.h"
#include "transillum/at.h"
#include "transillum/coplanar_overlap.h"
#include "transillum/radiosity.h"

namespace transillum::cli {
namespace {

/// Enough to meet any hole or turned face that matters, and still a matter of seconds.
constexpr int probing_directions = 64;
/// Shares of area below this are rounding (method, oracle 1).
constexpr double open_share = 1e-9;
constexpr std::size_t listed_faces = 20;
/// Faces copied over each other without end are told as this many.
constexpr std::size_t most_overlaps = 10000;

struct InfoCall {
  std::string scene;
  SceneOptions scene_options;
};

void print_row(const std::string& name, const std::string& value) {
  fmt::print("{:<18} {}\n", name, value);
}

std::string point_text(const Vec3& p) {
  return fmt::format("({:.6g}, {:.6g}, {:.6g})", p.x, p.y, p.z);
}
std::string color_text(const Rgb& c) { return fmt::format("{:.6g} {:.6g} {:.6g}", c.r, c.g, c.b); }

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
  print_row("area", fmt::format("{:.6g} m2; a patch {:.3g} to {:.3g} m2", area, smallest, largest));
  print_row("rho max", fmt::format("{:.6g}", rho_max));
  print_row("emitted power", color_text(power) + " W");
}

void print_mended(const SceneReport& report) {
  const std::pair<const char*, std::int64_t> counts[] = {
      {"dropped, no area", report.removed_degenerate},
      {"cut, not planar", report.cut_non_planar},
      {"cut, too large", report.refined},
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

struct SeenFace {
  std::int32_t face;
  double share;  ///< of what is seen of the face's plane from behind, unoccluded: 1
};

/// Faces whose back receivers look at, by number.
std::vector<SeenFace> faces_seen_from_behind(const Scene& scene,
                                             const std::vector<double>& shares) {
  std::map<std::int32_t, std::pair<double, double>> by_face;  // seen and whole area
  for (PatchId i = 0; i < scene.patch_count(); ++i) {
    auto& [seen, whole] = by_face[scene.patch(i).face];
    seen += scene.patch(i).area * at(shares, i);
    whole += scene.patch(i).area;
  }
  std::vector<SeenFace> faces;
  for (const auto& [face, areas] : by_face) {
    const double share = areas.first / areas.second;
    if (share > open_share) {
      faces.push_back({face, share});
    }
  }
  return faces;
}

void print_faces_seen(const std::vector<SeenFace>& faces) {
  if (faces.empty()) {
    print_row("seen from behind", "no face");
    return;
  }
  print_row(
      "seen from behind",
      fmt::format("{} face{}{}", faces.size(), faces.size() == 1 ? "" : "s",
                  faces.size() > listed_faces ? fmt::format(", of them the first {}:", listed_faces)
                                              : ":"));
  for (std::size_t k = 0; k < std::min(faces.size(), listed_faces); ++k) {
    fmt::print("  face {:<11} {:.3g} % of its back\n", faces[k].face, 100 * faces[k].share);
  }
}

void print_overlaps(const Scene& scene, const std::vector<CoplanarOverlap>& overlaps) {
  if (overlaps.empty()) {
    return;
  }
  print_row(
      "coplanar overlap",
      fmt::format("{}{} pair{} of patches{}", overlaps.size() < most_overlaps ? "" : "at least ",
                  overlaps.size(), overlaps.size() == 1 ? "" : "s",
                  overlaps.size() > listed_faces
                      ? fmt::format(", of them the first {}:", listed_faces)
                      : ":"));
  for (std::size_t k = 0; k < std::min(overlaps.size(), listed_faces); ++k) {
    const auto& [upper, lower, area] = overlaps[k];
    fmt::print("  face {:<11} lies over face {}, {:.3g} m2\n", scene.patch(upper).face,
               scene.patch(lower).face, area);
  }
}

/// Sends light through the scene from all sides and tells where it gets lost.
void probe(const std::shared_ptr<const Scene>& scene, const Cancellation& cancellation) {
  SolveOptions options;
  options.directions = probing_directions;
  options.iterations = 1;
  ProgressDisplay display;
  const auto tree = std::make_shared<const BspTree>(
      *scene, cancellation, [&](double share) { display.show("sorting", share); });
  RadiositySolver solver(scene, options, tree, cancellation);
  solver.advance(RadiositySolver::Until::finished, [&](const RadiositySolver& watched) {
    const SolveProgress progress = watched.progress();
    if (progress.direction > 0) {
      display.show("looking around", static_cast<double>(progress.direction) / progress.passes);
    }
    return true;
  });
  display.clear();
  const SolveStatistics statistics = solver.statistics();
  print_row("BSP fragments", fmt::format("{}", statistics.fragments));
  print_row("closed",
            statistics.escaped < open_share
                ? std::string("yes")
                : fmt::format("no, {:.3g} % of what is seen is open", 100 * statistics.escaped));
  print_faces_seen(faces_seen_from_behind(*scene, solver.back_seen_shares()));
  print_overlaps(*scene, coplanar_overlaps(*scene, *tree, most_overlaps, cancellation));
}

int run(const InfoCall& call) {
  const Cancellation& cancellation = cancel_on_signals();
  const auto scene = load_scene(call.scene, call.scene_options, cancellation);
  print_counts(*scene);
  print_size_and_light(*scene);
  probe(scene, cancellation);
  print_mended(scene->report());
  return success;
}

}  // namespace

Run add_info_command(CLI::App& program) {
  auto call = std::make_shared<InfoCall>();
  CLI::App& command = *program.add_subcommand(
      "info", "Tells a scene's counts, size, light, closedness and problems");
  add_scene_argument(command, call->scene);
  add_scene_options(command, call->scene_options);
  command.footer(fmt::format(
      "Whether the scene is closed and which faces are seen from behind is measured along {}\n"
      "directions, both ways. Faces are numbered from 0 in the order of the file. Seen from "
      "behind\n"
      "are faces turned the wrong way, but also those of a box that stands on a floor without a\n"
      "bottom of its own: the floor inside it looks at their backs.\n"
      "Example: transillum info rooms",
      probing_directions));
  return [call] { return run(*call); };
}

}  // namespace transillum::cli
