// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "transillum/picture.h"

#include <cstddef>
#include <numbers>
#include <utility>

#include "base/bit_mixing.h"
#include "pictures/sequences.h"
#include "pictures/visit_pixels.h"
#include "transillum/at.h"

namespace transillum {

namespace {

template <class Light>
Rgb mean_of_samples(const CameraRays& rays, int column, int row, int count, Light light) {
  Rgb sum;
  for (int k = 0; k < count; ++k) {
    sum += light(sample_ray(rays, {column, row, k, count}));
  }
  return 1.0 / count * sum;
}

}  // namespace

SampleRay sample_ray(const CameraRays& rays, const PixelSample& sample) {
  const auto [x, y] = sample_place(sample.number, sample.count);
  const std::uint64_t place =
      (static_cast<std::uint64_t>(sample.row) << 32) + static_cast<std::uint64_t>(sample.column);
  return {rays.at(sample.column + x, sample.row + y),
          joined({mixed(place), static_cast<std::uint32_t>(sample.number)})};
}

Rgb pixel_radiance(const SurfaceLight& light, const CameraRays& rays, int column, int row,
                   int count, const Cancellation& cancellation) {
  return mean_of_samples(rays, column, row, count, [&](const SampleRay& sample) {
    return light.radiance(sample.ray.origin, sample.ray.direction, sample.salt, cancellation);
  });
}

Picture make_picture(std::shared_ptr<const Solution> solution, const Camera& camera,
                     const PictureOptions& options, const Cancellation& cancellation,
                     const std::function<void(double)>& progress) {
  options.validate();
  const CameraRays rays(*solution->scene, camera, options.width, options.height);
  check_eye(solution->scene, camera, cancellation);
  const SurfaceLight light(std::move(solution), options.gather, cancellation);
  Picture picture{options.width, options.height, {}, light.gathered_lamps()};
  picture.radiance.resize(static_cast<std::size_t>(options.width) *
                          static_cast<std::size_t>(options.height));
  picture.coverage.resize(options.transparent ? picture.radiance.size() : 0);
  const auto light_of = [&](const SampleRay& sample) {
    const auto& [origin, direction] = sample.ray;
    return options.irradiance ? 1 / std::numbers::pi *
                                    light.irradiance(origin, direction, sample.salt, cancellation)
                              : light.radiance(origin, direction, sample.salt, cancellation);
  };
  const auto visit = [&](int column, int row) {
    const auto pixel = static_cast<std::size_t>(row) * static_cast<std::size_t>(options.width) +
                       static_cast<std::size_t>(column);
    int met = 0;
    at(picture.radiance,
       pixel) = mean_of_samples(rays, column, row, options.samples, [&](const SampleRay& sample) {
      if (options.transparent && !light.meets_surface(sample.ray.origin, sample.ray.direction)) {
        return Rgb();
      }
      ++met;
      return light_of(sample);
    });
    if (options.transparent) {
      at(picture.coverage, pixel) = static_cast<float>(met) / static_cast<float>(options.samples);
    }
  };
  visit_pixels({options.width, options.height}, options.threads, cancellation, visit, progress);
  return picture;
}

}  // namespace transillum
