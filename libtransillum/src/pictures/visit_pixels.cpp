// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "pictures/visit_pixels.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/for_each_index.h"
#include "base/worker_threads.h"

namespace transillum {
namespace {

constexpr int tile_side = 32;  ///< pixels

struct Tile {
  int left, top;
};

/// A multiple of the step, so that tiles begin with a visited pixel.
int side_of(const PixelSteps& grid) { return std::max(tile_side / grid.step, 1) * grid.step; }

std::vector<Tile> tiles_of(const PixelSteps& grid) {
  const int side = side_of(grid);
  std::vector<Tile> tiles;
  for (int top = 0; top < grid.height; top += side) {
    for (int left = 0; left < grid.width; left += side) {
      tiles.push_back({left, top});
    }
  }
  const auto from_middle = [&](const Tile& tile) {
    const std::int64_t x = 2 * tile.left + side - grid.width, y = 2 * tile.top + side - grid.height;
    return x * x + y * y;
  };
  std::stable_sort(tiles.begin(), tiles.end(),
                   [&](const Tile& a, const Tile& b) { return from_middle(a) < from_middle(b); });
  return tiles;
}

}  // namespace

void visit_pixels(const PixelSteps& grid, int threads, const Cancellation& cancellation,
                  const std::function<void(int column, int row)>& visit,
                  const std::function<void(double)>& progress) {
  const std::vector<Tile> tiles = tiles_of(grid);
  const int side = side_of(grid);
  const int count = thread_count(threads);
  WorkerThreads workers(count);
  const std::size_t batch = 8 * static_cast<std::size_t>(count);
  for (std::size_t first = 0; first < tiles.size(); first += batch) {
    const std::size_t end = std::min(first + batch, tiles.size());
    for_each_index(workers, first, end, [&](std::size_t n) {
      const auto [left, top] = tiles[n];
      for (int row = top; row < std::min(top + side, grid.height); row += grid.step) {
        for (int column = left; column < std::min(left + side, grid.width); column += grid.step) {
          cancellation.throw_if_canceled();
          visit(column, row);
        }
      }
    });
    if (progress) {
      progress(static_cast<double>(end) / static_cast<double>(tiles.size()));
    }
  }
}

}  // namespace transillum
