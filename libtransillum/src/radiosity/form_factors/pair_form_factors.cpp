// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// The matrix of engine pairs. Input: the exchange of each pair of patches, once; for linear
// functions its moments.
//
// Notation: n functions a patch, 1 or 3; T^ab as in ALGORITHM.md 5.9.
#include "transillum/pair_form_factors.h"

#include <fmt/format.h>

#include "base/memory_limit.h"
#include "radiosity/form_factors/form_factor_rows.h"
#include "radiosity/form_factors/pair_matrix.h"
#include "radiosity/linear_solution.h"
#include "transillum/at.h"
#include "transillum/errors.h"
#include "transillum/linear_basis.h"
#include "visibility/pairs/patch_exchange.h"

namespace transillum {
namespace {

/// Rows per thread between reports of progress.
constexpr PatchId pair_batch = 4;

/// Rows of the upper triangle: T^ab of patch i and every j > i, as entry n² j + n a + b, m².
class UpperRows {
 public:
  UpperRows(const ExchangeFinder& exchange, const std::vector<LinearBasis>& bases,
            std::size_t exchanges, const Cancellation& cancellation, IntegratedPairs& integrated)
      : exchange_(exchange),
        bases_(bases),
        exchanges_(exchanges),
        cancellation_(cancellation),
        integrated_(integrated) {}

  FormFactorRow gather(PatchId i) const {
    FormFactorRow row;
    exchange_.for_each_after(
        i, bases_, [this] { cancellation_.throw_if_canceled(); },
        [&](PatchId j, const PatchExchange& found, const TransferMoments& moments) {
          integrated_ += found.integrated ? 1 : 0;
          const PatchId first = j * static_cast<PatchId>(exchanges_);
          for (std::size_t k = 0; k < exchanges_; ++k) {
            row.emplace_back(first + static_cast<PatchId>(k), moments.value[k]);
          }
        });
    return row;
  }

 private:
  const ExchangeFinder& exchange_;
  const std::vector<LinearBasis>& bases_;
  std::size_t exchanges_;  ///< exchanges of a pair, n²
  const Cancellation& cancellation_;
  IntegratedPairs& integrated_;
};

/// Both triangles of the matrix.
/// @param upper of UpperRows, with n functions a patch
FormFactors both_ways(const Scene& scene, const FormFactors& upper, std::size_t n) {
  const std::size_t patches = scene.patches().size();
  const auto for_each_pair = [&](auto visit) {
    for (std::size_t i = 0; i < patches; ++i) {
      for (std::size_t k = upper.row_begin[i]; k < upper.row_begin[i + 1]; k += n * n) {
        visit(i, static_cast<std::size_t>(upper.source[k]) / (n * n), upper.value.data() + k);
      }
    }
  };
  std::vector<std::size_t> pairs(patches);
  for_each_pair([&](std::size_t i, std::size_t j, const double*) {
    ++pairs[i];
    ++pairs[j];
  });
  FormFactors all;
  all.row_begin.push_back(0);
  for (const std::size_t count : pairs) {
    all.row_begin.push_back(all.row_begin.back() + count);
  }
  all.source.resize(all.row_begin.back());
  all.value.resize(all.row_begin.back());
  all.moments.resize(n > 1 ? all.row_begin.back() : 0);
  std::vector<std::size_t> end(all.row_begin.begin(), all.row_begin.end() - 1);
  const auto append = [&](std::size_t i, std::size_t j, auto exchange) {
    const std::size_t k = end[i]++;
    const double area = scene.patches()[i].area;
    all.source[k] = static_cast<PatchId>(j);
    all.value[k] = exchange(0, 0) / area;
    for (std::size_t a = 0; a < n && n > 1; ++a) {
      for (std::size_t b = 0; b < n; ++b) {
        all.moments[k].of(a, b) = exchange(a, b) / area;
      }
    }
  };
  // Rows ascend: what a row gets from smaller i comes before its own part.
  for_each_pair([&](std::size_t i, std::size_t j, const double* exchanges) {
    append(j, i, [&](std::size_t a, std::size_t b) { return exchanges[n * b + a]; });
  });
  for_each_pair([&](std::size_t i, std::size_t j, const double* exchanges) {
    append(i, j, [&](std::size_t a, std::size_t b) { return exchanges[n * a + b]; });
  });
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
  return pair_matrix(scene, options, cancellation, progress, ignored);
}

FormFactors pair_matrix(const Scene& scene, const PairOptions& options,
                        const Cancellation& cancellation,
                        const std::function<void(double)>& progress, IntegratedPairs& integrated) {
  options.validate();
  const bool linear = options.basis == Basis::linear;
  const std::size_t n = linear ? linear_unknowns : 1;
  const ExchangeFinder exchange(scene, cancellation, options.points);
  const auto bases = linear ? linear_bases(scene) : std::vector<LinearBasis>();
  const auto show = [&](double rows) { progress(rows * (2 - rows)); };
  // Both triangles take twice the memory, beside the upper one.
  const FormFactors upper = gather_rows(
      {scene.patch_count(), options.threads, pair_batch, memory_limit(options.memory) / 3},
      [&] { return UpperRows(exchange, bases, n * n, cancellation, integrated); }, cancellation,
      progress ? std::function<void(double)>(show) : std::function<void(double)>());
  return both_ways(scene, upper, n);
}

std::vector<double> exact_form_factors(const Scene& scene, PatchId i,
                                       const Cancellation& cancellation,
                                       const std::function<void(double)>& progress) {
  const ExchangeFinder exchange(scene, cancellation);
  const double area = scene.patch(i).area;
  std::vector<double> factors(scene.patches().size());
  const std::function<void()> check = [&] { cancellation.throw_if_canceled(); };
  for (PatchId j = 0; j < scene.patch_count(); ++j) {
    check();
    if (j != i) {
      at(factors, j) = exchange.area_between(i, j, check) / area;
    }
    if (progress && j % 64 == 0) {
      progress(static_cast<double>(j) / scene.patch_count());
    }
  }
  return factors;
}

}  // namespace transillum
