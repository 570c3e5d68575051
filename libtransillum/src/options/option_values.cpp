// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "options/option_values.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <string_view>
#include <vector>

#include "geometry/unit_vector.h"
#include "transillum/errors.h"

namespace transillum {
namespace {

/// Whether all of `text` is one number of the type, without overflow.
template <typename Number>
bool reads_as(std::string_view text, Number& number) {
  if (text.size() > 1 && text[0] == '+' && text[1] != '-') {
    text.remove_prefix(1);
  }
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  return error == std::errc() && end == text.data() + text.size();
}

[[noreturn]] void refuse(std::string_view text, const std::string& expected) {
  throw InputError(fmt::format("\"{}\" is not {}", text, expected));
}

/// Finite numbers separated by commas; empty if the text is anything else.
std::vector<double> numbers_in(const std::string& text) {
  std::vector<double> numbers;
  for (std::string_view rest = text;;) {
    const std::size_t comma = rest.find(',');
    double number = 0;
    if (!reads_as(rest.substr(0, comma), number) || !std::isfinite(number)) {
      return {};
    }
    numbers.push_back(number);
    if (comma == std::string_view::npos) {
      return numbers;
    }
    rest.remove_prefix(comma + 1);
  }
}

}  // namespace

std::int64_t whole_number_from_text(const std::string& text, std::int64_t low, std::int64_t high) {
  std::int64_t number = 0;
  if (!reads_as(text, number) || number < low || number > high) {
    refuse(text, fmt::format("a whole number from {} to {}", low, high));
  }
  return number;
}

std::uint64_t seed_from_text(const std::string& text) {
  std::uint64_t number = 0;
  if (!reads_as(text, number)) {
    refuse(text,
           fmt::format("a whole number from 0 to {}", std::numeric_limits<std::uint64_t>::max()));
  }
  return number;
}

double number_from_text(const std::string& text) {
  double number = 0;
  if (!reads_as(text, number) || !std::isfinite(number)) {
    refuse(text, "a finite number");
  }
  return number;
}

Vec3 point_from_text(const std::string& text) {
  const std::vector<double> numbers = numbers_in(text);
  if (numbers.size() != 3) {
    refuse(text, "three finite numbers X,Y,Z");
  }
  return {numbers[0], numbers[1], numbers[2]};
}

Vec3 direction_from_text(const std::string& text) {
  const std::vector<double> numbers = numbers_in(text);
  if (numbers.size() != 3 || numbers == std::vector<double>(3, 0.0)) {
    refuse(text, "three finite numbers X,Y,Z, not all 0");
  }
  return unit_vector({numbers[0], numbers[1], numbers[2]});
}

Rgb exitance_from_text(const std::string& text) {
  std::vector<double> numbers = numbers_in(text);
  if (numbers.size() == 1) {
    numbers.resize(3, numbers.front());
  }
  if (numbers.size() != 3 || *std::min_element(numbers.begin(), numbers.end()) < 0) {
    refuse(text, "one or three numbers of at least 0, E or E,E,E");
  }
  return {numbers[0], numbers[1], numbers[2]};
}

std::pair<SolarPosition, Rgb> sun_from_text(const std::string& text) {
  const std::vector<double> numbers = numbers_in(text);
  if (numbers.size() != 3 && numbers.size() != 5) {
    refuse(text, "AZ,EL,W or AZ,EL,W,W,W, finite numbers");
  }
  if (std::abs(numbers[1]) > 90) {
    refuse(text, "AZ,EL,W with an elevation from -90 to 90 degrees");
  }
  const std::size_t step = numbers.size() == 5 ? 1 : 0;
  const Rgb irradiance{numbers[2], numbers[2 + step], numbers[2 + 2 * step]};
  if (std::min({irradiance.r, irradiance.g, irradiance.b}) < 0) {
    refuse(text, "AZ,EL,W with an irradiance of at least 0");
  }
  return {{numbers[0], numbers[1]}, irradiance};
}

Site site_from_text(const std::string& text) {
  const std::vector<double> numbers = numbers_in(text);
  if (numbers.size() != 2 || std::abs(numbers[0]) > 90 || std::abs(numbers[1]) > 180) {
    refuse(text, "LAT,LON, a latitude from -90 to 90 and a longitude from -180 to 180 degrees");
  }
  return {numbers[0], numbers[1]};
}

std::uint64_t memory_size_from_text(const std::string& text) {
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
  if (!reads_as(digits, size) || !(size >= 0) || !(std::ldexp(size, shift) < 0x1p63)) {
    refuse(text, "a size such as 2G or 800M, or a number of bytes");
  }
  return static_cast<std::uint64_t>(std::ldexp(size, shift));
}

}  // namespace transillum
