// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "io/results/light_map.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <vector>

#include "io/png_text.h"
#include "io/srgb.h"
#include "transillum/at.h"
#include "transillum/errors.h"

namespace transillum {

LightMap::LightMap(const Solution& solution, double exposure)
    : solution_(solution), exposure_(exposure) {
  const auto patches = static_cast<std::size_t>(std::max(solution.scene->patch_count(), 1));
  const auto side = static_cast<std::size_t>(std::ceil(std::sqrt(static_cast<double>(patches))));
  columns_ = std::bit_ceil(side);
  rows_ = (patches + columns_ - 1) / columns_;
  if (columns_ > largest_side / square) {
    throw InputError(fmt::format("{} patches do not fit into a light map of {} by {} texels",
                                 patches, largest_side, largest_side));
  }
}

LightMap::Chart LightMap::chart(PatchId patch) const {
  const Scene& scene = *solution_.scene;
  const auto outline = scene.outline(patch);
  Chart chart;
  chart.column = static_cast<std::size_t>(patch) % columns_;
  chart.row = static_cast<std::size_t>(patch) / columns_;
  chart.origin = scene.point(outline.front());
  // Along the longest edge: it has the most precise direction.
  Vec3 longest;
  for (std::size_t k = 0; k < outline.size(); ++k) {
    const Vec3 edge = scene.point(outline[(k + 1) % outline.size()]) - scene.point(outline[k]);
    if (max_abs(edge) > max_abs(longest)) {
      longest = edge;
    }
  }
  chart.s = normalized(longest);
  chart.t = cross(scene.patch(patch).normal, chart.s);
  double end_s = 0, end_t = 0;
  for (const PointId corner : outline) {
    const Vec3 to = scene.point(corner) - chart.origin;
    chart.begin_s = std::min(chart.begin_s, dot(to, chart.s));
    chart.begin_t = std::min(chart.begin_t, dot(to, chart.t));
    end_s = std::max(end_s, dot(to, chart.s));
    end_t = std::max(end_t, dot(to, chart.t));
  }
  chart.length_s = end_s - chart.begin_s;
  chart.length_t = end_t - chart.begin_t;
  return chart;
}

std::array<float, 2> LightMap::coordinates(const Chart& chart, const Vec3& point) const {
  const Vec3 to = point - chart.origin;
  const auto texel = [](std::size_t square_number, double value, double begin, double size) {
    constexpr double inside = square - 2;
    const double fraction = size > 0 ? std::clamp((value - begin) / size, 0.0, 1.0) : 0.5;
    return static_cast<double>(square * square_number) + 1 + inside * fraction;
  };
  // The picture's rows go down, t goes up.
  const double x = texel(chart.column, dot(to, chart.s), chart.begin_s, chart.length_s);
  const double y =
      texel(chart.row, -dot(to, chart.t), -(chart.begin_t + chart.length_t), chart.length_t);
  return {static_cast<float>(x / static_cast<double>(width())),
          static_cast<float>(y / static_cast<double>(height()))};
}

/// With a linear basis, texels at the border have the function's value beyond the box, so that
/// linear filtering gives the function within it, but for rounding and where it is below 0 or
/// above 1.
Rgb LightMap::at_texel(PatchId i, std::size_t x, std::size_t y) const {
  if (solution_.linear_terms.empty()) {
    return at(solution_.radiosity, i);
  }
  constexpr double inside = square - 2;
  const Chart box = chart(i);
  const double s = (static_cast<double>(x) - 0.5) / inside;
  const double t = 1 - (static_cast<double>(y) - 0.5) / inside;
  const Vec3 point = box.origin + (box.begin_s + s * box.length_s) * box.s +
                     (box.begin_t + t * box.length_t) * box.t;
  const auto [first, second] = linear_basis(*solution_.scene, i).at(point);
  const LinearTerm& term = at(solution_.linear_terms, i);
  return at(solution_.radiosity, i) + first * term.first + second * term.second;
}

std::string LightMap::png() const {
  std::vector<unsigned char> pixels(3 * width() * height());
  for (PatchId i = 0; i < solution_.scene->patch_count(); ++i) {
    const std::size_t left = square * (static_cast<std::size_t>(i) % columns_);
    const std::size_t top = square * (static_cast<std::size_t>(i) / columns_);
    for (std::size_t y = 0; y < square; ++y) {
      for (std::size_t x = 0; x < square; ++x) {
        const Rgb color = exposure_ * at_texel(i, x, y);
        const std::array<unsigned char, 3> bytes{static_cast<unsigned char>(srgb_byte(color.r)),
                                                 static_cast<unsigned char>(srgb_byte(color.g)),
                                                 static_cast<unsigned char>(srgb_byte(color.b))};
        std::copy(
            bytes.begin(), bytes.end(),
            pixels.begin() + static_cast<std::ptrdiff_t>(3 * ((top + y) * width() + left + x)));
      }
    }
  }
  return png_of(static_cast<int>(width()), static_cast<int>(height()), pixels);
}

}  // namespace transillum
