// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "radiosity/glossy/shot_rays.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/for_each_index.h"
#include "transillum/at.h"

namespace transillum {
namespace {

/// The sizes of two parts together, over their distance, at which one direction stands for them.
constexpr double small_pair = 0.15;
/// Divisions of a pair of triangles by four, at most.
constexpr int most_divisions = 4;

using Triangle = std::array<Vec3, 3>;

Vec3 center_of(const Triangle& t) { return 1.0 / 3 * (t[0] + t[1] + t[2]); }
double area_of(const Triangle& t) { return norm(cross(t[1] - t[0], t[2] - t[0])) / 2; }
double size_of(const Triangle& t) {
  return std::max({norm(t[1] - t[0]), norm(t[2] - t[1]), norm(t[0] - t[2])});
}

std::array<Triangle, 4> quarters_of(const Triangle& t) {
  const Vec3 a = 0.5 * (t[1] + t[2]), b = 0.5 * (t[2] + t[0]), c = 0.5 * (t[0] + t[1]);
  return {{{t[0], c, b}, {c, t[1], a}, {b, a, t[2]}, {a, b, c}}};
}

/// The triangles of each patch.
std::vector<std::vector<Triangle>> triangles_of(const Scene& scene) {
  std::vector<std::vector<Triangle>> triangles(scene.patches().size());
  for (const Piece& piece : scene.pieces()) {
    const auto corners = scene.corners(piece);
    for (std::size_t k = 2; k < corners.size(); ++k) {
      at(triangles, piece.patch)
          .push_back(
              {scene.point(corners[0]), scene.point(corners[k - 1]), scene.point(corners[k])});
    }
  }
  return triangles;
}

/// Collects the directions of one pair of patches.
class PairRays {
 public:
  PairRays(const Scene& scene, const DirectLight::Pair& pair)
      : pair_(pair), receiver_(scene.patch(pair.receiver)), source_(scene.patch(pair.source)) {}

  void add(const Triangle& a, const Triangle& b, int divisions = 0) {
    const Vec3 way = center_of(b) - center_of(a);
    const double square = dot(way, way), size_a = size_of(a), size_b = size_of(b);
    const bool is_small = std::pow(size_a + size_b, 2) <= small_pair * small_pair * square;
    if (is_small || divisions == most_divisions) {
      const double toward = dot(way, receiver_.normal), from = -dot(way, source_.normal);
      if (toward > 0 && from > 0) {
        const double weight = area_of(a) * area_of(b) * toward * from / (square * square);
        rays_.push_back({way / std::sqrt(square), pair_.source, weight});
      }
    } else if (size_a >= size_b) {
      for (const Triangle& quarter : quarters_of(a)) {
        add(quarter, b, divisions + 1);
      }
    } else {
      for (const Triangle& quarter : quarters_of(b)) {
        add(a, quarter, divisions + 1);
      }
    }
  }

  /// The rays, which share the irradiance of the pair; where no parts face each other, one from
  /// straight above.
  std::vector<ShotRay> rays() {
    double sum = 0;
    for (const ShotRay& ray : rays_) {
      sum += ray.irradiance;
    }
    if (!(sum > 0)) {
      return {{receiver_.normal, pair_.source, pair_.irradiance}};
    }
    for (ShotRay& ray : rays_) {
      ray.irradiance *= pair_.irradiance / sum;
    }
    return std::move(rays_);
  }

 private:
  const DirectLight::Pair& pair_;
  const Patch& receiver_;
  const Patch& source_;
  std::vector<ShotRay> rays_;  ///< irradiance: the weight
};

}  // namespace

ShotRays::ShotRays(const Scene& scene, const std::vector<DirectLight::Pair>& pairs,
                   const std::vector<PatchId>& receivers, WorkerThreads& workers,
                   const Cancellation& cancellation)
    : rays_(receivers.size()) {
  const std::vector<std::vector<Triangle>> triangles = triangles_of(scene);
  for_each_index(workers, std::size_t{0}, receivers.size(), [&](std::size_t g) {
    const auto [first, last] =
        std::equal_range(pairs.begin(), pairs.end(), DirectLight::Pair{.receiver = receivers[g]},
                         [](const auto& a, const auto& b) { return a.receiver < b.receiver; });
    for (auto pair = first; pair != last; ++pair) {
      cancellation.throw_if_canceled();
      PairRays of_pair(scene, *pair);
      for (const Triangle& a : at(triangles, pair->receiver)) {
        for (const Triangle& b : at(triangles, pair->source)) {
          of_pair.add(a, b);
        }
      }
      const std::vector<ShotRay> found = of_pair.rays();
      rays_[g].insert(rays_[g].end(), found.begin(), found.end());
    }
    rays_[g].shrink_to_fit();
  });
}

void ShotRays::add_sun(const Scene& scene, const std::vector<PatchId>& receivers, const Sun& sun,
                       const std::vector<Rgb>& irradiance) {
  for (std::size_t g = 0; g < receivers.size(); ++g) {
    // All channels have the same ratio.
    const double lit = max_abs(at(irradiance, receivers[g])) / max_abs(sun.irradiance);
    if (lit > 0) {
      // Part of a disc may light a patch below whose plane its middle is.
      constexpr double least_cosine = 1e-3;
      const Vec3& normal = scene.patch(receivers[g]).normal;
      const double lift = std::max(0.0, least_cosine - dot(sun.direction, normal));
      rays_[g].push_back({normalized(sun.direction + lift * normal), scene.patch_count(), lit});
    }
  }
}

std::uint64_t ShotRays::bytes() const {
  std::uint64_t bytes = 0;
  for (const std::vector<ShotRay>& rays : rays_) {
    bytes += rays.size() * sizeof(ShotRay);
  }
  return bytes;
}

}  // namespace transillum
