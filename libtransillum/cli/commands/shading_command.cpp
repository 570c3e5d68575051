// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// `transillum shading`: the sunlit fraction of each surface at each step of a year, as a table that
// EnergyPlus reads (Schedule:File:Shading).
#include <fmt/format.h>

#include <cmath>
#include <memory>
#include <ostream>

#include "cli/arguments/option_values.h"
#include "cli/arguments/scene_options.h"
#include "cli/commands/commands.h"
#include "cli/commands/shaded_surfaces.h"
#include "cli/interruption.h"
#include "cli/output_files.h"
#include "cli/progress_display.h"
#include "transillum/at.h"
#include "transillum/errors.h"
#include "transillum/files.h"
#include "transillum/shading.h"

namespace transillum::cli {
namespace {

struct ShadingCall {
  SceneInput scene;
  std::optional<ZonedTime> from, to;
  int step = 60;  ///< minutes
  std::string by;
  std::string out, sky_out;
};

/// The rows of a table: times in the middle of steps, and the sun above the horizon.
struct Steps {
  std::vector<ZonedTime> times;
  std::vector<Vec3> directions;     ///< toward the sun, of the steps by day
  std::vector<std::size_t> by_day;  ///< their numbers
};

Steps steps_of(const ShadingCall& call) {
  const SunPlace& place = call.scene.run.sun;
  const Vec3& up = call.scene.run.solve.sky.up;
  const Vec3 north = place.north.value_or(default_north(up));
  const double step = 60.0 * call.step;
  Steps steps;
  for (std::int64_t k = 0; call.from->utc + static_cast<double>(k + 1) * step <= call.to->utc;
       ++k) {
    const double middle = call.from->utc + (static_cast<double>(k) + 0.5) * step;
    const SolarPosition position = solar_position(*place.site, middle);
    if (position.elevation > 0) {
      steps.by_day.push_back(steps.times.size());
      steps.directions.push_back(direction_of(position, up, north));
    }
    steps.times.push_back({middle, call.from->offset});
  }
  return steps;
}

void check(const ShadingCall& call) {
  const SunPlace& place = call.scene.run.sun;
  if (!place.site || !call.from || !call.to) {
    throw InputError("shading requires --site LAT,LON, --from TIME and --to TIME");
  }
  if (call.scene.given.count("up") == 0) {
    throw InputError("the sun's azimuth and elevation require a vertical: --up X,Y,Z");
  }
  constexpr double longest = 366.0 * 86400;
  const double seconds = call.to->utc - call.from->utc;
  if (!(seconds >= 60.0 * call.step) || seconds > longest) {
    throw InputError(fmt::format("--to: {} is not from one step to 366 days after --from, {}",
                                 local_text(*call.to), local_text(*call.from)));
  }
  refuse_unless(!call.sky_out.empty(), *call.scene.command, "--directions",
                "used only with --sky-out");
}

/// Writes a row for each step; steps at night are 0.
void write_rows(
    std::ostream& out, const Steps& steps, const ShadedSurfaces& surfaces,
    const std::function<void(const std::function<void(std::size_t, const std::vector<double>&)>&)>&
        compute) {
  const std::vector<double> night(surfaces.count(), 0.0);
  std::size_t row = 0;
  const auto write_row = [&](const std::vector<double>& fractions) {
    out << local_text(steps.times[row]);
    for (const double fraction : fractions) {
      out << fmt::format(",{}", fraction);
    }
    out << '\n';
    ++row;
  };
  out << "time," << surfaces.header() << '\n';
  compute([&](std::size_t k, const std::vector<double>& fractions) {
    while (row < steps.by_day[k]) {
      write_row(night);
    }
    write_row(surfaces.means(fractions));
  });
  while (row < steps.times.size()) {
    write_row(night);
  }
}

void write_sky(const ShadingCall& call, const std::shared_ptr<const Scene>& scene,
               const std::shared_ptr<const BspTree>& tree, const ShadedSurfaces& surfaces,
               const Cancellation& cancellation) {
  const SolveOptions& options = call.scene.run.solve;
  const std::vector<double> fractions = surfaces.means(seen_sky_fractions(
      scene, tree, options.sky.up, options.directions, options.threads, cancellation));
  write_output(call.sky_out, [&](std::ostream& out) {
    out << "surface,sky\n";
    for (std::size_t k = 0; k < fractions.size(); ++k) {
      out << fmt::format("{},{}\n", surfaces.cell(k), fractions[k]);
    }
  });
}

int run(const ShadingCall& call) {
  const Cancellation& cancellation = cancel_on_signals();
  check(call);
  const std::vector<std::string> outputs = given_files({call.out, call.sky_out});
  check_output_files(outputs);
  const auto scene = load_input_scene(call.scene, outputs, cancellation);
  const ShadedSurfaces surfaces(*scene, call.by);
  const Steps steps = steps_of(call);
  ProgressDisplay progress;
  const int threads = call.scene.run.solve.threads;
  const auto tree = build_tree(*scene, cancellation, progress, threads);
  if (!call.sky_out.empty()) {
    progress.begin("computing the sky's fractions");
    write_sky(call, scene, tree, surfaces, cancellation);
  }
  progress.begin("computing shadows");
  write_output(call.out, [&](std::ostream& out) {
    write_rows(out, steps, surfaces, [&](const auto& take) {
      const auto count = static_cast<double>(steps.directions.size());
      sunlit_fractions(
          scene, tree, steps.directions,
          [&](std::size_t k, const std::vector<double>& fractions) {
            take(k, fractions);
            progress.show_rate("computing shadows", static_cast<double>(k + 1) / count, count,
                               "positions");
          },
          threads, cancellation);
    });
    progress.clear();
  });
  return success;
}

/// Minutes of a step: 10m, 15m, 1h.
int step_from_text(const std::string& text) {
  for (const int minutes : {1, 2, 3, 4, 5, 6, 10, 12, 15, 20, 30, 60}) {
    if (text == fmt::format("{}m", minutes) || (minutes == 60 && text == "1h")) {
      return minutes;
    }
  }
  throw InputError(
      fmt::format("--step: \"{}\" is not 1h, or minutes that divide an hour, such as 10m", text));
}

ZonedTime parse_time(const char* option, const std::string& text, bool is_end) {
  try {
    ZonedTime time = time_from_text(text);
    const bool is_date = text.find_first_of("T ") == std::string::npos;
    time.utc += is_end && is_date ? 86400 : 0;
    return time;
  } catch (const InputError& error) {
    throw InputError(fmt::format("{}: {}", option, error.what()));
  }
}

void add_times(CLI::App& command, const std::shared_ptr<ShadingCall>& call) {
  add_parsed_option(
      command, "--from", "TIME",
      "begin of the first step, in ISO 8601 with a zone, such as 2026-01-01+01:00",
      [call](const std::string& text) { call->from = parse_time("--from", text, false); });
  add_parsed_option(command, "--to", "TIME",
                    "end of the last step; a date alone is its end: 2026-12-31+01:00",
                    [call](const std::string& text) { call->to = parse_time("--to", text, true); });
  add_parsed_option(command, "--step", "STEP",
                    "length of a step: 1h (default), 15m, 10m or others that divide an hour",
                    [call](const std::string& text) { call->step = step_from_text(text); });
}

}  // namespace

Command add_shading_command(CLI::App& program) {
  auto call = std::make_shared<ShadingCall>();
  CLI::App& command = *program.add_subcommand(
      "shading", "Writes the sunlit fraction of each surface at each step of a year");
  add_scene_argument(command, call->scene);
  add_options(command, call->scene, {"site", "up", "north"});
  add_times(command, call);
  command
      .add_option("--by", call->by,
                  "surfaces: group, face or patch (default: group; face in a scene without groups)")
      ->type_name("NAME")
      ->check(CLI::IsMember({"group", "face", "patch"}));
  add_scene_options(command, call->scene);
  add_options(command, call->scene, {"directions", "threads"});
  command.get_option("--directions")
      ->description("number of passes for --sky-out, each for two directions (default 1024)");
  command
      .add_option("-o,--out", call->out,
                  "CSV: the time in the middle of each step, then a column per surface with its "
                  "sunlit fraction, 0 at night; EnergyPlus reads a whole year by "
                  "Schedule:File:Shading (default: standard output)")
      ->type_name("FILE.csv");
  command
      .add_option("--sky-out", call->sky_out,
                  "CSV: fraction of the sky above the horizon that each surface sees")
      ->type_name("FILE.csv");
  command.footer(
      "Example: transillum shading boards --site 52.52,13.40 --up 0,0,1 \\\n"
      "           --from 2026-06-21+02:00 --to 2026-06-21+02:00 --step 1h --out shading.csv");
  return [call] { return run(*call); };
}

}  // namespace transillum::cli
