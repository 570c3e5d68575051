// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "pictures/plane_points.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>
#include <utility>

namespace transillum {

PlanePoints::PlanePoints(const Scene& scene, const Cancellation& cancellation)
    : scene_(scene), step_(1e-4 * scene.bounds().diagonal()) {
  constexpr double steps = 1 << 20;  // in a component of a normal
  const auto rounded = [](double x) { return std::lround(steps * x); };
  std::map<std::tuple<PointId, long, long, long>, std::int32_t> numbers;
  std::vector<Vec3> sums;
  std::vector<double> counts;
  std::vector<std::pair<std::int32_t, PatchId>> met;  // points and patches
  const std::vector<Piece>& pieces = scene.pieces();
  for (std::size_t k = 0; k < pieces.size(); ++k) {
    cancellation.throw_if_canceled();
    while (first_piece_.size() <= static_cast<std::size_t>(pieces[k].patch)) {
      first_piece_.push_back(k);
    }
    const auto corners = scene.corners(pieces[k]);
    const Vec3& normal = scene.patch(pieces[k].patch).normal;
    const Vec3 middle = middle_of(outline(k));
    first_corner_.push_back(of_corner_.size());
    for (const PointId p : corners) {
      const auto [found, is_new] =
          numbers.try_emplace({p, rounded(normal.x), rounded(normal.y), rounded(normal.z)},
                              static_cast<std::int32_t>(points_.size()));
      const std::int32_t n = found->second;
      if (is_new) {
        points_.push_back({scene.point(p), normal});
        sums.emplace_back();
        counts.push_back(0);
      }
      at(sums, n) = at(sums, n) + middle;
      at(counts, n) += 1;
      of_corner_.push_back(n);
      if (met.empty() || met.back() != std::pair(n, pieces[k].patch)) {
        met.emplace_back(n, pieces[k].patch);
      }
    }
  }
  first_piece_.resize(scene.patches().size() + 1, pieces.size());
  std::sort(met.begin(), met.end());
  met.erase(std::unique(met.begin(), met.end()), met.end());
  for (const auto& [n, patch] : met) {
    first_patch_.resize(static_cast<std::size_t>(n) + 1,
                        static_cast<std::uint32_t>(patches_.size()));
    patches_.push_back(patch);
  }
  first_patch_.resize(points_.size() + 1, static_cast<std::uint32_t>(patches_.size()));
  for (std::size_t n = 0; n < points_.size(); ++n) {
    points_[n].place = inward(points_[n].place, sums[n] / counts[n]);
  }
}

Corners PlanePoints::outline(std::size_t piece) const {
  Corners corners;
  for (const PointId p : scene_.corners(scene_.pieces()[piece])) {
    corners.push_back(scene_.point(p));
  }
  return corners;
}

Vec3 PlanePoints::inward(const Vec3& x, const Vec3& middle) const {
  constexpr double most = 1.0 / 64;
  const Vec3 toward = middle - x;
  const double distance = norm(toward);
  return distance > 0 ? x + std::min(most, step_ / distance) * toward : x;
}

}  // namespace transillum
