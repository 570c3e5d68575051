// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <memory>

#include "transillum/engine.h"

namespace transillum {

/// The transfers that engine fast finds.
TransferEngine toy_engine(std::shared_ptr<const Scene> scene, std::shared_ptr<const BspTree> tree);

}  // namespace transillum
