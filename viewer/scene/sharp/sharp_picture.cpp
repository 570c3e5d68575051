// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "scene/sharp/sharp_picture.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <numbers>
#include <span>
#include <utility>

#include "base/memory_limit.h"
#include "model/snapshot_values.h"
#include "pictures/light_by_picker.h"
#include "pictures/visit_pixels.h"
#include "scene/sharp/shown_hit.h"
#include "widgets/theme.h"

namespace transillum::viewer {

namespace {

constexpr PatchId unknown = -2;  ///< the pixel is not visited; neither a patch nor no_patch
using Clock = std::chrono::steady_clock;
constexpr std::chrono::milliseconds delivery_pause{100};  ///< at least

/// Pixels whose columns and rows are multiples of `step` get the samples up to `end`.
struct Pass {
  int step, first, end;
};
constexpr Pass passes[] = {{8, 0, 1},
                           {4, 0, 1},
                           {2, 0, 1},
                           {1, 0, 1},
                           {1, 1, 2},
                           {1, 2, 3},
                           {1, 3, SharpRenderer::samples}};
constexpr std::size_t first_fine_pass = 3;

/// The pixels of one picture.
class Pixels {
 public:
  Pixels(const SharpSubject& subject, const SurfaceLight& light, const CameraRays& rays,
         const Cancellation& cancellation)
      : subject_(subject),
        light_(light),
        rays_(rays),
        cancellation_(cancellation),
        width_(subject.size.width()),
        height_(subject.size.height()),
        image_(subject.size, QImage::Format_RGBA8888),
        bytes_(image_.bits()),
        patches_(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_), unknown),
        sums_(patches_.size()) {
    image_.fill(Qt::transparent);
    const auto linear = [&](double shown) { return std::pow(shown, subject.scale.gamma); };
    const QColor& color = theme::scene_background;
    background_ = {linear(color.redF()), linear(color.greenF()), linear(color.blueF())};
  }
  const QImage& image() const { return image_; }

  /// Adds the samples of a pass to a pixel. Different pixels may be visited at the same time.
  void visit(int column, int row, const Pass& pass) {
    const std::size_t place = place_of(column, row);
    if (pass.first == 0 && patches_[place] != unknown) {
      return;  // visited with a larger step
    }
    auto& sum = sums_[place];
    for (int k = pass.first; k < pass.end; ++k) {
      auto [ray, salt] = sample_ray(rays_, {column, row, k, SharpRenderer::samples});
      const PatchId patch = seen(ray);
      Rgb color = background_;
      if (patch != no_patch) {
        const Rgb radiance = light_.radiance(ray.origin, ray.direction, salt, cancellation_);
        // The mean of what is shown: the edge of a lamp that is much too bright is smooth.
        color = subject_.scale.exposed(subject_.by_eye ? radiance : std::numbers::pi * radiance);
      }
      if (k == 0) {
        patches_[place] = patch;
      }
      sum[0] += static_cast<float>(color.r);
      sum[1] += static_cast<float>(color.g);
      sum[2] += static_cast<float>(color.b);
    }
    const auto mean = [&](std::size_t channel) {
      return std::min(1.0, static_cast<double>(sum[channel]) / pass.end);
    };
    const Color8 color = subject_.scale.shown({mean(0), mean(1), mean(2)});
    std::uint8_t* const pixel = bytes_at(column, row);
    std::copy(color.begin(), color.end(), pixel);
    pixel[3] = 255;
  }

  /// Interpolates between pixels of a pass that see one plane.
  void fill(int step) {
    const std::size_t across = static_cast<std::size_t>((width_ - 1) / step);
    const std::size_t down = static_cast<std::size_t>((height_ - 1) / step);
    if (step != filled_step_) {
      filled_step_ = step;
      filled_.assign(across * down, false);
    }
    for (std::size_t n = 0; n < filled_.size(); ++n) {
      if (!filled_[n]) {
        const int column = step * static_cast<int>(n % across);
        const int row = step * static_cast<int>(n / across);
        filled_[n] = fill_cell(column, row, step);
      }
    }
  }

 private:
  std::size_t place_of(int column, int row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(width_) +
           static_cast<std::size_t>(column);
  }
  std::uint8_t* bytes_at(int column, int row) const {
    return bytes_ + 4 * place_of(column, row);  // rows of 4 bytes per pixel have no padding
  }

  /// The patch that a ray sees; the ray then starts behind what is hidden or clipped.
  PatchId seen(CameraRays::Ray& ray) const {
    const auto hit = first_shown_hit(
        *subject_.loaded, ray.origin, normalized(ray.direction), [this](const PickedPoint& point) {
          return !(!subject_.hidden.empty() && at(subject_.hidden, point.patch)) &&
                 !(subject_.half &&
                   dot(point.point - subject_.half->origin, subject_.half->normal) < 0);
        });
    return hit ? hit->patch : no_patch;
  }

  /// Whether light may be interpolated between two patches: of one plane, and equal materials.
  bool is_continuous(PatchId a, PatchId b) const {
    if (a == b || a == no_patch || b == no_patch) {
      return a == b;
    }
    const Scene& scene = *subject_.loaded->scene;
    const Patch &first = scene.patch(a), &second = scene.patch(b);
    const Material& one = material_of(*subject_.snapshot, a);
    const Material& other = material_of(*subject_.snapshot, b);
    return one.exitance == other.exitance && one.reflectance == other.reflectance &&
           dot(first.normal, second.normal) > 1 - 1e-9 &&
           std::abs(dot(first.normal, second.center - first.center)) <
               1e-6 * scene.bounds().diagonal();
  }

  /// @returns whether the pixels at its corners are known
  bool fill_cell(int column, int row, int step) {
    const std::array<std::size_t, 4> corners{place_of(column, row), place_of(column + step, row),
                                             place_of(column, row + step),
                                             place_of(column + step, row + step)};
    for (const std::size_t corner : corners) {
      if (patches_[corner] == unknown) {
        return false;
      }
    }
    for (const std::size_t corner : corners) {
      if (!is_continuous(patches_[corners[0]], patches_[corner])) {
        return true;
      }
    }
    if (step > 2) {  // something small may be between the corners
      CameraRays::Ray ray = rays_.at(column + 0.5 * (step + 1), row + 0.5 * (step + 1));
      if (!is_continuous(patches_[corners[0]], seen(ray))) {
        return true;
      }
    }
    for (int y = 0; y < step; ++y) {
      for (int x = y == 0 ? 1 : 0; x < step; ++x) {
        std::uint8_t* const pixel = bytes_at(column + x, row + y);
        for (std::size_t c = 0; c < 4; ++c) {
          const int upper =
              (step - x) * bytes_[4 * corners[0] + c] + x * bytes_[4 * corners[1] + c];
          const int lower =
              (step - x) * bytes_[4 * corners[2] + c] + x * bytes_[4 * corners[3] + c];
          pixel[c] = static_cast<std::uint8_t>(((step - y) * upper + y * lower + step * step / 2) /
                                               (step * step));
        }
      }
    }
    return true;
  }

  const SharpSubject& subject_;
  const SurfaceLight& light_;
  const CameraRays& rays_;
  const Cancellation& cancellation_;
  int width_, height_;
  QImage image_;
  std::uint8_t* bytes_;
  Rgb background_;
  std::vector<PatchId> patches_;  ///< seen in the middle of each pixel
  std::vector<std::array<float, 3>>
      sums_;                  ///< sums of exposed light, over the samples of each pixel
  std::vector<bool> filled_;  ///< whether a cell of pixels is done, for filled_step_
  int filled_step_ = 0;
};

std::shared_ptr<const Scene> scene_of(const SolverSnapshot& snapshot) {
  const auto& scene = snapshot.loaded->scene;
  return snapshot.materials ? std::make_shared<const Scene>(*scene, snapshot.materials->materials,
                                                            snapshot.materials->of_patch)
                            : scene;
}

}  // namespace

void SharpRenderer::release() {
  const std::lock_guard lock(mutex_);
  light_ = nullptr;
}

std::shared_ptr<const SnapshotLight> SharpRenderer::light_of(
    const std::shared_ptr<const SolverSnapshot>& snapshot, const Cancellation& cancellation) {
  const std::lock_guard lock(mutex_);
  if (!light_ || light_->snapshot != snapshot) {
    light_ = nullptr;
    auto solution = std::make_shared<Solution>(solution_of(*snapshot));
    solution->scene = scene_of(*snapshot);
    std::shared_ptr<const Scene> scene = solution->scene;
    // While faces are moved, the picker may still be the one of the scene before.
    const LoadedScene& loaded = *snapshot->loaded;
    auto picker = loaded.picker && loaded.picker->scene() == loaded.scene
                      ? loaded.picker
                      : std::make_shared<const Picker>(scene, cancellation);
    light_ = std::make_shared<const SnapshotLight>(
        SnapshotLight{snapshot, std::move(scene),
                      LightByPicker::light(std::move(solution), std::move(picker), cancellation)});
    return_freed_memory();
  }
  return light_;
}

void SharpRenderer::render(const SharpSubject& subject, bool begins_fine,
                           const Cancellation& cancellation, const Deliver& deliver) {
  const SolverSnapshot& snapshot = *subject.snapshot;
  const auto light = light_of(subject.snapshot, cancellation);
  const Camera camera{.eye = subject.view.eye,
                      .target = subject.view.target,
                      .up = subject.view.up,
                      .field_of_view = subject.view.view_angle};
  const QSize& size = subject.size;
  const CameraRays rays(*light->scene, camera, size.width(), size.height());
  Pixels pixels(subject, light->light, rays, cancellation);
  const Clock::time_point begun = Clock::now();
  Clock::time_point delivered = begun;
  double done = 0;
  for (const Pass& pass : std::span(passes).subspan(begins_fine ? first_fine_pass : 0)) {
    // Three quarters of the pixels of a smaller step are new.
    const bool all_new = pass.step == 8 || begins_fine || pass.first > 0;
    const double share = (all_new ? 1 : 0.75) / (pass.step * pass.step);
    visit_pixels(
        {size.width(), size.height(), pass.step}, snapshot.options.threads, cancellation,
        [&](int column, int row) { pixels.visit(column, row, pass); },
        [&](double fraction) {
          const auto now = Clock::now();
          // To draw a picture costs as much time as many pixels.
          if (now - delivered < std::max<Clock::duration>(delivery_pause, (now - begun) / 20)) {
            return;
          }
          delivered = now;
          if (pass.step > 1) {
            pixels.fill(pass.step);
          }
          deliver(pixels.image(), {(done + fraction * share) / samples, false});
        });
    if (pass.step > 1) {
      pixels.fill(pass.step);
    }
    done += share;
  }
  deliver(pixels.image(), {1, true});
}

}  // namespace transillum::viewer
