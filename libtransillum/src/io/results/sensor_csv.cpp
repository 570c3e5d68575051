// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Sensors from a text file, and what they receive as CSV. data/FILES.md lists the columns.
#include <fmt/format.h>

#include <array>
#include <cmath>

#include "base/text_file.h"
#include "io/results/sensor_files.h"
#include "io/text.h"
#include "transillum/errors.h"

namespace transillum {
namespace {

constexpr std::uintmax_t largest_sensor_file = std::uintmax_t{1} << 30;

/// Whether a line is a header: none of its words is a number.
bool is_header(const std::vector<std::string_view>& words) {
  return std::none_of(words.begin(), words.end(),
                      [](std::string_view word) { return parse_number(word).has_value(); });
}

PointSensor sensor_of(const std::vector<std::string_view>& words, const std::string& place) {
  std::array<double, 6> numbers{};
  if (words.size() != numbers.size()) {
    throw InputError(fmt::format("{}: a line must have the six numbers x,y,z,nx,ny,nz", place));
  }
  for (std::size_t k = 0; k < numbers.size(); ++k) {
    const auto number = parse_number(words[k]);
    if (!number || !(std::abs(*number) <= 1e60)) {  // the range of vertices
      throw InputError(
          fmt::format("{}: {} is not a number from -1e60 to 1e60", place, in_quotes(words[k])));
    }
    numbers[k] = *number;
  }
  const Vec3 normal{numbers[3], numbers[4], numbers[5]};
  const double largest = max_abs(normal);
  if (largest == 0) {
    throw InputError(fmt::format("{}: the normal is 0", place));
  }
  return {{numbers[0], numbers[1], numbers[2]}, normalized(normal / largest)};
}

}  // namespace

std::vector<PointSensor> read_sensors(const std::filesystem::path& path,
                                      const Cancellation& cancellation) {
  const std::string file = read_text_file(path, largest_sensor_file);
  std::string_view text = file;
  std::vector<PointSensor> sensors;
  std::vector<std::string_view> words;
  std::string blanks_only;
  for (int line = 1; !text.empty(); ++line) {
    if (line % 4096 == 0) {
      cancellation.throw_if_canceled();
    }
    const std::size_t end = std::min(text.find('\n'), text.size());
    blanks_only = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    std::replace_if(
        blanks_only.begin(), blanks_only.end(),
        [](char c) { return c == ',' || c == ';' || c == '\r'; }, ' ');
    split_words(blanks_only, words, 7);
    if (words.empty() || words.front().starts_with('#') || (line == 1 && is_header(words))) {
      continue;
    }
    sensors.push_back(sensor_of(words, fmt::format("{}:{}", path.string(), line)));
  }
  if (sensors.empty()) {
    throw InputError(fmt::format("{}: there are no points", path.string()));
  }
  return sensors;
}

void write_sensor_factors_csv(std::ostream& out, const FormFactors& form_factors) {
  TextBuffer text(out);
  text.add("point,j,F\n");
  for (std::size_t i = 0; i + 1 < form_factors.row_begin.size(); ++i) {
    for (std::size_t k = form_factors.row_begin[i]; k < form_factors.row_begin[i + 1]; ++k) {
      text.add("{},{},{}\n", i, form_factors.source[k], form_factors.value[k]);
    }
  }
}

void write_sensor_irradiance_csv(std::ostream& out, std::span<const PointSensor> sensors,
                                 const FormFactors& form_factors, std::span<const Rgb> irradiance) {
  TextBuffer text(out);
  text.add("point,x,y,z,nx,ny,nz,H_r,H_g,H_b,F_sum\n");
  for (std::size_t i = 0; i < sensors.size(); ++i) {
    double sum = 0;
    for (std::size_t k = form_factors.row_begin[i]; k < form_factors.row_begin[i + 1]; ++k) {
      sum += form_factors.value[k];
    }
    const auto& [p, n] = sensors[i];
    const Rgb& h = irradiance[i];
    text.add("{},{},{},{},{},{},{},{},{},{},{}\n", i, p.x, p.y, p.z, n.x, n.y, n.z, h.r, h.g, h.b,
             sum);
  }
}

}  // namespace transillum
