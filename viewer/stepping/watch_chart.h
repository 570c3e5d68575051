// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QWidget>
#include <memory>
#include <vector>

#include "state/focus.h"
#include "state/selection.h"
#include "state/watches.h"

class QAction;
class QMenu;
class QToolButton;

namespace transillum::viewer {

class TimelineLanes;

/// Lines of the watched values over the steps of the direction, below the lane of steps, each on
/// its own scale. Above them, or beside them in a low window, is a button for each, which shows the
/// value and removes the line. Hidden without watches.
class WatchChart : public QWidget {
  Q_OBJECT

 public:
  /// @param lanes above the chart, as wide as it is
  WatchChart(Focus& focus, Selection& selection, Watches& watches, const TimelineLanes& lanes,
             QWidget* parent = nullptr);
  ~WatchChart() override;

  /// A menu of the values that can be watched.
  QMenu* menu() const { return menu_.get(); }
  /// The plot, and the height in it of a value of watch k.
  QRectF plot() const;
  double height_of(std::size_t k, double value) const;
  /// The color of watch k in the current appearance.
  static QColor color_of(std::size_t k);

  /// The plot is lower where the panels of a small screen leave no more room.
  QSize minimumSizeHint() const override;
  QSize sizeHint() const override;

 protected:
  void paintEvent(QPaintEvent* event) override;
  void resizeEvent(QResizeEvent* event) override;
  void changeEvent(QEvent* event) override;
  void mousePressEvent(QMouseEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;

 private:
  struct Series {
    Watch watch;
    std::vector<double> values;
    double largest = 0;  ///< the largest value
    QToolButton* button;
  };
  void make_menu();
  void show_list();
  void compute();
  void show_values();
  int button_height() const;
  /// Whether the chart is too low for buttons above the plot.
  bool is_low() const;
  void place_buttons();
  void draw(QPainter& painter, std::size_t k) const;
  void go_to(double x);

  Focus& focus_;
  Selection& selection_;
  Watches& watches_;
  const TimelineLanes& lanes_;
  std::unique_ptr<QMenu> menu_;
  std::vector<QAction*> choices_;
  std::vector<Series> series_;
  std::shared_ptr<const RecordedMap> computed_;  ///< the map that series_ is of
};

}  // namespace transillum::viewer
