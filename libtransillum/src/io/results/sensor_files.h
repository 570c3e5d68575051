// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <filesystem>
#include <iosfwd>
#include <span>
#include <vector>

#include "transillum/cancellation.h"
#include "transillum/form_factors.h"
#include "transillum/point_sensors.h"

namespace transillum {

/// Reads sensors: a line x,y,z,nx,ny,nz per point, separated by commas or blanks; a first line of
/// names, empty lines and lines that begin with # are ignored. Normals may have any length.
/// @throws InputError naming file, line and what is wrong
/// @throws Canceled
std::vector<PointSensor> read_sensors(const std::filesystem::path& path,
                                      const Cancellation& cancellation = {});
/// Columns point,j,F: rows of sensor_form_factors().
void write_sensor_factors_csv(std::ostream& out, const FormFactors& form_factors);
/// Columns point,x,y,z,nx,ny,nz,H_r,H_g,H_b,F_sum.
/// @param irradiance from sensor_irradiance().
void write_sensor_irradiance_csv(std::ostream& out, std::span<const PointSensor> sensors,
                                 const FormFactors& form_factors, std::span<const Rgb> irradiance);

}  // namespace transillum
