// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "transillum/errors.h"
#include "visibility/engines.h"

namespace transillum {

TransferEngine ray_engine(std::shared_ptr<const Scene>, const EngineOptions&) {
  throw InputError("the engine \"rays\" is not built yet");
}

}  // namespace transillum
