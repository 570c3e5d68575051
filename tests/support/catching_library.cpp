// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
// A library that catches signals while it is loaded, ignored or not, as UCX does.
#include <signal.h>

#include <initializer_list>

namespace {

[[gnu::constructor]] void catch_signals() {
  for (const int number : {SIGINT, SIGHUP}) {
    ::signal(number, [](int) {});
  }
}

}  // namespace
