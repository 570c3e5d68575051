// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// The state of exchange sums that the members of a group share. In a checkpoint it looks like the
// state of one process, so that any number of processes can continue with it.
#include <algorithm>
#include <utility>

#include "radiosity/exchange/exchange_sums.h"

namespace transillum {

void ExchangeSums::save(StateOutput& archive) const {
  const auto first = sums_.begin[owned_.first()], last = sums_.begin[owned_.last()];
  std::vector<std::size_t> sizes;
  for (std::size_t row = owned_.first(); row < owned_.last(); ++row) {
    sizes.push_back(sums_.begin[row + 1] - sums_.begin[row]);
  }
  sizes = owned_.gather(std::move(sizes));
  std::vector<std::size_t> begin{0};
  for (const std::size_t size : sizes) {
    begin.push_back(begin.back() + size);
  }
  const auto budgets = static_cast<std::uint64_t>(owned_.sums->size());
  archive(budget_ > ~std::uint64_t{0} / budgets ? budget_ : budget_ * budgets, overrun_, begin);
  const auto put = [&](const auto& list) {
    archive(std::uint64_t{begin.back()});
    owned_.sums->gather(
        std::as_bytes(std::span(list).subspan(first, last - first)),
        [&archive](std::span<const std::byte> part) { archive.block(part.data(), part.size()); });
  };
  put(sums_.source);
  put(sums_.area);
  archive(waiting_);
}

void ExchangeSums::restore(StateInput& archive) {
  std::uint64_t saved_budget = 0, count = 0;
  std::vector<std::size_t> begin;
  archive(saved_budget, overrun_, begin, count);
  if (owned_.is_all()) {
    budget_ = saved_budget;
  }
  archive.require(begin.size() == patches_ + 1 && begin.front() == 0 &&
                  std::is_sorted(begin.begin(), begin.end()) && begin.back() == count &&
                  count <= archive.left() / sizeof(PatchId));
  const auto is_needed = [this](PatchId i, PatchId j) {
    return owned_.range.contains(i) || (two_way_ && owned_.range.contains(j));
  };
  std::vector<bool> needed(static_cast<std::size_t>(count));
  sums_ = {{0}, {}, {}};
  std::vector<PatchId> row;
  for (std::size_t i = 0; i < patches_; ++i) {
    row.resize(begin[i + 1] - begin[i]);
    archive.block(row.data(), row.size() * sizeof(PatchId));
    for (std::size_t k = 0; k < row.size(); ++k) {
      if (is_needed(static_cast<PatchId>(i), row[k])) {
        needed[begin[i] + k] = true;
        sums_.source.push_back(row[k]);
      }
    }
    sums_.begin.push_back(sums_.source.size());
  }
  archive(count);
  archive.require(count == begin.back() && count <= archive.left() / sizeof(double));
  sums_.area.reserve(sums_.source.size());
  std::vector<double> areas;
  for (std::size_t i = 0; i < patches_; ++i) {
    areas.resize(begin[i + 1] - begin[i]);
    archive.block(areas.data(), areas.size() * sizeof(double));
    for (std::size_t k = 0; k < areas.size(); ++k) {
      if (needed[begin[i] + k]) {
        sums_.area.push_back(areas[k]);
      }
    }
  }
  archive(waiting_);
  waiting_size_ = 0;
  for (Sorted& sorted : waiting_) {
    std::erase_if(sorted, [&](const Transfer& t) { return !is_needed(t.receiver, t.source); });
    waiting_size_ += sorted.size();
  }
  archive.require(is_valid());
}

}  // namespace transillum
