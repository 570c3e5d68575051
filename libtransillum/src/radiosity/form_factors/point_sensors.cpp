// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "transillum/point_sensors.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "base/memory_limit.h"
#include "radiosity/form_factors/form_factor_rows.h"
#include "transillum/at.h"
#include "transillum/errors.h"
#include "visibility/pairs/patch_exchange.h"

namespace transillum {
namespace {

/// Gathers rows of form factors on one thread.
struct SensorWorker {
  const ExchangeFinder& exchange;
  PatchId patches;
  std::span<const PointSensor> sensors;
  std::function<void()> check;

  FormFactorRow gather(PatchId i) const {
    const PointSensor& sensor = at(sensors, i);
    FormFactorRow row;
    for (PatchId j = 0; j < patches; ++j) {
      check();
      if (const double f = exchange.from_point(sensor.position, sensor.normal, j, check); f > 0) {
        row.emplace_back(j, f);
      }
    }
    return row;
  }
};

void check_sensors(std::span<const PointSensor> sensors) {
  constexpr std::size_t most = std::numeric_limits<PatchId>::max();
  if (sensors.size() > most) {
    throw InputError(fmt::format("{} sensors are more than {}", sensors.size(), most));
  }
  for (std::size_t i = 0; i < sensors.size(); ++i) {
    const PointSensor& sensor = sensors[i];
    if (!is_finite(sensor.position) || !(std::abs(norm(sensor.normal) - 1) <= 1e-9)) {
      throw InputError(
          fmt::format("sensor {} has no finite position and unit vector as its normal", i));
    }
  }
}

}  // namespace

FormFactors sensor_form_factors(const Scene& scene, std::span<const PointSensor> sensors,
                                const SensorOptions& options, const Cancellation& cancellation,
                                const std::function<void(double)>& progress) {
  check_sensors(sensors);
  const ExchangeFinder exchange(scene, cancellation);
  const std::function<void()> check = [&cancellation] { cancellation.throw_if_canceled(); };
  constexpr PatchId batch = 4;
  return gather_rows(
      {static_cast<PatchId>(sensors.size()), options.threads, batch, memory_limit(options.memory)},
      [&] {
        return SensorWorker{exchange, scene.patch_count(), sensors, check};
      },
      cancellation, progress);
}

std::vector<Rgb> sensor_irradiance(const FormFactors& form_factors,
                                   std::span<const Rgb> radiosity) {
  std::vector<Rgb> irradiance;
  for (std::size_t i = 0; i + 1 < form_factors.row_begin.size(); ++i) {
    Rgb sum;
    for (std::size_t k = form_factors.row_begin[i]; k < form_factors.row_begin[i + 1]; ++k) {
      sum += form_factors.value[k] * at(radiosity, form_factors.source[k]);
    }
    irradiance.push_back(sum);
  }
  return irradiance;
}

}  // namespace transillum
