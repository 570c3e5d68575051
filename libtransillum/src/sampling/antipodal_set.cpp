// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Axes that are even together with their opposites (decision 50). A Fibonacci lattice on the half
// sphere is, except along the plane z = 0, where it meets its own mirror image. Repulsion between
// neighbors closes that seam; then smooth displacements make the means of the even harmonics of low
// degree exact, which repulsion over short distances would take thousands of steps to do, and the
// projected areas of axis-parallel patches.
//
// Only +, -, *, / and square roots are used, which IEEE 754 defines to the last bit.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <numbers>
#include <span>
#include <utility>
#include <vector>

#include "sampling/even_harmonics.h"
#include "sampling/sequences.h"

namespace transillum {
namespace {

/// Number of steps of the repulsion; most of its effect comes from the first ten.
constexpr int repulsion_steps = 20;
/// Reach of the repulsion, and radius of the lists of neighbors, in spacings.
constexpr double reach = 2, list_radius = 2.4;
/// Displacement per step by a point one spacing away, in spacings. From 0.1 on, steps overshoot.
constexpr double step_length = 0.04;
/// Larger sets keep the lattice: only a fraction of 1/sqrt(M) of the directions is near the seam.
constexpr std::size_t max_repelled = 1 << 16;
/// Steps that make means of harmonics and of projected areas exact, each of which disturbs the
/// other a little.
constexpr int exact_steps = 2;
/// Smaller sets have too few axes near each coordinate plane to move.
constexpr std::size_t min_balanced = 16;

/// Spacing of the 2M points: the side of a square of the area that belongs to one.
double spacing(std::size_t axes) {
  return std::sqrt(2 * std::numbers::pi / static_cast<double>(axes));
}

/// z = 1 - (k+1/2)/M; the longitude increases by 2 pi / golden ratio from one axis to the next.
std::vector<Vec3> half_sphere_lattice(int count) {
  // Products instead of cos(k angle), whose last bits differ between machines.
  constexpr double cosine = -0.73736887807831990, sine = -0.67549029426152364;
  std::vector<Vec3> axes;
  axes.reserve(static_cast<std::size_t>(count));
  double x = 1, y = 0;
  for (int k = 0; k < count; ++k) {
    const double z = 1 - (k + 0.5) / count;
    const double radius = std::sqrt(1 - z * z);
    axes.push_back(normalized({radius * x, radius * y, z}));
    const double next_x = cosine * x - sine * y;
    y = sine * x + cosine * y;
    x = next_x;
  }
  return axes;
}

std::vector<Vec3> with_opposites(const std::vector<Vec3>& axes) {
  std::vector<Vec3> points = axes;
  points.reserve(2 * axes.size());
  std::transform(axes.begin(), axes.end(), std::back_inserter(points),
                 [](const Vec3& a) { return -a; });
  return points;
}

/// The neighbors of points of the unit sphere: for each point the others nearer than a radius.
class SphereNeighbors {
 public:
  /// Lists the neighbors of the first `listed` points among all. O(N log N) for evenly spread
  /// points and a radius of a few spacings.
  SphereNeighbors(std::span<const Vec3> points, std::size_t listed, double radius);

  /// Numbers of the neighbors of point i < listed, in an order that depends on the points only.
  std::span<const std::uint32_t> of(std::size_t i) const {
    return std::span(near_).subspan(begin_[i], begin_[i + 1] - begin_[i]);
  }

 private:
  int cell(double x) const;
  std::int64_t key(int x, int y, int z) const;
  void append_near(std::span<const Vec3> points, std::size_t i, double radius);

  int cells_;  ///< along each side of the cube [-1,1]³; at least as wide as the radius
  std::vector<std::pair<std::int64_t, std::uint32_t>> sorted_;  ///< cell and number of each point
  std::vector<std::size_t> begin_;
  std::vector<std::uint32_t> near_;
};

SphereNeighbors::SphereNeighbors(std::span<const Vec3> points, std::size_t listed, double radius)
    : cells_(std::max(1, static_cast<int>(2 / radius))) {
  sorted_.reserve(points.size());
  for (const Vec3& p : points) {
    sorted_.emplace_back(key(cell(p.x), cell(p.y), cell(p.z)),
                         static_cast<std::uint32_t>(sorted_.size()));
  }
  std::sort(sorted_.begin(), sorted_.end());
  for (std::size_t i = 0; i < listed; ++i) {
    begin_.push_back(near_.size());
    append_near(points, i, radius);
  }
  begin_.push_back(near_.size());
}

int SphereNeighbors::cell(double x) const {
  return std::clamp(static_cast<int>((x + 1) / 2 * cells_), 0, cells_ - 1);
}

std::int64_t SphereNeighbors::key(int x, int y, int z) const {
  return x + std::int64_t{cells_} * (y + std::int64_t{cells_} * z);
}

void SphereNeighbors::append_near(std::span<const Vec3> points, std::size_t i, double radius) {
  const auto cells_around = [this](double x) {
    return std::pair(std::max(cell(x) - 1, 0), std::min(cell(x) + 1, cells_ - 1));
  };
  const auto [x0, x1] = cells_around(points[i].x);
  const auto [y0, y1] = cells_around(points[i].y);
  const auto [z0, z1] = cells_around(points[i].z);
  for (int z = z0; z <= z1; ++z) {
    for (int y = y0; y <= y1; ++y) {
      auto p = std::lower_bound(sorted_.begin(), sorted_.end(), std::pair(key(x0, y, z), 0U));
      for (const std::int64_t last = key(x1, y, z); p != sorted_.end() && p->first <= last; ++p) {
        const Vec3 apart = points[i] - points[p->second];
        if (p->second != i && dot(apart, apart) < radius * radius) {
          near_.push_back(p->second);
        }
      }
    }
  }
}

/// Force on an axis, tangential or not: from each neighbor 1/d², times a factor that decreases to 0
/// at the reach; d in spacings.
Vec3 force_on(const Vec3& axis, std::span<const std::uint32_t> near, std::span<const Vec3> points,
              double unit) {
  Vec3 force;
  for (const std::uint32_t j : near) {
    const Vec3 apart = (axis - points[j]) / unit;
    const double square = dot(apart, apart);
    const double rest = 1 - square / (reach * reach);
    if (rest > 0) {
      force = force + rest * rest / (square * std::sqrt(square)) * apart;
    }
  }
  return force;
}

void repel(std::vector<Vec3>& axes) {
  const double unit = spacing(axes.size());
  const SphereNeighbors neighbors(with_opposites(axes), axes.size(), list_radius * unit);
  for (int step = 0; step < repulsion_steps; ++step) {
    const std::vector<Vec3> points = with_opposites(axes);
    for (std::size_t i = 0; i < axes.size(); ++i) {
      const Vec3 force = force_on(axes[i], neighbors.of(i), points, unit);
      axes[i] = normalized(axes[i] + step_length * unit * (force - dot(force, axes[i]) * axes[i]));
    }
  }
}

/// The largest even degree of about half of what 2M points can resolve.
int harmonic_degree(std::size_t axes) {
  const double degree = std::sqrt(static_cast<double>(axes) / 2);
  return std::min(static_cast<int>(degree) / 2 * 2, max_harmonic_degree);
}

/// Moves axes near a coordinate plane so that the mean of |coordinate| approaches 1/2, its mean
/// over the sphere: axis-parallel patches then have the right projected area, without the error of
/// eq. 17.
void balance(std::vector<Vec3>& axes, double Vec3::*coordinate) {
  const double width = spacing(axes.size());
  const auto weight = [width](double x) {
    const double rest = 1 - x * x / (width * width);
    return rest > 0 ? rest * rest : 0;
  };
  double missing = static_cast<double>(axes.size()) / 2, weights = 0;
  for (const Vec3& axis : axes) {
    const double x = axis.*coordinate;
    missing -= std::abs(x);
    weights += weight(x) * (1 - x * x);
  }
  for (Vec3& axis : axes) {
    const double x = axis.*coordinate;
    axis.*coordinate += std::copysign(1.0, x) * weight(x) * missing / weights;
    axis = normalized(axis);
  }
}

/// Whether axis k lies on an even turn of the spiral. Axes of odd turns are replaced by their
/// opposites, so that the set, and each part of it in its progressive order, has about as many
/// directions above as below.
bool points_up(std::size_t k) {
  return static_cast<std::size_t>(static_cast<double>(k) / std::numbers::phi) % 2 == 0;
}

}  // namespace

std::vector<Vec3> antipodal_set(int count) {
  std::vector<Vec3> axes = half_sphere_lattice(count);
  if (axes.size() <= max_repelled) {
    repel(axes);
  }
  for (int step = 0; step < exact_steps; ++step) {
    move_to_exact_harmonics(axes, harmonic_degree(axes.size()));
    if (axes.size() >= min_balanced) {
      for (const auto coordinate : {&Vec3::x, &Vec3::y, &Vec3::z}) {
        balance(axes, coordinate);
      }
    }
  }
  for (std::size_t k = 0; k < axes.size(); ++k) {
    axes[k] = points_up(k) ? axes[k] : -axes[k];
  }
  return axes;
}

}  // namespace transillum
