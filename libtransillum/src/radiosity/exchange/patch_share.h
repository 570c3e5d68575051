// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <cstddef>
#include <cstring>
#include <span>
#include <type_traits>
#include <vector>

#include "transillum/cancellation.h"
#include "transillum/scene.h"
#include "transillum/solver_group.h"

namespace transillum {

/// The patches whose sums a solver computes: all, or those that its process owns in a group. The
/// functions do nothing without a group; within one, all members must call them in the same order.
struct PatchShare {
  SolverGroup* group = nullptr;
  PatchRange owned;
  PatchId patches = 0;  ///< patches of the scene

  PatchShare(SolverGroup* solver_group, PatchId patch_count)
      : group(solver_group),
        owned(group != nullptr ? group->owned(patch_count) : PatchRange{0, patch_count}),
        patches(patch_count) {}

  /// The same share of a list of `per_patch` unknowns for each patch, numbered as patches.
  PatchShare of_unknowns(std::size_t per_patch) const {
    const auto factor = static_cast<PatchId>(per_patch);
    PatchShare share = *this;
    share.owned = {factor * owned.first, factor * owned.last};
    share.patches = factor * patches;
    return share;
  }

  std::size_t first() const { return static_cast<std::size_t>(owned.first); }
  std::size_t last() const { return static_cast<std::size_t>(owned.last); }

  /// Completes arrays of the same number of values for each patch.
  void complete(std::vector<double>& values) const {
    if (group != nullptr && !values.empty()) {
      group->complete(values, patches);
    }
  }
  void complete(std::vector<Rgb>& values) const {
    static_assert(std::is_standard_layout_v<Rgb> && sizeof(Rgb) == 3 * sizeof(double));
    if (group != nullptr && !values.empty()) {
      group->complete({&values.front().r, 3 * values.size()}, patches);
    }
  }
  /// The lists of all members, in their order, on member 0; nothing on the others.
  template <class Value>
  std::vector<Value> gather(std::vector<Value> list) const {
    if (group == nullptr) {
      return list;
    }
    const std::vector<std::byte> bytes = group->gather(std::as_bytes(std::span(list)));
    std::vector<Value> all(bytes.size() / sizeof(Value));
    if (!all.empty()) {
      std::memcpy(all.data(), bytes.data(), bytes.size());
    }
    return all;
  }
  /// @throws Canceled if this process, or any in the group, is canceled
  void throw_if_canceled(const Cancellation& cancellation) const {
    if (group == nullptr) {
      cancellation.throw_if_canceled();
    } else if (group->any(cancellation.canceled())) {
      throw Canceled();
    }
  }
};

}  // namespace transillum
