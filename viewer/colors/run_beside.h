// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QObject>
#include <QString>
#include <memory>
#include <vector>

#include "colors/color_choice.h"
#include "model/requests/direction_comparison.h"
#include "state/focus.h"
#include "state/selection.h"
#include "support/newest_result.h"

namespace transillum::viewer {

/// A kept run, also of another scene or another version of this one, that is shown beside the open
/// scene: linked by the direction in focus and by the numbers of patches.
///
/// Threads: the main thread only.
class RunBeside : public QObject {
  Q_OBJECT

 public:
  RunBeside(const Focus& focus, const ColorChoice& colors, const Selection& selection,
            QObject* parent = nullptr);

  /// Shows a run; null ends that.
  void show(std::shared_ptr<const SolverSnapshot> run, const QString& name);
  /// The run shown; null if there is none.
  const std::shared_ptr<const SolverSnapshot>& run() const { return run_; }
  const QString& name() const { return name_; }
  /// The comparison along the direction in focus; null while it is being computed, or without a
  /// run. Its form factors may still belong to the patch selected before.
  std::shared_ptr<const DirectionComparison> comparison() const;
  /// Why there is no comparison; else empty.
  const QString& error() const { return error_; }
  /// The patches of the run in the quantity shown, on the scale of the open scene; dark grays where
  /// the run does not have it.
  std::vector<Color8> patch_colors() const;
  /// The step of the other map that processes the patch of a step of the open one; -1 if none does.
  std::int32_t step_beside(std::int32_t step) const;
  /// The comparison as text: a sentence, and the rows that differ as a table.
  QString summary() const;

 signals:
  void changed();

 private:
  void request();

  const Focus& focus_;
  const ColorChoice& colors_;
  const Selection& selection_;
  std::shared_ptr<const SolverSnapshot> run_;
  QString name_, error_;
  std::shared_ptr<const DirectionComparison> comparison_;
  NewestResult<DirectionRequest, DirectionComparison> comparer_;
};

}  // namespace transillum::viewer
