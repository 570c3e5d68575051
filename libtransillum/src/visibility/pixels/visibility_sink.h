// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include "transillum/scene.h"

namespace transillum {

/// Receives what a discrete engine finds at its sample points.
class VisibilitySink {
 public:
  virtual ~VisibilitySink() = default;
  /// In the pixels of `row` from column `begin` up to, not including, `end`, patch `below` is the
  /// next one below patch `above` (no_patch: `below` is the topmost). The calls for a pixel go from
  /// above downward, one per patch.
  virtual void record(int row, int begin, int end, PatchId below, PatchId above) = 0;
};

}  // namespace transillum
