// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <optional>
#include <vector>

#include "radiosity/error/surfaces.h"
#include "session/error_report.h"
#include "transillum/cancellation.h"

namespace transillum {

/// The errors that the engine of a solve makes, from some of its directions.
struct MethodErrors {
  std::vector<Rgb> rms;              ///< by surface: RMS error of B over patches, W/m²
  int directions = 0;                ///< along which transfers were compared
  Engine reference = Engine::exact;  ///< that they were compared with
  std::optional<double> lost;        ///< ErrorMeasurements::lost
};

/// Compares the engine of a solve with engine exact, or where the scene has many patches or the
/// solve used exact itself, with engine local; and adds up what is received in a closed scene.
/// @throws Canceled
MethodErrors method_errors(const MeasuredSolve& solve, const Surfaces& surfaces,
                           const Cancellation& cancellation);

}  // namespace transillum
