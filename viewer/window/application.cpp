// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "window/application.h"

#include <fcntl.h>
#include <unistd.h>
#include <QSocketNotifier>
#include <array>
#include <cerrno>
#include <csignal>
#include <system_error>

namespace transillum::viewer {

namespace {

constexpr std::array ending_signals{SIGHUP, SIGINT, SIGTERM};

// The pipe leads from the handler, which may call few functions, to the event loop.
std::array<int, 2> ends{-1, -1};

void pass_on(int number) {
  const int error = errno;
  const auto byte = static_cast<unsigned char>(number);
  // If the pipe is full, it has an earlier signal.
  [[maybe_unused]] const ssize_t written = ::write(ends[1], &byte, 1);
  errno = error;
}

}  // namespace

EndingSignals::EndingSignals(QObject* parent) : QObject(parent) {
  if (::pipe2(ends.data(), O_CLOEXEC | O_NONBLOCK) != 0) {
    throw std::system_error(errno, std::generic_category(), "pipe");
  }
  auto* notifier = new QSocketNotifier(ends[0], QSocketNotifier::Read, this);
  connect(notifier, &QSocketNotifier::activated, this, &EndingSignals::read);
  for (const int number : ending_signals) {
    struct sigaction inherited = {};
    ::sigaction(number, nullptr, &inherited);
    if (inherited.sa_handler == SIG_IGN) {
      continue;
    }
    struct sigaction action = {};
    action.sa_handler = pass_on;
    action.sa_flags = SA_RESTART | static_cast<int>(SA_RESETHAND);
    ::sigaction(number, &action, nullptr);
  }
}

EndingSignals::~EndingSignals() {
  for (const int number : ending_signals) {
    struct sigaction current = {};
    ::sigaction(number, nullptr, &current);
    if (current.sa_handler == pass_on) {
      std::signal(number, SIG_DFL);
    }
  }
  for (int& end : ends) {
    ::close(end);
    end = -1;
  }
}

void EndingSignals::read() {
  unsigned char byte = 0;
  if (::read(ends[0], &byte, 1) == 1 && number_ == 0) {
    number_ = byte;
    emit received(number_);
  }
}

}  // namespace transillum::viewer
