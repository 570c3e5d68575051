// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QObject>

namespace transillum::viewer {

/// Reports SIGINT, SIGTERM and SIGHUP in the event loop instead of ending the process at once.
/// Signals that were ignored when the program started stay ignored. The second signal of a kind
/// ends the process.
///
/// Threads: the main thread only. At most one object at a time.
class EndingSignals : public QObject {
  Q_OBJECT

 public:
  /// @throws std::system_error
  explicit EndingSignals(QObject* parent = nullptr);
  ~EndingSignals() override;

  /// The first signal received, or 0.
  int number() const { return number_; }

 signals:
  /// Emitted once, on the first signal.
  void received(int number);

 private:
  void read();

  int number_ = 0;
};

}  // namespace transillum::viewer
