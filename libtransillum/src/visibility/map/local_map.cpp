// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "visibility/map/local_map.h"

#include <memory>
#include <utility>

#include "base/memory_limit.h"
#include "visibility/map/map_engines.h"

namespace transillum {

TransferEngine local_map_engine(std::shared_ptr<const Scene> scene,
                                std::shared_ptr<const BspTree> tree, bool moments) {
  const auto bases =
      moments ? std::make_shared<const std::vector<LinearBasis>>(linear_bases(*scene)) : nullptr;
  return [scene = std::move(scene), tree = std::move(tree), bases](
             const Vec3& omega, const Cancellation& cancellation) {
    return LocalMap<Real, NoRecorder>(*scene, *tree, omega, cancellation, {}, bases.get()).run();
  };
}

RecordedDirection record_local_map(const Scene& scene, const BspTree& tree, const Vec3& omega,
                                   const Cancellation& cancellation, std::uint64_t memory) {
  RecordedDirection result;
  result.transfers = LocalMap<Real, Recorder>(scene, tree, omega, cancellation,
                                              Recorder(result.record, memory_limit(memory)))
                         .run();
  return result;
}

}  // namespace transillum
