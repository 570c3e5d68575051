// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "session/shot_points.h"

#include <algorithm>

#include "transillum/at.h"

namespace transillum {
namespace {

constexpr int more_points = 4;  ///< times as many
/// Most work, in units of the shot by the usual points.
constexpr double most_work = 64;

}  // namespace

ShotPoints::ShotPoints(const ShotOptions& options, std::size_t patches)
    : patches_(patches),
      usual_(options.points > 0 ? options.points : ShotOptions::default_points) {}

bool ShotPoints::refine(const std::vector<PatchId>& patches) {
  std::vector<int> refined = points_.empty() ? std::vector<int>(patches_, usual_) : points_;
  bool is_more = false;
  for (const PatchId i : patches) {
    int& points = at(refined, i);
    const int more = std::min(more_points * points, EngineOptions::largest_points);
    is_more = is_more || more > points;
    points = std::max(points, more);
  }
  // The work of a patch grows as the square of the number of points in a row.
  double work = 0;
  for (const int points : refined) {
    const double ratio = static_cast<double>(points) / usual_;
    work += ratio * ratio;
  }
  if (!is_more || work > most_work * static_cast<double>(patches_)) {
    return false;
  }
  points_ = std::move(refined);
  return true;
}

}  // namespace transillum
