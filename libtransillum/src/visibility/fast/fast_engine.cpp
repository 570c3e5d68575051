// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "visibility/fast/fast_engine.h"

#include <memory>
#include <mutex>
#include <utility>
#include <vector>

#include "scene/build/closed_surface.h"
#include "transillum/at.h"
#include "visibility/fast/fast_pass.h"

namespace transillum {
namespace {

/// Pool of FastPass objects not in use: as many as have run at the same time.
class IdlePasses {
 public:
  /// nullptr if all are in use.
  std::unique_ptr<FastPass> take() {
    const std::lock_guard lock(mutex_);
    if (passes_.empty()) {
      return nullptr;
    }
    std::unique_ptr<FastPass> pass = std::move(passes_.back());
    passes_.pop_back();
    return pass;
  }
  void give_back(std::unique_ptr<FastPass> pass) {
    const std::lock_guard lock(mutex_);
    passes_.push_back(std::move(pass));
  }

 private:
  std::mutex mutex_;
  std::vector<std::unique_ptr<FastPass>> passes_;
};

/// Whether front sides see front sides only. If surfaces are closed, what holds along all lines of
/// one direction holds along all lines: the number of surfaces around a point, counted by front and
/// back sides, is the same on every line through it (decisions/0015-closed-surfaces.md). So one
/// pass decides.
bool hides_all_backs(const FastScene& shared, const Cancellation& cancellation) {
  // An arbitrary direction with which no scene is likely to be aligned.
  const Vec3 omega = normalized(Vec3{0.5772156649, 0.3141592653, 0.7390851332});
  if (!is_closed_surface(*shared.scene)) {
    return false;
  }
  const Transfers transfers = FastPass(shared).run(omega, cancellation);
  for (PatchId i = 0; i < shared.scene->patch_count(); ++i) {
    // By rounding, slivers of backs are seen beside the edges of what hides them.
    const double limit = 1e-13 * shared.scene->patch(i).area;
    if (at(transfers.back_seen, i) > limit) {
      return false;
    }
  }
  return true;
}

}  // namespace

bool fronts_see_no_backs(std::shared_ptr<const Scene> scene, std::shared_ptr<const BspTree> tree) {
  return hides_all_backs(FastScene(std::move(scene), std::move(tree)), {});
}

namespace {

TransferEngine engine_of(std::shared_ptr<const FastScene> shared) {
  auto idle = std::make_shared<IdlePasses>();
  return [shared = std::move(shared), idle = std::move(idle)](const Vec3& omega,
                                                              const Cancellation& cancellation) {
    std::unique_ptr<FastPass> pass = idle->take();
    if (!pass) {
      pass = std::make_unique<FastPass>(*shared);
    }
    Transfers transfers = pass->run(omega, cancellation);
    idle->give_back(std::move(pass));
    return transfers;
  };
}

/// @param by_blocks whether patches of one face may be queried together
std::shared_ptr<FastScene> fast_scene(std::shared_ptr<const Scene> scene,
                                      std::shared_ptr<const BspTree> tree, bool moments,
                                      bool by_blocks, const Cancellation& cancellation) {
  auto blocks = by_blocks ? PatchBlocks::of(*scene, cancellation) : nullptr;
  if (blocks) {
    // Small beside the tree of the patches.
    tree = std::make_shared<const BspTree>(*blocks->scene, cancellation, nullptr, 1);
  }
  auto shared = std::make_shared<FastScene>(std::move(scene), std::move(tree), std::move(blocks));
  shared->backs_hidden = hides_all_backs(*shared, cancellation);
  if (moments) {
    shared->bases = std::make_shared<const std::vector<LinearBasis>>(linear_bases(*shared->scene));
  }
  return shared;
}

}  // namespace

TransferEngine fast_engine(std::shared_ptr<const Scene> scene, std::shared_ptr<const BspTree> tree,
                           bool moments, const Cancellation& cancellation) {
  return engine_of(fast_scene(std::move(scene), std::move(tree), moments, true, cancellation));
}

TransferEngine measured_fast_engine(std::shared_ptr<const Scene> scene,
                                    std::shared_ptr<const BspTree> tree, bool moments,
                                    std::vector<PatchCost>& costs) {
  const auto shared = fast_scene(std::move(scene), std::move(tree), moments, true, {});
  const auto pass = std::make_shared<FastPass>(*shared, &costs);
  return [shared, pass](const Vec3& omega, const Cancellation& cancellation) {
    return pass->run(omega, cancellation);
  };
}

TransferEngine fast_patch_engine(std::shared_ptr<const Scene> scene,
                                 std::shared_ptr<const BspTree> tree, PatchId patch, bool moments) {
  // That no backs are seen holds for the whole scene, and so for the fragments in the shaft.
  const auto shared = fast_scene(std::move(scene), std::move(tree), moments, false, {});
  shared->shaft.emplace(*shared->scene, *shared->tree, patch);
  return engine_of(shared);
}

}  // namespace transillum
