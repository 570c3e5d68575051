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

/// Sizes over the diagonal of the scene: larger cells are always divided, smaller ones never, and a
/// tiny patch is one cell.
constexpr double largest = 1.0 / 12, smallest = 1.0 / 1500, tiny = 1.0 / 300;
/// Tolerances from which on points of a smallest cell gather.
constexpr double unclear = 4;

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

/// The light of a cell's middle, compared with the mean of its corners.
struct InterpolatedLight::Check {
  GatheredLight::Gathered middle;
  double unit = 0;        ///< all light there, W/m²
  double difference = 0;  ///< from the mean or what is interpolated, over all light
  double tolerance = 0;   ///< the largest accepted difference at the default tolerance

  double excess() const { return difference / tolerance; }
};

/// A part of a quadrilateral, a square of its coordinates.
struct InterpolatedLight::Cell {
  std::array<Rgb, 4> light{};     ///< at its corners
  std::array<double, 4> noise{};  ///< there, W/m²
  bool is_part = false;           ///< whether it is of a divided cell
  /// The difference of the middle from the mean of the corners if the light is smooth, as a
  /// fraction of all light: a quarter of the difference in the cell that was divided.
  double expected_difference = HUGE_VAL;
  /// The largest difference of a middle in the divided cell, of its edges, too, over the tolerance.
  double roughness = HUGE_VAL;
  Kept<Check> check;
  Kept<std::array<Cell, 4>> parts;

  void set(std::size_t corner, const GatheredLight::Gathered& gathered) {
    light[corner] = gathered.irradiance;
    noise[corner] = gathered.noise;
  }
  /// RMS over the corners and the middle, W/m²: one value may be small by chance.
  double noise_with(double middle) const {
    double square = std::pow(middle, 2);
    for (const double at_corner : noise) {
      square += at_corner * at_corner;
    }
    return std::sqrt(square / 5);
  }
};

struct InterpolatedLight::Quad {
  std::array<Vec3, 4> corners;
  std::array<std::int32_t, 4> node;  ///< index of a PlanePoint; -1: no point of the scene
  Kept<Cell> root{};
};

struct InterpolatedLight::PatchCells {
  /// Light at points of the patch that are no points of the scene.
  struct Inside {
    mutable std::mutex mutex;
    mutable std::unordered_map<Place, GatheredLight::Gathered, PlaceHash> light;
  };
  PatchId patch;
  std::vector<Quad> quads;
  Kept<Inside> inside;
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
  const auto quads_of = [&](std::size_t count) { return count == 4 ? 1 : count; };
  std::size_t all = 0;
  for (std::size_t k = points_.first_piece(patch); k < points_.end_piece(patch); ++k) {
    all += quads_of(points_.outline(k).size());
  }
  cells->quads = std::vector<Quad>(all);
  Quad* next = cells->quads.data();
  for (std::size_t k = points_.first_piece(patch); k < points_.end_piece(patch); ++k) {
    const Corners corners = points_.outline(k);
    const std::size_t count = corners.size();
    const auto node = [&](std::size_t c) { return points_.of_corner(k, c); };
    if (count == 4) {
      next->corners = {corners[0], corners[1], corners[2], corners[3]};
      next++->node = {node(0), node(1), node(2), node(3)};
      continue;
    }
    const Vec3 middle = middle_of(corners);
    for (std::size_t c = 0; c < count; ++c) {
      next->corners = {corners[c], 0.5 * (corners[c] + corners[(c + 1) % count]), middle,
                       0.5 * (corners[c] + corners[(c + count - 1) % count])};
      next++->node = {node(c), -1, -1, -1};
    }
  }
  return cells;
}

const GatheredLight::Gathered& InterpolatedLight::light_of(std::int32_t n,
                                                           const Cancellation& cancellation) const {
  return at(light_, n).get([&] {
    const PlanePoint& point = at(points_.points(), n);
    return std::make_unique<const GatheredLight::Gathered>(
        gathered_.at_point(point.place, point.normal, 0, cancellation));
  });
}

/// The light at a point of a patch that is no point of the scene.
GatheredLight::Gathered InterpolatedLight::light_inside(const PatchCells& cells, const Vec3& x,
                                                        const Cancellation& cancellation) const {
  const PatchCells::Inside& inside =
      cells.inside.get([] { return std::make_unique<const PatchCells::Inside>(); });
  // A point that two cells compute differs by rounding: the place that it is rounded to is lit.
  const double step = 0x1p-36 * diagonal_;
  const Vec3 from_low = x - scene_.bounds().low;
  const Place place{std::llround(from_low.x / step), std::llround(from_low.y / step),
                    std::llround(from_low.z / step)};
  {
    const std::lock_guard lock(inside.mutex);
    if (const auto found = inside.light.find(place); found != inside.light.end()) {
      return found->second;
    }
  }
  const Vec3 rounded = scene_.bounds().low + step * Vec3{static_cast<double>(place[0]),
                                                         static_cast<double>(place[1]),
                                                         static_cast<double>(place[2])};
  const Patch& patch = scene_.patch(cells.patch);
  const GatheredLight::Gathered light =
      gathered_.at_point(points_.inward(rounded, patch.center), patch.normal, 0, cancellation);
  const std::lock_guard lock(inside.mutex);
  return inside.light.emplace(place, light).first->second;
}

std::unique_ptr<const InterpolatedLight::Cell> InterpolatedLight::root_of(
    const PatchCells& cells, const Quad& quad, const Cancellation& cancellation) const {
  auto root = std::make_unique<Cell>();
  for (std::size_t c = 0; c < 4; ++c) {
    root->set(c, quad.node[c] >= 0 ? light_of(quad.node[c], cancellation)
                                   : light_inside(cells, quad.corners[c], cancellation));
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

std::unique_ptr<const InterpolatedLight::Check> InterpolatedLight::check_of(
    const PatchCells& cells, const std::array<Vec3, 4>& corners, const Cell& cell,
    const Cancellation& cancellation) const {
  constexpr double least_contrast = 0.06;
  const double size = size_of(corners) / diagonal_;
  const Vec3 center = blend(corners, 0.5, 0.5);
  auto check = std::make_unique<Check>();
  check->middle = light_inside(cells, center, cancellation);
  const Rgb& middle = check->middle.irradiance;
  const Rgb all = middle + lamps_.at_point(cells.patch, center, cancellation);
  const double unit = std::max(max_abs(all), std::numeric_limits<double>::min());
  check->unit = unit;
  check->difference = max_abs(middle - blend(cell.light, 0.5, 0.5)) / unit;
  check->tolerance =
      std::max(Interpolation().tolerance, 2 * cell.noise_with(check->middle.noise) / unit);
  // The edge of a shadow through the middle has the mean of the corners there.
  if (size <= largest && size > smallest && check->excess() <= 1 &&
      cell.expected_difference > check->tolerance &&
      contrast_of(cell.light) > least_contrast * unit) {
    check->difference = difference_at_quarters(cells, corners, cell, cancellation) / unit;
  }
  return check;
}

std::unique_ptr<const std::array<InterpolatedLight::Cell, 4>> InterpolatedLight::parts_of(
    const PatchCells& cells, const std::array<Vec3, 4>& corners, const Cell& cell,
    const Check& check, const Cancellation& cancellation) const {
  auto parts = std::make_unique<std::array<Cell, 4>>();
  double largest_difference = check.difference;
  for (std::size_t k = 0; k < 4; ++k) {
    const std::size_t next = (k + 1) % 4;
    const GatheredLight::Gathered light =
        light_inside(cells, 0.5 * (corners[k] + corners[next]), cancellation);
    const Rgb mean = 0.5 * (cell.light[k] + cell.light[next]);
    largest_difference =
        std::max(largest_difference, max_abs(light.irradiance - mean) / check.unit);
    (*parts)[k].set(next, light);
    (*parts)[next].set(k, light);
  }
  for (std::size_t k = 0; k < 4; ++k) {
    Cell& part = (*parts)[k];
    part.light[k] = cell.light[k];
    part.noise[k] = cell.noise[k];
    part.set((k + 2) % 4, check.middle);
    part.is_part = true;
    part.expected_difference = check.difference / 4;
    part.roughness = largest_difference / check.tolerance;
  }
  return parts;
}

Rgb InterpolatedLight::at_point(PatchId patch, const Vec3& x, const Interpolation& precision,
                                const Cancellation& cancellation) const {
  const PatchCells& cells = at(cells_, patch).get([&] { return cells_of(patch); });
  const Vec3& normal = scene_.patch(patch).normal;
  const Quad* quad = cells.quads.data();
  if (cells.quads.size() > 1) {
    double deepest = -HUGE_VAL;
    for (const Quad& each : cells.quads) {
      if (const double depth = depth_in(each.corners, normal, x); depth > deepest) {
        deepest = depth;
        quad = &each;
      }
    }
  }
  std::array<Vec3, 4> corners = quad->corners;
  auto [s, t] = coordinates_in(corners, normal, x);
  const Cell* cell = &quad->root.get([&] { return root_of(cells, *quad, cancellation); });
  const double looseness = precision.tolerance / Interpolation().tolerance;
  // If no middle of a cell differs by more than the tolerance, its parts need no check.
  while (size_of(corners) > precision.detail) {
    const double size = size_of(corners) / diagonal_;
    if ((size <= tiny && !cell->is_part) || (size <= largest && cell->roughness <= looseness)) {
      break;
    }
    const Check& check =
        cell->check.get([&] { return check_of(cells, corners, *cell, cancellation); });
    const double excess = check.excess() / looseness;
    if (size <= largest && (excess <= 1 || size <= smallest)) {
      if (excess > unclear) {
        return gathered_.at_point(x, normal, 0, cancellation).irradiance;
      }
      break;
    }
    const auto& parts =
        cell->parts.get([&] { return parts_of(cells, corners, *cell, check, cancellation); });
    const bool is_right = s >= 0.5, is_upper = t >= 0.5;
    cell = &parts[is_upper ? (is_right ? 2 : 3) : (is_right ? 1 : 0)];
    const double low_s = is_right ? 0.5 : 0, low_t = is_upper ? 0.5 : 0;
    corners = {blend(corners, low_s, low_t), blend(corners, low_s + 0.5, low_t),
               blend(corners, low_s + 0.5, low_t + 0.5), blend(corners, low_s, low_t + 0.5)};
    s = 2 * (s - low_s);
    t = 2 * (t - low_t);
  }
  return blend(cell->light, s, t);
}

}  // namespace transillum
