// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "transillum/cancellation.h"
#include "transillum/export.h"
#include "transillum/form_factors.h"
#include "transillum/scene.h"

namespace TRANSILLUM_API transillum {

/// A point at which light is measured, on one side of a small area.
struct PointSensor {
  Vec3 position;  ///< m
  Vec3 normal;    ///< unit, of the side that receives
};

/// Options of sensor_form_factors().
struct SensorOptions {
  std::uint64_t memory = 0;  ///< limit of the form factors, bytes; 0: a quarter of the machine's
  int threads = 0;           ///< 0 uses all cores; the result does not depend on it
};

/// Form factors from sensors to all patches: row i has, per patch j that sensor i sees, the
/// fraction of what sensor i receives under a uniform hemisphere that comes from the visible part
/// of j. Exact up to rounding: the visible parts are polygons, and the integral over each is in
/// closed form. In a closed scene a row sums to 1 where the sensor sees no back sides.
///
/// A sensor may be on a patch, on its lit side: patches whose plane it is in, to 1e-12 of the
/// scene's size, do not block it. One that is behind a surface sees what is behind it.
/// @param scene the scene.
/// @param sensors points and unit normals.
/// @param options limits.
/// @param cancellation checked during computation.
/// @param progress if set, called at intervals with the fraction done, in [0,1], on this thread.
/// @throws InputError where a sensor is not finite or its normal not a unit vector
/// @throws Canceled, MemoryLimitExceeded
FormFactors sensor_form_factors(const Scene& scene, std::span<const PointSensor> sensors,
                                const SensorOptions& options = {},
                                const Cancellation& cancellation = {},
                                const std::function<void(double)>& progress = {});

/// Irradiance at the sensors, W/m², sum_j F_ij B_j: what comes from patches, without what comes
/// directly from a sky.
/// @param form_factors from sensor_form_factors().
/// @param radiosity B of all patches, W/m².
std::vector<Rgb> sensor_irradiance(const FormFactors& form_factors, std::span<const Rgb> radiosity);

}  // namespace TRANSILLUM_API transillum
