// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Lobes on a set of directions (decisions/0074-lobes-scaled-on-the-set.md): scaling, so that each
// reflects its share exactly and stays reciprocal, and reflection.
//
// Notation: p, q passes, whose direction above the surface is meant; w = 4 pi / (2M), the solid
// angle of a direction; c cosines with the normal; g a glossy patch.
#include "radiosity/glossy/lobe_tables.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>

#include "base/for_each_index.h"
#include "transillum/at.h"
#include "transillum/glossy.h"

namespace transillum {
namespace {

/// Rows of a table that a task computes.
constexpr std::size_t rows_per_task = 32;

/// Equal for patches whose normals differ by rounding, mostly.
std::array<std::int64_t, 4> key_of(std::size_t kernel, const Vec3& normal) {
  const auto rounded = [](double v) { return std::llround(std::ldexp(v, 36)); };
  return {static_cast<std::int64_t>(kernel), rounded(normal.x), rounded(normal.y),
          rounded(normal.z)};
}

/// The scalar products of `row` with `planes` vectors that follow each other. Four sums for each:
/// the compiler computes them at once, and their order is the same everywhere.
template <std::size_t planes>
std::array<double, planes> product(const double* row, const double* vectors, std::size_t count) {
  constexpr std::size_t lanes = 4;
  double sums[planes][lanes] = {};
  const std::size_t whole = count - count % lanes;
  for (std::size_t q = 0; q < whole; q += lanes) {
    for (std::size_t k = 0; k < planes; ++k) {
      for (std::size_t l = 0; l < lanes; ++l) {
        sums[k][l] += row[q + l] * vectors[k * count + q + l];
      }
    }
  }
  std::array<double, planes> result{};
  for (std::size_t k = 0; k < planes; ++k) {
    for (std::size_t q = whole; q < count; ++q) {
      sums[k][0] += row[q] * vectors[k * count + q];
    }
    result[k] = (sums[k][0] + sums[k][1]) + (sums[k][2] + sums[k][3]);
  }
  return result;
}

void set_planes(const Rgb* light, std::size_t count, std::vector<double>& planes) {
  planes.resize(3 * count);
  for (std::size_t q = 0; q < count; ++q) {
    planes[q] = light[q].r;
    planes[count + q] = light[q].g;
    planes[2 * count + q] = light[q].b;
  }
}

double largest_of(const std::vector<double>& values) {
  return *std::max_element(values.begin(), values.end());
}

double difference_from_one(const std::vector<double>& values) {
  double worst = 0;
  for (const double v : values) {
    worst = std::max(worst, std::abs(v - 1));
  }
  return worst;
}

}  // namespace

LobeTables::LobeTables(const std::vector<Lobe>& lobes, const std::vector<Vec3>& normals,
                       const std::vector<Vec3>& directions, const LobeTables* before,
                       WorkerThreads& workers, const Cancellation& cancellation)
    : directions_(directions) {
  add_patches(lobes, normals);
  if (before != nullptr) {
    copy_tables(*before);
  }
  std::vector<char> is_new(shapes_.size(), 0);
  for (const LobeTable& table : tables_) {
    if (table.scale.empty()) {
      is_new[table.kernel] = 1;
    }
  }
  std::vector<std::unique_ptr<LobeFunction>> functions(shapes_.size());
  for_each_index(workers, std::size_t{0}, shapes_.size(), [&](std::size_t k) {
    if (is_new[k] != 0) {
      functions[k] = std::make_unique<LobeFunction>(shapes_[k], cancellation);
    }
  });
  for_each_index(workers, std::size_t{0}, tables_.size(), [&](std::size_t t) {
    LobeTable& table = tables_[t];
    if (!table.scale.empty()) {
      return;
    }
    const Hemisphere above(directions_, table.normal);
    for (const double c : above.cosine) {
      table.scale.push_back(functions[table.kernel]->scale(c));
    }
    scale(table, above.cosine, cancellation);
  });
}

void LobeTables::add_patches(const std::vector<Lobe>& lobes, const std::vector<Vec3>& normals) {
  std::map<std::array<std::int64_t, 4>, std::size_t> known;
  for (std::size_t g = 0; g < lobes.size(); ++g) {
    Lobe shape = lobes[g];
    shape.reflectance = {};
    const auto found = std::find(shapes_.begin(), shapes_.end(), shape);
    const auto kernel = static_cast<std::size_t>(found - shapes_.begin());
    if (found == shapes_.end()) {
      shapes_.push_back(shape);
      kernels_.emplace_back(shape);
    }
    const auto [entry, is_new] = known.try_emplace(key_of(kernel, normals[g]), tables_.size());
    if (is_new) {
      tables_.push_back({.kernel = kernel, .normal = normals[g]});
      members_.emplace_back();
    }
    table_of_.push_back(entry->second);
    members_[entry->second].push_back(g);
  }
}

void LobeTables::copy_tables(const LobeTables& before) {
  std::map<std::array<std::int64_t, 4>, std::size_t> known;
  for (std::size_t t = 0; t < before.tables_.size(); ++t) {
    const Lobe& shape = before.shapes_[before.tables_[t].kernel];
    const auto found = std::find(shapes_.begin(), shapes_.end(), shape);
    if (found != shapes_.end()) {
      const auto kernel = static_cast<std::size_t>(found - shapes_.begin());
      known.emplace(key_of(kernel, before.tables_[t].normal), t);
    }
  }
  for (LobeTable& table : tables_) {
    const auto found = known.find(key_of(table.kernel, table.normal));
    if (found != known.end() && before.tables_[found->second].normal == table.normal) {
      const std::size_t kernel = table.kernel;
      table = before.tables_[found->second];
      table.kernel = kernel;
    }
  }
}

double LobeTables::weight() const {
  return 2 * std::numbers::pi / static_cast<double>(directions_.size());
}

void LobeTables::sums(const LobeTable& table, const Hemisphere& above, std::vector<double>& result,
                      const Cancellation& cancellation) const {
  const LobeKernel& kernel = kernels_[table.kernel];
  const std::size_t count = above.size();
  std::vector<double> row, spare, factor(count);
  for (std::size_t q = 0; q < count; ++q) {
    factor[q] = weight() * table.scale[q] * above.cosine[q];
  }
  result.resize(count);
  for (std::size_t p = 0; p < count; ++p) {
    if (p % rows_per_task == 0) {
      cancellation.throw_if_canceled();
    }
    kernel.row(above.direction(p), above.cosine[p], above, row, spare);
    result[p] = table.scale[p] * product<1>(row.data(), factor.data(), count)[0];
  }
}

/// Sinkhorn's iteration from the scales of the continuous lobe: a full step removes what varies
/// from direction to direction, a damped one what is common to all. What then is left, at most the
/// largest sum's excess over each, is made up for by a part that is a product of two functions.
void LobeTables::scale(LobeTable& table, const std::vector<double>& cosine,
                       const Cancellation& cancellation) const {
  constexpr int most_sweeps = 8;
  constexpr double enough = 1e-13, largest_step = 16;
  const Hemisphere above(directions_, table.normal);
  const std::size_t count = above.size();
  std::vector<double> sum;
  sums(table, above, sum, cancellation);
  table.sum_error = difference_from_one(sum);
  for (int sweep = 0; sweep < most_sweeps && difference_from_one(sum) > enough; ++sweep) {
    for (std::size_t p = 0; p < count; ++p) {
      const double step = std::clamp(sum[p], 1 / largest_step, largest_step);
      table.scale[p] /= sweep % 2 == 0 ? step : std::sqrt(step);
    }
    sums(table, above, sum, cancellation);
  }
  const double most = largest_of(sum);  // 0 where the mirrors of all directions are too far away
  const double excess = most > 0 ? std::sqrt(most) : 1.0;
  for (double& s : table.scale) {
    s /= excess;
  }
  sums(table, above, sum, cancellation);
  table.spread.resize(count);
  double total = 0;
  for (std::size_t p = 0; p < count; ++p) {
    table.spread[p] = std::max(1 - sum[p], 0.0);
    total += weight() * cosine[p] * table.spread[p];
  }
  table.spread_share = largest_of(table.spread);
  double all = 0;
  for (std::size_t p = 0; p < count; ++p) {
    table.spread[p] = total > 0 ? table.spread[p] / std::sqrt(total) : 0.0;
    all += weight() * cosine[p] * table.spread[p];
  }
  for (std::size_t p = 0; p < count; ++p) {
    sum[p] += table.spread[p] * all;
  }
  table.sum_defect = difference_from_one(sum);
}

/// w f(p, q) for p from `first` to before `last` and all q.
std::vector<double> LobeTables::rows_of(const LobeTable& table, std::size_t first,
                                        std::size_t last) const {
  const std::size_t count = directions_.size();
  const LobeKernel& kernel = kernels_[table.kernel];
  const Hemisphere above(directions_, table.normal);
  const double* scale = table.scale.data();
  const double* spread = table.spread.data();
  std::vector<double> rows((last - first) * count), row, spare;
  for (std::size_t p = first; p < last; ++p) {
    kernel.row(above.direction(p), above.cosine[p], above, row, spare);
    double* to = rows.data() + (p - first) * count;
    const double w = weight(), scale_p = scale[p], spread_p = spread[p];
    for (std::size_t q = 0; q < count; ++q) {
      to[q] = w * (row[q] * scale_p * scale[q] + spread_p * spread[q]);
    }
  }
  return rows;
}

/// For a block of directions, first the rows of the table, then patch by patch: its light as three
/// planes, and the products of the rows with them.
LobeTables::Change LobeTables::reflect(const std::vector<Rgb>& arriving,
                                       const std::vector<Rgb>& shares,
                                       const std::vector<Rgb>& lambertian_before,
                                       const std::vector<Rgb>& lambertian_after,
                                       std::vector<Rgb>& reflected, WorkerThreads& workers,
                                       const Cancellation& cancellation) const {
  const std::size_t count = directions_.size();
  const std::size_t blocks = (count + rows_per_task - 1) / rows_per_task;
  std::vector<Change> changes(tables_.size() * blocks);
  for_each_index(workers, std::size_t{0}, changes.size(), [&](std::size_t task) {
    const std::size_t first = rows_per_task * (task % blocks);
    const std::size_t last = std::min(first + rows_per_task, count);
    cancellation.throw_if_canceled();
    const std::vector<double> rows = rows_of(tables_[task / blocks], first, last);
    std::vector<double> planes;
    Change& change = changes[task];
    for (const std::size_t g : members_[task / blocks]) {
      cancellation.throw_if_canceled();
      set_planes(arriving.data() + g * count, count, planes);
      for (std::size_t p = first; p < last; ++p) {
        const std::array<double, 3> sum =
            product<3>(rows.data() + (p - first) * count, planes.data(), count);
        Rgb& to = reflected[g * count + p];
        const Rgb before = to + lambertian_before[g];
        to = shares[g] * Rgb{sum[0], sum[1], sum[2]};
        const Rgb after = to + lambertian_after[g];
        change.change = std::max(change.change, max_abs(after - before));
        change.largest = std::max(change.largest, max_abs(after));
      }
    }
  });
  Change result;
  for (const Change& change : changes) {
    result.change = std::max(result.change, change.change);
    result.largest = std::max(result.largest, change.largest);
  }
  return result;
}

Rgb LobeTables::reflected_toward(const Rgb* arriving, std::size_t g, const Vec3& toward) const {
  const LobeTable& table = tables_[table_of_[g]];
  const Hemisphere above(directions_, table.normal);
  std::vector<double> row, spare;
  kernels_[table.kernel].row(toward, dot(toward, table.normal), above, row, spare);
  Rgb sum;
  double all = 0;
  for (std::size_t q = 0; q < above.size(); ++q) {
    sum += row[q] * table.scale[q] * arriving[q];
    all += row[q] * table.scale[q] * above.cosine[q];
  }
  if (!(all > 0)) {  // the lobe falls between directions: what the table spreads
    for (std::size_t q = 0; q < table.spread.size() && q < above.size(); ++q) {
      sum += table.spread[q] * arriving[q];
      all += table.spread[q] * above.cosine[q];
    }
  }
  return all > 0 ? 1 / all * sum : Rgb{};
}

void LobeTables::write_to(GlossyFigures& figures) const {
  figures.lobes = std::ssize(tables_);
  for (const LobeTable& table : tables_) {
    figures.sum_error = std::max(figures.sum_error, table.sum_error);
    figures.sum_defect = std::max(figures.sum_defect, table.sum_defect);
    figures.spread = std::max(figures.spread, table.spread_share);
    figures.exponent = std::max(figures.exponent, kernels_[table.kernel].exponent());
    figures.lobe_bytes += (table.scale.size() + table.spread.size()) * sizeof(double);
  }
}

}  // namespace transillum
