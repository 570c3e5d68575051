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
class QPushButton;
class QStackedWidget;
class QSpinBox;
class QTimer;

namespace transillum::viewer {

class DifferencePicture;
class HemicubeView;
class MapCanvas;

/// Two engines on the direction in focus, side by side: map, processor time and transfers of each,
/// and a map of where they differ. The maps share one view.
class CompareView : public QWidget {
  Q_OBJECT

 public:
  CompareView(Focus& focus, Selection& selection, const ColorChoice& colors,
              QWidget* parent = nullptr);

  void show_snapshot(std::shared_ptr<const SolverSnapshot> snapshot);
  void clear();
  /// Whether the comparison shown is of the direction in focus and the chosen engines.
  bool up_to_date() const;

 protected:
  void showEvent(QShowEvent* event) override;

 private:
  struct Choice {
    QComboBox* engine;
    QSpinBox* resolution;
    MapCanvas* map;
    HemicubeView* hemicube;
    QStackedWidget* picture;  ///< holds map and hemicube
    QLabel* figures;

    bool is_hemicube() const;
    bool has_directions() const;
    bool up_to_date() const;
    /// As in EngineComparer::Request: 0 for an engine without one; even for a hemicube.
    int requested_resolution() const;
  };
  Choice make_choice(const char* name, Engine engine);
  QBoxLayout* column_of(const Choice& choice) const;
  /// Moving one of these maps moves the others.
  void link(const std::vector<MapCanvas*>& maps);
  EngineComparer::Request current_request() const;
  void send_request();
  void show_maps();
  void go_to_worst();
  void show_comparison(std::shared_ptr<const EngineComparison> comparison);

  Focus& focus_;
  Selection& selection_;
  const ColorChoice& colors_;
  EngineComparer comparer_;
  EngineComparer::Request sent_;  ///< the newest that comparer_ got
  bool comparing_ = false;
  std::shared_ptr<const SolverSnapshot> snapshot_;
  std::shared_ptr<const EngineComparison> comparison_;
  Choice first_, other_;
  QLabel* text_;
  QPushButton* worst_;
  DifferencePicture* difference_;
  QTimer* request_timer_;
};

}  // namespace transillum::viewer
