// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QWidget>
#include <vector>

#include "transillum/study.h"

class QCheckBox;
class QLabel;
class QVBoxLayout;

namespace transillum::viewer {

/// What a study compares, by check boxes: samplings, ways of light, numbers of directions.
class StudyChoices : public QWidget {
  Q_OBJECT

 public:
  explicit StudyChoices(QWidget* parent = nullptr);

  /// What is not chosen here: engine, normalization, scheme, first shot, seed, memory, threads.
  void set_solve(const SolveOptions& solve);
  /// What goes together of what is chosen; no series or directions where nothing is.
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
  void show_solve();
  void show_size();

  SolveOptions solve_;
  std::vector<Choice> samplings_, ways_, directions_;
  QLabel *size_ = nullptr, *rest_ = nullptr;
};

}  // namespace transillum::viewer
