// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
// `transillum factors --points`: reads sensors, computes what they see, and writes form factors and
// irradiance.
#include "cli/commands/sensor_factors.h"

#include <fmt/format.h>

#include <functional>
#include <ostream>

#include "cli/arguments/option_values.h"
#include "cli/commands/commands.h"
#include "cli/interruption.h"
#include "cli/output_files.h"
#include "cli/progress_display.h"
#include "io/results/sensor_files.h"
#include "radiosity/analysis/result_comparison.h"
#include "transillum/errors.h"
#include "transillum/files.h"
#include "transillum/point_sensors.h"

namespace transillum::cli {
namespace {

/// The radiosity of a result of the same scene.
std::vector<Rgb> radiosity_of(const std::string& file, const Scene& scene,
                              const Cancellation& cancellation) {
  Solution result = read_result(file, cancellation);
  if (const std::string difference = scene_difference(scene, *result.scene); !difference.empty()) {
    throw InputError(
        fmt::format("{}: the result is not of {}: {}", file, scene.name(), difference));
  }
  return std::move(result.radiosity);
}

}  // namespace

void add_sensor_options(CLI::App& command, SensorCall& call) {
  command
      .add_option(
          "--result", call.result,
          "with --points FILE: result of the same scene, .vtp, whose radiosity lights the points")
      ->type_name("FILE.vtp");
  command
      .add_option("--irradiance", call.irradiance,
                  "with --result: CSV of the irradiance at the points, - for standard output")
      ->type_name("FILE.csv");
}

void check_sensor_options(const CLI::App& command, const SensorCall& call) {
  if (call.points.empty()) {
    for (const char* option : {"--result", "--irradiance"}) {
      refuse_unless(false, command, option, "used only with --points FILE");
    }
    return;
  }
  for (const char* option : {"--directions", "--sampling", "--seed", "--rotate", "--engine",
                             "--rays", "--resolution", "--drop"}) {
    refuse_unless(false, command, option, "not used with --points FILE");
  }
  if (call.result.empty() != call.irradiance.empty()) {
    throw InputError("--irradiance and --result are used together");
  }
}

int run_sensors(const SensorCall& call, const SceneInput& scene_input, const std::string& out,
                std::uint64_t memory, int threads) {
  const Cancellation& cancellation = cancel_on_signals();
  const std::vector<std::string> outputs = given_files({out, call.irradiance});
  check_output_files(outputs);
  check_distinct(outputs, given_files({call.points, call.result}));
  const std::vector<PointSensor> sensors = read_sensors(call.points, cancellation);
  const auto scene = load_input_scene(scene_input, outputs, cancellation);
  std::vector<Rgb> radiosity;
  if (!call.result.empty()) {
    radiosity = radiosity_of(call.result, *scene, cancellation);
  }
  ProgressDisplay display;
  display.begin("points");
  const FormFactors form_factors = sensor_form_factors(
      *scene, sensors, {.memory = memory, .threads = threads}, cancellation, [&](double fraction) {
        display.show_rate("points", fraction, static_cast<double>(sensors.size()), "points");
      });
  display.clear();
  std::vector<std::function<void()>> writers;
  if (!out.empty() || call.irradiance.empty()) {
    writers.emplace_back([&] {
      write_output(out,
                   [&](std::ostream& stream) { write_sensor_factors_csv(stream, form_factors); });
    });
  }
  if (!call.irradiance.empty()) {
    writers.emplace_back([&] {
      write_output(call.irradiance, [&](std::ostream& stream) {
        write_sensor_irradiance_csv(stream, sensors, form_factors,
                                    sensor_irradiance(form_factors, radiosity));
      });
    });
  }
  write_all(writers);
  return success;
}

}  // namespace transillum::cli
