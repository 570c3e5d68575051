// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// The position of the sun against NREL's solar position algorithm, and times with zones.
#include <gmock/gmock.h>

#include <cmath>
#include <numbers>

#include "support/refusal.h"
#include "transillum/sun.h"

namespace transillum::solar_position_test {
namespace {

using test::refusal;
using ::testing::HasSubstr;

double utc(const char* text) { return time_from_text(text).utc; }

/// Reda and Andreas, "Solar position algorithm for solar radiation applications"
/// (NREL/TP-560-34302, revised 2008), A.5: elevation without refraction and azimuth.
TEST(SolarPosition, AgreesWithTheExampleOfNrel) {
  const SolarPosition sun =
      solar_position({39.742476, -105.1786}, utc("2003-10-17T12:30:30-07:00"));
  EXPECT_NEAR(sun.elevation, 39.872046, 0.001);
  EXPECT_NEAR(sun.azimuth, 194.340241, 0.001);
}

/// The right ascension and declination of Meeus, Astronomical Algorithms (2nd edition), chapter 25,
/// low accuracy: 0.01°; a pole sees the declination as elevation.
double declination(double utc) {
  constexpr double degree = std::numbers::pi / 180;
  const double t = (utc / 86400 + 2440587.5 - 2451545) / 36525;
  const double anomaly = (357.52911 + 35999.05029 * t) * degree;
  const double center = (1.914602 - 0.004817 * t) * std::sin(anomaly) +
                        0.019993 * std::sin(2 * anomaly) + 0.000289 * std::sin(3 * anomaly);
  const double node = (125.04 - 1934.136 * t) * degree;
  const double longitude =
      280.46646 + 36000.76983 * t + 0.0003032 * t * t + center - 0.00569 - 0.00478 * std::sin(node);
  const double obliquity = 23.439291 - 0.0130042 * t + 0.00256 * std::cos(node);
  return std::asin(std::sin(obliquity * degree) * std::sin(longitude * degree)) / degree;
}

TEST(SolarPosition, HasTheDeclinationOfTheCentury) {
  for (int month = 0; month < 1200; month += 7) {
    const double time = utc("1950-01-01Z") + month * 30.4375 * 86400;
    EXPECT_NEAR(solar_position({90, 0}, time).elevation, declination(time), 0.015) << month;
  }
}

TEST(SolarPosition, FollowsTheSeasonsAtThePoles) {
  for (int hour = 0; hour < 24; ++hour) {
    const double june = utc("2026-06-21Z") + 3600 * hour;
    const double december = utc("2026-12-21Z") + 3600 * hour;
    // Tromsø has midnight sun and polar night.
    EXPECT_GT(solar_position({69.65, 18.96}, june).elevation, 1);
    EXPECT_LT(solar_position({69.65, 18.96}, december).elevation, -1);
    EXPECT_NEAR(solar_position({-90, 0}, december).elevation, 23.43, 0.02);
  }
}

TEST(SolarPosition, IsInTheSouthAtNoonOfTheNorthernHemisphere) {
  const SolarPosition noon = solar_position({51.4779, 0}, utc("2026-06-21T12:02Z"));
  EXPECT_NEAR(noon.azimuth, 180, 0.5);
  EXPECT_NEAR(noon.elevation, 90 - 51.4779 + 23.436, 0.02);
  EXPECT_LT(solar_position({51.4779, 0}, utc("2026-06-21T08:00Z")).azimuth, 120);
  const double azimuth = solar_position({-33.9, 151.2}, utc("2026-06-21T11:57+10:00")).azimuth;
  EXPECT_NEAR(std::remainder(azimuth, 360), 0, 1);
}

TEST(ZonedTimes, AreReadWithTheirZones) {
  EXPECT_EQ(utc("1970-01-01T00:00Z"), 0);
  EXPECT_EQ(utc("2026-06-21T14:00+02:00"), utc("2026-06-21T12:00:00Z"));
  EXPECT_EQ(utc("2026-06-21T12:00:30.5Z"), utc("2026-06-21T12:00Z") + 30.5);
  EXPECT_EQ(utc("2024-02-29T24:00-05:30"), utc("2024-03-01T05:30Z"));
  EXPECT_EQ(utc("2026-01-01+01:00"), utc("2025-12-31T23:00Z"));
  EXPECT_EQ(local_text(time_from_text("2026-01-01T00:30+01:00")), "2026-01-01 00:30");
  for (const char* text : {"2026-06-21T14:00", "2026-06-21"}) {
    EXPECT_THAT(refusal([=] { time_from_text(text); }), HasSubstr("it has no zone"));
  }
  for (const char* text : {"2026-02-30T14:00Z", "2026-06-21T25:00Z", "2026-06-21T14:00+15:00",
                           "noon", "1066-10-14T09:00Z"}) {
    EXPECT_THAT(refusal([=] { time_from_text(text); }), HasSubstr(text)) << text;
  }
}

}  // namespace
}  // namespace transillum::solar_position_test
