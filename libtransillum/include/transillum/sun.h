// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// The sun as a source of light, and where it is seen from a place on the earth.
#pragma once

#include <string>

#include "transillum/export.h"
#include "transillum/vec3.h"

namespace TRANSILLUM_API transillum {

/// Light from outside of an open scene that comes from one direction.
struct Sun {
  /// Irradiance of an unobstructed plane perpendicular to `direction`, W/m², per channel; 0 means
  /// no sun.
  Rgb irradiance;
  Vec3 direction;              ///< toward the sun; unit; read if there is irradiance
  bool disc = false;           ///< light comes from directions over a disc of sun_diameter
  bool below_horizon = false;  ///< there is no irradiance because it is night

  /// Whether there is light.
  bool is_set() const { return max_abs(irradiance) > 0; }
  /// @throws InputError naming the value and its range.
  void validate() const;
  /// Exact comparison of all members.
  friend bool operator==(const Sun&, const Sun&) = default;
};

/// Angular diameter of the sun's disc, degrees.
inline constexpr double sun_diameter = 0.53;

/// A direction toward the sky.
struct SolarPosition {
  double azimuth = 0;    ///< degrees clockwise from north, seen from above
  double elevation = 0;  ///< degrees above the horizon, without refraction; -90 … 90

  /// Exact comparison of all members.
  friend bool operator==(const SolarPosition&, const SolarPosition&) = default;
};

/// A place on the earth.
struct Site {
  double latitude = 0;   ///< degrees, positive to the north; -90 … 90
  double longitude = 0;  ///< degrees, positive to the east; -180 … 180

  /// Exact comparison of all members.
  friend bool operator==(const Site&, const Site&) = default;
};

/// A time, and the zone in which it is written.
struct ZonedTime {
  double utc = 0;  ///< seconds since 1970-01-01T00:00Z, without leap seconds
  int offset = 0;  ///< zone: local time minus UTC, minutes

  /// Exact comparison of all members.
  friend bool operator==(const ZonedTime&, const ZonedTime&) = default;
};

/// Reads a time as in ISO 8601 with a zone: 2026-06-21T14:00+02:00, 2026-06-21T12:00:30.5Z, or a
/// date alone, 2026-06-21+02:00, which is its beginning. Years are 1900 … 2100.
/// @throws InputError, as where the zone is missing.
ZonedTime time_from_text(const std::string& text);
/// The local time as 2026-06-21 14:00, rounded to a minute.
std::string local_text(const ZonedTime& time);

/// The position of the sun's center, seen from the surface of the earth at `site`, without
/// refraction; within 0.01° in the years 1950 … 2050.
/// @param utc seconds since 1970-01-01T00:00Z.
SolarPosition solar_position(const Site& site, double utc);

/// The y axis; where `up` is along it, the negative z axis.
Vec3 default_north(const Vec3& up);
/// The direction of a position in the coordinates of a scene, as a unit vector.
/// @param up unit vector.
/// @param north of any length; its part perpendicular to `up` counts.
/// @throws InputError where `north` is along `up`.
Vec3 direction_of(const SolarPosition& position, const Vec3& up, const Vec3& north);

}  // namespace TRANSILLUM_API transillum
