// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "pictures/inside_solid.h"
#include "pictures/sequences.h"
#include "transillum/errors.h"
#include "transillum/picture.h"
#include "visibility/embree/picking.h"

namespace transillum {
namespace {

constexpr double radians_per_degree = std::numbers::pi / 180;
/// Largest angle from the middle of a picture of the whole scene upward.
constexpr double largest_half_angle = 37.5 * radians_per_degree;
/// Around a picture of the whole scene.
constexpr double margin = 1.02;

void check_camera(const Scene& scene, const Camera& camera, int width, int height) {
  const auto refuse = [&](const std::string& what) {
    throw InputError(fmt::format("{}: {}", scene.name(), what));
  };
  if (!is_finite(camera.eye) || !is_finite(camera.target) ||
      (camera.up && !(is_finite(*camera.up) && norm(*camera.up) > 0))) {
    refuse("the camera's eye, target and up must be finite, and up not 0");
  }
  if (!(norm(camera.target - camera.eye) > 0)) {
    refuse(
        fmt::format("the eye of the picture, {} {} {}, is the point in its middle; choose another",
                    camera.eye.x, camera.eye.y, camera.eye.z));
  }
  const double angle = camera.field_of_view.value_or(60), size = camera.height.value_or(1);
  if (!(angle > 0 && angle < 180)) {
    refuse(fmt::format("the angle of view is {} degrees; it must be above 0 and below 180", angle));
  }
  if (!(size > 0 && std::isfinite(size))) {
    refuse(fmt::format("the height of the picture is {} m; it must be above 0", size));
  }
  PictureOptions options;
  options.width = width;
  options.height = height;
  options.validate();
}

}  // namespace

void PictureOptions::validate() const {
  const auto check = [](const char* name, int value, int least, int most) {
    if (value < least || value > most) {
      throw InputError(
          fmt::format("picture: {} is {}; it must be {} to {}", name, value, least, most));
    }
  };
  check("the width in pixels", width, 1, largest_size);
  check("the height in pixels", height, 1, largest_size);
  check("the number of samples a pixel", samples, 1, most_samples);
  check("the number of gathering rays", gather, 0, most_rays);
  check("the number of threads", threads, 0, 4096);
}

CameraRays::CameraRays(const Scene& scene, const Camera& camera, int width, int height)
    : projection_(camera.projection), eye_(camera.eye), width_(width), height_(height) {
  check_camera(scene, camera, width, height);
  forward_ = normalized(camera.target - camera.eye);
  const Vec3 upward = normalized(camera.up.value_or(Vec3{0, 0, 1}));
  if (projection_ == CameraProjection::panorama) {
    // Upward is the pole; the target is in the middle column.
    above_ = upward;
    const Vec3 level = forward_ - dot(forward_, above_) * above_;
    forward_ =
        norm(level) > 1e-3
            ? normalized(level)
            : normalized(cross(std::abs(above_.x) < 0.7 ? Vec3{1, 0, 0} : Vec3{0, 1, 0}, above_));
    right_ = cross(forward_, above_);
    return;
  }
  Vec3 up = upward;
  if (norm(cross(forward_, up)) < 1e-3) {
    up = std::abs(forward_.y) < 0.9 ? Vec3{0, 1, 0} : Vec3{1, 0, 0};
  }
  right_ = normalized(cross(forward_, up));
  above_ = cross(right_, forward_);
  const double aspect = width_ / height_;
  const bool is_parallel = projection_ == CameraProjection::orthographic;
  // Half the height: over the distance, or in meters.
  double half = 0;
  for (const Vec3& point : scene.points()) {
    const Vec3 to_point = point - eye_;
    const double depth = is_parallel ? 1 : dot(to_point, forward_);
    const double aside =
        std::max(std::abs(dot(to_point, right_)) / aspect, std::abs(dot(to_point, above_)));
    half = depth > 0 ? std::max(half, aside / depth) : std::tan(largest_half_angle);
  }
  half *= margin;
  if (is_parallel) {
    half = camera.height ? *camera.height / 2 : std::max(half, 1e-9 * scene.bounds().diagonal());
  } else {
    half = camera.field_of_view ? std::tan(*camera.field_of_view / 2 * radians_per_degree)
                                : std::clamp(half, 1e-6, std::tan(largest_half_angle));
  }
  right_ = aspect * half * right_;
  above_ = half * above_;
}

CameraRays::Ray CameraRays::at(double column, double row) const {
  const double x = 2 * column / width_ - 1, y = 1 - 2 * row / height_;
  switch (projection_) {
    case CameraProjection::orthographic:
      return {eye_ + x * right_ + y * above_, forward_};
    case CameraProjection::panorama: {
      const double longitude = std::numbers::pi * x, latitude = std::numbers::pi / 2 * y;
      return {eye_,
              std::cos(latitude) * (std::cos(longitude) * forward_ + std::sin(longitude) * right_) +
                  std::sin(latitude) * above_};
    }
    case CameraProjection::perspective:
      break;
  }
  return {eye_, forward_ + x * right_ + y * above_};
}

bool is_inside_solid(const Picker& picker, const Vec3& eye) {
  constexpr int rays = 64;
  int backs = 0;
  for (int k = 0; k < rays; ++k) {
    const double z = 1 - (2 * k + 1.0) / rays;
    const double angle = 2 * std::numbers::pi * mirrored_bits(static_cast<std::uint32_t>(k));
    const double radius = std::sqrt(1 - z * z);
    const auto hit = picker.first_hit(eye, {radius * std::cos(angle), radius * std::sin(angle), z});
    backs += hit && !hit->lit_side ? 1 : 0;
  }
  // Outside of a room, no more than half of the rays meet it. Solids often have no bottom.
  return 4 * backs > 3 * rays;
}

void check_eye(const std::shared_ptr<const Scene>& scene, const Camera& camera,
               const Cancellation& cancellation) {
  if (camera.projection != CameraProjection::orthographic &&
      is_inside_solid(Picker(scene, cancellation), camera.eye)) {
    throw InputError(
        fmt::format("{}: the eye of the picture, {} {} {}, is inside a wall or a solid: backs of "
                    "faces surround it",
                    scene->name(), camera.eye.x, camera.eye.y, camera.eye.z));
  }
}

}  // namespace transillum
