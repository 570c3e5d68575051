// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Star discrepancy by a sweep over u with one line per upper side v, in O(M^1.5).
#include <algorithm>
#include <cmath>

#include "sampling/discrepancy.h"

namespace transillum {
namespace {

/// The maximum of many lines at x, where ranges of lines can be raised.
///
/// The lines are divided into blocks of about the square root of their number. A block stores the
/// upper envelope of its lines and the height by which it was raised as a whole; raising a part of
/// it rebuilds its envelope. Both operations therefore cost the square root of the number of lines.
class LiftedLines {
 public:
  /// Line k is initially slopes[k] x. Slopes must ascend.
  explicit LiftedLines(std::vector<double> slopes)
      : slope_(std::move(slopes)),
        height_(slope_.size(), 0),
        block_size_(std::max<std::size_t>(
            1, static_cast<std::size_t>(std::sqrt(static_cast<double>(slope_.size()))))) {
    for (std::size_t begin = 0; begin < slope_.size(); begin += block_size_) {
      blocks_.push_back({begin, std::min(begin + block_size_, slope_.size()), 0, {}, 0});
      make_hull(blocks_.back());
    }
  }

  /// Adds `height` to lines begin … end-1.
  void lift(std::size_t begin, std::size_t end, double height) {
    for (std::size_t b = begin / block_size_; b < blocks_.size() && blocks_[b].begin < end; ++b) {
      Block& block = blocks_[b];
      if (begin <= block.begin && block.end <= end) {
        block.height += height;
        continue;
      }
      const std::size_t last = std::min(end, block.end);
      for (std::size_t k = std::max(begin, block.begin); k < last; ++k) {
        height_[k] += height;
      }
      make_hull(block);
    }
  }

  /// The maximum of all lines at x; x must not decrease from call to call.
  double max_at(double x) {
    double highest = -HUGE_VAL;
    for (Block& block : blocks_) {
      const auto value = [&](std::size_t k) {
        return height_[block.hull[k]] + slope_[block.hull[k]] * x;
      };
      // With increasing x, steeper lines become the largest.
      while (block.at + 1 < block.hull.size() && value(block.at + 1) >= value(block.at)) {
        ++block.at;
      }
      highest = std::max(highest, block.height + value(block.at));
    }
    return highest;
  }

 private:
  struct Block {
    std::size_t begin, end;
    double height;
    std::vector<std::size_t> hull;
    std::size_t at;  ///< index in the hull of the largest line at the last x
  };

  void make_hull(Block& block) {
    block.hull.clear();
    block.at = 0;
    for (std::size_t k = block.begin; k < block.end; ++k) {
      while (!block.hull.empty() && hides_last(block.hull, k)) {
        block.hull.pop_back();
      }
      block.hull.push_back(k);
    }
  }

  /// Whether the hull's last line is nowhere above both its predecessor and the steeper line k.
  bool hides_last(const std::vector<std::size_t>& hull, std::size_t k) const {
    const std::size_t b = hull.back();
    if (slope_[k] == slope_[b]) {
      return height_[k] >= height_[b];
    }
    if (hull.size() < 2) {
      return false;
    }
    const std::size_t a = hull[hull.size() - 2];
    return (height_[a] - height_[b]) * (slope_[k] - slope_[b]) >=
           (height_[b] - height_[k]) * (slope_[b] - slope_[a]);
  }

  std::vector<double> slope_, height_;
  std::size_t block_size_;
  std::vector<Block> blocks_;
};

std::vector<double> distinct_sorted(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  values.erase(std::unique(values.begin(), values.end()), values.end());
  return values;
}

}  // namespace

double star_discrepancy(std::span<const DirectionSample> samples,
                        const Cancellation& cancellation) {
  if (samples.empty()) {
    return 0;
  }
  const auto count = static_cast<double>(samples.size());
  std::vector<DirectionSample> points(samples.begin(), samples.end());
  std::sort(points.begin(), points.end(), [](const auto& a, const auto& b) { return a.u < b.u; });
  std::vector<double> tops;  // possible upper sides v of a box
  for (const DirectionSample& p : points) {
    tops.push_back(p.v);
  }
  tops.push_back(1);
  tops = distinct_sorted(std::move(tops));

  // At position u of the sweep, a box with upper side v has (points in it) - M v u too many points
  // if its upper sides belong to it, or M v u - (points in it) too few if they do not. Slopes must
  // ascend, so the lines of boxes with too many are stored from the highest v down.
  std::vector<double> few_slopes, many_slopes;
  for (const double v : tops) {
    few_slopes.push_back(count * v);
  }
  for (auto v = tops.rbegin(); v != tops.rend(); ++v) {
    many_slopes.push_back(-count * *v);
  }
  LiftedLines too_few(std::move(few_slopes)), too_many(std::move(many_slopes));

  double largest = 0;
  for (auto next = points.begin(); next != points.end();) {
    cancellation.throw_if_canceled();
    const double u = next->u;
    largest = std::max(largest, too_few.max_at(u));
    for (; next != points.end() && next->u == u; ++next) {
      const auto at = static_cast<std::size_t>(std::lower_bound(tops.begin(), tops.end(), next->v) -
                                               tops.begin());
      too_few.lift(at + 1, tops.size(), -1);
      too_many.lift(0, tops.size() - at, 1);
    }
    largest = std::max(largest, too_many.max_at(u));
  }
  largest = std::max(largest, too_few.max_at(1));
  return largest / count;
}

}  // namespace transillum
