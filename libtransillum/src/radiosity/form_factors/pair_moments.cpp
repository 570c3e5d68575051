// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// The matrix of engine pairs for a linear basis. Input: the moments of each pair of patches, once.
#include "radiosity/form_factors/pair_moments.h"

#include "base/memory_limit.h"
#include "radiosity/form_factors/form_factor_rows.h"
#include "transillum/linear_basis.h"
#include "visibility/pairs/patch_exchange.h"

namespace transillum {
namespace {

/// Rows per thread between reports of progress.
constexpr PatchId moment_batch = 4;
constexpr std::size_t moment_count = linear_unknowns * linear_unknowns;

/// Rows of the upper triangle: T^ab of patch i and every j > i, as entry 9 j + 3 a + b, m².
class UpperMoments {
 public:
  UpperMoments(const ExchangeFinder& exchange, const std::vector<LinearBasis>& bases,
               const Cancellation& cancellation, IntegratedPairs& integrated)
      : exchange_(exchange), bases_(bases), cancellation_(cancellation), integrated_(integrated) {}

  FormFactorRow gather(PatchId i) const {
    FormFactorRow row;
    exchange_.for_each_moments_after(
        i, bases_, [this] { cancellation_.throw_if_canceled(); },
        [&](PatchId j, const PatchExchange& found, const TransferMoments& moments) {
          integrated_ += found.integrated ? 1 : 0;
          const PatchId first = j * static_cast<PatchId>(moment_count);
          for (std::size_t k = 0; k < moment_count; ++k) {
            row.emplace_back(first + static_cast<PatchId>(k), moments.value[k]);
          }
        });
    return row;
  }

 private:
  const ExchangeFinder& exchange_;
  const std::vector<LinearBasis>& bases_;
  const Cancellation& cancellation_;
  IntegratedPairs& integrated_;
};

/// Calls visit(i, j, moments) for each pair of rows of UpperMoments, where moments[3 a + b] is
/// T^ab.
template <class Visit>
void for_each_pair(const FormFactors& upper, Visit visit) {
  for (std::size_t i = 0; i + 1 < upper.row_begin.size(); ++i) {
    for (std::size_t k = upper.row_begin[i]; k < upper.row_begin[i + 1]; k += moment_count) {
      const auto j = static_cast<std::size_t>(upper.source[k]) / moment_count;
      visit(i, j, upper.value.data() + k);
    }
  }
}

/// Both triangles, of unknowns.
FormFactors moments_both_ways(const Scene& scene, const FormFactors& upper) {
  const std::size_t patches = scene.patches().size();
  std::vector<std::size_t> pairs(patches);
  for_each_pair(upper, [&](std::size_t i, std::size_t j, const double*) {
    ++pairs[i];
    ++pairs[j];
  });
  FormFactors all;
  all.row_begin.push_back(0);
  for (std::size_t u = 0; u < linear_unknowns * patches; ++u) {
    all.row_begin.push_back(all.row_begin.back() + linear_unknowns * pairs[u / linear_unknowns]);
  }
  all.source.resize(all.row_begin.back());
  all.value.resize(all.row_begin.back());
  std::vector<std::size_t> end(all.row_begin.begin(), all.row_begin.end() - 1);
  const auto append = [&](std::size_t i, std::size_t j, auto moment) {
    for (std::size_t a = 0; a < linear_unknowns; ++a) {
      for (std::size_t b = 0; b < linear_unknowns; ++b) {
        const std::size_t k = end[linear_unknowns * i + a]++;
        all.source[k] = static_cast<PatchId>(linear_unknowns * j + b);
        all.value[k] = moment(a, b) / scene.patches()[i].area;
      }
    }
  };
  // Rows ascend: what a row gets from smaller i comes before its own part.
  for_each_pair(upper, [&](std::size_t i, std::size_t j, const double* moments) {
    append(j, i, [&](std::size_t a, std::size_t b) { return moments[linear_unknowns * b + a]; });
  });
  for_each_pair(upper, [&](std::size_t i, std::size_t j, const double* moments) {
    append(i, j, [&](std::size_t a, std::size_t b) { return moments[linear_unknowns * a + b]; });
  });
  return all;
}

}  // namespace

FormFactors pair_moment_factors(const Scene& scene, const PairOptions& options,
                                const Cancellation& cancellation,
                                const std::function<void(double)>& progress,
                                IntegratedPairs& integrated) {
  options.validate();
  const ExchangeFinder exchange(scene, cancellation, options.points);
  const std::vector<LinearBasis> bases = linear_bases(scene);
  const auto show = [&](double rows) { progress(rows * (2 - rows)); };
  // Both triangles take twice the memory, beside the upper one.
  const FormFactors upper = gather_rows(
      {scene.patch_count(), options.threads, moment_batch, memory_limit(options.memory) / 3},
      [&] { return UpperMoments(exchange, bases, cancellation, integrated); }, cancellation,
      progress ? std::function<void(double)>(show) : std::function<void(double)>());
  return moments_both_ways(scene, upper);
}

FormFactors factors_of_means(const FormFactors& of_unknowns) {
  FormFactors means;
  means.row_begin.push_back(0);
  for (std::size_t u = 0; u + 1 < of_unknowns.row_begin.size(); u += linear_unknowns) {
    for (std::size_t k = of_unknowns.row_begin[u]; k < of_unknowns.row_begin[u + 1];
         k += linear_unknowns) {
      means.source.push_back(of_unknowns.source[k] / static_cast<PatchId>(linear_unknowns));
      means.value.push_back(of_unknowns.value[k]);
    }
    means.row_begin.push_back(means.source.size());
  }
  return means;
}

}  // namespace transillum
