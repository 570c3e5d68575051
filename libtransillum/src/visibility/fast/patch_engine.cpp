// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "visibility/fast/patch_engine.h"

#include <utility>

#include "visibility/fast/fast_engine.h"

namespace transillum {

TransferEngine make_patch_engine(Engine engine, std::shared_ptr<const Scene> scene,
                                 std::shared_ptr<const BspTree> tree, PatchId patch,
                                 const EngineOptions& options) {
  TransferEngine run = engine == Engine::fast
                           ? fast_patch_engine(std::move(scene), std::move(tree), patch)
                           : make_engine(engine, std::move(scene), std::move(tree), options);
  return [run = std::move(run), patch](const Vec3& omega, const Cancellation& cancellation) {
    Transfers of_patch;
    of_patch.direction = omega;
    for (const Transfer& t : run(omega, cancellation).exchanges) {
      if (t.receiver == patch || t.source == patch) {
        of_patch.exchanges.push_back(t);
      }
    }
    return of_patch;
  };
}

}  // namespace transillum
