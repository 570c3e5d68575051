// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "transillum/pair_form_factors.h"

#include <fmt/format.h>

#include "base/memory_limit.h"
#include "radiosity/form_factors/counted_pairs.h"
#include "radiosity/form_factors/form_factor_rows.h"
#include "transillum/errors.h"
#include "visibility/pairs/patch_exchange.h"

namespace transillum {
namespace {

/// Rows per thread between reports of progress.
constexpr PatchId pair_batch = 4;

/// Rows of the upper triangle: the exchanges of patch i and every j > i, m².
class UpperRows {
 public:
  UpperRows(const ExchangeFinder& exchange, const Cancellation& cancellation,
            IntegratedPairs& integrated)
      : exchange_(exchange), cancellation_(cancellation), integrated_(integrated) {}

  FormFactorRow gather(PatchId i) const {
    FormFactorRow row;
    exchange_.for_each_after(
        i, [this] { cancellation_.throw_if_canceled(); },
        [&](PatchId j, const PatchExchange& found) {
          row.emplace_back(j, found.area);
          integrated_ += found.integrated ? 1 : 0;
        });
    return row;
  }

 private:
  const ExchangeFinder& exchange_;
  const Cancellation& cancellation_;
  IntegratedPairs& integrated_;
};

/// The form factors of all pairs from the exchanges of those with i < j.
FormFactors both_ways(const Scene& scene, const FormFactors& upper) {
  const std::size_t patches = scene.patches().size();
  FormFactors all;
  all.row_begin.assign(patches + 1, 0);
  const auto for_each_exchange = [&](auto visit) {
    for (std::size_t i = 0; i < patches; ++i) {
      for (std::size_t k = upper.row_begin[i]; k < upper.row_begin[i + 1]; ++k) {
        visit(i, static_cast<std::size_t>(upper.source[k]), upper.value[k]);
      }
    }
  };
  for_each_exchange([&](std::size_t i, std::size_t j, double) {
    ++all.row_begin[i + 1];
    ++all.row_begin[j + 1];
  });
  for (std::size_t i = 0; i < patches; ++i) {
    all.row_begin[i + 1] += all.row_begin[i];
  }
  all.source.resize(all.row_begin.back());
  all.value.resize(all.row_begin.back());
  std::vector<std::size_t> end(all.row_begin.begin(), all.row_begin.end() - 1);
  const auto append = [&](std::size_t i, std::size_t j, double area) {
    all.source[end[i]] = static_cast<PatchId>(j);
    all.value[end[i]++] = area / scene.patches()[i].area;
  };
  // Rows ascend: what a row gets from smaller i comes before its own part.
  for_each_exchange([&](std::size_t i, std::size_t j, double area) { append(j, i, area); });
  for_each_exchange([&](std::size_t i, std::size_t j, double area) { append(i, j, area); });
  return all;
}

}  // namespace

void PairOptions::validate() const {
  if (points < 1 || points > EngineOptions::largest_points) {
    throw InputError(fmt::format("points: {} is not in the range 1 to {}", points,
                                 EngineOptions::largest_points));
  }
  if (threads < 0 || threads > 4096) {
    throw InputError(fmt::format("threads: {} is not in the range 0 to 4096", threads));
  }
}

FormFactors pair_form_factors(const Scene& scene, const PairOptions& options,
                              const Cancellation& cancellation,
                              const std::function<void(double)>& progress) {
  IntegratedPairs ignored{0};
  return counted_pair_form_factors(scene, options, cancellation, progress, ignored);
}

FormFactors counted_pair_form_factors(const Scene& scene, const PairOptions& options,
                                      const Cancellation& cancellation,
                                      const std::function<void(double)>& progress,
                                      IntegratedPairs& integrated) {
  options.validate();
  const ExchangeFinder exchange(scene, cancellation, options.points);
  const auto show = [&](double rows) { progress(rows * (2 - rows)); };
  // Both triangles take twice the memory, beside the upper one.
  const FormFactors upper = gather_rows(
      {scene.patch_count(), options.threads, pair_batch, memory_limit(options.memory) / 3},
      [&] { return UpperRows(exchange, cancellation, integrated); }, cancellation,
      progress ? std::function<void(double)>(show) : std::function<void(double)>());
  return both_ways(scene, upper);
}

}  // namespace transillum
