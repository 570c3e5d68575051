// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QDateTime>
#include <QObject>
#include <QString>
#include <cstdint>
#include <memory>
#include <vector>

#include "model/snapshot.h"

class QUndoStack;

namespace transillum::viewer {

/// A run that was kept to be compared with others.
struct KeptRun {
  QString name;
  QDateTime kept;  ///< local time
  /// Has B, H, sums of form factors, the error estimate and the last change of B, but no form
  /// factors and no directions. `loaded` has only the scene.
  std::shared_ptr<const SolverSnapshot> snapshot;
};

/// The runs that the user has kept, with names, and the two of them that are compared: A, and a
/// kept run B or the current one. Only runs of the patches of the open scene can be compared.
///
/// Threads: the main thread only.
class KeptRuns : public QObject {
  Q_OBJECT

 public:
  /// Limit of all kept runs together, bytes.
  static constexpr std::int64_t most_bytes = 1'000'000'000;

  using QObject::QObject;

  const std::vector<KeptRun>& all() const { return runs_; }
  /// Changes of the list can be undone there. Without a stack, they cannot.
  void set_undo_stack(QUndoStack* undo) { undo_ = undo; }
  /// Keeps a run as "Run N", which becomes A.
  /// @returns false where all kept runs would exceed `bytes`
  bool keep(const SolverSnapshot& snapshot, std::int64_t bytes = most_bytes);
  /// Renames a run; an empty name changes nothing.
  void rename(std::size_t k, const QString& name);
  void remove(std::size_t k);

  /// Sets the scene whose patches the compared runs must have. Emits only changed(), although A and
  /// B may be other runs afterward.
  void set_scene(std::shared_ptr<const Scene> scene);
  /// A message on why run k cannot be compared with runs of the scene; empty if it can.
  const QString& reason_against(std::size_t k) const;

  /// The indices of A and B. The first is -1 where no run can be compared, the second is -1 for the
  /// current run.
  int first() const;
  int second() const;
  /// Ignored where the run cannot be compared.
  void set_first(int k);
  void set_second(int k);
  /// The run at such an index; null for -1.
  std::shared_ptr<const SolverSnapshot> run(int k) const;

 signals:
  /// The list, its names or its reasons have changed.
  void changed();
  /// Another run is A or B.
  void compared_changed();

 private:
  void change(const QString& what, std::vector<KeptRun> runs);
  void set(std::vector<KeptRun> runs);
  void find_reasons();
  int comparable_index(const std::shared_ptr<const SolverSnapshot>& run) const;

  std::vector<KeptRun> runs_;
  std::vector<QString> reasons_;  ///< one per run
  std::shared_ptr<const Scene> scene_;
  std::shared_ptr<const SolverSnapshot> first_,
      second_;    ///< chosen by the user; may have been removed
  int kept_ = 0;  ///< the number of runs ever kept
  QUndoStack* undo_ = nullptr;
};

}  // namespace transillum::viewer
