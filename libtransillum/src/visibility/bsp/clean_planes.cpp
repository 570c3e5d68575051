// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "visibility/bsp/clean_planes.h"

#include "transillum/at.h"

namespace transillum {

const std::vector<CleanPlanes::Plane>& CleanPlanes::find_all(const PolygonSet& set) {
  begin(set);
  for (std::size_t p = 0; p < set.size(); ++p) {
    if (covered_[p] == 0) {
      check_();
      test_all(static_cast<std::int32_t>(p));
    }
  }
  return found_;
}

bool CleanPlanes::many_one_sided(const PolygonSet& set) {
  constexpr std::size_t tested = 32;
  begin(set);
  std::size_t one_sided = 0;
  for (std::size_t k = 0; k < tested; ++k) {
    check_();
    one_sided += is_one_sided_in_sample(k * set.size() / tested) ? 1 : 0;
  }
  return 4 * one_sided >= tested;
}

/// Whether the polygons of a sample are on one side of a polygon's plane.
bool CleanPlanes::is_one_sided_in_sample(std::size_t polygon) {
  constexpr std::size_t sample = 512;
  const BspTree::Plane& plane = plane_of(static_cast<std::int32_t>(polygon));
  bool any_front = false, any_back = false;
  const std::size_t step = set_->size() / sample + 1;
  for (std::size_t other = 0; other < set_->size() && !(any_front && any_back); other += step) {
    if (other != polygon) {
      const auto [low, high] = set_->extent(set_->polygons[other], plane);
      any_front |= high > thickness_;
      any_back |= low < -thickness_;
    }
  }
  return !any_front || !any_back;
}

const std::vector<CleanPlanes::Plane>& CleanPlanes::find_one_sided(const PolygonSet& set) {
  begin(set);
  const DiskTree tree(set, planes_, check_);
  for (const std::int32_t p : tree.polygons()) {
    check_();
    test_one_sided(tree, p);
  }
  return found_;
}

void CleanPlanes::begin(const PolygonSet& set) {
  set_ = &set;
  found_.clear();
  in_plane_.clear();
  covered_.assign(set.size(), 0);
  witnesses_.fill(0);
}

const BspTree::Plane& CleanPlanes::plane_of(std::int32_t polygon) const {
  return at(planes_, at(set_->polygons, polygon).plane);
}

/// Keeps the plane of a polygon with the polygons listed since the last one kept.
void CleanPlanes::keep(std::int32_t polygon, std::size_t front, std::size_t back) {
  const std::uint32_t begin = found_.empty() ? 0 : found_.back().end;
  found_.push_back({polygon, front > 0, back > 0, std::min(front, back), begin,
                    static_cast<std::uint32_t>(in_plane_.size())});
  at(covered_, polygon) = 1;
  for (std::uint32_t k = begin; k < in_plane_.size(); ++k) {
    at(covered_, in_plane_[k]) = 1;
  }
}

void CleanPlanes::test_all(std::int32_t polygon) {
  const BspTree::Plane& plane = plane_of(polygon);
  const auto n = static_cast<std::int32_t>(set_->size());
  const std::size_t listed = in_plane_.size();
  std::size_t front = 0, back = 0;
  // The polygon cut by the plane before is tested first.
  for (std::int32_t k = -1; k < n; ++k) {
    const std::int32_t other = k < 0 ? witnesses_[0] : k;
    if (other == polygon) {
      continue;
    }
    const auto [low, high] = set_->extent(at(set_->polygons, other), plane);
    const bool above = high > thickness_, below = low < -thickness_;
    if (above && below) {
      witnesses_[0] = other;
      in_plane_.resize(listed);
      return;
    }
    if (k < 0) {
      continue;
    }
    front += above;
    back += below;
    if (!above && !below) {
      in_plane_.push_back(other);
    }
  }
  keep(polygon, front, back);
}

void CleanPlanes::test_one_sided(const DiskTree& tree, std::int32_t polygon) {
  if (at(covered_, polygon) != 0) {
    return;
  }
  const BspTree::Plane& plane = plane_of(polygon);
  bool any_front = false, any_back = false;
  for (const std::int32_t other : witnesses_) {
    if (other != polygon) {
      const auto [low, high] = set_->extent(at(set_->polygons, other), plane);
      any_front |= high > thickness_;
      any_back |= low < -thickness_;
    }
  }
  if (!any_front || !any_back) {
    test_side(tree, polygon, any_front);
  }
}

/// Keeps the plane of a polygon if all others are on one side of it.
/// @param front the side; if false and wrong, the other is tried.
void CleanPlanes::test_side(const DiskTree& tree, std::int32_t polygon, bool front) {
  const BspTree::Plane& own = plane_of(polygon);
  // `plane` has all others behind it.
  const BspTree::Plane plane =
      front ? BspTree::Plane{-own.normal, -own.offset} : BspTree::Plane{own};
  const std::size_t listed = in_plane_.size();
  std::int32_t wrong = -1;
  bool any_behind = false;
  tree.for_each_reaching(plane.normal, plane.offset - thickness_, [&](std::int32_t other) {
    if (other == polygon) {
      return true;
    }
    const auto [low, high] = set_->extent(at(set_->polygons, other), plane);
    any_behind |= low < -thickness_;
    if (high > thickness_) {
      wrong = other;
    } else if (low >= -thickness_) {
      in_plane_.push_back(other);
    }
    return wrong < 0;
  });
  if (wrong < 0) {
    const std::size_t others = set_->size() - 1 - (in_plane_.size() - listed);
    keep(polygon, front ? others : 0, front ? 0 : others);
    return;
  }
  in_plane_.resize(listed);
  at(witnesses_, next_witness_++ % witnesses_.size()) = wrong;
  if (!front && !any_behind) {
    test_side(tree, polygon, true);
  }
}

}  // namespace transillum
