// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "transillum/scene.h"

#include <fmt/format.h>

#include <cmath>

#include "scene/build/description_check.h"
#include "scene/build/patch_builder.h"

namespace transillum {

Scene::Scene(const SceneDescription& description, const SceneOptions& options,
             const Cancellation& cancellation)
    : name_(description.name),
      files_(description.files),
      options_(options),
      materials_(description.materials) {
  if (!(options.max_patch_area >= 0 && std::isfinite(options.max_patch_area))) {
    throw InputError(fmt::format("the maximum patch area is {} m², but must be finite and >= 0",
                                 options.max_patch_area));
  }
  check_description(description);
  PatchBuilder builder(description, options_, cancellation);
  builder.build();
  points_ = builder.table.take();
  patches_ = std::move(builder.patches);
  outline_corners_ = std::move(builder.outline_corners);
  pieces_ = std::move(builder.pieces);
  piece_corners_ = std::move(builder.piece_corners);
  report_ = std::move(builder.report);
  for (const PointId p : outline_corners_) {
    bounds_.add(point(p));
  }
}

std::shared_ptr<const Scene> load_scene(const std::string& spec, const SceneOptions& options,
                                        const Cancellation& cancellation) {
  return std::make_shared<const Scene>(describe_scene(spec, cancellation), options, cancellation);
}

}  // namespace transillum
