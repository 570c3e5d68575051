// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// The hemicube: clipping, perspective projection and z-buffer of polygons in the frame of a point,
// which form_factors/hemicube_factors.cpp passes in.
//
// Notation: on a side, a is the coordinate along it, b upward, depth the distance from the point
// along the side's axis; a and b are divided by depth after clipping.
#include "visibility/pixels/hemicube.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "transillum/at.h"

namespace transillum {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
/// Where two depths differ relatively by less than this, the polygon drawn later covers the
/// earlier.
constexpr float tie = 1e-6F;

/// Form factor from a small area at the origin, facing up, to [0,x] by [0,y] at height 1.
double to_top(double x, double y) {
  const double p = std::sqrt(1 + x * x), q = std::sqrt(1 + y * y);
  return (x / p * std::atan(y / p) + y / q * std::atan(x / q)) / (2 * std::numbers::pi);
}

/// The same to [0,y] by [0,z] in the vertical plane x = 1.
double to_side(double y, double z) {
  const double r = std::sqrt(1 + z * z);
  return (std::atan(y) - std::atan(y / r) / r) / (2 * std::numbers::pi);
}

/// `p` in the coordinates (a, b, depth) of a side.
Vec3 in_side_frame(int side, const Vec3& p) {
  switch (side) {
    case 0:
      return {p.x, p.y, p.z};
    case 1:
      return {p.y, p.z, p.x};
    case 2:
      return {-p.x, p.z, p.y};
    case 3:
      return {-p.y, p.z, -p.x};
    default:
      return {p.x, p.z, -p.y};
  }
}

/// Lower end of b / depth on a side; the upper end is 1.
double lowest_b(int side) { return side == 0 ? -1 : 0; }

/// Whether a ball lies wholly outside the pyramid of a side.
bool is_outside(int side, const Vec3& center, double radius) {
  const Vec3 p = in_side_frame(side, center);
  const double reach = std::numbers::sqrt2 * radius;
  const bool below = side == 0 ? p.z + p.y < -reach : p.y < -radius;
  return below || p.z - p.x < -reach || p.z + p.x < -reach || p.z - p.y < -reach;
}

}  // namespace

Hemicube::Hemicube(int resolution) : resolution_(resolution) {
  const double step = 2.0 / resolution;
  for (int side = 0; side < sides; ++side) {
    at(first_, side) = delta_.size();
    const int rows = side == 0 ? resolution : resolution / 2;
    for (int row = 0; row < rows; ++row) {
      const double b = lowest_b(side) + row * step;
      for (int column = 0; column < resolution; ++column) {
        const double a = -1 + column * step;
        const auto integral = [side](double x, double y) {
          return side == 0 ? to_top(x, y) : to_side(x, y);
        };
        delta_.push_back(integral(a + step, b + step) - integral(a, b + step) -
                         integral(a + step, b) + integral(a, b));
      }
    }
  }
  inverse_depths_.resize(delta_.size());
  patches_.resize(delta_.size());
  left_.resize(static_cast<std::size_t>(resolution));
  right_.resize(static_cast<std::size_t>(resolution));
  clear();
}

void Hemicube::clear() {
  std::fill(inverse_depths_.begin(), inverse_depths_.end(), 0.0F);
  std::fill(patches_.begin(), patches_.end(), no_patch);
}

void Hemicube::draw(const Polygon& polygon) {
  for (int side = 0; side < sides; ++side) {
    if (is_outside(side, polygon.center, polygon.radius)) {
      continue;
    }
    polygon_.clear();
    for (const Vec3& corner : polygon.corners) {
      const Vec3 p = in_side_frame(side, corner);
      polygon_.push_back({p.x, p.y, p.z});
    }
    // On the ray through (a, b, 1), depth = offset / (normal·(a, b, 1)).
    if (clip_to_side(side)) {
      fill(side, (1 / polygon.offset) * in_side_frame(side, polygon.normal), polygon.patch);
    }
  }
}

/// Clips polygon_ to the pyramid of a side. Returns whether anything remains.
bool Hemicube::clip_to_side(int side) {
  const auto clip = [this](auto distance) {
    std::size_t inside = 0;
    for (const Point& p : polygon_) {
      inside += distance(p) >= 0 ? 1 : 0;
    }
    if (inside == polygon_.size()) {
      return true;
    }
    if (inside == 0) {
      return false;
    }
    clipped_.clear();
    for (std::size_t k = 0; k < polygon_.size(); ++k) {
      const Point &p = polygon_[k], &q = polygon_[k + 1 < polygon_.size() ? k + 1 : 0];
      const double here = distance(p), there = distance(q);
      if (here >= 0) {
        clipped_.push_back(p);
      }
      if ((here >= 0) == (there >= 0)) {
        continue;
      }
      const double t = here / (here - there);
      clipped_.push_back(
          {p.a + t * (q.a - p.a), p.b + t * (q.b - p.b), p.depth + t * (q.depth - p.depth)});
    }
    polygon_.swap(clipped_);
    return polygon_.size() >= 3;
  };
  const double low = lowest_b(side);
  return clip([](const Point& p) { return p.depth - p.a; }) &&
         clip([](const Point& p) { return p.depth + p.a; }) &&
         clip([](const Point& p) { return p.depth - p.b; }) &&
         clip([low](const Point& p) { return p.b - low * p.depth; });
}

/// Draws the pixels whose centers polygon_ covers.
/// @param inverse_depth its dot product with (a, b, 1) is 1 / depth at (a, b) of the side
void Hemicube::fill(int side, const Vec3& inverse_depth, PatchId patch) {
  const double scale = 0.5 * resolution_, low = lowest_b(side);
  const int rows = side == 0 ? resolution_ : resolution_ / 2;
  double bottom = infinity, top = -infinity;
  for (Point& p : polygon_) {
    if (!(p.depth > 0)) {
      return;  // the polygon touches the point
    }
    p.a = scale * (p.a / p.depth + 1);
    p.b = scale * (p.b / p.depth - low);
    bottom = std::min(bottom, p.b);
    top = std::max(top, p.b);
  }
  // A row or column is covered if its center is in [low end, high end): neighboring polygons share
  // none and miss none.
  const auto from = [](double at, int count) {
    return static_cast<int>(std::clamp(std::ceil(at - 0.5), 0.0, static_cast<double>(count)));
  };
  const int first = from(bottom, rows), last = from(top, rows);
  for (int row = first; row < last; ++row) {
    at(left_, row) = infinity;
    at(right_, row) = -infinity;
  }
  for (std::size_t k = 0; k < polygon_.size(); ++k) {
    const Point* p = &polygon_[k];
    const Point* q = &polygon_[k + 1 < polygon_.size() ? k + 1 : 0];
    if (p->b > q->b) {
      std::swap(p, q);
    }
    const int end = from(q->b, rows);
    for (int row = from(p->b, rows); row < end; ++row) {
      const double a = p->a + (row + 0.5 - p->b) / (q->b - p->b) * (q->a - p->a);
      double& left = at(left_, row);
      double& right = at(right_, row);
      left = std::min(left, a);
      right = std::max(right, a);
    }
  }
  const double step = 1 / scale;
  for (int row = first; row < last; ++row) {
    const int begin = from(at(left_, row), resolution_);
    const int end = from(at(right_, row), resolution_);
    const double b = low + step * (row + 0.5);
    const double at_row = inverse_depth.y * b + inverse_depth.z;
    const std::size_t pixel =
        at(first_, side) + static_cast<std::size_t>(row) * static_cast<std::size_t>(resolution_);
    for (int column = begin; column < end; ++column) {
      const double a = -1 + step * (column + 0.5);
      const auto inverse = static_cast<float>(at_row + inverse_depth.x * a);
      const std::size_t k = pixel + static_cast<std::size_t>(column);
      if (inverse < (1 - tie) * inverse_depths_[k]) {
        continue;
      }
      inverse_depths_[k] = inverse;
      patches_[k] = patch;
    }
  }
}

}  // namespace transillum
