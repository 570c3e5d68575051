// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QPointF>
#include <QWidget>
#include <memory>
#include <optional>
#include <vector>

#include "colors/color_choice.h"
#include "model/requests/per_direction_visibility.h"
#include "model/snapshot.h"
#include "state/focus.h"
#include "state/selection.h"

namespace transillum::viewer {

/// The sphere of directions. It shows the directions that the current iteration has processed so
/// far, colored by what the selected patch receives along each. Dragging rotates it; a click on a
/// point moves the focus to that direction.
class DirectionView : public QWidget {
  Q_OBJECT

 public:
  /// @param visibility shared with other views of the selected patch
  DirectionView(Focus& focus, Selection& selection, const ColorChoice& colors,
                PerDirectionVisibility& visibility, QWidget* parent = nullptr);

  void show_snapshot(std::shared_ptr<const SolverSnapshot> snapshot);
  void clear();
  /// Whether all points are colored for the selected patch.
  bool up_to_date() const { return !needs_visibility() || visibility_.complete(); }

  /// A direction of the run as a point of the sphere.
  struct Point {
    Vec3 omega;
    int pass;       ///< from 0
    bool opposite;  ///< -omega of a two-way pass
  };
  /// The points shown.
  std::vector<Point> points() const;
  /// Contribution of each point to the irradiance of the selected patch (luminance), W/m²; shorter
  /// than points() while visibility is being computed, empty without a selected patch.
  std::vector<double> received() const;

  QSize sizeHint() const override { return {420, 340}; }
  QSize minimumSizeHint() const override { return {220, 128}; }

 protected:
  void paintEvent(QPaintEvent* event) override;
  void mousePressEvent(QMouseEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;
  void mouseReleaseEvent(QMouseEvent* event) override;
  void showEvent(QShowEvent* event) override;

 private:
  bool needs_visibility() const;
  void request_visibility();
  Vec3 rotated(const Vec3& direction) const;
  /// In the widget.
  QPointF position_of(const Vec3& rotated) const;
  QString caption() const;
  QRectF caption_rect() const;
  QRectF sphere_rect() const;
  double legend_height() const;
  double radius() const;
  QPointF center() const;
  void draw_sphere(QPainter& painter) const;
  void draw_points(QPainter& painter, bool front) const;
  void draw_normal(QPainter& painter) const;
  void draw_focus(QPainter& painter) const;
  void draw_legend(QPainter& painter) const;
  std::optional<Point> point_at(const QPointF& where) const;
  /// The iteration shown: the one in focus where each has its own directions, else the newest.
  int iteration() const;
  const std::vector<Vec3>& directions() const { return *snapshot_->directions_of(iteration()); }
  /// Directions of iteration() that have been processed.
  int directions_done() const;

  Focus& focus_;
  Selection& selection_;
  const ColorChoice& colors_;
  PerDirectionVisibility& visibility_;
  std::shared_ptr<const SolverSnapshot> snapshot_;
  Vec3 right_{1, 0, 0}, up_{0, 1, 0}, toward_{0, 0, 1};  ///< the scene's first view
  double turn_ = 0, tilt_ = 0;  ///< from there, radians: about the upright axis, then over
  QPointF pressed_, last_;
  bool dragged_ = false;
};

}  // namespace transillum::viewer
