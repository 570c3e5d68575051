// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "transillum/scene.h"

namespace transillum {

/// The spread of a mean over correlated lists of values, such as consecutive iterations: sums over
/// batches of consecutive lists. There are at most 16; when they are complete, neighbors are
/// joined.
class BatchMeans {
 public:
  /// Adds a list; all have the same length.
  void add(const std::vector<Rgb>& values);
  /// Half width of the interval that contains the limit of the mean with 95 % confidence: largest
  /// over list entries and channels, over `unit`. Nothing before there are 8 complete batches.
  /// @param correlation upper bound of that of consecutive lists, which decreases geometrically
  /// @param unit above 0; of the size of the values
  std::optional<double> largest_half_width(double correlation, double unit) const;

  /// For StateOutput and StateInput.
  /// @param patches length of the lists
  template <class Archive, class Self>
  static void visit_state(Archive& archive, Self& self, std::size_t patches) {
    archive(self.sums_, self.length_, self.in_last_);
    archive.require(self.sums_.size() <= most && self.length_ > 0 && self.in_last_ >= 0 &&
                    self.in_last_ < self.length_ && (self.in_last_ == 0 || !self.sums_.empty()));
    for (const auto& list : self.sums_) {
      archive.require(list.size() == patches);
    }
  }

 private:
  static constexpr std::size_t most = 16, fewest = 8;
  std::size_t complete() const { return sums_.size() - (in_last_ > 0 ? 1 : 0); }
  void join_neighbors();

  std::vector<std::vector<Rgb>> sums_;
  int length_ = 1;   ///< lists per batch
  int in_last_ = 0;  ///< lists in the last batch; 0 if it is complete
};

}  // namespace transillum
