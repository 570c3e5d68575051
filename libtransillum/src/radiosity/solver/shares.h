// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Shares of the passes of a solve, which several runs make, on any machines
// (decisions/0062-shards.md).
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "transillum/bsp_tree.h"
#include "transillum/cancellation.h"
#include "transillum/engine.h"
#include "transillum/scene.h"
#include "transillum/solve_options.h"

namespace transillum {

/// One of `of` equal shares of the passes of a solve.
struct Share {
  int number = 1;  ///< 1 … of
  int of = 1;      ///< at most the number of passes

  /// Whether pass k, from 0, belongs to it: every of-th does, so that all shares take as long.
  bool has(int k) const { return k % of == number - 1; }
  /// "3/16"
  std::string text() const;
  /// Exact comparison of all members.
  friend bool operator==(const Share&, const Share&) = default;
};
/// The share that a text such as 3/16 names.
/// @throws InputError
Share share_from_text(const std::string& text);

/// Whether the passes of a solve are known before it begins, so that they can be shared out.
/// @param options of the solve.
/// @throws InputError where an option makes them depend on results: a goal, or the scheme
/// semi-iterative; or where there are no passes, or fewer than shares.
void check_can_be_shared(const SolveOptions& options, const Share& share);

/// Makes the passes of a share, on options.threads threads.
/// @param scene the scene.
/// @param options of the solve.
/// @param tree BSP tree of `scene`.
/// @param share which passes.
/// @param add called with each pass, its number from 0, in rising order, on one thread at a time.
/// @param cancellation checked throughout.
/// @throws InputError, Canceled, and what `add` throws
void make_passes(const std::shared_ptr<const Scene>& scene, const SolveOptions& options,
                 const std::shared_ptr<const BspTree>& tree, const Share& share,
                 const std::function<void(int, const Transfers&)>& add,
                 const Cancellation& cancellation = {});

}  // namespace transillum
