// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Keeps the exchanges of all passes within the memory limit and turns them into form factors.
// Input: the exchanges that sort() prepared, in the order of the passes.
#include "radiosity/solver/kept_exchanges.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <optional>
#include <utility>

#include "base/memory_limit.h"
#include "transillum/at.h"
#include "transillum/errors.h"

namespace transillum {
namespace {

/// Entries of sums that are of constant functions, as receiver, source and entry.
template <class Visit>
void for_each_constant(const ExchangeSums& sums, std::size_t per_patch, Visit visit) {
  const auto stride = static_cast<PatchId>(per_patch);
  sums.for_each([&](PatchId u, PatchId v, double entry) {
    if (stride == 1 || (u % stride == 0 && v % stride == 0)) {
      visit(u / stride, v / stride, entry);
    }
  });
}

/// A matrix with room for the entries of `sums`, its row_begin set.
FormFactors empty_rows(const ExchangeSums& sums, std::size_t patches, std::size_t per_patch,
                       bool two_way) {
  FormFactors result;
  result.row_begin.resize(patches + 1);
  for_each_constant(sums, per_patch, [&](PatchId i, PatchId j, double) {
    ++result.row_begin[static_cast<std::size_t>(i) + 1];
    if (two_way) {
      ++result.row_begin[static_cast<std::size_t>(j) + 1];
    }
  });
  std::partial_sum(result.row_begin.begin(), result.row_begin.end(), result.row_begin.begin());
  result.source.resize(result.row_begin.back());
  result.value.resize(result.row_begin.back());
  return result;
}

/// The memory limit less what replicas take besides their sums.
std::uint64_t memory_for_sums(const SolverInput& input) {
  const std::uint64_t limit = memory_limit(input.options.memory);
  const int replicas = input.options.replicas;
  const std::uint64_t others = replicas > 1 ? static_cast<std::uint64_t>(replicas) *
                                                  input.unknowns->count() *
                                                  RadiosityIterate::bytes_per_unknown
                                            : 0;
  return limit > others ? limit - others : 0;
}

}  // namespace

KeptExchanges::KeptExchanges(const SolverInput& input, bool renews)
    : patches_(input.scene->patch_count()),
      per_patch_(input.unknowns->per_patch),
      two_way_(input.options.two_way),
      owned_(input.owned()),
      owned_unknowns_(owned_.of_unknowns(per_patch_)),
      renews_(renews),
      cancellation_(input.cancellation),
      memory_(memory_for_sums(input)),
      renewed_areas_(input.patch_count(), input.unknowns->per_patch) {
  const SolveOptions& options = input.options;
  if (options.normalize == Normalization::symmetric) {
    required_by_ = "the symmetric normalization";
  } else if (traits_of(options.scheme).is_symmetric) {
    required_by_ = "the scheme conjugate-gradients";
  }
  for (int r = 0; r < options.replicas; ++r) {
    sums_.push_back(empty_sums(memory_ / static_cast<std::uint64_t>(options.replicas)));
  }
}

ExchangeSums KeptExchanges::empty_sums(std::uint64_t memory) const {
  return {owned_unknowns_, two_way_, memory, cancellation_};
}

void KeptExchanges::add_replica() {
  const std::uint64_t used = own_size() * sizeof(Transfer);
  const bool dropped = !available();
  sums_.push_back(empty_sums(memory_ > used ? memory_ - used : 0));
  if (dropped) {
    sums_.back().drop();
  }
}

bool KeptExchanges::available() const {
  return requested() &&
         std::none_of(sums_.begin(), sums_.end(), [](const auto& s) { return s.overrun(); });
}

void KeptExchanges::check_available() const {
  if (required_by_ && !available()) {
    throw MemoryLimitExceeded(fmt::format(
        "{} requires kept form factors, and they exceed the memory limit", required_by_));
  }
}

ExchangeSums::Sorted KeptExchanges::sort(const Transfers& transfers) const {
  if (per_patch_ == 1) {
    return sums_.front().sort(transfers.exchanges);
  }
  std::vector<Transfer> exchanges;
  exchanges.reserve(per_patch_ * per_patch_ * transfers.exchanges.size());
  for_each_exchange(transfers, per_patch_,
                    [&](const Transfer& t, PatchId, PatchId) { exchanges.push_back(t); });
  return sums_.front().sort(exchanges);
}

void KeptExchanges::add(std::size_t r, ExchangeSums::Sorted sorted) {
  sums_[r].add(std::move(sorted));
  // Where one replica does not fit, the others are of no use.
  if (!available()) {
    drop();
    if (owned_.is_all()) {
      check_available();
    }
  }
}

void KeptExchanges::drop() {
  for (ExchangeSums& part : sums_) {
    part.drop();
  }
}

void KeptExchanges::complete() {
  renewed_areas_.complete(owned_);
  count();
}

void KeptExchanges::prepare_to_save() {
  for (ExchangeSums& part : sums_) {
    part.prepare_to_save();
  }
}

void KeptExchanges::count() {
  std::int64_t size = 0;
  for (const ExchangeSums& part : sums_) {
    size += static_cast<std::int64_t>(part.size_of_owned());
  }
  owned_.sums->sums({&size, 1});
  kept_elsewhere_ = size - static_cast<std::int64_t>(own_size());
}

void KeptExchanges::add_areas(const Transfers& transfers) {
  if (renews_ && requested_) {
    renewed_areas_.add(transfers, two_way_, owned_);
  }
}

void KeptExchanges::finish() {
  for (ExchangeSums& part : sums_) {
    part.finish();
  }
  count();
}

KeptSums KeptExchanges::all() const {
  KeptSums all;
  for (const ExchangeSums& part : sums_) {
    all.push_back(&part);
  }
  return all;
}

std::size_t KeptExchanges::own_size() const {
  return std::accumulate(
      sums_.begin(), sums_.end(), std::size_t{0},
      [](std::size_t size, const ExchangeSums& part) { return size + part.size(); });
}

ExchangeSums KeptExchanges::joined() const {
  ExchangeSums joined(owned_unknowns_.patches, two_way_, ~std::uint64_t{0}, cancellation_);
  for (const ExchangeSums& part : sums_) {
    ExchangeSums::Sorted sorted;
    sorted.reserve(part.size());
    part.for_each([&](PatchId i, PatchId j, double area) {
      if (owned_unknowns_.range.contains(i)) {
        sorted.push_back({i, j, area});
      }
    });
    joined.add(owned_.gather(std::move(sorted)));
  }
  joined.finish();
  return joined;
}

FormFactors KeptExchanges::form_factors(const RadiosityIterate& iterate,
                                        const VisibleAreaSums& areas) const {
  const std::optional<ExchangeSums> all_replicas =
      sums_.size() > 1 || !owned_.is_all() ? std::optional(joined()) : std::nullopt;
  const ExchangeSums& sums = all_replicas ? *all_replicas : sums_.front();
  FormFactors result = empty_rows(sums, static_cast<std::size_t>(patches_), per_patch_, two_way_);
  std::vector<std::size_t> next(result.row_begin.begin(), result.row_begin.end() - 1);
  const auto put = [&](PatchId i, PatchId j, double area) {
    const std::size_t k = at(next, i)++;
    result.source[k] = j;
    result.value[k] = area * iterate.form_factor_scale(static_cast<std::size_t>(i) * per_patch_,
                                                       static_cast<std::size_t>(j) * per_patch_,
                                                       at(areas.projected, i), areas.passes);
  };
  // Pairs come in rising order. Entries left of the diagonal are put first, so that sources rise
  // within each row.
  if (two_way_) {
    for_each_constant(sums, per_patch_,
                      [&](PatchId i, PatchId j, double area) { put(j, i, area); });
  }
  for_each_constant(sums, per_patch_, put);
  if (per_patch_ > 1) {
    add_moments(sums, iterate, areas, result);
  }
  return result;
}

void KeptExchanges::add_moments(const ExchangeSums& sums, const RadiosityIterate& iterate,
                                const VisibleAreaSums& areas, FormFactors& result) const {
  result.moments.resize(result.size());
  const auto n = static_cast<PatchId>(per_patch_);
  const auto put = [&](PatchId u, PatchId v, double entry) {
    const PatchId i = u / n, j = v / n;
    const auto row = static_cast<std::size_t>(i);
    const auto begin = result.source.begin();
    const auto first = begin + static_cast<std::ptrdiff_t>(result.row_begin[row]);
    const auto last = begin + static_cast<std::ptrdiff_t>(result.row_begin[row + 1]);
    const auto found = static_cast<std::size_t>(std::lower_bound(first, last, j) - begin);
    result.moments[found].of(static_cast<std::size_t>(u % n), static_cast<std::size_t>(v % n)) =
        entry * iterate.form_factor_scale(static_cast<std::size_t>(u), static_cast<std::size_t>(v),
                                          at(areas.projected, i), areas.passes);
  };
  sums.for_each([&](PatchId u, PatchId v, double entry) {
    put(u, v, entry);
    if (two_way_) {
      put(v, u, entry);
    }
  });
  if (!iterate.has_scaled_moments()) {
    return;
  }
  for (PatchId i = 0; i < patches_; ++i) {
    const auto row = static_cast<std::size_t>(i);
    for (std::size_t k = result.row_begin[row]; k < result.row_begin[row + 1]; ++k) {
      iterate.scale_moments(i, result.source[k], result.moments[k]);
      result.value[k] = result.moments[k].of(0, 0);
    }
  }
}

}  // namespace transillum
