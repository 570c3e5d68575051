// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// The direction toward the sun: from a place and a time by libnova, and from angles.
#include "transillum/sun.h"

#include <fmt/format.h>
#include <libnova/julian_day.h>
#include <libnova/sidereal_time.h>
#include <libnova/solar.h>
#include <libnova/transform.h>

#include <chrono>
#include <cmath>
#include <numbers>
#include <regex>

#include "transillum/errors.h"

namespace transillum {
namespace {

using namespace std::chrono;

constexpr double degree = std::numbers::pi / 180;
/// The sun's horizontal parallax at its mean distance, degrees.
constexpr double parallax = 8.794 / 3600;
/// Terrestrial time minus universal time, s: 29 in 1950, 69 in 2020. The sun moves 0.0008° in
/// 69 s.
constexpr double terrestrial_minus_universal = 60;
/// How much the motion of the earth moves the sun, degrees.
constexpr double aberration = 20.4898 / 3600;
constexpr double seconds_per_day = 86400, julian_day_of_1970 = 2440587.5;

[[noreturn]] void refuse(const std::string& text, const std::string& why) {
  throw InputError(
      fmt::format("\"{}\" is not a time such as 2026-06-21T14:00+02:00: {}", text, why));
}

/// Precession in longitude since the equinox of 2000, degrees, of a Julian day: libnova omits it
/// and aberration.
double since_2000(double julian_day) {
  const double centuries = (julian_day - 2451545) / 36525;
  return (5028.796195 * centuries + 1.1054348 * centuries * centuries) / 3600;
}

int number(const std::ssub_match& match) { return match.matched ? std::stoi(match.str()) : 0; }

/// Minutes of Z or +hh:mm.
int zone_of(const std::string& text, const std::smatch& match) {
  constexpr std::size_t zone = 7, sign = 8, hours = 9, minutes = 10;
  if (!match[zone].matched) {
    refuse(text, "it has no zone, Z or +hh:mm");
  }
  const int offset = 60 * number(match[hours]) + number(match[minutes]);
  if (number(match[hours]) > 14 || number(match[minutes]) > 59) {
    refuse(text, "the zone is not from -14:00 to +14:00");
  }
  return match[sign] == "-" ? -offset : offset;
}

}  // namespace

void Sun::validate() const {
  constexpr double largest = 1e170;  // the limit of materials
  for (const double value : {irradiance.r, irradiance.g, irradiance.b}) {
    if (!(value >= 0 && value <= largest)) {
      throw InputError(
          fmt::format("sun: an irradiance of {} is not in the range 0 to {}", value, largest));
    }
  }
  if (is_set() && direction == Vec3{}) {
    throw InputError("sun: its direction is missing");
  }
  if (is_set() && (!is_finite(direction) || std::abs(norm(direction) - 1) > 1e-9)) {
    throw InputError(fmt::format("sun: the vector {} {} {} is not a unit vector", direction.x,
                                 direction.y, direction.z));
  }
}

ZonedTime time_from_text(const std::string& text) {
  static const std::regex form(
      R"((\d{4})-(\d\d)-(\d\d)(?:[T ](\d\d):(\d\d)(?::(\d\d(?:\.\d+)?))?)?)"
      R"((Z|([+-])(\d\d):?(\d\d)?)?)");
  std::smatch match;
  if (!std::regex_match(text, match, form)) {
    refuse(text, "expected date, T, hours and minutes, and a zone");
  }
  const year_month_day date{year{number(match[1])}, month(static_cast<unsigned>(number(match[2]))),
                            day(static_cast<unsigned>(number(match[3])))};
  if (!date.ok() || date.year() < year{1900} || date.year() > year{2100}) {
    refuse(text, "there is no such date in the years 1900 to 2100");
  }
  const int hours = number(match[4]), minutes = number(match[5]);
  const double seconds = match[6].matched ? std::stod(match[6].str()) : 0;
  if (hours > 24 || minutes > 59 || seconds >= 60 ||
      (hours == 24 && (minutes > 0 || seconds > 0))) {
    refuse(text, "there is no such time of day");
  }
  const int offset = zone_of(text, match);
  const auto days = static_cast<double>(sys_days{date}.time_since_epoch().count());
  return {days * seconds_per_day + 60 * (60 * hours + minutes - offset) + seconds, offset};
}

std::string local_text(const ZonedTime& time) {
  const auto minute = static_cast<std::int64_t>(std::floor((time.utc + 30) / 60)) + time.offset;
  const sys_time<minutes> local{minutes{minute}};
  const sys_days midnight = floor<days>(local);
  const year_month_day date{midnight};
  const int of_day = static_cast<int>((local - midnight).count());
  return fmt::format("{:04}-{:02}-{:02} {:02}:{:02}", static_cast<int>(date.year()),
                     static_cast<unsigned>(date.month()), static_cast<unsigned>(date.day()),
                     of_day / 60, of_day % 60);
}

SolarPosition solar_position(const Site& site, double utc) {
  const double universal = julian_day_of_1970 + utc / seconds_per_day;
  const double terrestrial = universal + terrestrial_minus_universal / seconds_per_day;
  ln_lnlat_posn of_sun{};
  ln_get_solar_ecl_coords(terrestrial, &of_sun);
  of_sun = {of_sun.lng + since_2000(terrestrial) - aberration, 0};
  ln_equ_posn equatorial{};
  ln_get_equ_from_ecl(&of_sun, terrestrial, &equatorial);
  ln_lnlat_posn observer{site.longitude, site.latitude};
  ln_hrz_posn seen{};
  ln_get_hrz_from_equ_sidereal_time(&equatorial, &observer,
                                    ln_get_apparent_sidereal_time(universal), &seen);
  // libnova counts azimuths from the south, and sees the sun from the center of the earth.
  return {std::fmod(seen.az + 180, 360), seen.alt - parallax * std::cos(seen.alt * degree)};
}

Vec3 default_north(const Vec3& up) {
  return std::abs(up.y) > 1 - 1e-9 ? Vec3{0, 0, -1} : Vec3{0, 1, 0};
}

Vec3 direction_of(const SolarPosition& position, const Vec3& up, const Vec3& north) {
  const Vec3 level = north - dot(north, up) * up;
  if (!(norm(level) > 1e-6 * norm(north))) {
    throw InputError(fmt::format("north: the direction {} {} {} is along the vertical", north.x,
                                 north.y, north.z));
  }
  const Vec3 to_north = normalized(level), to_east = cross(to_north, up);
  const double azimuth = position.azimuth * degree, elevation = position.elevation * degree;
  return normalized(std::cos(elevation) *
                        (std::cos(azimuth) * to_north + std::sin(azimuth) * to_east) +
                    std::sin(elevation) * up);
}

}  // namespace transillum
