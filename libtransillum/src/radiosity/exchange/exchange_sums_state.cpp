// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// The state of exchange sums that the members of a group share. In a checkpoint it looks like the
// state of one process, so that any number of processes can continue with it.
#include <algorithm>
#include <type_traits>
#include <utility>

#include "radiosity/exchange/exchange_sums.h"

namespace transillum {

void ExchangeSums::save_in_group(StateOutput& archive, const PatchShare& share) const {
  const auto first = sums_.begin[share.first()], last = sums_.begin[share.last()];
  std::vector<std::size_t> sizes;
  for (std::size_t row = share.first(); row < share.last(); ++row) {
    sizes.push_back(sums_.begin[row + 1] - sums_.begin[row]);
  }
  sizes = share.gather(std::move(sizes));
  std::vector<std::size_t> begin{0};
  for (const std::size_t size : sizes) {
    begin.push_back(begin.back() + size);
  }
  const auto members = static_cast<std::uint64_t>(share.group->size());
  archive(budget_ > ~std::uint64_t{0} / members ? budget_ : budget_ * members, overrun_, begin);
  const auto put = [&](const auto& list) {
    using Values = std::remove_cvref_t<decltype(list)>;
    archive(std::uint64_t{begin.back()});
    for (int member = 0; member < share.group->size(); ++member) {
      const auto from = list.begin() + static_cast<std::ptrdiff_t>(first);
      const auto to = list.begin() + static_cast<std::ptrdiff_t>(last);
      const Values part = share.gather(member == share.group->rank() ? Values(from, to) : Values());
      archive.block(part.data(), part.size() * sizeof(part[0]));
    }
  };
  put(sums_.source);
  put(sums_.area);
  archive(std::vector<Run>());  // all are merged
}

void ExchangeSums::restore_share(StateInput& archive, const PatchShare& share) {
  std::uint64_t other_budget = 0, count = 0;
  std::vector<std::size_t> begin;
  archive(other_budget, overrun_, begin, count);
  archive.require(begin.size() == patches_ + 1 && begin.front() == 0 &&
                  std::is_sorted(begin.begin(), begin.end()) && begin.back() == count &&
                  count <= archive.left() / sizeof(PatchId));
  const auto is_needed = [&](PatchId i, PatchId j) {
    return share.owned.contains(i) || (two_way_ && share.owned.contains(j));
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
  for (Run& run : waiting_) {
    std::erase_if(run, [&](const Transfer& t) { return !is_needed(t.receiver, t.source); });
    waiting_size_ += run.size();
  }
  archive.require(is_valid());
}

}  // namespace transillum
