// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// The scene while faces are moved, computed on worker threads: with its tree, the map of the
// direction shown, and the light of a draft.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "model/requests/recorded_map.h"
#include "model/snapshot.h"
#include "radiosity/sun_light.h"
#include "scene/edit/face_edits.h"
#include "transillum/cancellation.h"
#include "transillum/linear_basis.h"
#include "transillum/solution.h"

namespace transillum::viewer {

/// A description whose faces are placed, to become a scene.
struct LiveRequest {
  std::shared_ptr<const LoadedScene> before;  ///< gives the options, and what can be kept
  std::shared_ptr<const SceneDescription> base;
  FaceList faces;
  Vec3 pivot;
  FacePlacement placement;
  std::vector<std::string> divided;  ///< SceneInput::divided
  std::optional<MapRequest> map;     ///< its `loaded` is not used; not set if no map is shown
  /// The number of the edit that is to be solved, whose scene is complete; not set while the hand
  /// moves.
  std::optional<int> edit = {};
};
/// A moved scene.
struct LiveScene {
  std::shared_ptr<const LoadedScene> loaded;
  std::shared_ptr<const std::vector<LinearBasis>> bases;
  std::shared_ptr<const RecordedMap> map;  ///< null if none was requested
  double seconds_map = 0;                  ///< wall time of recording the map
};
/// Any thread. @throws InputError, Canceled
LiveScene live_scene(const LiveRequest& request, const Cancellation& cancellation);

/// The light of a scene in which something has moved: by a draft, or where only the sun has, by the
/// form factors of its solve.
struct LiveLightRequest {
  std::shared_ptr<const LoadedScene> loaded;
  SolveOptions options;  ///< the solve's; lobes reflect diffusely
  /// Changed materials of its patches; null for the scene's own.
  std::shared_ptr<const PatchMaterials> materials;
  /// The finished solve of the same patches, with form factors; null for a draft.
  std::shared_ptr<const SolverSnapshot> solved = nullptr;
  /// The light of the sun of `solved`, set by the first request.
  std::shared_ptr<std::optional<SunLight>> sun_of_solve =
      std::make_shared<std::optional<SunLight>>();
};
/// Any thread. @throws InputError, Canceled, NotConvergent
Solution live_light(const LiveLightRequest& request, const Cancellation& cancellation);

/// The snapshot of a moved scene.
/// @param solved  the snapshot of the scene before
/// @param light   null for the light of `solved`, of each face where the numbers of patches differ
std::shared_ptr<const SolverSnapshot> live_snapshot(
    const SolverSnapshot& solved, const LiveScene& scene, const Solution* light,
    const std::shared_ptr<const PatchMaterials>& materials);

}  // namespace transillum::viewer
