// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QWidget>
#include <vector>

#include "transillum/study.h"

class QCheckBox;
class QLabel;
class QVBoxLayout;

namespace transillum::viewer {

/// Check boxes for what a study compares: samplings, one-way or two-way passes, engines, numbers of
/// directions.
class StudyChoices : public QWidget {
  Q_OBJECT

 public:
  explicit StudyChoices(QWidget* parent = nullptr);

  /// Sets the options that have no control here: normalization, scheme, first shot, seed, memory,
  /// threads. If the engine changes, it becomes the only one that is checked.
  void set_solve(const SolveOptions& solve);
  /// All valid combinations of the checked choices; without series or directions where none is
  /// checked.
  StudyOptions options() const;

 signals:
  void changed();

 private:
  struct Choice {
    QCheckBox* box;
    int value;
  };
  QCheckBox* add_box(std::vector<Choice>& choices, const QString& name, const QString& text,
                     int value, bool on);
  void check_engine();
  /// The checked engines; the engine of the solve if none is checked.
  std::vector<Engine> engines() const;
  void show_solve();
  void show_cost();

  SolveOptions solve_;
  std::vector<Choice> samplings_, passes_, engines_, directions_;
  QLabel *cost_ = nullptr, *fixed_settings_ = nullptr;
};

}  // namespace transillum::viewer
