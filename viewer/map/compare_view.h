// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QWidget>
#include <memory>

#include "colors/color_choice.h"
#include "model/engine_comparer.h"
#include "state/focus.h"
#include "state/selection.h"

class QBoxLayout;
class QComboBox;
class QLabel;
class QStackedWidget;
class QSpinBox;
class QTimer;

namespace transillum::viewer {

class DifferencePicture;
class HemicubeView;
class MapCanvas;

/// Two engines on the direction in focus, side by side: what each shows of the plane, takes and
/// finds, and where they differ. The maps move and grow together.
class CompareView : public QWidget {
  Q_OBJECT

 public:
  CompareView(Focus& focus, Selection& selection, const ColorChoice& colors,
              QWidget* parent = nullptr);

  void show_snapshot(std::shared_ptr<const SolverSnapshot> snapshot);
  void clear();
  /// Whether the direction in focus is compared, as chosen.
  bool up_to_date() const;

 protected:
  void showEvent(QShowEvent* event) override;

 private:
  struct Choice {
    QComboBox* engine;
    QSpinBox* resolution;
    MapCanvas* map;
    HemicubeView* hemicube;
    QStackedWidget* picture;  ///< one of both
    QLabel* figures;

    bool is_hemicube() const;
    bool up_to_date() const;
    /// As EngineComparer::Request has it.
    int resolution_asked() const;
  };
  Choice make_choice(const char* name, Engine engine);
  QBoxLayout* column_of(const Choice& choice) const;
  void link(const std::vector<MapCanvas*>& maps);
  EngineComparer::Request wanted() const;
  void ask();
  void show_maps();
  void show_comparison(std::shared_ptr<const EngineComparison> comparison);

  Focus& focus_;
  Selection& selection_;
  const ColorChoice& colors_;
  EngineComparer comparer_;
  EngineComparer::Request asked_;
  bool comparing_ = false;
  std::shared_ptr<const SolverSnapshot> snapshot_;
  std::shared_ptr<const EngineComparison> comparison_;
  Choice first_, other_;
  QLabel* words_;
  DifferencePicture* picture_;
  QTimer* later_;
};

}  // namespace transillum::viewer
