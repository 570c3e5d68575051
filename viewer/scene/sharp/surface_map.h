// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QString>
#include <functional>
#include <memory>

#include "scene/sharp/sharp_picture.h"
#include "transillum/picture.h"

namespace transillum::viewer {

/// The light of a snapshot on its surfaces, as a texture of them: with exact direct light, for any
/// camera.
struct SurfaceMap {
  std::shared_ptr<const SolverSnapshot> snapshot;
  std::shared_ptr<const LightMap> light;  ///< null without a map

  friend bool operator==(const SurfaceMap&, const SurfaceMap&) = default;
};

/// The reason, for the user, why a snapshot has no map; empty if it has one.
QString why_no_map(const SolverSnapshot& snapshot);

/// Makes the map: a coarse one, and then the fine one. Both have about as many texels for any
/// scene.
/// @param deliver  called with each, on this thread
/// @throws Canceled, InputError
void make_map(const SnapshotLight& light, const Cancellation& cancellation,
              const std::function<void(const SurfaceMap&)>& deliver);

}  // namespace transillum::viewer
