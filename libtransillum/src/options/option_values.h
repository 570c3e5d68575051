// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Values of options from text. All functions throw InputError with the text and what is valid, as
// `"x" is not a whole number from 1 to 64`.
#pragma once

#include <cstdint>
#include <string>
#include <utility>

#include "transillum/sun.h"
#include "transillum/vec3.h"

namespace transillum {

/// A whole number from `low` to `high`.
std::int64_t whole_number_from_text(const std::string& text, std::int64_t low, std::int64_t high);
/// A whole number of 64 bits, as of a random seed.
std::uint64_t seed_from_text(const std::string& text);
/// A finite number.
double number_from_text(const std::string& text);
/// A point X,Y,Z of finite numbers.
Vec3 point_from_text(const std::string& text);
/// A direction X,Y,Z, not all 0, as a unit vector.
Vec3 direction_from_text(const std::string& text);
/// E or E,E,E: an exitance of at least 0 for all channels, or for each, W/m².
Rgb exitance_from_text(const std::string& text);
/// AZ,EL,W or AZ,EL,W,W,W: a position of the sun and its irradiance, W/m².
std::pair<SolarPosition, Rgb> sun_from_text(const std::string& text);
/// LAT,LON: a place, in degrees.
Site site_from_text(const std::string& text);
/// A size in bytes: a number, optionally followed by K, M, G or T (powers of 1024).
std::uint64_t memory_size_from_text(const std::string& text);

}  // namespace transillum
