// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <memory>

#include "transillum/cancellation.h"
#include "transillum/picture.h"
#include "visibility/embree/picking.h"

namespace transillum {

/// Makes a SurfaceLight without an acceleration structure of its own.
class LightByPicker {
 public:
  /// The light of `solution`, interpolated (`gather` 0).
  /// @param picker  of a scene with the same patches; other materials do not matter
  /// @throws Canceled
  static SurfaceLight light(std::shared_ptr<const Solution> solution,
                            std::shared_ptr<const Picker> picker, const Cancellation& cancellation);
};

}  // namespace transillum
