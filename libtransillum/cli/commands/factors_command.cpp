// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <ostream>

#include "cli/arguments/option_values.h"
#include "cli/arguments/scene_options.h"
#include "cli/commands/commands.h"
#include "cli/commands/sensor_factors.h"
#include "cli/interruption.h"
#include "cli/messages.h"
#include "cli/output_files.h"
#include "cli/progress_display.h"
#include "radiosity/form_factors/small_form_factors.h"
#include "transillum/errors.h"
#include "transillum/files.h"
#include "transillum/form_factor_solve.h"

namespace transillum::cli {
namespace {

using Factors = EngineTraits::Factors;

struct FactorsCall {
  SceneInput scene;
  GatherOptions rays;
  SensorCall sensors;
  double drop = 0;  ///< form factors below it are omitted; 0 writes all
  std::string out;

  const SolveOptions& passes() const { return scene.run.solve; }
};

FormFactors gather_by_rays(const FactorsCall& call, const Scene& scene,
                           const Cancellation& cancellation, ProgressDisplay& display) {
  GatherOptions options = call.rays;
  options.seed = call.passes().seed;
  options.threads = call.passes().threads;
  return gather_form_factors(scene, options, cancellation,
                             [&](double fraction) { display.show("tracing rays", fraction); });
}

FormFactors draw_hemicubes(const FactorsCall& call, const Scene& scene,
                           const Cancellation& cancellation, ProgressDisplay& display) {
  return hemicube_form_factors(
      scene, hemicube_options(call.passes()), cancellation,
      [&](double fraction) { display.show("drawing hemicubes", fraction); });
}

FormFactors compute_pairs(const FactorsCall& call, const Scene& scene,
                          const Cancellation& cancellation, ProgressDisplay& display) {
  display.begin("computing pairs");
  return pair_form_factors(scene, pair_options(call.passes()), cancellation, [&](double fraction) {
    const double patches = scene.patch_count();
    display.show_rate("computing pairs", fraction, patches * (patches - 1) / 2, "pairs");
  });
}

FormFactors sum_passes(const FactorsCall& call, const std::shared_ptr<const Scene>& scene,
                       const Cancellation& cancellation, ProgressDisplay& display) {
  const auto tree = build_tree(*scene, cancellation, display, call.passes().threads);
  SolveOptions options = call.passes();
  options.iterations = 1;
  RadiositySolver solver(scene, options, {.tree = tree}, cancellation);
  solver.advance(RadiositySolver::Until::finished, [&](const RadiositySolver& watched) {
    display.show_passes("", watched.progress());
    return true;
  });
  return solver.form_factors();
}

FormFactors compute_form_factors(const FactorsCall& call, const std::shared_ptr<const Scene>& scene,
                                 const Cancellation& cancellation, ProgressDisplay& display) {
  switch (traits_of(call.passes().engine).factors) {
    case Factors::passes:
      return sum_passes(call, scene, cancellation, display);
    case Factors::rays:
      return gather_by_rays(call, *scene, cancellation, display);
    case Factors::hemicubes:
      return draw_hemicubes(call, *scene, cancellation, display);
    case Factors::pairs:
      return compute_pairs(call, *scene, cancellation, display);
  }
  return {};
}

void check_options(const FactorsCall& call) {
  const Factors factors = traits_of(call.passes().engine).factors;
  refuse_unless(factors == Factors::rays, *call.scene.command, "--rays",
                "used only with engine rays");
  const std::string conflict = conflict_of("basis", call.scene.run);
  refuse_unless(conflict.empty(), *call.scene.command, "--basis", conflict);
  const bool has_no_moments = std::filesystem::path(call.out).extension() == ".vf";
  refuse_unless(!has_no_moments || call.passes().basis == Basis::constant, *call.scene.command,
                "--basis", "linear has moments, which a .vf file cannot hold; write .npz or .mtx");
  if (factors == Factors::hemicubes) {
    hemicube_options(call.passes()).validate();
  }
  if (factors != Factors::rays) {
    refuse_unused(call.scene, {call.scene.run});
    return;
  }
  // Here its rays start at patches: there is no direction, no plane of pixels, no memory limit.
  for (const char* option :
       {"--directions", "--sampling", "--rotate", "--resolution", "--points", "--memory"}) {
    refuse_unless(false, *call.scene.command, option, "not used with engine rays");
  }
}

/// Omits what --drop says, and prints how much that is.
FormFactors without_tiny(const FactorsCall& call, const Scene& scene, FormFactors form_factors,
                         const Cancellation& cancellation) {
  if (call.drop == 0) {
    return form_factors;
  }
  DroppedFormFactors rest = drop_small_form_factors(scene, form_factors, call.drop, cancellation);
  std::string text =
      fmt::format("{} of {} form factors omitted, {:.2g} of all light; the others are rebalanced",
                  rest.dropped, form_factors.size(), rest.fraction);
  if (rest.kept > 0) {
    text += fmt::format("; {} below {} are kept, without which their rows cannot be rebalanced",
                        rest.kept, call.drop);
  }
  if (rest.row_error > 1e-10) {
    text += fmt::format("; row sums are off by up to {:.1e}", rest.row_error);
  }
  print_message(text);
  return std::move(rest.form_factors);
}

int run(const FactorsCall& call) {
  check_sensor_options(*call.scene.command, call.sensors);
  if (!call.sensors.points.empty()) {
    return run_sensors(call.sensors, call.scene, call.out, call.passes().memory,
                       call.passes().threads);
  }
  const Cancellation& cancellation = cancel_on_signals();
  check_options(call);
  const std::vector<std::string> outputs = given_files({call.out});
  for (const std::string& file : outputs) {
    check_form_factor_path(file);
  }
  check_output_files(outputs);
  const auto scene = load_input_scene(call.scene, outputs, cancellation);
  ProgressDisplay display;
  FormFactors computed = compute_form_factors(call, scene, cancellation, display);
  display.clear();
  const FormFactors form_factors = without_tiny(call, *scene, std::move(computed), cancellation);
  if (call.out.empty() || is_standard_output(call.out)) {
    print_results([&](std::ostream& out) { write_form_factors_csv(out, form_factors); });
  } else {
    write_form_factors(call.out, *scene, form_factors);
  }
  return success;
}

/// How form factors are computed.
void add_methods(CLI::App& command, const std::shared_ptr<FactorsCall>& call) {
  add_parsed_option(
      command, "--engine", "NAME",
      fmt::format("{} (default {}); rays: cosine-distributed rays from every patch instead of "
                  "directions; hemicube: a hemicube on every patch; pairs: pair by pair",
                  fmt::join(names_of<Engine>(), " | "), name_of(Engine::fast)),
      [call](const std::string& text) { call->scene.run.solve.engine = from_name<Engine>(text); });
  add_parsed_option(
      command, "--points", "P|FILE",
      option("points").help_text() +
          "; or a file with points x,y,z,nx,ny,nz, one a line: form factors from them instead of "
          "patches, exactly by the visible parts",
      [call](const std::string& text) {
        if (text.find_first_not_of("+-0123456789") == std::string::npos) {
          call->scene.run.solve.engine_options.points = parse_points("--points", text);
          call->scene.given.insert("points");
        } else {
          call->sensors.points = text;
        }
      });
  add_sensor_options(command, call->sensors);
  add_parsed_option(
      command, "--rays", "N",
      fmt::format("engine rays: rays per patch (default {})", call->rays.rays_per_patch),
      [call](const std::string& text) {
        call->rays.rays_per_patch =
            static_cast<int>(parse_whole_number("--rays", text, 1, 1 << 24));
      });
  add_parsed_option(
      command, "--resolution", "R",
      fmt::format("hemicube: pixels along a side of the cube, even (default {}); zbuffer, painter: "
                  "pixels along the longer side of the projected scene (default {})",
                  HemicubeOptions().resolution, EngineOptions::default_resolution),
      [call](const std::string& text) {
        call->scene.run.solve.engine_options.resolution = parse_resolution("--resolution", text);
        call->scene.given.insert("resolution");
      });
}

/// Adds the options for what is written.
void add_outputs(CLI::App& command, const std::shared_ptr<FactorsCall>& call) {
  command
      .add_option("-o,--out", call->out,
                  "by its ending .csv: i,j,F for every F > 0, sorted by i, then j; .npz: sparse "
                  "matrix of SciPy; .mtx: Matrix Market; .vf: View3D (default: CSV on standard "
                  "output); with --basis linear all but .vf also have the moments")
      ->type_name("FILE");
  add_parsed_option(command, "--drop", "F",
                    "omit form factors below F, such as 1e-6, and scale the others so that "
                    "row sums and reciprocity stay",
                    [call](const std::string& text) {
                      call->drop = parse_number("--drop", text);
                      if (!(call->drop > 0 && call->drop < 1)) {
                        throw InputError(fmt::format(
                            "--drop: \"{}\" is not greater than 0 and less than 1", text));
                      }
                    });
}

}  // namespace

Command add_factors_command(CLI::App& program) {
  auto call = std::make_shared<FactorsCall>();
  call->scene.run.solve.first_shot.reset();
  CLI::App& command =
      *program.add_subcommand("factors", "Writes the form factors of all pairs of patches");
  add_scene_argument(command, call->scene);
  add_options(command, call->scene, {"directions", "sampling", "seed", "rotate", "basis"});
  add_methods(command, call);
  add_scene_options(command, call->scene);
  add_sections(command, call->scene, {"Machine"});
  command.get_option("--memory")
      ->description("largest memory for form factors (default: a quarter of the machine's)");
  add_outputs(command, call);
  command.footer(
      "F_ij is the fraction of the power leaving patch i that reaches patch j.\n"
      "Example: transillum factors cornell-box -m 256 --out factors.csv");
  return [call] { return run(*call); };
}

}  // namespace transillum::cli
