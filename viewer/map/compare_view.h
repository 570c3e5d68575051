// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QWidget>
#include <memory>

#include "colors/color_choice.h"
#include "model/requests/engine_comparison.h"
#include "state/focus.h"
#include "state/selection.h"
#include "support/newest_result.h"

class QBoxLayout;
class QComboBox;
class QLabel;
class QPushButton;
class QAction;
class QStackedWidget;
class QSpinBox;
class QTableView;
class QTimer;

namespace transillum::viewer {

class DifferencePicture;
class HemicubeView;
class MapCanvas;
class PairPicture;
class PairTable;

/// Two engines on the direction in focus, side by side: map, processor time and transfers of each,
/// maps of their differences by patch and by polygon, and the pairs of patches in which they
/// differ. The maps share one view.
class CompareView : public QWidget {
  Q_OBJECT

 public:
  CompareView(Focus& focus, Selection& selection, const ColorChoice& colors,
              QWidget* parent = nullptr);

  void show_snapshot(std::shared_ptr<const SolverSnapshot> snapshot);
  void clear();
  /// Whether the comparison shown is of the direction in focus and the chosen engines.
  bool up_to_date() const;
  /// Whether the panel is visible and waits for a comparison.
  bool busy() const;
  /// Switches between a large panel, which takes most of the window, and the layout in use.
  QAction* large() const { return large_; }

 signals:
  void enlarged(bool large);

 protected:
  void showEvent(QShowEvent* event) override;

 private:
  struct Choice {
    QComboBox* engine;
    QSpinBox* resolution;
    MapCanvas* map;
    HemicubeView* hemicube;
    QStackedWidget* picture;  ///< holds map and hemicube
    QLabel* values;

    bool is_hemicube() const;
    bool has_directions() const;
    bool up_to_date() const;
    /// The resolution of an EngineRequest: 0 for an engine that has none, an even number for a
    /// hemicube.
    int requested_resolution() const;
  };
  /// Whether the maps show the comparison.
  bool drawn() const;
  Choice make_choice(const char* name, Engine engine);
  QBoxLayout* column_of(const Choice& choice) const;
  /// Moving one of these maps moves the others.
  void link(const std::vector<MapCanvas*>& maps);
  EngineRequest current_request() const;
  void send_request();
  void show_maps();
  void make_large_action();
  QWidget* make_words();
  QTableView* make_list();
  void show_pair(int row);
  /// Selects the receiver and goes to the step where it meets the source.
  void go_to(PatchId receiver, PatchId source);
  PatchId receiver_to_show() const;
  void show_comparison(std::shared_ptr<const EngineComparison> comparison);

  Focus& focus_;
  Selection& selection_;
  const ColorChoice& colors_;
  EngineRequest sent_;  ///< the newest that comparer_ got
  bool comparing_ = false;
  std::shared_ptr<const SolverSnapshot> snapshot_;
  std::shared_ptr<const EngineComparison> comparison_;
  Choice first_, other_;
  QLabel* text_;
  QPushButton* worst_;
  DifferencePicture* difference_;
  PairPicture* by_polygon_;
  PairTable* pairs_;
  QTableView* list_;
  QAction* large_;
  QTimer* request_timer_;
  NewestResult<EngineRequest, EngineComparison> comparer_;
};

}  // namespace transillum::viewer
