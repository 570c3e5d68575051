// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "radiosity/glossy/directional_exchanges.h"

#include <utility>

#include "transillum/at.h"

namespace transillum {

DirectionalExchanges::DirectionalExchanges(std::vector<char> glossy, int passes,
                                           std::uint64_t budget, const Cancellation& cancellation)
    : glossy_(std::move(glossy)),
      budget_(budget),
      passes_(static_cast<std::size_t>(passes)),
      sums_(static_cast<PatchId>(glossy_.size()), true, budget, cancellation) {}

DirectionalExchanges::Sorted DirectionalExchanges::sort(const Transfers& transfers) const {
  Sorted sorted;
  std::vector<Transfer> diffuse;
  for (const Transfer& t : transfers.exchanges) {
    const bool directional = at(glossy_, t.receiver) != 0 || at(glossy_, t.source) != 0;
    (directional ? sorted.directional : diffuse).push_back(t);
  }
  sorted.directional.shrink_to_fit();
  sorted.diffuse = sums_.sort(diffuse);
  return sorted;
}

void DirectionalExchanges::add(int pass, Sorted sorted) {
  if (dropped_) {
    return;
  }
  directional_ += std::ssize(sorted.directional);
  passes_[static_cast<std::size_t>(pass)] = std::move(sorted.directional);
  sums_.add(std::move(sorted.diffuse));
  // While sums are merged, they exist twice.
  const std::uint64_t merging = sums_.size() * sizeof(Transfer);
  if (sums_.overrun() || bytes() + merging > budget_) {
    drop();
  }
}

void DirectionalExchanges::finish() {
  if (!dropped_) {
    sums_.finish();
  }
}

std::int64_t DirectionalExchanges::size() const {
  return directional_ + static_cast<std::int64_t>(sums_.size());
}

void DirectionalExchanges::drop() {
  dropped_ = true;
  sums_.drop();
  passes_ = {};
  directional_ = 0;
}

}  // namespace transillum
