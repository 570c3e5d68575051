// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QDialog>
#include <filesystem>
#include <memory>

#include "io/drawing/study_chart.h"
#include "model/solver/study_runner.h"

class QComboBox;
class QLabel;
class QProgressBar;
class QPushButton;
class QTableWidget;

namespace transillum::viewer {

class Banner;
class MaterialEdits;
class StudyChart;
class StudyChoices;

/// Runs studies of the open scene: error of B against the number of passes, as a plot and a table.
class StudyDialog : public QDialog {
  Q_OBJECT

 public:
  /// @param cache folder for reference solutions; if it is empty, none are kept
  /// @param edits changed materials have to be solved before they are studied; outlives this object
  StudyDialog(const std::filesystem::path& cache, const MaterialEdits& edits,
              QWidget* parent = nullptr);

  /// Shows the dialog in front of all other windows.
  void present();
  /// Sets the scene; a running study of another scene is stopped.
  void show_scene(std::shared_ptr<const LoadedScene> loaded);
  /// Takes the options of the current solve, which apply where the dialog has no choice.
  void show_solve(const SolverSnapshot& solve);

  std::shared_ptr<const StudySnapshot> snapshot() const { return snapshot_; }
  /// Writes the plot or the table, by the ending of `path`; shows an error where it fails.
  void save(const QString& path);

 private:
  QWidget* make_controls();
  QWidget* make_results();
  void run_or_stop();
  void choose_file();
  void show_snapshot(std::shared_ptr<const StudySnapshot> snapshot);
  void show_phase();
  void show_table();
  void show_buttons();
  ErrorMeasure measure() const;
  StudyAxis axis() const;
  bool has_points() const { return snapshot_ && !snapshot_->study.points.empty(); }

  const MaterialEdits& edits_;
  StudyRunner runner_;
  std::shared_ptr<const LoadedScene> loaded_;
  std::shared_ptr<const StudySnapshot> snapshot_;
  bool running_ = false;

  StudyChoices* choices_;
  QLabel *scene_, *phase_;
  QComboBox *error_, *axis_;
  QProgressBar* progress_;
  QPushButton *run_, *save_;
  QTableWidget* table_;
  StudyChart* chart_;
  Banner* banner_;
};

}  // namespace transillum::viewer
