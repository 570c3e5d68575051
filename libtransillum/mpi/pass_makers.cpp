// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "pass_makers.h"

#include <algorithm>
#include <utility>

namespace transillum::mpi {

PassMakers::PassMakers(const GroupPasses& passes) : passes_(passes) {
  for (int k = 0; k < passes.threads; ++k) {
    try {
      threads_.emplace_back([this] { work(); });
    } catch (const std::system_error&) {
      if (threads_.empty()) {
        throw;
      }
      break;  // the threads that started do the work
    }
  }
}

PassMakers::~PassMakers() {
  {
    const std::lock_guard lock(mutex_);
    stopped_ = ended_ = true;
  }
  work_there_.notify_all();
  for (std::thread& thread : threads_) {
    thread.join();
  }
}

void PassMakers::work() {
  std::unique_lock lock(mutex_);
  for (;;) {
    work_there_.wait(lock, [this] { return ended_ || (!stopped_ && !waiting_.empty()); });
    if (ended_) {
      return;
    }
    const int k = waiting_.front();
    waiting_.pop_front();
    lock.unlock();
    const auto start = std::chrono::steady_clock::now();
    GroupMessages messages;
    std::exception_ptr error;
    try {
      messages = passes_.make(k);
    } catch (...) {
      error = std::current_exception();
    }
    lock.lock();
    if (!error) {
      made_[k] = std::move(messages);
      unmade_.erase(k);
      time_of_a_pass_ = std::chrono::steady_clock::now() - start;
    } else if (!error_) {
      error_ = error;
    }
    news_ = true;
    pass_made_.notify_one();
  }
}

void PassMakers::add(int first, int last) {
  {
    const std::lock_guard lock(mutex_);
    for (int k = first; k < last; ++k) {
      waiting_.push_back(k);
      unmade_.insert(unmade_.end(), k);
    }
  }
  work_there_.notify_all();
}

std::size_t PassMakers::waiting() const {
  const std::lock_guard lock(mutex_);
  return waiting_.size();
}

bool PassMakers::made_below(int limit) const {
  const std::lock_guard lock(mutex_);
  return unmade_.empty() || *unmade_.begin() >= limit;
}

std::map<int, GroupMessages> PassMakers::take_below(int limit) {
  const std::lock_guard lock(mutex_);
  std::map<int, GroupMessages> taken;
  while (!made_.empty() && made_.begin()->first < limit) {
    taken.insert(taken.end(), made_.extract(made_.begin()));
  }
  return taken;
}

void PassMakers::stop() {
  const std::lock_guard lock(mutex_);
  stopped_ = true;
}

bool PassMakers::failed() const {
  const std::lock_guard lock(mutex_);
  return error_ != nullptr;
}

std::exception_ptr PassMakers::error() const {
  const std::lock_guard lock(mutex_);
  return error_;
}

void PassMakers::pause(std::chrono::microseconds time) {
  using std::chrono::duration_cast;
  using std::chrono::microseconds;
  constexpr microseconds longest{5000};
  std::unique_lock lock(mutex_);
  if (!unmade_.empty()) {
    time = std::max(time, std::min(longest, duration_cast<microseconds>(time_of_a_pass_ / 4)));
  }
  pass_made_.wait_for(lock, time, [this] { return news_; });
  news_ = false;
}

}  // namespace transillum::mpi
