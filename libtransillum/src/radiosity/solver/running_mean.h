// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <vector>

#include "transillum/scene.h"

namespace transillum {

/// The mean of lists of the same length, added one by one (eq. 45).
struct RunningMean {
  std::vector<Rgb> sum;
  int count = 0;

  void add(const std::vector<Rgb>& values) {
    sum.resize(values.size());
    for (std::size_t i = 0; i < values.size(); ++i) {
      sum[i] += values[i];
    }
    ++count;
  }
  std::vector<Rgb> mean() const {
    std::vector<Rgb> mean(sum.size());
    for (std::size_t i = 0; i < sum.size(); ++i) {
      mean[i] = (1.0 / count) * sum[i];
    }
    return mean;
  }
  /// For StateOutput and StateInput.
  /// @param patches length of the lists
  template <class Archive, class Self>
  static void visit_state(Archive& archive, Self& self, std::size_t patches) {
    archive.empty_or(patches, self.sum);
    archive(self.count);
    archive.require(self.count >= 0 && (self.count == 0 || self.sum.size() == patches));
  }
};

}  // namespace transillum
