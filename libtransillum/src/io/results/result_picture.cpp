// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// A picture of a result as a point sees it: each pixel has the radiance of the patch that the rays
// through it meet first, four to a pixel; with linear functions, at the points that they meet.
#include <fmt/format.h>
#include <png.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <ostream>
#include <stdexcept>
#include <vector>

#include "base/for_each_index.h"
#include "base/worker_threads.h"
#include "io/results/result_writers.h"
#include "io/results/srgb.h"
#include "transillum/at.h"
#include "transillum/errors.h"
#include "transillum/glossy.h"
#include "transillum/linear_basis.h"
#include "visibility/embree/picking.h"

namespace transillum {
namespace {

constexpr std::size_t picture_width = 1280, picture_height = 960;
constexpr double largest_half_angle = 37.5 * std::numbers::pi / 180;
constexpr int rays_per_side = 2;

/// A camera without lens: the direction of a pixel is forward + x right + y above.
struct Camera {
  Vec3 eye, forward, right, above;

  Vec3 toward(double column, double row) const {
    return forward + (2 * column / picture_width - 1) * right +
           (1 - 2 * row / picture_height) * above;
  }
};

Vec3 target_of(const Scene& scene, const DisplayOptions& display) {
  return display.target.value_or(scene.bounds().center());
}

/// Wide enough for the whole scene, up to 75 degrees from top to bottom.
Camera camera_of(const Scene& scene, const Vec3& eye, const DisplayOptions& display) {
  check_picture(scene, eye, display);
  Camera camera{eye, normalized(target_of(scene, display) - eye), {}, {}};
  Vec3 up = display.up.value_or(Vec3{0, 0, 1});
  if (norm(cross(camera.forward, up)) < 1e-3) {
    up = std::abs(camera.forward.y) < 0.9 ? Vec3{0, 1, 0} : Vec3{1, 0, 0};
  }
  camera.right = normalized(cross(camera.forward, up));
  camera.above = cross(camera.right, camera.forward);
  constexpr double aspect = static_cast<double>(picture_width) / picture_height;
  double tangent = 0;
  for (const Vec3& point : scene.points()) {
    const Vec3 to_point = point - eye;
    const double depth = dot(to_point, camera.forward);
    const double aside = std::max(std::abs(dot(to_point, camera.right)) / aspect,
                                  std::abs(dot(to_point, camera.above)));
    tangent = depth > 0 ? std::max(tangent, aside / depth) : std::tan(largest_half_angle);
  }
  constexpr double margin = 1.02;
  tangent = std::clamp(margin * tangent, 1e-6, std::tan(largest_half_angle));
  camera.right = aspect * tangent * camera.right;
  camera.above = tangent * camera.above;
  return camera;
}

/// pi times the radiance toward the eye, which is B for a diffuse patch.
class ShownLight {
 public:
  explicit ShownLight(const Solution& solution)
      : means_(solution.radiosity), linear_terms_(solution.linear_terms) {
    if (solution.glossy) {
      means_ = solution.glossy->radiance_toward(*solution.eye);
      for (Rgb& value : means_) {
        value = std::numbers::pi * value;
      }
    } else if (!linear_terms_.empty()) {
      bases_ = linear_bases(*solution.scene);
    }
  }

  /// At a point of a patch; a linear function may be below 0 there.
  Rgb at_point(PatchId i, const Vec3& point) const {
    Rgb light = at(means_, i);
    if (!bases_.empty()) {
      const auto [first, second] = at(bases_, i).at(point);
      light += first * at(linear_terms_, i).first + second * at(linear_terms_, i).second;
    }
    return light;
  }

 private:
  std::vector<Rgb> means_;
  const std::vector<LinearTerm>& linear_terms_;
  std::vector<LinearBasis> bases_;
};

/// A color that can be shown: not below 0, and of the same hue where it is too bright.
Rgb limited(const Rgb& color) {
  const Rgb shown{std::max(color.r, 0.0), std::max(color.g, 0.0), std::max(color.b, 0.0)};
  return 1 / std::max({shown.r, shown.g, shown.b, 1.0}) * shown;
}

}  // namespace

void check_picture(const Scene& scene, const Vec3& eye, const DisplayOptions& display) {
  const Vec3 target = target_of(scene, display);
  if (!(norm(target - eye) > 0)) {
    throw InputError(fmt::format(
        "{}: the eye of the picture, {} {} {}, is the point in its middle{}; choose another",
        scene.name(), eye.x, eye.y, eye.z, display.target ? "" : ", the center of the scene"));
  }
}

void write_result_png(std::ostream& out, const Solution& solution, const DisplayOptions& display) {
  const Scene& scene = *solution.scene;
  if (!solution.eye) {
    throw InputError(
        fmt::format("{}: a picture needs the point that it is seen from", scene.name()));
  }
  const Camera camera = camera_of(scene, *solution.eye, display);
  const ShownLight light(solution);
  const double exposure = exposure_of(solution, display);
  const Picker picker(solution.scene);
  std::vector<unsigned char> pixels(3 * picture_width * picture_height);
  WorkerThreads workers(thread_count(0));
  for_each_index(workers, std::size_t{0}, picture_height, [&](std::size_t row) {
    for (std::size_t column = 0; column < picture_width; ++column) {
      Rgb sum;
      for (int k = 0; k < rays_per_side * rays_per_side; ++k) {
        const auto part = [](int n) { return (n + 0.5) / rays_per_side; };
        const Vec3 ray = camera.toward(static_cast<double>(column) + part(k % rays_per_side),
                                       static_cast<double>(row) + part(k / rays_per_side));
        if (const auto hit = picker.first_lit_hit(camera.eye, ray)) {
          // Ray by ray, so that the edges of lamps are smooth.
          sum += limited(exposure * light.at_point(hit->patch, hit->point));
        }
      }
      const Rgb mean = 1.0 / (rays_per_side * rays_per_side) * sum;
      unsigned char* pixel = pixels.data() + 3 * (row * picture_width + column);
      pixel[0] = static_cast<unsigned char>(srgb_byte(mean.r));
      pixel[1] = static_cast<unsigned char>(srgb_byte(mean.g));
      pixel[2] = static_cast<unsigned char>(srgb_byte(mean.b));
    }
  });
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  image.width = picture_width;
  image.height = picture_height;
  image.format = PNG_FORMAT_RGB;
  png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(image);
  std::string bytes(size, '\0');
  if (png_image_write_to_memory(&image, bytes.data(), &size, 0, pixels.data(), 0, nullptr) == 0) {
    throw std::runtime_error(fmt::format("picture: {}", image.message));
  }
  out.write(bytes.data(), static_cast<std::streamsize>(size));
}

}  // namespace transillum
