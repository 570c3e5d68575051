// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
// Compiled into every program, the viewer included: keeps what a signal does as it was when the
// program was started. Some libraries catch signals while they are loaded, even those that nohup or
// a script's trap "" INT has the program ignore: UCX, which comes with Open MPI 5, catches SIGHUP.
#include <signal.h>

#include <array>
#include <cstddef>

namespace transillum::cli {
namespace {

constexpr std::array restored_signals{SIGINT, SIGTERM, SIGHUP, SIGUSR1};

std::array<struct sigaction, restored_signals.size()> inherited;

void keep_inherited(int, char**, char**) {
  for (std::size_t k = 0; k < restored_signals.size(); ++k) {
    sigaction(restored_signals[k], nullptr, &inherited[k]);
  }
}

// Functions in this section run before those that initialize libraries.
[[gnu::used,
  gnu::section(".preinit_array")]] void (*const before_libraries)(int, char**,
                                                                  char**) = keep_inherited;

// Constructors of the program itself run after them.
[[gnu::constructor]] void restore_inherited() {
  for (std::size_t k = 0; k < restored_signals.size(); ++k) {
    sigaction(restored_signals[k], &inherited[k], nullptr);
  }
}

}  // namespace
}  // namespace transillum::cli
