// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "radiosity/sun_light.h"

#include <array>
#include <cmath>
#include <numbers>

#include "base/for_each_index.h"
#include "radiosity/linear_solution.h"
#include "transillum/at.h"
#include "transillum/engine.h"

namespace transillum {
namespace {

/// Directions over the disc. The penumbra of an edge is a staircase of about 8 steps then, each of
/// a tenth of its width.
constexpr int disc_rays = 64;

/// The coefficients of the irradiance on one patch, per irradiance of the sun.
using Coefficients = std::array<double, linear_unknowns>;

/// The light that one direction brings to a patch.
Coefficients received(const Transfers& transfers, PatchId i, double area) {
  Coefficients found{at(transfers.forward, i).uncovered() / area};
  if (found[0] > 0 && !transfers.forward_moments.empty()) {
    const CoverageMoments& moments = at(transfers.forward_moments, i);
    for (std::size_t a = 0; a < 2; ++a) {
      found[a + 1] = (moments.projected[a] - moments.covered[a]) / area;
    }
  }
  return found;
}

}  // namespace

std::vector<SunRay> rays_of(const Sun& sun) {
  if (!sun.disc) {
    return {{sun.direction}};
  }
  // Points on a spiral by the golden angle fill a disc evenly.
  const Vec3& w = sun.direction;
  const Vec3 u = normalized(cross(std::abs(w.x) < 0.5 ? Vec3{1, 0, 0} : Vec3{0, 1, 0}, w));
  const Vec3 v = cross(w, u);
  const double radius = std::tan(sun_diameter / 2 * std::numbers::pi / 180);
  const double golden = std::numbers::pi * (3 - std::sqrt(5.0));
  std::vector<SunRay> rays;
  double sum = 0;
  for (int k = 0; k < disc_rays; ++k) {
    const double r = radius * std::sqrt((k + 0.5) / disc_rays);
    rays.push_back({normalized(w + r * (std::cos(golden * k) * u + std::sin(golden * k) * v))});
    sum += dot(rays.back().direction, w);
  }
  for (SunRay& ray : rays) {
    ray.weight = 1 / sum;
  }
  return rays;
}

SunLight sun_light(const std::shared_ptr<const Scene>& scene,
                   const std::shared_ptr<const BspTree>& tree, const SolveOptions& options,
                   const Cancellation& cancellation, TransferEngine engine) {
  SunLight light;
  const Sun& sun = options.sky.sun;
  if (!sun.is_set()) {
    return light;
  }
  const bool linear = options.basis == Basis::linear;
  if (!engine || options.engine != Engine::fast) {
    const auto used_tree =
        tree ? tree
             : std::make_shared<const BspTree>(*scene, cancellation, std::function<void(double)>{},
                                               options.threads);
    engine = make_engine(Engine::fast, scene, used_tree, {.moments = linear}, cancellation);
  }
  const std::vector<SunRay> rays = rays_of(sun);
  std::vector<std::vector<Coefficients>> of_ray(rays.size());
  WorkerThreads workers(thread_count(options.threads));
  for_each_index(workers, std::size_t{0}, rays.size(), [&](std::size_t k) {
    const Transfers transfers = engine(rays[k].direction, cancellation);
    for (PatchId i = 0; i < scene->patch_count(); ++i) {
      of_ray[k].push_back(received(transfers, i, scene->patch(i).area));
    }
  });
  for (std::size_t i = 0; i < scene->patches().size(); ++i) {
    Coefficients sums{};
    for (std::size_t k = 0; k < rays.size(); ++k) {
      for (std::size_t a = 0; a < sums.size(); ++a) {
        sums[a] += rays[k].weight * of_ray[k][i][a];
      }
    }
    light.irradiance.push_back(sums[0] * sun.irradiance);
    if (linear) {
      light.linear_terms.push_back({sums[1] * sun.irradiance, sums[2] * sun.irradiance});
    }
  }
  return light;
}

}  // namespace transillum
