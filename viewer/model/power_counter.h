// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QObject>
#include <memory>

#include "model/snapshot.h"
#include "radiosity/analysis/power_table.h"
#include "support/request_worker.h"

namespace transillum::viewer {

/// Powers by group and by material of a snapshot.
struct PowerTables {
  std::shared_ptr<const SolverSnapshot> snapshot;
  PowerTable groups;            ///< with exchanges where the snapshot has form factors
  PowerTable materials;         ///< likewise
  bool received_known = false;  ///< false before the first iteration: received and absorbed are 0
};

/// Adds up powers on its own thread; the newest snapshot replaces the waiting one.
///
/// Threads: the public functions and the signals belong to the thread that created it.
class PowerCounter : public QObject {
  Q_OBJECT

 public:
  explicit PowerCounter(QObject* parent = nullptr);

  void request(std::shared_ptr<const SolverSnapshot> snapshot);
  /// Drops what has not been delivered.
  void clear();
  bool busy() const { return newest_ != delivered_; }

 signals:
  void counted(std::shared_ptr<const transillum::viewer::PowerTables> tables);
  void failed(const QString& message);

 private:
  struct Task {
    std::shared_ptr<const SolverSnapshot> snapshot;
    quint64 number;
  };
  /// If `tables` is null, the request failed with `error`.
  void deliver(const Task& task, const std::shared_ptr<const PowerTables>& tables,
               const QString& error);

  quint64 newest_ = 0, delivered_ = 0;  // numbers of requests; used by the owner's thread only

  RequestWorker<Task> worker_;
};

}  // namespace transillum::viewer
