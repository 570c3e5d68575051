// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Patches are divided into quadrilaterals: a convex piece of four corners is one, any other as many
// as it has corners, about its middle. Lit points are computed when they are first needed, and
// kept: at points of the scene for all patches of a plane, at others for their patch. A point is
// moved inward by a little, so that it is not in the plane of an adjacent wall.
#include "pictures/interpolated_light.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <mutex>
#include <unordered_map>

#include "base/bit_mixing.h"
#include "transillum/at.h"

namespace transillum {
namespace {

using Place = std::array<std::int64_t, 3>;  ///< a position in steps

struct PlaceHash {
  std::size_t operator()(const Place& p) const {
    const auto part = [](std::int64_t n) { return static_cast<std::uint64_t>(n); };
    return mixed(part(p[0]) + mixed(part(p[1]) + mixed(part(p[2]))));
  }
};

Vec3 blend(const std::array<Vec3, 4>& corners, double s, double t) {
  return (1 - t) * ((1 - s) * corners[0] + s * corners[1]) +
         t * ((1 - s) * corners[3] + s * corners[2]);
}

Rgb blend(const std::array<Rgb, 4>& corners, double s, double t) {
  return (1 - t) * ((1 - s) * corners[0] + s * corners[1]) +
         t * ((1 - s) * corners[3] + s * corners[2]);
}

struct Point2 {
  double x, y;
};
double cross_of(const Point2& a, const Point2& b) { return a.x * b.y - a.y * b.x; }

/// Coordinates (s, t) of a point of a convex quadrilateral, in which blend() gives it; in [0,1].
std::array<double, 2> coordinates_in(const std::array<Vec3, 4>& corners, const Vec3& normal,
                                     const Vec3& p) {
  const Vec3 size{std::abs(normal.x), std::abs(normal.y), std::abs(normal.z)};
  const auto flat = [&](const Vec3& a) {
    return size.z >= size.x && size.z >= size.y ? Point2{a.x, a.y}
           : size.y >= size.x                   ? Point2{a.x, a.z}
                                                : Point2{a.y, a.z};
  };
  const Point2 e = flat(corners[1] - corners[0]), f = flat(corners[3] - corners[0]),
               g = flat(corners[0] - corners[1] + corners[2] - corners[3]),
               h = flat(p - corners[0]);
  const double a = cross_of(g, f), b = cross_of(e, f) + cross_of(h, g), c = cross_of(h, e);
  double t = 0;
  if (std::abs(a) <= 1e-12 * std::abs(b)) {
    t = b != 0 ? -c / b : 0;
  } else {
    const double root = std::sqrt(std::max(0.0, b * b - 4 * a * c));
    const double q = -0.5 * (b + (b < 0 ? -root : root));
    const double first = q / a, second = q != 0 ? c / q : first;
    const auto outside = [](double x) { return std::max(-x, x - 1); };
    t = outside(first) < outside(second) ? first : second;
  }
  t = std::clamp(t, 0.0, 1.0);
  const Point2 along{e.x + t * g.x, e.y + t * g.y}, left{h.x - t * f.x, h.y - t * f.y};
  const double square = along.x * along.x + along.y * along.y;
  const double s = square > 0 ? (along.x * left.x + along.y * left.y) / square : 0;
  return {std::clamp(s, 0.0, 1.0), t};
}

/// How far inside a quadrilateral a point is: the smallest distance from an edge, < 0 outside, m.
double depth_in(const std::array<Vec3, 4>& corners, const Vec3& normal, const Vec3& p) {
  double depth = HUGE_VAL;
  for (std::size_t k = 0; k < 4; ++k) {
    const Vec3 edge = corners[(k + 1) % 4] - corners[k];
    const Vec3 inward = cross(normal, edge);
    if (const double length = norm(inward); length > 0) {
      depth = std::min(depth, dot(inward, p - corners[k]) / length);
    }
  }
  return depth;
}

/// The largest difference between two corners.
double contrast_of(const std::array<Rgb, 4>& corners) {
  return std::max({max_abs(corners[0] - corners[1]), max_abs(corners[1] - corners[2]),
                   max_abs(corners[2] - corners[3]), max_abs(corners[3] - corners[0]),
                   max_abs(corners[0] - corners[2]), max_abs(corners[1] - corners[3])});
}

double size_of(const std::array<Vec3, 4>& corners) {
  return std::max(norm(corners[2] - corners[0]), norm(corners[3] - corners[1]));
}

}  // namespace

/// A part of a quadrilateral, a square of its coordinates.
struct InterpolatedLight::Cell {
  std::array<Rgb, 4> light{};  ///< at its corners
  bool is_part = false;        ///< whether it is of a divided cell
  /// The difference of the middle from the mean of the corners if the light is smooth, as a
  /// fraction of all light: a quarter of the difference in the cell that was divided.
  double expected_difference = HUGE_VAL;
  Kept<Division> division;
};

/// A cell is interpolated, or divided, or its points gather.
struct InterpolatedLight::Division {
  std::unique_ptr<Cell[]> parts = nullptr;  ///< four
  bool is_unclear = false;
};

struct InterpolatedLight::PatchCells {
  PatchId patch;
  std::vector<Quad> quads;
  std::vector<Kept<Cell>> roots;  ///< by quad
  mutable std::mutex mutex;
  mutable std::unordered_map<Place, GatheredLight::Gathered, PlaceHash> light;
};

InterpolatedLight::InterpolatedLight(const Scene& scene, const PlanePoints& points,
                                     const GatheredLight& gathered, const LampLight& lamps)
    : scene_(scene),
      points_(points),
      gathered_(gathered),
      lamps_(lamps),
      diagonal_(scene.bounds().diagonal()),
      light_(points.points().size()),
      cells_(scene.patches().size()) {}

InterpolatedLight::~InterpolatedLight() = default;

std::unique_ptr<const InterpolatedLight::PatchCells> InterpolatedLight::cells_of(
    PatchId patch) const {
  auto cells = std::make_unique<PatchCells>();
  cells->patch = patch;
  for (std::size_t k = points_.first_piece(patch); k < points_.end_piece(patch); ++k) {
    const Corners corners = points_.outline(k);
    const std::size_t count = corners.size();
    const auto node = [&](std::size_t c) { return points_.of_corner(k, c); };
    if (count == 4) {
      cells->quads.push_back(
          {{corners[0], corners[1], corners[2], corners[3]}, {node(0), node(1), node(2), node(3)}});
      continue;
    }
    const Vec3 middle = middle_of(corners);
    for (std::size_t c = 0; c < count; ++c) {
      cells->quads.push_back({{corners[c], 0.5 * (corners[c] + corners[(c + 1) % count]), middle,
                               0.5 * (corners[c] + corners[(c + count - 1) % count])},
                              {node(c), -1, -1, -1}});
    }
  }
  cells->roots = std::vector<Kept<Cell>>(cells->quads.size());
  return cells;
}

Rgb InterpolatedLight::light_of(std::int32_t n, const Cancellation& cancellation) const {
  return at(light_, n).get([&] {
    const PlanePoint& point = at(points_.points(), n);
    return std::make_unique<const Rgb>(
        gathered_.at_point(point.place, point.normal, 0, cancellation).irradiance);
  });
}

/// The light at a point of a patch that is no point of the scene.
GatheredLight::Gathered InterpolatedLight::light_inside(const PatchCells& cells, const Vec3& x,
                                                        const Cancellation& cancellation) const {
  // A point that two cells compute differs by rounding: the place that it is rounded to is lit.
  const double step = 0x1p-36 * diagonal_;
  const Vec3 from_low = x - scene_.bounds().low;
  const Place place{std::llround(from_low.x / step), std::llround(from_low.y / step),
                    std::llround(from_low.z / step)};
  {
    const std::lock_guard lock(cells.mutex);
    if (const auto found = cells.light.find(place); found != cells.light.end()) {
      return found->second;
    }
  }
  const Vec3 rounded = scene_.bounds().low + step * Vec3{static_cast<double>(place[0]),
                                                         static_cast<double>(place[1]),
                                                         static_cast<double>(place[2])};
  const Patch& patch = scene_.patch(cells.patch);
  const GatheredLight::Gathered light =
      gathered_.at_point(points_.inward(rounded, patch.center), patch.normal, 0, cancellation);
  const std::lock_guard lock(cells.mutex);
  return cells.light.emplace(place, light).first->second;
}

std::unique_ptr<const InterpolatedLight::Cell> InterpolatedLight::root_of(
    const PatchCells& cells, std::size_t q, const Cancellation& cancellation) const {
  auto root = std::make_unique<Cell>();
  const Quad& quad = cells.quads[q];
  for (std::size_t c = 0; c < 4; ++c) {
    root->light[c] = quad.node[c] >= 0
                         ? light_of(quad.node[c], cancellation)
                         : light_inside(cells, quad.corners[c], cancellation).irradiance;
  }
  return root;
}

/// The largest difference of what two points between the middle and the corners gather from what
/// is interpolated there, W/m².
double InterpolatedLight::difference_at_quarters(const PatchCells& cells,
                                                 const std::array<Vec3, 4>& corners,
                                                 const Cell& cell,
                                                 const Cancellation& cancellation) const {
  double largest = 0;
  // A line through the middle meets at most one of two that are not opposite.
  for (const double s : {0.25, 0.75}) {
    const Rgb light = light_inside(cells, blend(corners, s, 0.25), cancellation).irradiance;
    largest = std::max(largest, max_abs(light - blend(cell.light, s, 0.25)));
  }
  return largest;
}

/// Decides whether a cell is divided, and divides it.
std::unique_ptr<const InterpolatedLight::Division> InterpolatedLight::division_of(
    const PatchCells& cells, const std::array<Vec3, 4>& corners, const Cell& cell,
    const Cancellation& cancellation) const {
  constexpr double largest = 1.0 / 12, smallest = 1.0 / 1500, tiny = 1.0 / 300;
  constexpr double least_tolerance = 0.004, least_contrast = 0.06;
  const double size = size_of(corners) / diagonal_;
  auto division = std::make_unique<Division>();
  if (size <= tiny && !cell.is_part) {
    return division;
  }
  const Vec3 center = blend(corners, 0.5, 0.5);
  const auto [middle, noise] = light_inside(cells, center, cancellation);
  const Rgb all = middle + lamps_.at_point(cells.patch, center, cancellation);
  const double unit = std::max(max_abs(all), std::numeric_limits<double>::min());
  double difference = max_abs(middle - blend(cell.light, 0.5, 0.5)) / unit;
  const double tolerance = std::max(least_tolerance, 2 * max_abs(noise) / unit);
  // The edge of a shadow through the middle has the mean of the corners there.
  if (size <= largest && size > smallest && difference <= tolerance &&
      cell.expected_difference > tolerance && contrast_of(cell.light) > least_contrast * unit) {
    difference = difference_at_quarters(cells, corners, cell, cancellation) / unit;
  }
  if (size <= largest && (difference <= tolerance || size <= smallest)) {
    division->is_unclear = difference > 4 * tolerance;
    return division;
  }
  const auto edge = [&](double s, double t) {
    return light_inside(cells, blend(corners, s, t), cancellation).irradiance;
  };
  const Rgb bottom = edge(0.5, 0), right = edge(1, 0.5), top = edge(0.5, 1), left = edge(0, 0.5);
  division->parts = std::make_unique<Cell[]>(4);
  division->parts[0].light = {cell.light[0], bottom, middle, left};
  division->parts[1].light = {bottom, cell.light[1], right, middle};
  division->parts[2].light = {middle, right, cell.light[2], top};
  division->parts[3].light = {left, middle, top, cell.light[3]};
  for (std::size_t k = 0; k < 4; ++k) {
    division->parts[k].is_part = true;
    division->parts[k].expected_difference = difference / 4;
  }
  return division;
}

Rgb InterpolatedLight::at_point(PatchId patch, const Vec3& x,
                                const Cancellation& cancellation) const {
  const PatchCells& cells = at(cells_, patch).get([&] { return cells_of(patch); });
  const Vec3& normal = scene_.patch(patch).normal;
  std::size_t q = 0;
  if (cells.quads.size() > 1) {
    double deepest = -HUGE_VAL;
    for (std::size_t k = 0; k < cells.quads.size(); ++k) {
      if (const double depth = depth_in(cells.quads[k].corners, normal, x); depth > deepest) {
        deepest = depth;
        q = k;
      }
    }
  }
  std::array<Vec3, 4> corners = cells.quads[q].corners;
  auto [s, t] = coordinates_in(corners, normal, x);
  const Cell* cell = &cells.roots[q].get([&] { return root_of(cells, q, cancellation); });
  while (true) {
    const Division& division =
        cell->division.get([&] { return division_of(cells, corners, *cell, cancellation); });
    if (!division.parts) {
      return division.is_unclear ? gathered_.at_point(x, normal, 0, cancellation).irradiance
                                 : blend(cell->light, s, t);
    }
    const bool is_right = s >= 0.5, is_upper = t >= 0.5;
    cell = &division.parts[is_upper ? (is_right ? 2 : 3) : (is_right ? 1 : 0)];
    const double low_s = is_right ? 0.5 : 0, low_t = is_upper ? 0.5 : 0;
    corners = {blend(corners, low_s, low_t), blend(corners, low_s + 0.5, low_t),
               blend(corners, low_s + 0.5, low_t + 0.5), blend(corners, low_s, low_t + 0.5)};
    s = 2 * (s - low_s);
    t = 2 * (t - low_t);
  }
}

}  // namespace transillum
