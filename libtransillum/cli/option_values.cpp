// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "option_values.h"

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <cmath>
#include <limits>

#include "transillum/errors.h"
#include "transillum/unit_vector.h"

namespace transillum::cli {
namespace {

/// Whether all of `text` is one number of the type, without overflow.
template <typename Number>
bool reads_as(std::string_view text, Number& number) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  return error == std::errc() && end == text.data() + text.size();
}

std::string_view without_plus(std::string_view text) {
  return text.size() > 1 && text[0] == '+' && text[1] != '-' ? text.substr(1) : text;
}

[[noreturn]] void refuse(const std::string& option, std::string_view text,
                         const std::string& expected) {
  throw InputError(fmt::format("{}: \"{}\" is not {}", option, text, expected));
}

}  // namespace

std::int64_t parse_whole_number(const std::string& option, const std::string& text,
                                std::int64_t low, std::int64_t high) {
  std::int64_t number = 0;
  if (!reads_as(without_plus(text), number) || number < low || number > high) {
    refuse(option, text, fmt::format("a whole number from {} to {}", low, high));
  }
  return number;
}

double parse_accuracy(const std::string& option, const std::string& text) {
  try {
    return accuracy_from_text(text);
  } catch (const InputError&) {
    refuse(option, text, "a percentage such as 1%, or a number greater than 0 and less than 1");
  }
}

AccuracyGoal parse_accuracy_of(const std::string& option, const std::string& text) {
  try {
    return accuracy_of_from_name(text);
  } catch (const InputError&) {
    refuse(option, text, "rms, max, mean or patch:I, where I is the number of a patch");
  }
}

std::optional<double> parse_first_shot(const std::string& option, const std::string& text) {
  try {
    return first_shot_from_name(text);
  } catch (const InputError&) {
    refuse(option, text, "none, auto or a number of at least 0");
  }
}

std::uint64_t parse_seed(const std::string& option, const std::string& text) {
  std::uint64_t number = 0;
  if (!reads_as(without_plus(text), number)) {
    refuse(option, text,
           fmt::format("a whole number from 0 to {}", std::numeric_limits<std::uint64_t>::max()));
  }
  return number;
}

double parse_number(const std::string& option, const std::string& text) {
  double number = 0;
  if (!reads_as(without_plus(text), number) || !std::isfinite(number)) {
    refuse(option, text, "a finite number");
  }
  return number;
}

namespace {

/// Three numbers X,Y,Z; calls `wrong` where the text is something else.
template <class Wrong>
Vec3 parse_three(const std::string& text, Wrong wrong) {
  std::array<double, 3> xyz{};
  std::string_view rest = text;
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t comma = rest.find(',');
    if ((comma == std::string_view::npos) != (k == 2)) {
      wrong();
    }
    if (!reads_as(without_plus(rest.substr(0, comma)), xyz[k]) || !std::isfinite(xyz[k])) {
      wrong();
    }
    if (k < 2) {
      rest.remove_prefix(comma + 1);
    }
  }
  return {xyz[0], xyz[1], xyz[2]};
}

}  // namespace

Vec3 parse_point(const std::string& option, const std::string& text) {
  return parse_three(text, [&] { refuse(option, text, "three finite numbers X,Y,Z"); });
}

Vec3 parse_direction(const std::string& option, const std::string& text) {
  const auto wrong = [&] { refuse(option, text, "three finite numbers X,Y,Z, not all 0"); };
  const Vec3 direction = parse_three(text, wrong);
  if (max_abs(direction) == 0) {
    wrong();
  }
  return unit_vector(direction);
}

Rgb parse_exitance(const std::string& option, const std::string& text) {
  const auto wrong = [&] {
    refuse(option, text, "one or three numbers of at least 0, E or E,E,E");
  };
  std::vector<double> values;
  for (std::string_view rest = text;;) {
    const std::size_t comma = rest.find(',');
    double value = 0;
    if (!reads_as(without_plus(rest.substr(0, comma)), value) || !(value >= 0) ||
        !std::isfinite(value)) {
      wrong();
    }
    values.push_back(value);
    if (comma == std::string_view::npos) {
      break;
    }
    rest.remove_prefix(comma + 1);
  }
  if (values.size() == 1) {
    values.resize(3, values.front());
  }
  if (values.size() != 3) {
    wrong();
  }
  return {values[0], values[1], values[2]};
}

std::uint64_t parse_memory_size(const std::string& option, const std::string& text) {
  const auto wrong = [&] {
    refuse(option, text, "a size such as 2G or 800M, or a number of bytes");
  };
  std::string_view digits = text;
  int shift = 0;
  if (!digits.empty()) {
    constexpr std::string_view upper = "KMGT", lower = "kmgt";
    const char last = digits.back();
    const std::size_t unit = std::min(upper.find(last), lower.find(last));
    if (unit != std::string_view::npos) {
      shift = 10 * static_cast<int>(unit + 1);
      digits.remove_suffix(1);
    }
  }
  double size = 0;
  if (!reads_as(digits, size) || !(size >= 0)) {
    wrong();
  }
  size = std::ldexp(size, shift);
  if (!(size < 0x1p63)) {
    wrong();
  }
  return static_cast<std::uint64_t>(size);
}

std::string choice_help(const std::string& setting, const std::vector<std::string>& names,
                        const std::string& default_name) {
  return fmt::format("{}: {} (default {})", description_of(setting), fmt::join(names, " | "),
                     default_name);
}

void refuse_unless(bool used, const CLI::App& command, const std::string& option,
                   const std::string& why) {
  const CLI::Option* known = command.get_option_no_throw(option);
  if (!used && known != nullptr && known->count() > 0) {
    throw InputError(option + ": " + why);
  }
}

void refuse_unused(const CLI::App& command, const std::vector<SolveOptions>& solves,
                   const std::string& except) {
  for (const Setting& setting : settings()) {
    const std::string name = setting.name;
    const std::string why = name == except ? std::string() : why_unused(name, solves);
    refuse_unless(why.empty(), command, "--" + name, why);
    if (name == "two-way") {
      refuse_unless(why.empty(), command, "--one-way", why);
    }
  }
}

void add_sky_options(CLI::App& command, Sky& sky) {
  add_parsed_option(
      command, "--sky", "E[,E,E]", help_of("sky", "no sky"),
      [&sky](const std::string& text) { sky.exitance = parse_exitance("--sky", text); });
  add_parsed_option(command, "--sky-model", "NAME",
                    choice_help("sky-model", sky_model_names(), name_of(sky.model)),
                    [&sky](const std::string& text) { sky.model = sky_model_from_name(text); });
  add_parsed_option(
      command, "--up", "X,Y,Z",
      "the zenith of the sky cie-overcast (default 0,0,1); the direction that becomes "
      "up, +y, in .glb and .gltf files (default 0,1,0: coordinates stay)",
      [&sky](const std::string& text) { sky.up = parse_direction("--up", text); });
}

void add_direction_option(CLI::App& command, Vec3& direction) {
  add_parsed_option(
      command, "--direction", "X,Y,Z",
      "omega, pointing from the receivers to the sources; any length",
      [&direction](const std::string& text) { direction = parse_direction("--direction", text); })
      ->required();
}

void add_order_option(CLI::App& command, EngineOptions& options) {
  add_parsed_option(
      command, "--order", "NAME",
      choice_help("order", painters_order_names(), name_of(options.order)),
      [&options](const std::string& text) { options.order = painters_order_from_name(text); });
}

void add_engine_options(CLI::App& command, Engine& engine, EngineOptions& options) {
  add_parsed_option(command, "--engine", "NAME",
                    choice_help("engine", engine_names(), name_of(engine)),
                    [&engine](const std::string& text) { engine = engine_from_name(text); });
  add_engine_details(command, options);
}

int parse_thread_count(const std::string& option, const std::string& text) {
  return static_cast<int>(parse_whole_number(option, text, 1, 4096));
}

int parse_resolution(const std::string& option, const std::string& text) {
  return static_cast<int>(parse_whole_number(option, text, 1, EngineOptions::largest_resolution));
}

int parse_points(const std::string& option, const std::string& text) {
  return static_cast<int>(parse_whole_number(option, text, 1, EngineOptions::largest_points));
}

void add_engine_details(CLI::App& command, EngineOptions& options) {
  add_parsed_option(command, "--lines", "L", help_of("lines", options.lines_per_patch),
                    [&options](const std::string& text) {
                      options.lines_per_patch = parse_number("--lines", text);
                      if (!(options.lines_per_patch > 0 && options.lines_per_patch <= 1e6)) {
                        refuse("--lines", text, "greater than 0 and at most 1e6");
                      }
                    });
  add_parsed_option(
      command, "--resolution", "R",
      help_of("resolution", fmt::format("{}, hemicube 64", EngineOptions::default_resolution)),
      [&options](const std::string& text) {
        options.resolution = parse_resolution("--resolution", text);
      });
  add_parsed_option(
      command, "--points", "P", help_of("points", EngineOptions::default_points),
      [&options](const std::string& text) { options.points = parse_points("--points", text); });
  add_order_option(command, options);
  command.add_flag_callback(
      "--random-lines", [&options] { options.gridded = false; }, description_of("random-lines"));
}

void add_memory_option(CLI::App& command, std::uint64_t& memory, const std::string& help) {
  add_parsed_option(command, "--memory", "SIZE", help, [&memory](const std::string& text) {
    // To the library, 0 means the default; here it means that nothing is stored.
    memory = std::max<std::uint64_t>(1, parse_memory_size("--memory", text));
  });
}

void add_machine_limits(CLI::App& command, std::uint64_t& memory, int& threads) {
  add_memory_option(command, memory, help_of("memory", "a quarter of the machine's"));
  add_threads_option(command, threads);
}

void add_threads_option(CLI::App& command, int& threads) {
  add_parsed_option(
      command, "--threads", "N", help_of("threads", "all cores"),
      [&threads](const std::string& text) { threads = parse_thread_count("--threads", text); });
}

}  // namespace transillum::cli
