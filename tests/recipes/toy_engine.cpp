// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "toy_engine.h"

#include <utility>

#include "visibility/fast/fast_engine.h"

namespace transillum {

TransferEngine toy_engine(std::shared_ptr<const Scene> scene, std::shared_ptr<const BspTree> tree) {
  return fast_engine(std::move(scene), std::move(tree), false);
}

}  // namespace transillum
