// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QWidget>
#include <functional>
#include <vector>

#include "state/focus.h"
#include "state/selection.h"

namespace transillum::viewer {

/// A run in three lanes: its iterations, the directions of one iteration, the steps of one
/// direction. A click or drag moves the focus; with Shift held, one pixel is one index of the lane.
class TimelineLanes : public QWidget {
  Q_OBJECT

 public:
  TimelineLanes(Focus& focus, Selection& selection, QWidget* parent = nullptr);

  enum class Lane { iterations, directions, steps };
  /// The rectangle of a lane, in logical pixels.
  QRectF rect_of(Lane lane) const;
  /// The x coordinate of index `k` of `count` on a lane, and back.
  static double position(const QRectF& lane, int k, int count);
  static int index(const QRectF& lane, double x, int count);

  /// Returns the steps to mark in the lane of steps; called with each history shown.
  using Marks = std::function<std::vector<std::int32_t>(const MapHistory&)>;
  void set_marks(Marks marks);
  /// Recomputes the columns; to be called when the result of the marks function has changed.
  void count_columns();
  /// Shows the lane of steps alone.
  void set_thin(bool thin);
  /// Number of directions of the newest iteration that are done.
  void set_progress(int iteration, int directions);

  QSize sizeHint() const override { return {900, 84}; }
  QSize minimumSizeHint() const override;

 protected:
  void paintEvent(QPaintEvent* event) override;
  void resizeEvent(QResizeEvent* event) override;
  void mousePressEvent(QMouseEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;
  void mouseReleaseEvent(QMouseEvent* event) override;
  void keyPressEvent(QKeyEvent* event) override;

 private:
  /// Totals of the steps in one pixel column.
  struct Column {
    int cuts = 0, exchanges = 0;
    bool selected = false, marked = false;
  };
  void scrub(double x);
  void draw_lane(QPainter& painter, Lane lane, const QString& name, int at, int count,
                 const QString& value) const;
  void draw_columns(QPainter& painter) const;
  double value_width() const;
  const RunPosition& position_shown() const;
  int count_of(Lane lane) const;
  int index_at(Lane lane) const;

  Focus& focus_;
  Selection& selection_;
  Marks marks_;
  int done_iteration_ = 0, done_directions_ = 0;
  std::shared_ptr<const RecordedMap> counted_;  ///< the map that columns_ are of
  std::vector<Column> columns_;
  bool thin_ = false;
  bool scrubbing_ = false;
  Lane scrubbed_ = Lane::steps;
  double press_x_ = 0;
  int press_index_ = 0;
};

}  // namespace transillum::viewer
