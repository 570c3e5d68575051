// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// For maps of a direction after some of its steps: which part of each patch has been processed, and
// from which piece of the scene a fragment was cut.
#include "visibility/pixels/processed_fragments.h"

#include <algorithm>
#include <cmath>

#include "transillum/at.h"

namespace transillum {
namespace {

std::vector<PointId> outline_of(const BspTree& tree, FragmentId f) {
  std::vector<PointId> outline;
  for (const BspTree::Corner& corner : tree.corners(tree.fragment(f))) {
    outline.push_back(corner.point);
  }
  return outline;
}

}  // namespace

bool contains_point(std::span<const PointId> outline, const std::vector<Vec3>& points,
                    const PlaneFrame& frame, const Vec2& point) {
  bool inside = false;
  for (std::size_t k = 0; k < outline.size(); ++k) {
    const auto [p, q] = std::minmax(outline[k], outline[(k + 1) % outline.size()]);
    const Vec2 a = frame.project(at(points, p));
    const Vec2 b = frame.project(at(points, q));
    if ((a.y > point.y) == (b.y > point.y)) {
      continue;
    }
    if (point.x < a.x + (point.y - a.y) / (b.y - a.y) * (b.x - a.x)) {
      inside = !inside;
    }
  }
  return inside;
}

ProcessedFragments::ProcessedFragments(const Scene& scene, const BspTree& tree,
                                       std::span<const FragmentId> fragments,
                                       const PlaneFrame& frame)
    : tree_(tree),
      frame_(frame),
      whole_(static_cast<std::size_t>(scene.patch_count())),
      outlines_(whole_.size()) {
  std::vector<std::size_t> missing(whole_.size(), 0);
  for (const BspTree::Fragment& fragment : tree.fragments()) {
    ++at(missing, fragment.patch);
  }
  for (const FragmentId f : fragments) {
    --at(missing, tree.fragment(f).patch);
  }
  for (std::size_t i = 0; i < whole_.size(); ++i) {
    whole_[i] = missing[i] == 0;
  }
  for (const FragmentId f : fragments) {
    const PatchId patch = tree.fragment(f).patch;
    if (!at(whole_, patch)) {
      at(outlines_, patch).push_back(boxed_outline_of(f));
    }
  }
}

ProcessedFragments::BoxedOutline ProcessedFragments::boxed_outline_of(FragmentId f) const {
  BoxedOutline boxed{outline_of(tree_, f), {HUGE_VAL, HUGE_VAL}, {-HUGE_VAL, -HUGE_VAL}};
  for (const PointId p : boxed.outline) {
    const Vec2 place = frame_.project(at(tree_.points(), p));
    boxed.low = {std::min(boxed.low.x, place.x), std::min(boxed.low.y, place.y)};
    boxed.high = {std::max(boxed.high.x, place.x), std::max(boxed.high.y, place.y)};
  }
  return boxed;
}

bool ProcessedFragments::covers(PatchId i, const Vec2& point) const {
  if (at(whole_, i)) {
    return true;
  }
  const std::vector<BoxedOutline>& outlines = at(outlines_, i);
  return std::any_of(outlines.begin(), outlines.end(), [&](const BoxedOutline& boxed) {
    return point.x >= boxed.low.x && point.x <= boxed.high.x && point.y >= boxed.low.y &&
           point.y <= boxed.high.y && contains_point(boxed.outline, tree_.points(), frame_, point);
  });
}

PieceFinder::PieceFinder(const Scene& scene, const BspTree& tree, const PlaneFrame& frame)
    : scene_(scene),
      tree_(tree),
      frame_(frame),
      pieces_(static_cast<std::size_t>(scene.patch_count())) {
  for (std::size_t k = 0; k < scene.pieces().size(); ++k) {
    at(pieces_, scene.pieces()[k].patch).push_back(k);
  }
}

std::size_t PieceFinder::piece_of(FragmentId f) const {
  const auto& pieces = at(pieces_, tree_.fragment(f).patch);
  if (pieces.size() == 1) {
    return pieces.front();
  }
  const std::vector<PointId> outline = outline_of(tree_, f);
  Vec3 middle;
  for (const PointId p : outline) {
    middle = middle + (1.0 / static_cast<double>(outline.size())) * at(tree_.points(), p);
  }
  const Vec2 at = frame_.project(middle);
  const auto found = std::find_if(pieces.begin(), pieces.end(), [&](std::size_t k) {
    return contains_point(scene_.corners(scene_.pieces()[k]), scene_.points(), frame_, at);
  });
  return found == pieces.end() ? pieces.front() : *found;
}

}  // namespace transillum
