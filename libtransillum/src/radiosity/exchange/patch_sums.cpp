// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "transillum/patch_sums.h"

#include <exception>

namespace transillum {

PatchRange PatchSums::range_of(int process, PatchId patches) const {
  const auto bound = [this, patches](std::int64_t k) {
    return static_cast<PatchId>(k * patches / size());
  };
  return {bound(process), bound(process + 1)};
}

bool PatchSums::any(bool value) {
  double largest = value ? 1 : 0;
  maxima({&largest, 1});
  return largest > 0;
}

double PatchSums::from_first(double value) {
  double first = is_first() ? value : -1;
  maxima({&first, 1});
  return first;
}

void PatchSums::agree(const std::function<void()>& body) {
  std::exception_ptr error;
  try {
    body();
  } catch (...) {
    error = std::current_exception();
  }
  const bool failed = any(error != nullptr);
  if (error) {
    std::rethrow_exception(error);
  }
  if (failed) {
    throw OtherProcessFailed();
  }
}

Cancellation PatchSums::own(const Cancellation& requested) const {
  return size() == 1 ? requested : Cancellation();
}

}  // namespace transillum
