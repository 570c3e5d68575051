// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Lobes on a set of directions (decisions/0074-lobes-scaled-on-the-set.md): scaling, so that each
// reflects its fraction exactly and stays reciprocal, and reflection.
//
// Notation: p, q passes, whose direction above the surface is meant; w = 4 pi / (2M), the solid
// angle of a direction; c cosines with the normal; g a glossy patch.
#include "radiosity/glossy/lobe_tables.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>

#include "base/for_each_index.h"
#include "base/seconds_since.h"
#include "radiosity/glossy/lobe_vectors.h"
#include "transillum/glossy.h"

namespace transillum {
namespace {

/// Rows of a table that a task computes.
constexpr std::size_t rows_per_task = 64;
/// Memory limit for the rows of tables while these are scaled, all threads together.
constexpr std::size_t most_kept_bytes = std::size_t{1} << 28;

/// Equal for patches whose normals differ by rounding, mostly.
std::array<std::int64_t, 4> key_of(std::size_t kernel, const Vec3& normal) {
  const auto rounded = [](double v) { return std::llround(std::ldexp(v, 36)); };
  return {static_cast<std::int64_t>(kernel), rounded(normal.x), rounded(normal.y),
          rounded(normal.z)};
}

/// Light of a patch as three planes, each value times the value of `factor`.
void set_planes(const Rgb* light, const std::vector<double>& factor, std::vector<double>& planes) {
  const std::size_t count = factor.size();
  planes.resize(3 * count);
  for (std::size_t q = 0; q < count; ++q) {
    planes[q] = factor[q] * light[q].r;
    planes[count + q] = factor[q] * light[q].g;
    planes[2 * count + q] = factor[q] * light[q].b;
  }
}

/// Calls body(i) for each i below `count`, and `report` several times a second between.
template <class Body>
void for_each_with_report(WorkerThreads& workers, std::size_t count, const Body& body,
                          const std::function<void(double)>& report) {
  constexpr double between_reports = 0.05;  // s
  const auto threads = static_cast<std::size_t>(workers.arena().max_concurrency());
  std::size_t batch = report ? threads : count;
  for (std::size_t first = 0; first < count;) {
    const auto start = std::chrono::steady_clock::now();
    const std::size_t end = std::min(first + batch, count);
    for_each_index(workers, first, end, body);
    first = end;
    const double seconds = seconds_since(start);
    batch = seconds < between_reports       ? 2 * batch
            : seconds > 4 * between_reports ? std::max(batch / 2, threads)
                                            : batch;
    if (report) {
      report(static_cast<double>(first) / static_cast<double>(count));
    }
  }
}

std::function<void(double)> with_size(const LobeReport& report, std::size_t tables) {
  if (!report) {
    return {};
  }
  return [&report, tables](double fraction) { report(fraction, tables); };
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

/// Rows of the kernel of a table: computed once, or `rows_per_task` at a time.
class LobeTables::KernelRows {
 public:
  KernelRows(const LobeKernel& kernel, const Hemisphere& above, bool keep)
      : kernel_(kernel), above_(above) {
    const std::size_t count = keep ? above.size() : std::min(rows_per_task, above.size());
    values_ = std::make_unique_for_overwrite<double[]>(count * above.size());
    if (keep) {
      compute(0, above.size());
      kept_ = true;
    }
  }
  const Hemisphere& above() const { return above_; }
  /// Rows from `first` to before `last`, at most rows_per_task of them.
  const double* rows(std::size_t first, std::size_t last) {
    if (kept_) {
      return values_.get() + first * above_.size();
    }
    compute(first, last);
    return values_.get();
  }

 private:
  void compute(std::size_t first, std::size_t last) {
    for (std::size_t p = first; p < last; ++p) {
      kernel_.row(above_.direction(p), above_.cosine[p], above_,
                  values_.get() + (p - first) * above_.size());
    }
  }

  const LobeKernel& kernel_;
  const Hemisphere& above_;
  std::unique_ptr<double[]> values_;
  bool kept_ = false;
};

LobeTables::LobeTables(std::span<const LobePatch> patches, const std::vector<Vec3>& directions,
                       const LobeTables* before, WorkerThreads& workers,
                       const Cancellation& cancellation, const LobeReport& report)
    : directions_(directions) {
  add_patches(patches);
  if (before != nullptr) {
    copy_tables(*before);
  }
  std::vector<char> is_new(shapes_.size(), 0);
  for (const LobeTable& table : tables_) {
    if (table.scale.empty()) {
      is_new[table.kernel] = 1;
    }
  }
  for_each_index(workers, std::size_t{0}, shapes_.size(), [&](std::size_t k) {
    if (is_new[k] != 0 && functions_[k] == nullptr) {
      functions_[k] = std::make_shared<const LobeFunction>(shapes_[k], cancellation);
    }
  });
  const std::size_t bytes = directions.size() * directions.size() * sizeof(double);
  const auto threads = static_cast<std::size_t>(workers.arena().max_concurrency());
  const bool keep_rows = bytes * threads <= most_kept_bytes;
  const auto make = [&](std::size_t t) {
    LobeTable& table = tables_[t];
    if (!table.scale.empty()) {
      return;
    }
    const Hemisphere above(directions_, table.normal);
    for (const double c : above.cosine) {
      table.scale.push_back(functions_[table.kernel]->scale(c));
    }
    scale(table, above, keep_rows, cancellation);
  };
  for_each_with_report(workers, tables_.size(), make, with_size(report, tables_.size()));
}

void LobeTables::add_patches(std::span<const LobePatch> patches) {
  std::map<std::array<std::int64_t, 4>, std::size_t> known;
  for (std::size_t g = 0; g < patches.size(); ++g) {
    const Vec3& normal = patches[g].normal;
    Lobe shape = patches[g].lobe;
    shape.reflectance = {};
    const auto found = std::find(shapes_.begin(), shapes_.end(), shape);
    const auto kernel = static_cast<std::size_t>(found - shapes_.begin());
    if (found == shapes_.end()) {
      shapes_.push_back(shape);
      kernels_.emplace_back(shape);
      functions_.emplace_back();
    }
    const auto [entry, is_new] = known.try_emplace(key_of(kernel, normal), tables_.size());
    if (is_new) {
      tables_.push_back({.kernel = kernel, .normal = normal});
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
      functions_[kernel] = before.functions_[before.tables_[t].kernel];
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

void LobeTables::sums(const LobeTable& table, KernelRows& rows, std::vector<double>& result,
                      const Cancellation& cancellation) const {
  const std::size_t count = rows.above().size();
  std::vector<double> factor(count);
  for (std::size_t q = 0; q < count; ++q) {
    factor[q] = weight() * table.scale[q] * rows.above().cosine[q];
  }
  result.resize(count);
  for (std::size_t first = 0; first < count; first += rows_per_task) {
    cancellation.throw_if_canceled();
    const std::size_t last = std::min(first + rows_per_task, count);
    multiply_rows(rows.rows(first, last), last - first, factor.data(), 1, count,
                  result.data() + first);
  }
  for (std::size_t p = 0; p < count; ++p) {
    result[p] *= table.scale[p];
  }
}

/// Sinkhorn's iteration from the scales of the continuous lobe: a full step removes what varies
/// from direction to direction, a damped one what is common to all. What then is left, at most the
/// largest sum's excess over each, is made up for by a part that is a product of two functions.
void LobeTables::scale(LobeTable& table, const Hemisphere& above, bool keep_rows,
                       const Cancellation& cancellation) const {
  constexpr int most_sweeps = 8;
  constexpr double enough = 1e-13, largest_step = 16;
  const std::vector<double>& cosine = above.cosine;
  const std::size_t count = above.size();
  KernelRows rows(kernels_[table.kernel], above, keep_rows);
  std::vector<double> sum;
  sums(table, rows, sum, cancellation);
  table.sum_error = difference_from_one(sum);
  for (int sweep = 0; sweep < most_sweeps && difference_from_one(sum) > enough; ++sweep) {
    for (std::size_t p = 0; p < count; ++p) {
      const double step = std::clamp(sum[p], 1 / largest_step, largest_step);
      table.scale[p] /= sweep % 2 == 0 ? step : std::sqrt(step);
    }
    sums(table, rows, sum, cancellation);
  }
  const double most = largest_of(sum);  // 0 where the mirrors of all directions are too far away
  const double excess = most > 0 ? std::sqrt(most) : 1.0;
  for (double& s : table.scale) {
    s /= excess;
  }
  sums(table, rows, sum, cancellation);
  table.spread.resize(count);
  double total = 0;
  for (std::size_t p = 0; p < count; ++p) {
    table.spread[p] = std::max(1 - sum[p], 0.0);
    total += weight() * cosine[p] * table.spread[p];
  }
  table.spread_fraction = largest_of(table.spread);
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

/// For a block of directions, first the rows of the kernel, then patch by patch: its light times
/// the scales as three planes, the products of the rows with them, and what the lobe spreads.
LobeTables::Change LobeTables::reflect(const Light& light, std::span<Rgb> reflected,
                                       WorkerThreads& workers, const Cancellation& cancellation,
                                       const LobeReport& report) const {
  const std::size_t count = directions_.size();
  const std::size_t blocks = (count + rows_per_task - 1) / rows_per_task;
  std::vector<Change> changes(tables_.size() * blocks);
  const auto reflect_block = [&](std::size_t task) {
    const std::size_t first = rows_per_task * (task % blocks);
    const std::size_t last = std::min(first + rows_per_task, count);
    const LobeTable& table = tables_[task / blocks];
    cancellation.throw_if_canceled();
    const Hemisphere above(directions_, table.normal);
    KernelRows kernel(kernels_[table.kernel], above, false);
    const double* rows = kernel.rows(first, last);
    std::vector<double> planes, sums(3 * (last - first));
    Change& change = changes[task];
    for (const std::size_t g : members_[task / blocks]) {
      cancellation.throw_if_canceled();
      const Rgb* arriving = light.arriving.data() + g * light.stride;
      Rgb spread;
      for (std::size_t q = 0; q < count; ++q) {
        spread += table.spread[q] * arriving[q];
      }
      set_planes(arriving, table.scale, planes);
      multiply_rows(rows, last - first, planes.data(), 3, count, sums.data());
      for (std::size_t p = first; p < last; ++p) {
        const double* sum = sums.data() + 3 * (p - first);
        Rgb& to = reflected[g * light.stride + p];
        const Rgb before = to + light.lambertian_before[g];
        to = weight() * (light.fractions[g] *
                         (table.scale[p] * Rgb{sum[0], sum[1], sum[2]} + table.spread[p] * spread));
        if (!light.direct.empty()) {
          to += light.direct[g * light.stride + p];
        }
        const Rgb after = to + light.lambertian_after[g];
        change.change = std::max(change.change, max_abs(after - before));
        change.largest = std::max(change.largest, max_abs(after));
      }
    }
  };
  for_each_with_report(workers, changes.size(), reflect_block, with_size(report, tables_.size()));
  Change result;
  for (const Change& change : changes) {
    result.change = std::max(result.change, change.change);
    result.largest = std::max(result.largest, change.largest);
  }
  return result;
}

/// The row of the kernel for the direction of a ray gets its own scale, as toward a point.
void LobeTables::reflect(const ShotRays& rays, const ShotLight& light, std::span<Rgb> reflected,
                         WorkerThreads& workers, const Cancellation& cancellation) const {
  for_each_index(workers, std::size_t{0}, table_of_.size(), [&](std::size_t g) {
    const LobeTable& table = tables_[table_of_[g]];
    const Hemisphere above(directions_, table.normal);
    std::vector<double> row(above.size());
    for (const ShotRay& ray : rays.of(g)) {
      cancellation.throw_if_canceled();
      const double cosine = dot(ray.direction, table.normal);
      kernels_[table.kernel].row(ray.direction, cosine, above, row.data());
      double all = 0;
      for (std::size_t q = 0; q < row.size(); ++q) {
        row[q] *= table.scale[q];
        all += row[q] * above.cosine[q];
      }
      if (!(all > 0)) {  // the lobe falls between directions
        row = table.spread;
        for (std::size_t q = 0; q < row.size(); ++q) {
          all += row[q] * above.cosine[q];
        }
      }
      if (!(all > 0)) {
        std::fill(row.begin(), row.end(), 1.0);
        all = std::accumulate(above.cosine.begin(), above.cosine.end(), 0.0);
      }
      const Rgb power = ray.irradiance * light.sources[static_cast<std::size_t>(ray.source)];
      const Rgb sent = all > 0 ? 1 / (weight() * all) * (light.fractions[g] * power) : Rgb{};
      for (std::size_t q = 0; q < row.size(); ++q) {
        reflected[g * light.stride + q] += row[q] * sent;
      }
    }
  });
}

Rgb LobeTables::reflected_toward(std::span<const ShotRay> rays, const std::vector<Rgb>& sources,
                                 std::size_t g, const Vec3& toward) const {
  const LobeTable& table = tables_[table_of_[g]];
  const LobeFunction& lobe = *functions_[table.kernel];
  Rgb sum;
  for (const ShotRay& ray : rays) {
    sum += ray.irradiance * lobe.value(ray.direction, toward, table.normal) *
           sources[static_cast<std::size_t>(ray.source)];
  }
  return sum;
}

Rgb LobeTables::reflected_toward(const Rgb* arriving, std::size_t g, const Vec3& toward) const {
  const LobeTable& table = tables_[table_of_[g]];
  const Hemisphere above(directions_, table.normal);
  std::vector<double> row(above.size());
  kernels_[table.kernel].row(toward, dot(toward, table.normal), above, row.data());
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

void LobeTables::write_to(GlossyStatistics& counted) const {
  counted.lobes = std::ssize(tables_);
  for (const LobeTable& table : tables_) {
    counted.sum_error = std::max(counted.sum_error, table.sum_error);
    counted.sum_defect = std::max(counted.sum_defect, table.sum_defect);
    counted.spread = std::max(counted.spread, table.spread_fraction);
    counted.exponent = std::max(counted.exponent, kernels_[table.kernel].exponent());
    counted.lobe_bytes += (table.scale.size() + table.spread.size()) * sizeof(double);
  }
}

}  // namespace transillum
