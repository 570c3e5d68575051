// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <string>
#include <utility>

#include "transillum/cancellation.h"
#include "transillum/errors.h"

namespace transillum::cli {

/// Canceled, and the partial results are useless; what() gives the reason.
class NothingToSave : public Canceled {
 public:
  explicit NothingToSave(std::string why) : why_(std::move(why)) {}
  const char* what() const noexcept override { return why_.c_str(); }

 private:
  std::string why_;
};

/// From now on the first SIGINT, SIGTERM or SIGHUP (the terminal is closed) cancels the returned
/// Cancellation, and the second ends the program immediately. A signal that the caller of the
/// program ignores stays ignored. SIGUSR1 cancels too, for runs of several processes: mpirun
/// passes it on and, unlike the other signals, ends nothing itself. Call it once, before threads
/// start.
const Cancellation& cancel_on_signals();

}  // namespace transillum::cli
