// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <cstddef>
#include <cstring>
#include <span>
#include <type_traits>
#include <vector>

#include "radiosity/exchange/sums_in_memory.h"
#include "transillum/cancellation.h"
#include "transillum/patch_sums.h"
#include "transillum/scene.h"

namespace transillum {

/// The patches whose sums a solver computes, or the unknowns of those patches. All functions but
/// the constants call PatchSums.
struct OwnedPatches {
  PatchSums* sums;
  PatchRange range;
  PatchId patches;  ///< number of patches of the scene

  /// All patches.
  OwnedPatches(PatchId patch_count) : OwnedPatches(*sums_in_memory(), patch_count) {}
  /// The patches that `patch_sums` owns.
  OwnedPatches(PatchSums& patch_sums, PatchId patch_count)
      : sums(&patch_sums), range(patch_sums.owned(patch_count)), patches(patch_count) {}

  /// The same share of a list of `per_patch` unknowns for each patch, numbered as patches.
  OwnedPatches of_unknowns(std::size_t per_patch) const {
    const auto factor = static_cast<PatchId>(per_patch);
    OwnedPatches owned = *this;
    owned.range = {factor * range.first, factor * range.last};
    owned.patches = factor * patches;
    return owned;
  }

  std::size_t first() const { return static_cast<std::size_t>(range.first); }
  std::size_t last() const { return static_cast<std::size_t>(range.last); }
  /// Whether all patches are owned.
  bool is_all() const { return range.size() == static_cast<std::size_t>(patches); }

  /// Completes arrays of the same number of values for each patch, which consist of doubles.
  template <class Value>
  void complete(std::vector<Value>& values) const {
    if (!values.empty()) {
      sums->complete({reinterpret_cast<double*>(values.data()), doubles_in(values)}, patches);
    }
  }
  /// Calls PatchSums::check_same().
  template <class Value>
  void check_same(const std::vector<Value>& values) const {
    sums->check_same({reinterpret_cast<const double*>(values.data()), doubles_in(values)});
  }
  /// The lists of all processes, in their order, in process 0; nothing in the others.
  template <class Value>
  std::vector<Value> gather(std::vector<Value> list) const {
    if (is_all()) {
      return list;
    }
    std::vector<Value> all;
    sums->gather(std::as_bytes(std::span(list)), [&all](std::span<const std::byte> bytes) {
      const std::size_t before = all.size();
      all.resize(before + bytes.size() / sizeof(Value));
      if (!bytes.empty()) {
        std::memcpy(all.data() + before, bytes.data(), bytes.size());
      }
    });
    return all;
  }
  /// @throws Canceled if this process, or any other, is canceled
  void throw_if_canceled(const Cancellation& cancellation) const {
    if (sums->any(cancellation.canceled())) {
      throw Canceled();
    }
  }

 private:
  template <class Value>
  static std::size_t doubles_in(const std::vector<Value>& values) {
    constexpr std::size_t unit = sizeof(double);
    static_assert(std::is_standard_layout_v<Value> && sizeof(Value) % unit == 0);
    return values.size() * (sizeof(Value) / unit);
  }
};

}  // namespace transillum
