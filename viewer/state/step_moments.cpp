// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "state/step_moments.h"

#include <array>
#include <optional>
#include <vector>

#include "model/linear_values.h"
#include "transillum/at.h"
#include "transillum/linear_basis.h"

namespace transillum::viewer {

namespace {

/// The functions phi_0, phi_1 and phi_2 of a patch over the transillumination plane.
class PlaneFunctions {
 public:
  PlaneFunctions(const PlaneFrame& frame, const Scene& scene, PatchId i)
      : frame_(frame), patch_(scene.patch(i)), basis_(linear_basis(scene, i)) {}

  std::array<double, 3> at(const Vec2& p) const {
    const std::optional<Vec3> point = point_of_patch(frame_, p, patch_);
    const std::array<double, 2> values = point ? basis_.at(*point) : std::array<double, 2>{};
    return {1, values[0], values[1]};
  }

 private:
  const PlaneFrame& frame_;
  const Patch& patch_;
  LinearBasis basis_;
};

double twice_area(const Vec2& p, const Vec2& q, const Vec2& r) {
  return (q.x - p.x) * (r.y - p.y) - (q.y - p.y) * (r.x - p.x);
}

/// Adds the integrals of the products of functions over a convex polygon.
void add_polygon(std::span<const Vec2> polygon, const PlaneFunctions& own,
                 const PlaneFunctions& other, TransferMoments& moments) {
  for (std::size_t k = 1; k + 1 < polygon.size(); ++k) {
    const std::array corners{polygon[0], polygon[k], polygon[k + 1]};
    const double area = std::abs(twice_area(corners[0], corners[1], corners[2])) / 2;
    std::array<std::array<double, 3>, 3> f, g;  // by corner, then function
    for (std::size_t c = 0; c < 3; ++c) {
      f[c] = own.at(corners[c]);
      g[c] = other.at(corners[c]);
    }
    // ∫ f g = A/12 (Σ f Σ g + Σ f g), sums over the corners of a triangle.
    for (std::size_t a = 0; a < 3; ++a) {
      for (std::size_t b = 0; b < 3; ++b) {
        double products = 0;
        for (std::size_t c = 0; c < 3; ++c) {
          products += f[c][a] * g[c][b];
        }
        const double sums = (f[0][a] + f[1][a] + f[2][a]) * (g[0][b] + g[1][b] + g[2][b]);
        moments.of(a, b) += area / 12 * (sums + products);
      }
    }
  }
}

}  // namespace

std::map<PatchId, TransferMoments> moments_of_step(const MapHistory& history, const Scene& scene,
                                                   std::int32_t step) {
  std::map<PatchId, TransferMoments> moments;
  if (step < 0) {
    return moments;
  }
  const MapRecord& record = history.record();
  const PlaneFunctions own(record.frame, scene, history.step(step).patch);
  for (const std::int32_t r : history.inside_at(step)) {
    if (!history.exchanges(r)) {
      continue;
    }
    const MapRecord::Row& row = history.row(r);
    const PlaneFunctions other(record.frame, scene, row.patch);
    add_polygon(record.outline(row), own, other, moments[row.patch]);
  }
  return moments;
}

}  // namespace transillum::viewer
