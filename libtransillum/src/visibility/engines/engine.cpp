// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "transillum/engine.h"

#include <fmt/format.h>

#include <utility>

#include "base/choice.h"
#include "transillum/errors.h"
#include "visibility/fast/fast_engine.h"
#include "visibility/map/map_engines.h"
#include "visibility/pixels/pixel_engines.h"

namespace transillum {

namespace {

constexpr std::array orders{
    Choice{PaintersOrder::bsp, "bsp", "BSP tree",
           "splits polygons that overlap in a cycle, so that an order always exists"},
    Choice{PaintersOrder::newell, "newell", "Newell's tests",
           "splits nothing, and fails where polygons overlap in a cycle"},
};

}  // namespace

template <>
const Choices& choices_of<PaintersOrder>() {
  return texts_of<orders>("painter's order");
}

namespace {

void check(Engine engine, const EngineOptions& options) {
  if (options.moments && !has_moments(engine)) {
    throw InputError(
        fmt::format("engine {}: it has no moments, which a linear basis requires; choose fast, "
                    "local or exact",
                    name_of(engine)));
  }
  if (options.resolution < 0 || options.resolution > EngineOptions::largest_resolution) {
    throw InputError(fmt::format("resolution: {} is not in the range 1 to {}", options.resolution,
                                 EngineOptions::largest_resolution));
  }
}

}  // namespace

TransferEngine make_engine(Engine engine, std::shared_ptr<const Scene> scene,
                           std::shared_ptr<const BspTree> tree, const EngineOptions& options,
                           const Cancellation& cancellation) {
  check(engine, options);
  switch (engine) {
    case Engine::fast:
      return fast_engine(std::move(scene), std::move(tree), options.moments, cancellation);
    case Engine::local:
      return local_map_engine(std::move(scene), std::move(tree), options.moments);
    case Engine::global:
      return global_map_engine(std::move(scene), std::move(tree));
    case Engine::exact:
      return exact_engine(std::move(scene), std::move(tree), options.moments);
    case Engine::rays:
      return ray_engine(std::move(scene), options);
    case Engine::zbuffer:
      return zbuffer_engine(std::move(scene), options);
    case Engine::painter:
      return painter_engine(std::move(scene), std::move(tree), options);
    case Engine::corrected:
      return corrected_engine(std::move(scene), std::move(tree));
    case Engine::hemicube:
      throw InputError(
          "engine hemicube has no directions; it draws the scene as seen from each patch");
    case Engine::pairs:
      throw InputError("engine pairs has no directions; it computes form factors pair by pair");
  }
  throw InputError("no such engine");
}

}  // namespace transillum
