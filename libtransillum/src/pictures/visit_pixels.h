// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <functional>

#include "transillum/cancellation.h"

namespace transillum {

/// Pixels of a picture: columns and rows that are multiples of `step`.
struct PixelSteps {
  int width = 0, height = 0;  ///< size of the picture, at least 1
  int step = 1;               ///< at least 1
};

/// Calls visit(column, row) once for each pixel of a grid, in tiles from the middle outward: pixels
/// of a tile share what their patches see of the lamps.
/// @param threads 0 uses all cores.
/// @param cancellation checked at every pixel.
/// @param visit on any thread, for several pixels at once.
/// @param progress if set, called between batches of tiles, when no pixel is being visited, with
/// the fraction done, in [0,1], on this thread.
/// @throws Canceled, and what `visit` or `progress` throws
void visit_pixels(const PixelSteps& grid, int threads, const Cancellation& cancellation,
                  const std::function<void(int column, int row)>& visit,
                  const std::function<void(double)>& progress = {});

}  // namespace transillum
