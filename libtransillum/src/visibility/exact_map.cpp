// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include <utility>

#include "visibility/engines.h"

namespace transillum {

TransferEngine exact_engine(std::shared_ptr<const Scene> scene, std::shared_ptr<const BspTree> tree) {
  return local_map_engine(std::move(scene), std::move(tree));
}

}  // namespace transillum
