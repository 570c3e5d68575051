// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QWidget>
#include <memory>

#include "engine_comparer.h"
#include "focus.h"

class QComboBox;
class QLabel;
class QSpinBox;
class QTableWidget;
class QTimer;

namespace transillum::viewer {

class DifferencePicture;

/// Two engines on the direction in focus: what each takes and finds, and where they differ.
class CompareView : public QWidget {
  Q_OBJECT

 public:
  explicit CompareView(Focus& focus, QWidget* parent = nullptr);

  void show_snapshot(std::shared_ptr<const SolverSnapshot> snapshot);
  void clear();
  /// Whether the direction in focus is compared.
  bool up_to_date() const;

 protected:
  void showEvent(QShowEvent* event) override;

 private:
  struct Choice {
    QComboBox* engine;
    QSpinBox* resolution;
  };
  Choice make_choice(const char* name, Engine engine);
  int resolution_of(const Choice& choice) const;
  void ask();
  void show_comparison(std::shared_ptr<const EngineComparison> comparison);
  void fill_table(const EngineComparison& comparison);

  Focus& focus_;
  EngineComparer comparer_;
  EngineComparer::Request asked_;
  std::shared_ptr<const SolverSnapshot> snapshot_;
  std::shared_ptr<const EngineComparison> comparison_;
  Choice first_, other_;
  QLabel* words_;
  DifferencePicture* picture_;
  QTableWidget* table_;
  QTimer* later_;
};

}  // namespace transillum::viewer
