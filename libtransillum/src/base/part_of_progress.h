// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <functional>

namespace transillum {

/// Reports the progress of a part of some work as progress of the whole.
/// @param progress of the whole, called with fractions in [0,1]; must outlive the result; may be
/// empty
/// @param from fraction done before the part
/// @param share of the part
inline std::function<void(double)> part_of_progress(const std::function<void(double)>& progress,
                                                    double from, double share) {
  return progress ? std::function<void(double)>([&progress, from, share](double now) {
    progress(from + share * now);
  })
                  : std::function<void(double)>();
}

}  // namespace transillum
