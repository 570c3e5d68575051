// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QObject>
#include <QTableView>
#include <memory>
#include <string>

#include "colors/color_choice.h"
#include "model/measured_errors.h"
#include "model/snapshot.h"
#include "patches/patch_table.h"
#include "support/newest_result.h"

class QLabel;
class QMenu;
class QProgressBar;
class QPushButton;
class QTabWidget;
class QToolButton;
class QWidget;

namespace transillum::viewer {

/// The tab "Errors" of the panel "Surfaces": the errors of each surface by directions, patches,
/// iterations and method, and their sum, once the user has them measured; and the step that makes
/// the worst surface more accurate for the least time.
///
/// Measures on a thread of its own. The newest result is ColorChoice::errors().
class ErrorPage : public QObject {
  Q_OBJECT

 public:
  ErrorPage(ColorChoice& colors, QTabWidget& tabs);

  /// The tab.
  QWidget* widget() const { return page_.view->parentWidget(); }
  void show_snapshot(std::shared_ptr<const SolverSnapshot> snapshot);
  void show_state(RunState state);
  bool busy() const { return measuring_.busy(); }

 signals:
  void failed(const QString& message);
  /// The errors are to be measured once the solve, with the changed materials, has finished.
  void solve_wanted();
  /// A step of ColorChoice::errors() is to be carried out.
  void step_chosen(const transillum::NextStep& step);
  /// ColorChoice::errors() is to be written to a file.
  void save_wanted();

 private:
  struct Job {
    std::shared_ptr<const SolverSnapshot> snapshot;
    int number = 0;
  };

  QWidget* make_foot();
  void start_or_cancel();
  void start_if_wanted();
  void cancel();
  MeasuredErrors measure_and_report(const Job& job, const Cancellation& cancellation);
  void show_progress(int number, Measurement what, int percent);
  /// The errors of the snapshot shown; null if they are not known.
  std::shared_ptr<const MeasuredErrors> errors() const;
  void show_errors();
  void show_steps(const ErrorReport& report);
  void show_buttons();
  QString caption() const;

  ColorChoice& colors_;
  std::shared_ptr<const SolverSnapshot> snapshot_;
  RunState state_ = RunState::empty;
  std::string wanted_;  ///< scene to measure once it is solved; empty if none
  int number_ = 0;      ///< number of the newest job
  TablePage page_;
  std::shared_ptr<const MeasuredErrors> shown_;
  QLabel* total_;
  QToolButton* step_;
  QMenu* steps_;
  QPushButton *measure_, *save_;
  QProgressBar* progress_;
  NewestResult<Job, MeasuredErrors> measuring_;
};

}  // namespace transillum::viewer
