// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Engine `exact`: the local map in rational numbers. Its result is exact for the scene's double
// coordinates projected along the frame's double axes; areas are rounded once, after summation.
#include <memory>
#include <utility>

#include "visibility/map/local_map.h"
#include "visibility/map/map_engines.h"
#include "visibility/plane/exact_number.h"

namespace transillum {

TransferEngine exact_engine(std::shared_ptr<const Scene> scene, std::shared_ptr<const BspTree> tree,
                            bool moments) {
  let_exact_numbers_throw();
  const auto bases =
      moments ? std::make_shared<const std::vector<LinearBasis>>(linear_bases(*scene)) : nullptr;
  return [scene = std::move(scene), tree = std::move(tree), bases](
             const Vec3& omega, const Cancellation& cancellation) {
    return LocalMap<Rational, NoRecorder>(*scene, *tree, omega, cancellation, {}, bases.get())
        .run();
  };
}

}  // namespace transillum
