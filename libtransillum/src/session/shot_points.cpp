// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "session/shot_points.h"

#include <algorithm>
#include <limits>

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

std::vector<int> ShotPoints::refined(const std::vector<PatchId>& patches) const {
  std::vector<int> refined = points_.empty() ? std::vector<int>(patches_, usual_) : points_;
  for (const PatchId i : patches) {
    int& points = at(refined, i);
    points = std::max(points, std::min(more_points * points, EngineOptions::largest_points));
  }
  return refined;
}

/// The work of a patch grows as the square of the number of points in a row.
double ShotPoints::work_of(const std::vector<int>& points) const {
  double work = points.empty() ? static_cast<double>(patches_) : 0;
  for (const int count : points) {
    const double ratio = static_cast<double>(count) / usual_;
    work += ratio * ratio;
  }
  return work / static_cast<double>(patches_);
}

double ShotPoints::work_to_refine(const std::vector<PatchId>& patches) const {
  const double before = work(), after = work_of(refined(patches));
  return after > before && after <= most_work ? after - before
                                              : std::numeric_limits<double>::infinity();
}

}  // namespace transillum
