// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "radiosity/glossy/directional_exchanges.h"

#include <utility>

#include "transillum/at.h"

namespace transillum {

DirectionalExchanges::DirectionalExchanges(std::vector<char> glossy, std::size_t passes,
                                           std::size_t replicas, std::uint64_t budget,
                                           const Cancellation& cancellation)
    : glossy_(std::move(glossy)), budget_(budget), passes_(passes) {
  for (std::size_t r = 0; r < replicas; ++r) {
    sums_.emplace_back(static_cast<PatchId>(glossy_.size()), true, budget, cancellation);
  }
}

DirectionalExchanges::Sorted DirectionalExchanges::sort(const Transfers& transfers) const {
  Sorted sorted;
  std::vector<Transfer> diffuse;
  for (const Transfer& t : transfers.exchanges) {
    const bool directional = at(glossy_, t.receiver) != 0 || at(glossy_, t.source) != 0;
    (directional ? sorted.directional : diffuse).push_back(t);
  }
  sorted.directional.shrink_to_fit();
  sorted.diffuse = sums_.front().sort(diffuse);
  return sorted;
}

void DirectionalExchanges::add(std::size_t pass, std::size_t replica, Sorted sorted) {
  if (dropped_) {
    return;
  }
  directional_ += std::ssize(sorted.directional);
  passes_[pass] = std::move(sorted.directional);
  ExchangeSums& sums = sums_[replica];
  sums.add(std::move(sorted.diffuse));
  // While sums are merged, they exist twice.
  const std::uint64_t merging = sums.size() * sizeof(Transfer);
  if (sums.overrun() || bytes() + merging > budget_) {
    drop();
  }
}

void DirectionalExchanges::finish() {
  for (ExchangeSums& sums : sums_) {
    if (!dropped_) {
      sums.finish();
    }
  }
}

std::int64_t DirectionalExchanges::size() const {
  std::int64_t size = directional_;
  for (const ExchangeSums& sums : sums_) {
    size += static_cast<std::int64_t>(sums.size());
  }
  return size;
}

void DirectionalExchanges::drop() {
  dropped_ = true;
  for (ExchangeSums& sums : sums_) {
    sums.drop();
  }
  passes_ = {};
  directional_ = 0;
}

}  // namespace transillum
