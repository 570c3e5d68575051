// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "transillum/picture.h"

#include <cstddef>
#include <utility>

#include "base/bit_mixing.h"
#include "pictures/sequences.h"
#include "pictures/visit_pixels.h"
#include "transillum/at.h"

namespace transillum {

SampleRay sample_ray(const CameraRays& rays, const PixelSample& sample) {
  const auto [x, y] = sample_place(sample.number, sample.count);
  const std::uint64_t place =
      (static_cast<std::uint64_t>(sample.row) << 32) + static_cast<std::uint64_t>(sample.column);
  return {rays.at(sample.column + x, sample.row + y),
          mixed(place) + golden_step * static_cast<std::uint64_t>(sample.number + 1)};
}

Rgb pixel_radiance(const SurfaceLight& light, const CameraRays& rays, int column, int row,
                   int count) {
  Rgb sum;
  for (int k = 0; k < count; ++k) {
    const auto [ray, salt] = sample_ray(rays, {column, row, k, count});
    sum += light.radiance(ray.origin, ray.direction, salt);
  }
  return 1.0 / count * sum;
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
  const auto visit = [&](int column, int row) {
    at(picture.radiance, static_cast<std::size_t>(row) * static_cast<std::size_t>(options.width) +
                             static_cast<std::size_t>(column)) =
        pixel_radiance(light, rays, column, row, options.samples);
  };
  visit_pixels({options.width, options.height}, options.threads, cancellation, visit, progress);
  return picture;
}

}  // namespace transillum
