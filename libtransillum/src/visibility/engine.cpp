// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "transillum/engine.h"

#include <utility>

#include "choice.h"
#include "transillum/errors.h"
#include "visibility/engines.h"

namespace transillum {

const std::vector<std::string>& engine_names() {
  static const std::vector<std::string> names{"fast",  "local", "global",
                                              "exact", "rays",  "corrected"};
  return names;
}

Engine engine_from_name(const std::string& name) {
  return choice_from_name<Engine>(engine_names(), "engine", name);
}

const std::string& name_of(Engine engine) {
  return engine_names()[static_cast<std::size_t>(engine)];
}

TransferEngine make_engine(Engine engine, std::shared_ptr<const Scene> scene,
                           std::shared_ptr<const BspTree> tree, const EngineOptions& options) {
  switch (engine) {
    case Engine::fast:
      return fast_engine(std::move(scene), std::move(tree));
    case Engine::local:
      return local_map_engine(std::move(scene), std::move(tree));
    case Engine::global:
      return global_map_engine(std::move(scene), std::move(tree));
    case Engine::exact:
      return exact_engine(std::move(scene), std::move(tree));
    case Engine::rays:
      return ray_engine(std::move(scene), options);
    case Engine::corrected:
      return corrected_engine(std::move(scene), std::move(tree));
  }
  throw InputError("no such engine");
}

}  // namespace transillum
