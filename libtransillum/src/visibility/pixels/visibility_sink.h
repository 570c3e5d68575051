// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include "transillum/scene.h"

namespace transillum {

/// Who is told what a discrete engine finds, line by line.
class VisibilitySink {
 public:
  virtual ~VisibilitySink() = default;
  /// In the pixels of `row` from column `begin` up to `end`, patch `below` is met right below patch
  /// `above` (no_patch: below nothing). Of each pixel from above downward, each patch once.
  virtual void record(int row, int begin, int end, PatchId below, PatchId above) = 0;
};

}  // namespace transillum
