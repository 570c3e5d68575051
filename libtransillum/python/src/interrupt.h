// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <pybind11/pybind11.h>

#include <chrono>
#include <exception>
#include <functional>
#include <future>

#include "transillum/cancellation.h"

namespace transillum::python {

/// Runs `body` on a thread of its own, without Python's lock, so that Ctrl-C and other threads of
/// Python work meanwhile.
/// @param tick called several times a second on the calling thread with the lock held; throws to
/// stop.
/// @param stop asks `body` to end soon; called where Ctrl-C was pressed or `tick` has thrown.
/// @throws what `body` throws; KeyboardInterrupt, or what `tick` has thrown, once `body` has ended.
template <class Body>
auto run_interruptibly(Body&& body, const std::function<void()>& tick,
                       const std::function<void()>& stop) {
  namespace py = pybind11;
  constexpr std::chrono::milliseconds polling_interval{50};
  auto running = std::async(std::launch::async, std::forward<Body>(body));
  std::exception_ptr reason;
  for (bool done = false; !done;) {
    {
      const py::gil_scoped_release released;
      done = running.wait_for(polling_interval) == std::future_status::ready;
    }
    if (reason) {
      continue;
    }
    try {
      if (PyErr_CheckSignals() != 0) {
        throw py::error_already_set();
      }
      tick();
    } catch (...) {
      reason = std::current_exception();
      stop();
    }
  }
  if (reason) {
    try {
      running.get();
    } catch (...) {  // the thread was asked to end
    }
    std::rethrow_exception(reason);
  }
  return running.get();
}

/// run_interruptibly() of body(cancellation), which Ctrl-C cancels.
template <class Body>
auto run_cancelably(
    Body body, const std::function<void()>& tick = [] {}) {
  const Cancellation cancellation;
  return run_interruptibly([&] { return body(cancellation); }, tick,
                           [&] { cancellation.cancel(); });
}

}  // namespace transillum::python
