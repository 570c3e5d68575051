// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Omits tiny form factors and rebalances the matrix. Input: form factors from passes, pairs or
// a file.
//
// Notation: S_ij = A_i F_ij, symmetric where F is reciprocal; d the scales of rows and columns; w_i
// the sum of row i of S before.
#include "radiosity/form_factors/small_form_factors.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "transillum/at.h"
#include "transillum/errors.h"

namespace transillum {
namespace {

constexpr double reciprocal = 1e-9;  ///< relative difference of S_ij and S_ji that is rounding
constexpr double balanced = 1e-11;   ///< relative error of row sums at which sweeps end
constexpr int most_sweeps = 2000;
constexpr int stalled_sweeps = 50;  ///< in which errors that decrease are at least halved

/// The matrix under change.
class Balance {
 public:
  Balance(const Scene& scene, const FormFactors& form_factors, double threshold,
          const Cancellation& cancellation)
      : scene_(scene),
        f_(form_factors),
        cancellation_(cancellation),
        patches_(scene.patches().size()),
        partner_(f_.size()),
        kept_(f_.size(), true),
        wanted_(patches_),
        scales_(patches_, 1.0) {
    find_partners();
    for_each([&](std::size_t i, std::size_t k) { wanted_[i] += area(i) * f_.value[k]; });
    for_each([&](std::size_t, std::size_t k) {
      kept_[k] = std::max(f_.value[k], symmetric_ ? f_.value[partner_[k]] : 0) >= threshold;
      tiny_ += kept_[k] ? 0 : 1;
    });
  }

  /// Every round but the last keeps at least one entry more, so there are at most as many as rows.
  DroppedFormFactors result() {
    do {
      errors_ = symmetric_ ? balance_symmetric() : balance_rows();
    } while (keep_for_rows_short_of_light());
    return collected();
  }

 private:
  double area(std::size_t i) const { return scene_.patches()[i].area; }
  template <class Visit>
  void for_each(Visit visit) const {
    for (std::size_t i = 0; i < patches_; ++i) {
      for (std::size_t k = f_.row_begin[i]; k < f_.row_begin[i + 1]; ++k) {
        visit(i, k);
      }
    }
  }

  /// Finds entry (j, i) of each entry (i, j); symmetric_ is false where one is missing or differs.
  void find_partners() {
    for_each([&](std::size_t i, std::size_t k) {
      const auto j = static_cast<std::size_t>(f_.source[k]);
      const auto begin = f_.source.begin();
      const auto last = begin + static_cast<std::ptrdiff_t>(f_.row_begin[j + 1]);
      const auto found = std::lower_bound(begin + static_cast<std::ptrdiff_t>(f_.row_begin[j]),
                                          last, static_cast<PatchId>(i));
      if (found == last || *found != static_cast<PatchId>(i)) {
        symmetric_ = false;
        return;
      }
      partner_[k] = static_cast<std::size_t>(found - begin);
      const double there = area(i) * f_.value[k], back = area(j) * f_.value[partner_[k]];
      symmetric_ = symmetric_ && std::abs(there - back) <= reciprocal * there;
    });
  }

  /// sum_j S_ij d_j over the kept entries.
  std::vector<double> image() const {
    cancellation_.throw_if_canceled();
    std::vector<double> sums(patches_);
    for_each([&](std::size_t i, std::size_t k) {
      if (kept_[k]) {
        sums[i] += area(i) * f_.value[k] * (symmetric_ ? at(scales_, f_.source[k]) : 1.0);
      }
    });
    return sums;
  }

  /// The symmetric form of Sinkhorn's iteration, until rows are balanced or no longer get closer.
  /// Returns the relative error of each row, negative where it sums to less than before.
  std::vector<double> balance_symmetric() {
    scales_.assign(patches_, 1.0);
    std::vector<double> errors(patches_);
    double worst_before = HUGE_VAL;
    for (int sweep = 1; sweep <= most_sweeps; ++sweep) {
      const std::vector<double> sums = image();
      double worst = 0;
      for (std::size_t i = 0; i < patches_; ++i) {
        const double sum = scales_[i] * sums[i];
        errors[i] = wanted_[i] > 0 ? sum / wanted_[i] - 1 : 0;
        worst = std::max(worst, std::abs(errors[i]));
        if (sum > 0) {
          scales_[i] *= std::sqrt(wanted_[i] / sum);
        }
      }
      const bool stalled = sweep % stalled_sweeps == 0 && worst > 0.5 * worst_before;
      if (worst <= balanced || stalled) {
        break;
      }
      if (sweep % stalled_sweeps == 0) {
        worst_before = worst;
      }
    }
    return errors;
  }

  std::vector<double> balance_rows() {
    const std::vector<double> sums = image();
    std::vector<double> errors(patches_);
    for (std::size_t i = 0; i < patches_; ++i) {
      scales_[i] = sums[i] > 0 ? wanted_[i] / sums[i] : 1;
      errors[i] = wanted_[i] > 0 && !(sums[i] > 0) ? -1 : 0;
    }
    return errors;
  }

  /// Keeps all entries of the rows that lack the most, and of their columns. Rows that cannot be
  /// balanced lack light: those that have too much would not without them. Where all of these are
  /// whole, convergence is slow, and all rows off balance become whole.
  /// Returns whether there are such entries.
  bool keep_for_rows_short_of_light() {
    const double worst = -*std::min_element(errors_.begin(), errors_.end());
    const double least = std::max(balanced, 0.5 * worst);
    return keep_rows([&](std::size_t i) { return errors_[i] < -least; }) ||
           keep_rows([&](std::size_t i) { return std::abs(errors_[i]) > balanced; });
  }

  template <class IsChosen>
  bool keep_rows(IsChosen is_chosen) {
    bool any = false;
    for_each([&](std::size_t i, std::size_t k) {
      if (!kept_[k] && is_chosen(i)) {
        kept_[k] = any = true;
        if (symmetric_) {
          kept_[partner_[k]] = true;
        }
      }
    });
    return any;
  }

  DroppedFormFactors collected() const {
    DroppedFormFactors result;
    double moved = 0, all = 0;
    result.form_factors.row_begin.push_back(0);
    for (std::size_t i = 0; i < patches_; ++i) {
      for (std::size_t k = f_.row_begin[i]; k < f_.row_begin[i + 1]; ++k) {
        all += area(i) * f_.value[k];
        if (!kept_[k]) {
          ++result.dropped;
          moved += area(i) * f_.value[k];
          continue;
        }
        const double scale = scales_[i] * (symmetric_ ? at(scales_, f_.source[k]) : 1.0);
        result.form_factors.source.push_back(f_.source[k]);
        result.form_factors.value.push_back(scale * f_.value[k]);
        if (!f_.moments.empty()) {
          TransferMoments moments = f_.moments[k];
          for (double& value : moments.value) {
            value *= scale;
          }
          result.form_factors.moments.push_back(moments);
        }
      }
      result.form_factors.row_begin.push_back(result.form_factors.size());
    }
    result.fraction = all > 0 ? moved / all : 0;
    result.kept = tiny_ - result.dropped;
    for (const double error : errors_) {
      result.row_error = std::max(result.row_error, std::abs(error));
    }
    return result;
  }

  const Scene& scene_;
  const FormFactors& f_;
  const Cancellation& cancellation_;
  std::size_t patches_;
  std::vector<std::size_t> partner_;  ///< per entry (i, j): the index of (j, i); if symmetric
  bool symmetric_ = true;
  std::vector<bool> kept_;
  std::size_t tiny_ = 0;  ///< number of entries below the threshold
  std::vector<double> wanted_, scales_, errors_;
};

}  // namespace

DroppedFormFactors drop_small_form_factors(const Scene& scene, const FormFactors& form_factors,
                                           double threshold, const Cancellation& cancellation) {
  if (!(threshold > 0 && threshold < 1)) {
    throw InputError(
        fmt::format("threshold of form factors: {} is not between 0 and 1", threshold));
  }
  if (form_factors.row_begin.size() != scene.patches().size() + 1) {
    throw InputError("the form factors belong to another scene: the number of patches differs");
  }
  return Balance(scene, form_factors, threshold, cancellation).result();
}

}  // namespace transillum
