// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <cstdint>
#include <memory>

#include "model/snapshot.h"
#include "transillum/cancellation.h"

namespace transillum::viewer {

/// Counts how many patches a limit of their area makes of a scene, or finds the limit that makes
/// about a given number. Keeps the faces of the last
/// request, not divided.
class PatchForecast {
 public:
  struct Request {
    std::shared_ptr<const LoadedScene> loaded;  ///< with a description, not divided by rounds
    SceneOptions options;
    std::int64_t patches = 0;  ///< about how many are wanted; 0 counts the patches that `options` give
  };
  struct Answer {
    std::int64_t patches = 0;   ///< at least 2^62 where there are more
    double max_patch_area = 0;  ///< the limit that makes them, m²
  };
  /// @throws InputError, Canceled
  Answer operator()(const Request& request, const Cancellation& cancellation);

 private:
  std::shared_ptr<const Scene> unrefined(const Request& request, const Cancellation& cancellation);

  std::weak_ptr<const LoadedScene> counted_;
  std::shared_ptr<const Scene> faces_;
};

}  // namespace transillum::viewer
