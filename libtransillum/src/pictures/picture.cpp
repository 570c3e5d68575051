// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Pictures tile by tile, so that the pixels of a tile share what their patches see of the lamps.
#include "transillum/picture.h"

#include <algorithm>
#include <cstddef>
#include <utility>

#include "base/bit_mixing.h"
#include "base/for_each_index.h"
#include "base/worker_threads.h"
#include "pictures/sequences.h"
#include "transillum/at.h"

namespace transillum {
namespace {

constexpr int tile_size = 16;

struct Tile {
  int left, top;
};

std::vector<Tile> tiles_of(const PictureOptions& options) {
  std::vector<Tile> tiles;
  for (int top = 0; top < options.height; top += tile_size) {
    for (int left = 0; left < options.width; left += tile_size) {
      tiles.push_back({left, top});
    }
  }
  return tiles;
}

}  // namespace

Rgb pixel_radiance(const SurfaceLight& light, const CameraRays& rays, const PixelSamples& pixel) {
  Rgb sum;
  for (int k = pixel.first; k < pixel.end; ++k) {
    // The first is in the middle; all are spread evenly.
    const double x = fraction(0.5 + plastic_step * k), y = fraction(0.5 + plastic_square * k);
    const CameraRays::Ray ray = rays.at(pixel.column + x, pixel.row + y);
    const std::uint64_t place =
        (static_cast<std::uint64_t>(pixel.row) << 32) + static_cast<std::uint64_t>(pixel.column);
    sum += light.radiance(ray.origin, ray.direction,
                          mixed(place) + golden_step * static_cast<std::uint64_t>(k + 1));
  }
  return 1.0 / (pixel.end - pixel.first) * sum;
}

Picture make_picture(std::shared_ptr<const Solution> solution, const Camera& camera,
                     const PictureOptions& options, const Cancellation& cancellation,
                     const std::function<void(double)>& progress) {
  options.validate();
  const CameraRays rays(*solution->scene, camera, options.width, options.height);
  check_eye(solution->scene, camera);
  const SurfaceLight light(std::move(solution), options.gather, cancellation);
  Picture picture{options.width, options.height, {}};
  picture.radiance.resize(static_cast<std::size_t>(options.width) *
                          static_cast<std::size_t>(options.height));
  const std::vector<Tile> tiles = tiles_of(options);
  const int threads = thread_count(options.threads);
  WorkerThreads workers(threads);
  const std::size_t batch = 8 * static_cast<std::size_t>(threads);
  for (std::size_t first = 0; first < tiles.size(); first += batch) {
    const std::size_t end = std::min(first + batch, tiles.size());
    for_each_index(workers, first, end, [&](std::size_t n) {
      const auto [left, top] = tiles[n];
      for (int row = top; row < std::min(top + tile_size, options.height); ++row) {
        for (int column = left; column < std::min(left + tile_size, options.width); ++column) {
          cancellation.throw_if_canceled();
          at(picture.radiance,
             static_cast<std::size_t>(row) * static_cast<std::size_t>(options.width) +
                 static_cast<std::size_t>(column)) =
              pixel_radiance(light, rays, {column, row, 0, options.samples});
        }
      }
    });
    if (progress) {
      progress(static_cast<double>(end) / static_cast<double>(tiles.size()));
    }
  }
  return picture;
}

}  // namespace transillum
