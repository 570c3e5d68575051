// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "visibility/fast/patch_engine.h"

#include <utility>

#include "visibility/fast/fast_engine.h"

namespace transillum {

TransferEngine make_patch_engine(Engine engine, std::shared_ptr<const Scene> scene,
                                 std::shared_ptr<const BspTree> tree, PatchId patch,
                                 const EngineOptions& options) {
  TransferEngine run =
      engine == Engine::fast
          ? fast_patch_engine(std::move(scene), std::move(tree), patch, options.moments)
          : make_engine(engine, std::move(scene), std::move(tree), options);
  return [run = std::move(run), patch](const Vec3& omega, const Cancellation& cancellation) {
    Transfers found = run(omega, cancellation), of_patch;
    of_patch.direction = omega;
    for (std::size_t k = 0; k < found.exchanges.size(); ++k) {
      const Transfer& t = found.exchanges[k];
      if (t.receiver != patch && t.source != patch) {
        continue;
      }
      of_patch.exchanges.push_back(t);
      if (!found.moments.empty()) {
        of_patch.moments.push_back(found.moments[k]);
      }
    }
    of_patch.forward = std::move(found.forward);
    of_patch.backward = std::move(found.backward);
    return of_patch;
  };
}

}  // namespace transillum
