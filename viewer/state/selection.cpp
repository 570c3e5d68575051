// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "state/selection.h"

#include <algorithm>
#include <utility>

namespace transillum::viewer {

bool Selection::contains(PatchId patch) const {
  return std::binary_search(patches_.begin(), patches_.end(), patch);
}

void Selection::select(PatchId patch) {
  set(patch, patch == no_patch ? std::vector<PatchId>() : std::vector<PatchId>{patch});
}

void Selection::toggle(PatchId patch) {
  if (patch == no_patch) {
    return;
  }
  std::vector<PatchId> patches = patches_;
  const auto place = std::lower_bound(patches.begin(), patches.end(), patch);
  if (!contains(patch)) {
    patches.insert(place, patch);
    set(patch, std::move(patches));
    return;
  }
  patches.erase(place);
  const PatchId first = patches.empty() ? no_patch : patches.front();
  set(patch == patch_ ? first : patch_, std::move(patches));
}

void Selection::select_all(std::vector<PatchId> patches) {
  const bool keeps = std::binary_search(patches.begin(), patches.end(), patch_);
  const PatchId patch = keeps ? patch_ : patches.empty() ? no_patch : patches.front();
  set(patch, std::move(patches));
}

void Selection::set(PatchId patch, std::vector<PatchId> patches) {
  const bool another = patch != patch_, others = patches != patches_;
  patch_ = patch;
  patches_ = std::move(patches);
  if (another) {
    emit changed(patch);
  }
  if (others) {
    emit patches_changed();
  }
}

}  // namespace transillum::viewer
