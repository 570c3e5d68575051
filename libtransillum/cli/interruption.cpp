// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "cli/interruption.h"

#include <signal.h>
#include <unistd.h>

#include <atomic>
#include <vector>

#include "cli/commands/commands.h"
#include "cli/processes.h"

namespace transillum::cli {
namespace {

// Cancellation::cancel() stores to such a flag, which is allowed in a signal handler.
static_assert(std::atomic<bool>::is_always_lock_free);

const Cancellation* canceled_by_signals = nullptr;

void on_signal(int) {
  if (canceled_by_signals->canceled()) {
    ::_exit(interrupted);
  }
  canceled_by_signals->cancel();
}

}  // namespace

const Cancellation& cancel_on_signals() {
  static const Cancellation cancellation;
  canceled_by_signals = &cancellation;
  struct sigaction action = {};
  action.sa_handler = on_signal;
  action.sa_flags = SA_RESTART;
  sigemptyset(&action.sa_mask);
  std::vector<int> signals{SIGINT, SIGTERM, SIGHUP};
  if (processes().sums) {
    signals.push_back(SIGUSR1);
  }
  for (const int signal : signals) {
    struct sigaction inherited = {};
    sigaction(signal, nullptr, &inherited);
    if (inherited.sa_handler != SIG_IGN) {  // nohup, or a script's trap "" INT
      sigaction(signal, &action, nullptr);
    }
  }
  return cancellation;
}

}  // namespace transillum::cli
