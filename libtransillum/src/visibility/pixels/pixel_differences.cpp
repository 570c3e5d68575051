// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Areas where a map in pixels differs from the exact map of the same direction. Each polygon of the
// exact map is clipped to the pixels it overlaps; the parts in pixels that show another patch
// differ. The part of a pixel that no polygon covers differs too, if the pixel shows a patch.
#include <algorithm>
#include <cmath>
#include <iterator>

#include "geometry/plane_region.h"
#include "geometry/polygon_area.h"
#include "transillum/at.h"
#include "visibility/pixels/pixel_map.h"

namespace transillum {
namespace {

using Outline = std::vector<Vec2>;

double area_of(const Outline& outline) {
  return polygon_area(outline.size(), [&](std::size_t k) -> const Vec2& { return outline[k]; });
}

/// Clips a convex outline to low <= `axis` <= high. `spare` is scratch space.
void clip_to(double Vec2::*axis, double low, double high, const Outline& outline, Outline& part,
             Outline& spare) {
  const auto clip = [axis](double at, double sign, const Outline& from, Outline& to) {
    to.clear();
    for (std::size_t k = 0; k < from.size(); ++k) {
      const Vec2 &a = from[k], &b = from[(k + 1) % from.size()];
      const double in_a = sign * (a.*axis - at), in_b = sign * (b.*axis - at);
      if (in_a >= 0) {
        to.push_back(a);
      }
      if ((in_a > 0 && in_b < 0) || (in_a < 0 && in_b > 0)) {
        const double t = in_a / (in_a - in_b);
        Vec2 crossing{a.x + t * (b.x - a.x), a.y + t * (b.y - a.y)};
        crossing.*axis = at;
        to.push_back(crossing);
      }
    }
  };
  clip(low, 1, outline, spare);
  clip(high, -1, spare, part);
}

/// Appends the differences to the drawn map.
class Differences {
 public:
  Differences(const PixelMap& pixels, const VisibilityMap& exact, VisibilityMap& drawn,
              const Cancellation& cancellation)
      : pixels_(pixels),
        exact_(exact),
        drawn_(drawn),
        cancellation_(cancellation),
        covered_(pixels.items.size()),
        first_overlap_(pixels.items.size(), no_polygon) {}

  void mark() {
    for (std::int32_t k = 0; k < std::ssize(exact_.polygons); ++k) {
      add(k);
    }
    mark_uncovered_pixels();
  }

 private:
  static constexpr std::int32_t no_polygon = -1;
  /// A polygon that overlaps a pixel: an entry of the pixel's linked list.
  struct Overlap {
    std::int32_t polygon;
    std::int32_t next;  ///< index in overlaps_ of the pixel's next entry
  };

  double x(int column) const { return pixels_.corner.x + column * pixels_.side; }
  double y(int row) const { return pixels_.corner.y + row * pixels_.side; }
  int column_of(double at) const {
    return static_cast<int>(
        std::clamp(std::floor((at - pixels_.corner.x) / pixels_.side), 0.0, pixels_.columns - 1.0));
  }
  int row_of(double at) const {
    return static_cast<int>(
        std::clamp(std::floor((at - pixels_.corner.y) / pixels_.side), 0.0, pixels_.rows - 1.0));
  }

  void add(std::int32_t k) {
    const VisibilityMap::Polygon& polygon = at(exact_.polygons, k);
    const auto outline = exact_.outline(polygon);
    const Outline whole(outline.begin(), outline.end());
    const auto [low, high] = std::minmax_element(
        whole.begin(), whole.end(), [](const Vec2& a, const Vec2& b) { return a.y < b.y; });
    const int last = row_of(high->y);
    for (int row = row_of(low->y); row <= last; ++row) {
      cancellation_.throw_if_canceled();
      clip_to(&Vec2::y, y(row), y(row + 1), whole, in_row_, spare_);
      if (in_row_.size() >= 3) {
        add_row(k, polygon, row);
      }
    }
  }

  void add_row(std::int32_t k, const VisibilityMap::Polygon& polygon, int row) {
    const auto [low, high] = std::minmax_element(
        in_row_.begin(), in_row_.end(), [](const Vec2& a, const Vec2& b) { return a.x < b.x; });
    const int last = column_of(high->x);
    for (int column = column_of(low->x); column <= last; ++column) {
      clip_to(&Vec2::x, x(column), x(column + 1), in_row_, in_pixel_, spare_);
      if (in_pixel_.size() < 3) {
        continue;
      }
      const std::size_t at = pixels_.index(column, row);
      const double area = area_of(in_pixel_);
      covered_[at] += area;
      overlaps_.push_back({k, first_overlap_[at]});
      first_overlap_[at] = static_cast<std::int32_t>(overlaps_.size()) - 1;
      if (pixels_.items[at] != polygon.patch) {
        mark(polygon.patch, polygon.front_facing, area, in_pixel_);
      }
    }
  }

  void mark(PatchId patch, bool front_facing, double area, const Outline& outline) {
    if (!(area > 0)) {
      return;
    }
    const auto begin = static_cast<std::uint32_t>(drawn_.corners.size());
    drawn_.corners.insert(drawn_.corners.end(), outline.begin(), outline.end());
    drawn_.pixels.differences.push_back(
        {patch, front_facing, area, begin, static_cast<std::uint32_t>(drawn_.corners.size())});
  }

  void mark_uncovered_pixels() {
    const double whole = pixels_.side * pixels_.side;
    for (int row = 0; row < pixels_.rows; ++row) {
      cancellation_.throw_if_canceled();
      for (int column = 0; column < pixels_.columns; ++column) {
        const std::size_t at = pixels_.index(column, row);
        if (pixels_.items[at] != no_patch && covered_[at] < (1 - 1e-9) * whole) {
          mark_uncovered_part(column, row, first_overlap_[at]);
        }
      }
    }
  }

  /// Marks the part of a pixel that the exact map leaves uncovered.
  void mark_uncovered_part(int column, int row, std::int32_t overlap) {
    // Coordinates relative to the pixel's corner are small and so more precise.
    const double side = pixels_.side, x0 = x(column), y0 = y(row);
    const PlaneRegion::Point square[] = {{0, 0}, {side, 0}, {side, side}, {0, side}};
    rest_.assign(square);
    for (; overlap != no_polygon; overlap = at(overlaps_, overlap).next) {
      const auto outline = exact_.outline(at(exact_.polygons, at(overlaps_, overlap).polygon));
      PlaneRegion::Box box;
      sides_.clear();
      for (std::size_t n = 0; n < outline.size(); ++n) {
        const Vec2 a{outline[n].x - x0, outline[n].y - y0};
        const Vec2& to = outline[(n + 1) % outline.size()];
        const Vec2 along{to.x - x0 - a.x, to.y - y0 - a.y};
        box.add({a.x, a.y});
        const double length = std::hypot(along.x, along.y);
        if (length < 1e-9 * side) {
          continue;  // nearly a point; the direction of its line would be noise
        }
        const double u = -along.y / length, v = along.x / length;
        sides_.push_back({u, v, -(u * a.x + v * a.y)});
      }
      if (!sides_.empty()) {
        rest_.subtract(sides_, box);
      }
    }
    rest_.for_each([&](std::span<const PlaneRegion::Point> part) {
      in_pixel_.clear();
      for (const PlaneRegion::Point& p : part) {
        in_pixel_.push_back({x0 + p.u, y0 + p.v});
      }
      const double area = area_of(in_pixel_);
      if (area > 1e-9 * side * side) {
        mark(no_patch, false, area, in_pixel_);
      }
    });
  }

  const PixelMap& pixels_;
  const VisibilityMap& exact_;
  VisibilityMap& drawn_;
  const Cancellation& cancellation_;
  std::vector<double> covered_;              ///< area per pixel, m²
  std::vector<std::int32_t> first_overlap_;  ///< per pixel: start of its list in overlaps_
  std::vector<Overlap> overlaps_;
  Outline in_row_, in_pixel_, spare_;
  PlaneRegion rest_;
  std::vector<PlaneRegion::Side> sides_;
};

}  // namespace

void mark_differences(const PixelMap& pixels, const VisibilityMap& exact, VisibilityMap& drawn,
                      const Cancellation& cancellation) {
  Differences(pixels, exact, drawn, cancellation).mark();
}

}  // namespace transillum
