// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <string>
#include <utility>

#include "transillum/cancellation.h"
#include "transillum/errors.h"

namespace transillum::cli {

/// Canceled where what is done would be of no use to anybody; what() tells why.
class NothingToSave : public Canceled {
 public:
  explicit NothingToSave(std::string why) : why_(std::move(why)) {}
  const char* what() const noexcept override { return why_.c_str(); }

 private:
  std::string why_;
};

/// From now on the first SIGINT or SIGTERM sets what this returns, and the second ends the
/// program at once. Call it once, before threads start.
const Cancellation& cancel_on_signals();

}  // namespace transillum::cli
