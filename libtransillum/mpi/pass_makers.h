// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <chrono>
#include <condition_variable>
#include <deque>
#include <exception>
#include <map>
#include <mutex>
#include <set>
#include <thread>
#include <vector>

#include "process_group.h"

namespace transillum::mpi {

/// Threads that make the passes dealt to this rank. Threads: one other thread calls it.
class PassMakers {
 public:
  explicit PassMakers(const GroupPasses& passes);
  /// Waits for the passes being made.
  ~PassMakers();
  PassMakers(const PassMakers&) = delete;
  PassMakers& operator=(const PassMakers&) = delete;

  /// Makes these passes after all others.
  void add(int first, int last);
  /// Number of passes that no thread has begun.
  std::size_t waiting() const;
  /// Whether all passes below `limit` that were added are made.
  bool made_below(int limit) const;
  /// Takes the passes below `limit` that are made.
  std::map<int, GroupMessages> take_below(int limit);
  /// Begins no more passes.
  void stop();
  /// Whether a pass has failed.
  bool failed() const;
  /// The exception that a pass threw; null if there is none
  std::exception_ptr error() const;
  /// Pauses, at most until a pass is made. While passes are being made, for at least a quarter of
  /// the time of one, or 5 ms: waking more often costs more than it saves. Requests of other ranks
  /// wait as long.
  void pause(std::chrono::microseconds time);

 private:
  void work();

  const GroupPasses& passes_;
  mutable std::mutex mutex_;
  std::condition_variable work_there_, pass_made_;
  std::deque<int> waiting_;
  std::set<int> unmade_;  ///< waiting or being made
  std::map<int, GroupMessages> made_;
  std::exception_ptr error_;
  bool stopped_ = false, ended_ = false;
  bool news_ = false;                                     ///< a pass was made since the last pause
  std::chrono::steady_clock::duration time_of_a_pass_{};  ///< the last one made
  std::vector<std::thread> threads_;
};

}  // namespace transillum::mpi
