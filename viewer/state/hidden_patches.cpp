// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "state/hidden_patches.h"

#include <algorithm>
#include <utility>

#include "support/has_index.h"
#include "support/list_change.h"
#include "transillum/at.h"

namespace transillum::viewer {

void HiddenPatches::reset(PatchId patches, std::span<const PatchId> hidden) {
  flags_.assign(static_cast<std::size_t>(patches), false);
  for (const PatchId patch : hidden) {
    at(flags_, patch) = true;
  }
  emit changed();
}

bool HiddenPatches::hidden(PatchId patch) const {
  return has_index(flags_, patch) && at(flags_, patch);
}

bool HiddenPatches::any() const {
  return std::find(flags_.begin(), flags_.end(), true) != flags_.end();
}

void HiddenPatches::hide(std::span<const PatchId> patches) {
  std::vector<bool> flags = flags_;
  for (const PatchId patch : patches) {
    at(flags, patch) = true;
  }
  change(tr("hide patches"), std::move(flags));
}

void HiddenPatches::isolate(std::span<const PatchId> patches) {
  std::vector<bool> flags(flags_.size(), true);
  for (const PatchId patch : patches) {
    at(flags, patch) = false;
  }
  change(tr("isolate patches"), std::move(flags));
}

void HiddenPatches::show_all() {
  change(tr("show all patches"), std::vector<bool>(flags_.size(), false));
}

void HiddenPatches::change(const QString& what, std::vector<bool> flags) {
  if (flags == flags_) {
    return;
  }
  change_list(undo_, what, flags_, std::move(flags), [this](const std::vector<bool>& other) {
    flags_ = other;
    emit changed();
  });
}

}  // namespace transillum::viewer
