// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <cstdint>
#include <memory>

#include "model/snapshot.h"
#include "transillum/cancellation.h"

namespace transillum::viewer {

/// Counts how many patches a limit of their area makes of a scene. Keeps the faces of the last
/// request, not divided.
class PatchForecast {
 public:
  struct Request {
    std::shared_ptr<const LoadedScene> loaded;  ///< with a description, not divided by rounds
    SceneOptions options;
  };
  /// @returns at least 2^62 where there are more
  /// @throws InputError, Canceled
  std::int64_t operator()(const Request& request, const Cancellation& cancellation);

 private:
  std::shared_ptr<const Scene> unrefined(const Request& request, const Cancellation& cancellation);

  std::weak_ptr<const LoadedScene> counted_;
  std::shared_ptr<const Scene> faces_;
};

}  // namespace transillum::viewer
