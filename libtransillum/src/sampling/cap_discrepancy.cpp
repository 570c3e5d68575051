// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Spherical-cap discrepancy. Notation: a cap is {omega: n·omega >= height} with unit center n; its
// area is (1 - height)/2 of the sphere, its excess its fraction of the directions minus that area.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "sampling/discrepancy.h"

namespace transillum {
namespace {

constexpr double pi = std::numbers::pi;
constexpr std::size_t most_centers = 2048, fewest_centers = 32;
/// Directions times centers examined, if that gives between the fewest and the most centers.
constexpr std::size_t examined_pairs = std::size_t{1} << 22;
/// Directions within this angle of the rim of a cap, in radians, are treated as on it.
constexpr double on_rim = 1e-12;

// A cap with too few directions is the complement of one with too many. So it suffices to find the
// largest excess of closed caps.

/// The largest excess of all caps about a center; one with a direction on its rim reaches it.
double largest_excess_about(const Vec3& center, std::span<const DirectionSample> samples,
                            std::vector<double>& heights) {
  heights.clear();
  for (const DirectionSample& s : samples) {
    heights.push_back(dot(center, s.direction));
  }
  std::sort(heights.begin(), heights.end(), std::greater<>());
  const auto count = static_cast<double>(samples.size());
  double excess = 0;
  for (std::size_t k = 0; k < heights.size(); ++k) {
    excess = std::max(excess, static_cast<double>(k + 1) / count - (1 - heights[k]) / 2);
  }
  return excess;
}

/// The pencil of caps with directions a and b on their rim; their centers form a great circle.
class Pencil {
 public:
  Pencil(const Vec3& a, const Vec3& b) {
    const Vec3 chord = b - a;
    const Vec3 sum = a + b;
    const bool opposite = norm(sum) < on_rim;
    const Vec3 least = std::abs(a.x) < 0.6 ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
    x_ = normalized(opposite ? cross(a, least) : sum);
    y_ = normalized(cross(chord, x_));
    height_ = opposite ? 0 : dot(a, x_);
  }

  /// The largest excess of these caps. As the center moves along the great circle, each direction
  /// is inside for half a turn; the area changes in between.
  double largest_excess(std::span<const DirectionSample> samples, std::size_t first,
                        std::size_t second, std::vector<std::pair<double, int>>& events) const {
    events.clear();
    int inside = 2;  // at the angle -pi
    for (std::size_t k = 0; k < samples.size(); ++k) {
      if (k == first || k == second) {
        continue;
      }
      const double x = dot(samples[k].direction, x_) - height_;
      const double y = dot(samples[k].direction, y_);
      if (std::hypot(x, y) < on_rim) {  // the same direction as one on the rim
        ++inside;
        continue;
      }
      const double middle = std::atan2(y, x);
      const double enters = wrapped(middle - pi / 2 - on_rim);
      const double leaves = wrapped(middle + pi / 2 + on_rim);
      if (leaves < enters) {
        ++inside;
      }
      events.emplace_back(enters, 1);
      events.emplace_back(leaves, -1);
    }
    // The cap is smallest at the angle 0.
    events.emplace_back(0.0, 0);
    std::sort(events.begin(), events.end());
    const auto count = static_cast<double>(samples.size());
    double excess = 0;
    for (const auto& [angle, change] : events) {
      // The caps are closed: a direction counts from entering up to and including leaving.
      if (change > 0) {
        ++inside;
      }
      excess = std::max(excess, inside / count - (1 - height_ * std::cos(angle)) / 2);
      if (change < 0) {
        --inside;
      }
    }
    return excess;
  }

 private:
  static double wrapped(double angle) {
    if (angle < -pi) {
      return angle + 2 * pi;
    }
    return angle >= pi ? angle - 2 * pi : angle;
  }

  Vec3 x_, y_;
  double height_;  ///< height of the smallest cap, whose center is x_
};

double largest_excess_of_pencils(std::span<const DirectionSample> samples,
                                 const Cancellation& cancellation) {
  double excess = 0;
  std::vector<std::pair<double, int>> events;
  for (std::size_t b = 0; b < samples.size(); ++b) {
    for (std::size_t a = 0; a < b; ++a) {
      cancellation.throw_if_canceled();
      const Vec3 &first = samples[a].direction, &second = samples[b].direction;
      if (norm(second - first) < on_rim) {
        continue;
      }
      excess = std::max(excess, Pencil(first, second).largest_excess(samples, a, b, events));
    }
  }
  return excess;
}

}  // namespace

CapDiscrepancy cap_discrepancy(std::span<const DirectionSample> samples,
                               const Cancellation& cancellation) {
  CapDiscrepancy result;
  if (samples.empty()) {
    return result;
  }
  std::vector<double> heights;
  const auto examine = [&](const Vec3& center) {
    cancellation.throw_if_canceled();
    result.value = std::max(result.value, largest_excess_about(center, samples, heights));
  };
  const std::size_t centers =
      std::clamp(examined_pairs / samples.size(), fewest_centers, most_centers);
  for (std::size_t k = 0; k < std::min(samples.size(), centers); ++k) {
    examine(samples[k].direction);
    examine(-samples[k].direction);
  }
  result.exact = samples.size() <= max_exact_cap_directions;
  if (result.exact) {
    result.value = std::max(result.value, largest_excess_of_pencils(samples, cancellation));
  } else {
    for (const Vec3& center : spread_normals(static_cast<int>(centers))) {
      examine(center);
    }
  }
  return result;
}

}  // namespace transillum
