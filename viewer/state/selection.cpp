// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "state/selection.h"

namespace transillum::viewer {

void Selection::select(PatchId patch) {
  if (patch == patch_) {
    return;
  }
  patch_ = patch;
  emit changed(patch);
}

}  // namespace transillum::viewer
