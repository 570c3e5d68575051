// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Light maps: charts, rectangles of texels with a border, are put side by side in rows. Where light
// is computed at points, patches of one plane and material that touch form a chart, and a texel
// that no patch covers, but that filtering reads, has the light of the nearest point of a patch.
#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <numeric>
#include <utility>

#include "base/for_each_index.h"
#include "base/worker_threads.h"
#include "pictures/plane_points.h"
#include "transillum/at.h"
#include "transillum/errors.h"
#include "transillum/linear_basis.h"
#include "transillum/picture.h"

namespace transillum {
namespace {

/// A rectangle of the map, and the frame of its plane.
struct Chart {
  Vec3 origin, s, t;  ///< s and t: unit vectors along the rows and against the columns
  double low_s = HUGE_VAL, high_s = -HUGE_VAL, low_t = HUGE_VAL, high_t = -HUGE_VAL;  ///< m
  int columns = 1, rows = 1;  ///< without the border
  int left = 0, top = 0;      ///< corner of the border
  std::vector<PatchId> patches;

  std::array<double, 2> in_plane(const Vec3& x) const {
    return {dot(x - origin, s), dot(x - origin, t)};
  }
  /// From the upper left corner of the border, texels.
  std::array<double, 2> texel_of(const std::array<double, 2>& p) const {
    return {1 + (p[0] - low_s) / std::max(high_s - low_s, 1e-300) * columns,
            1 + (high_t - p[1]) / std::max(high_t - low_t, 1e-300) * rows};
  }
  Vec3 point_of(double column, double row) const {
    return origin + (low_s + (column - 1) / columns * (high_s - low_s)) * s +
           (high_t - (row - 1) / rows * (high_t - low_t)) * t;
  }
};

/// A texel to be computed.
struct Texel {
  PatchId patch = no_patch;
  Vec3 point;  ///< m
};

/// The point of a convex polygon that is nearest to x, a point of its plane.
Vec3 nearest_in(const Corners& polygon, const Vec3& normal, const Vec3& x) {
  bool is_inside = true;
  Vec3 nearest = polygon[0];
  double least = HUGE_VAL;
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const Vec3 &a = polygon[k], edge = polygon[(k + 1) % polygon.size()] - a;
    is_inside = is_inside && dot(cross(normal, edge), x - a) >= 0;
    const double square = dot(edge, edge);
    const double along = square > 0 ? std::clamp(dot(x - a, edge) / square, 0.0, 1.0) : 0;
    const Vec3 candidate = a + along * edge;
    if (const double distance = norm(candidate - x); distance < least) {
      least = distance;
      nearest = candidate;
    }
  }
  return is_inside ? x : nearest;
}

/// By patch, the first patch of its chart: patches of one material that share points of a plane.
std::vector<PatchId> chart_of_patches(const Scene& scene, const PlanePoints& points,
                                      const Cancellation& cancellation) {
  std::vector<PatchId> first(scene.patches().size());
  std::iota(first.begin(), first.end(), 0);
  const auto root = [&](PatchId i) {
    while (at(first, i) != i) {
      i = at(first, i) = at(first, at(first, i));
    }
    return i;
  };
  for (std::int32_t n = 0; n < std::ssize(points.points()); ++n) {
    cancellation.throw_if_canceled();
    for (const PatchId i : points.patches_at(n)) {
      for (const PatchId j : points.patches_at(n)) {
        if (i < j && scene.patch(i).material == scene.patch(j).material) {
          const PatchId a = root(i), b = root(j);
          at(first, std::max(a, b)) = std::min(a, b);
        }
      }
    }
  }
  for (PatchId i = 0; i < scene.patch_count(); ++i) {
    at(first, i) = root(i);
  }
  return first;
}

}  // namespace

struct [[gnu::visibility("hidden")]] LightMap::Impl {
  int width = 1, height = 1;
  std::vector<std::array<float, 3>> radiosity;
  std::vector<Chart> charts;
  std::vector<std::int32_t> chart_of;  ///< by patch

  /// @param first by patch, the first patch of its chart
  /// @param density texels per meter; 0 means two along each side of a chart
  Impl(const Scene& scene, const std::vector<PatchId>& first, double density,
       const Cancellation& cancellation = {}) {
    chart_of.assign(first.size(), 0);
    for (PatchId i = 0; i < scene.patch_count(); ++i) {
      cancellation.throw_if_canceled();
      if (at(first, i) == i) {
        at(chart_of, i) = static_cast<std::int32_t>(charts.size());
        charts.push_back(frame_of(scene, i));
      }
      at(chart_of, i) = at(chart_of, at(first, i));
      Chart& chart = at(charts, at(chart_of, i));
      chart.patches.push_back(i);
      for (const PointId p : scene.outline(i)) {
        const auto [s, t] = chart.in_plane(scene.point(p));
        chart.low_s = std::min(chart.low_s, s);
        chart.high_s = std::max(chart.high_s, s);
        chart.low_t = std::min(chart.low_t, t);
        chart.high_t = std::max(chart.high_t, t);
      }
    }
    const auto texels = [&](double length) {
      return density > 0
                 ? static_cast<int>(std::clamp(std::ceil(density * length - 1e-9), 1.0, 1e6))
                 : 2;
    };
    for (Chart& chart : charts) {
      chart.columns = texels(chart.high_s - chart.low_s);
      chart.rows = texels(chart.high_t - chart.low_t);
    }
    put_side_by_side(scene.name());
  }

  /// The frame of a patch: along its longest edge, which has the most precise direction.
  static Chart frame_of(const Scene& scene, PatchId i) {
    const auto outline = scene.outline(i);
    Vec3 longest;
    for (std::size_t k = 0; k < outline.size(); ++k) {
      const Vec3 edge = scene.point(outline[(k + 1) % outline.size()]) - scene.point(outline[k]);
      longest = max_abs(edge) > max_abs(longest) ? edge : longest;
    }
    Chart chart;
    chart.origin = scene.point(outline[0]);
    chart.s = normalized(longest);
    chart.t = cross(scene.patch(i).normal, chart.s);
    return chart;
  }

  /// Rows of charts, the highest first.
  void put_side_by_side(const std::string& name) {
    std::vector<Chart*> by_height;
    double area = 0;
    int widest = 1;
    for (Chart& chart : charts) {
      by_height.push_back(&chart);
      area += (chart.columns + 2.0) * (chart.rows + 2.0);
      widest = std::max(widest, chart.columns + 2);
    }
    std::stable_sort(by_height.begin(), by_height.end(),
                     [](const Chart* a, const Chart* b) { return a->rows > b->rows; });
    const double side = std::max(static_cast<double>(widest), std::sqrt(area));
    const auto refuse = [&](double needed) {
      throw InputError(fmt::format(
          "{}: a light map of {:.0f} texels along a side would be larger than {}; it needs fewer "
          "patches or texels per meter",
          name, needed, largest_side));
    };
    if (side > largest_side) {
      refuse(side);
    }
    width = static_cast<int>(std::bit_ceil(static_cast<unsigned>(std::ceil(side))));
    int left = 0, top = 0, row_height = 0;
    for (Chart* const chart : by_height) {
      if (left + chart->columns + 2 > width) {
        left = 0;
        top += row_height;
        row_height = 0;
      }
      chart->left = left;
      chart->top = top;
      left += chart->columns + 2;
      row_height = std::max(row_height, chart->rows + 2);
      if (top + row_height > largest_side) {
        refuse(top + row_height);
      }
    }
    height = top + row_height;
    radiosity.resize(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  }

  /// @param n number of the texel in the chart with its border, row by row
  void set(const Chart& chart, std::size_t n, const Rgb& b) {
    const std::size_t columns = static_cast<std::size_t>(chart.columns) + 2;
    const std::size_t row = static_cast<std::size_t>(chart.top) + n / columns,
                      column = static_cast<std::size_t>(chart.left) + n % columns;
    radiosity[row * static_cast<std::size_t>(width) + column] = {
        static_cast<float>(b.r), static_cast<float>(b.g), static_cast<float>(b.b)};
  }
};

namespace {

/// The texels of a chart, row by row with its border: of those that no patch covers, only those
/// beside a covered one have a patch.
std::vector<Texel> texels_of(const Scene& scene, const PlanePoints& points, const Chart& chart,
                             const Cancellation& cancellation) {
  const int columns = chart.columns + 2, rows = chart.rows + 2;
  const auto index = [&](int column, int row) {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) +
           static_cast<std::size_t>(column);
  };
  std::vector<Texel> texels(index(0, rows));
  struct PolygonOfPatch {
    PatchId patch;
    Corners polygon;
    std::array<int, 4> box;  ///< columns and rows that it meets, with a border
    Vec3 middle;
  };
  std::vector<PolygonOfPatch> parts;
  for (const PatchId i : chart.patches) {
    for (std::size_t k = points.first_piece(i); k < points.end_piece(i); ++k) {
      PolygonOfPatch part{i, points.outline(k), {columns, 0, rows, 0}, {}};
      for (const Vec3& corner : part.polygon) {
        const auto [x, y] = chart.texel_of(chart.in_plane(corner));
        part.box = {std::min(part.box[0], static_cast<int>(std::floor(x)) - 1),
                    std::max(part.box[1], static_cast<int>(std::floor(x)) + 1),
                    std::min(part.box[2], static_cast<int>(std::floor(y)) - 1),
                    std::max(part.box[3], static_cast<int>(std::floor(y)) + 1)};
      }
      part.middle = middle_of(part.polygon);
      parts.push_back(std::move(part));
    }
  }
  // Beyond the edge of a patch, up to the texel that filtering reads there.
  std::vector<double> distances(texels.size(), HUGE_VAL);
  for (const PolygonOfPatch& part : parts) {
    cancellation.throw_if_canceled();
    for (int row = std::max(part.box[2], 0); row <= std::min(part.box[3], rows - 1); ++row) {
      for (int column = std::max(part.box[0], 0); column <= std::min(part.box[1], columns - 1);
           ++column) {
        const Vec3 middle = chart.point_of(column + 0.5, row + 0.5);
        const Vec3 nearest = nearest_in(part.polygon, scene.patch(part.patch).normal, middle);
        const double distance = norm(nearest - middle);
        if (distance < distances[index(column, row)]) {
          distances[index(column, row)] = distance;
          // At an edge itself, an adjacent wall is seen edge-on.
          texels[index(column, row)] = {part.patch, points.inward(nearest, part.middle)};
        }
      }
    }
  }
  return texels;
}

}  // namespace

LightMap::LightMap(const Solution& solution) {
  const Scene& scene = *solution.scene;
  std::vector<PatchId> each(scene.patches().size());
  std::iota(each.begin(), each.end(), 0);
  auto impl = std::make_unique<Impl>(scene, each, 0);
  for (const Chart& chart : impl->charts) {
    const PatchId i = chart.patches.front();
    const auto columns = static_cast<std::size_t>(chart.columns) + 2;
    const auto rows = static_cast<std::size_t>(chart.rows) + 2;
    for (std::size_t n = 0; n < columns * rows; ++n) {
      Rgb b = at(solution.radiosity, i);
      if (!solution.linear_terms.empty()) {
        const std::size_t column = n % columns, row = n / columns;
        const Vec3 middle =
            chart.point_of(static_cast<double>(column) + 0.5, static_cast<double>(row) + 0.5);
        const auto [first, second] = linear_basis(scene, i).at(middle);
        const LinearTerm& term = at(solution.linear_terms, i);
        b += first * term.first + second * term.second;
      }
      impl->set(chart, n, b);
    }
  }
  impl_ = std::move(impl);
}

LightMap::LightMap(const Scene& scene, const SurfaceLight& light, const Options& options,
                   const Cancellation& cancellation, const std::function<void(double)>& progress) {
  if (!(options.density >= 0 && std::isfinite(options.density))) {
    throw InputError(
        fmt::format("{}: {} texels per meter; it must be above 0", scene.name(), options.density));
  }
  if (!(options.tolerance > 0)) {
    throw InputError(
        fmt::format("{}: a tolerance of {}; it must be above 0", scene.name(), options.tolerance));
  }
  constexpr double along_diagonal = 1024;
  const PlanePoints points(scene, cancellation);
  const double texel =
      options.density > 0 ? 1 / options.density : scene.bounds().diagonal() / along_diagonal;
  auto impl = std::make_unique<Impl>(scene, chart_of_patches(scene, points, cancellation),
                                     1 / texel, cancellation);
  WorkerThreads workers(thread_count(options.threads));
  constexpr std::size_t batch = 4096;
  // The diagonal of a texel.
  const Interpolation precision{std::numbers::sqrt2 * texel, options.tolerance};
  double done = 0;
  for (const Chart& chart : impl->charts) {
    const std::vector<Texel> texels = texels_of(scene, points, chart, cancellation);
    for (std::size_t first = 0; first < texels.size(); first += batch) {
      const std::size_t end = std::min(first + batch, texels.size());
      for_each_index(workers, first, end, [&](std::size_t n) {
        cancellation.throw_if_canceled();
        if (texels[n].patch != no_patch) {
          impl->set(chart, n,
                    light.radiosity(texels[n].patch, texels[n].point, cancellation, precision));
        }
      });
      done += static_cast<double>(end - first);
      if (progress) {
        progress(std::min(done / static_cast<double>(impl->radiosity.size()), 1.0));
      }
    }
  }
  if (progress) {
    progress(1);
  }
  impl_ = std::move(impl);
}

LightMap::~LightMap() = default;

int LightMap::width() const { return impl_->width; }
int LightMap::height() const { return impl_->height; }
const std::vector<std::array<float, 3>>& LightMap::radiosity() const { return impl_->radiosity; }

std::array<double, 2> LightMap::place(PatchId patch, const Vec3& point) const {
  const Chart& chart = at(impl_->charts, at(impl_->chart_of, patch));
  const auto [x, y] = chart.texel_of(chart.in_plane(point));
  return {chart.left + x, chart.top + y};
}

}  // namespace transillum
