// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>

namespace transillum::mpi {

/// Some passes: `first` to `last` - 1.
struct PassBlock {
  int first = 0, last = 0;
  /// No pass before this one will be dealt any more; past the last pass when there are no more.
  int floor = 0;
  bool stopped = false;  ///< some rank has asked to stop
};

/// How passes are dealt: rank 0 gives blocks to those who ask, in rising order. A block is small
/// where little is left before the limit, so that all finish at about the same time.
class BlockSchedule {
 public:
  /// @param workers threads of all ranks
  BlockSchedule(int first, int last, int workers) : next_(first), last_(last), workers_(workers) {}
  /// The next block, empty where all passes below `limit` are dealt.
  PassBlock take(int limit) {
    if (stopped_) {
      return {0, 0, std::numeric_limits<int>::max(), true};
    }
    const int end = std::min(limit, last_);
    constexpr int share = 4, most = 16;
    const int count = std::clamp((end - next_) / (share * workers_), 1, most);
    PassBlock block{next_, std::max(next_, std::min(next_ + count, end))};
    next_ = block.last;
    block.floor = next_ >= last_ ? std::numeric_limits<int>::max() : next_;
    return block;
  }
  /// Deals no more.
  void stop() { stopped_ = true; }

 private:
  int next_, last_, workers_;
  bool stopped_ = false;
};

/// Passes per thread and message round: some, for even loads; few where their messages are large.
/// @param bytes_of_a_pass of the messages of a pass to all ranks
inline int passes_per_thread(std::uint64_t bytes_of_a_pass) {
  constexpr std::uint64_t bytes = std::uint64_t{64} << 20;
  return static_cast<int>(std::clamp(bytes / std::max(bytes_of_a_pass, std::uint64_t{1}),
                                     std::uint64_t{1}, std::uint64_t{8}));
}

/// Message rounds that may be begun before the first of them is added.
inline constexpr int message_rounds_ahead = 3;

}  // namespace transillum::mpi
