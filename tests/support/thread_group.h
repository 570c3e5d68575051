// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <algorithm>
#include <condition_variable>
#include <cstring>
#include <exception>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <thread>
#include <vector>

#include "process_group.h"

namespace transillum::testing {

/// The values that the members of a ThreadGroup share.
class GroupTable {
 public:
  explicit GroupTable(int members)
      : members_(members), values_(static_cast<std::size_t>(members)) {}
  int members() const { return members_; }

  /// Returns on every member once all have called it.
  void meet() {
    std::unique_lock lock(mutex_);
    const int meeting = meetings_;
    if (++arrived_ == members_) {
      arrived_ = 0;
      ++meetings_;
      all_here_.notify_all();
    } else {
      all_here_.wait(lock, [&] { return meetings_ != meeting; });
    }
  }
  /// The values of all members, in their order.
  template <class Value>
  std::vector<std::vector<Value>> exchange(int rank, std::span<const Value> own) {
    const auto bytes = std::as_bytes(own);
    {
      const std::lock_guard lock(mutex_);
      values_[static_cast<std::size_t>(rank)].assign(bytes.begin(), bytes.end());
    }
    meet();
    std::vector<std::vector<Value>> all;
    for (const auto& part : values_) {
      all.emplace_back(part.size() / sizeof(Value));
      if (!part.empty()) {
        std::memcpy(all.back().data(), part.data(), part.size());
      }
    }
    meet();
    return all;
  }

  std::mutex& mutex() { return mutex_; }
  int next = 0;                                ///< pass to be dealt
  std::map<int, mpi::GroupMessages> messages;  ///< by pass, of one round

 private:
  int members_;
  std::mutex mutex_;
  std::condition_variable all_here_;
  int arrived_ = 0, meetings_ = 0;
  std::vector<std::vector<std::byte>> values_;
};

/// A member of a group whose processes are threads of a test.
class ThreadGroup : public mpi::ProcessGroup {
 public:
  ThreadGroup(int rank, GroupTable& table) : rank_(rank), table_(table) {}
  int rank() const override { return rank_; }
  int size() const override { return table_.members(); }

  bool run_messages(const mpi::GroupPasses& passes) override {
    const int round = 2 * size();
    bool going = true;
    for (int first = passes.first; going && first < passes.last; first += round) {
      const int last = std::min(passes.last, first + round);
      make_round(passes, first, last);
      for (int k = first; k < last; ++k) {
        passes.add(k, table_.messages.at(k).to(rank_));
      }
      going = passes.after_message_round();
    }
    return going;
  }
  void complete(std::span<double> values, PatchId patches) override {
    const std::size_t each = values.size() / static_cast<std::size_t>(patches);
    const PatchRange own = owned(patches);
    const auto all = table_.exchange<double>(
        rank_, values.subspan(each * static_cast<std::size_t>(own.first), each * own.size()));
    auto place = values.begin();
    for (const auto& part : all) {
      place = std::copy(part.begin(), part.end(), place);
    }
  }
  void maxima(std::span<double> values) override {
    for (const auto& part : table_.exchange<double>(rank_, values)) {
      for (std::size_t k = 0; k < values.size(); ++k) {
        values[k] = std::max(values[k], part[k]);
      }
    }
  }
  void sums(std::span<std::int64_t> values) override {
    const auto all = table_.exchange<std::int64_t>(rank_, values);
    for (std::size_t k = 0; k < values.size(); ++k) {
      values[k] = 0;
      for (const auto& part : all) {
        values[k] += part[k];
      }
    }
  }
  void gather(std::span<const std::byte> bytes,
              const std::function<void(std::span<const std::byte>)>& take) override {
    for (const auto& part : table_.exchange<std::byte>(rank_, bytes)) {
      if (is_first()) {
        take(part);
      }
    }
  }

 private:
  void make_round(const mpi::GroupPasses& passes, int first, int last) {
    table_.meet();
    if (rank_ == 0) {
      table_.next = first;
      table_.messages.clear();
    }
    table_.meet();
    std::exception_ptr error;
    try {
      for (int k = deal(); k < last; k = deal()) {
        passes.cancellation.throw_if_canceled();
        mpi::GroupMessages made = passes.make(k);
        const std::lock_guard lock(table_.mutex());
        table_.messages[k] = std::move(made);
      }
    } catch (const Canceled&) {
      // seen below
    } catch (...) {
      error = std::current_exception();
    }
    const bool failed = any(error != nullptr), canceled = any(passes.cancellation.canceled());
    if (error) {
      std::rethrow_exception(error);
    }
    if (failed) {
      throw OtherProcessFailed();
    }
    if (canceled) {
      throw Canceled();
    }
  }
  int deal() {
    const std::lock_guard lock(table_.mutex());
    return table_.next++;
  }

  int rank_;
  GroupTable& table_;
};

/// Calls body(group) on one thread per member, at the same time, and returns the error of each.
inline std::vector<std::exception_ptr> run_in_group(
    int members, const std::function<void(const std::shared_ptr<PatchSums>&)>& body) {
  GroupTable table(members);
  std::vector<std::exception_ptr> errors(static_cast<std::size_t>(members));
  std::vector<std::thread> threads;
  for (int r = 0; r < members; ++r) {
    threads.emplace_back([&, r] {
      try {
        body(std::make_shared<ThreadGroup>(r, table));
      } catch (...) {
        errors[static_cast<std::size_t>(r)] = std::current_exception();
      }
    });
  }
  for (std::thread& thread : threads) {
    thread.join();
  }
  return errors;
}

}  // namespace transillum::testing
