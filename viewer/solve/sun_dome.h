// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QPointF>
#include <QWidget>
#include <vector>

#include "transillum/sun.h"

namespace transillum::viewer {

/// The sky seen from above, north at the top: the zenith is the center, the horizon the rim. The
/// sun is a handle, dragged with the mouse or moved with the arrow keys by 1°, with Shift by 10°.
class SunDome : public QWidget {
  Q_OBJECT

 public:
  explicit SunDome(QWidget* parent = nullptr);

  const SolarPosition& position() const { return position_; }
  /// Emits nothing.
  void set_position(const SolarPosition& position);
  /// Draws the way of the sun through a day; empty for none. Parts below the horizon are omitted.
  void set_path(std::vector<SolarPosition> path);
  /// The place of a position in the widget, px; below the horizon outside of the rim.
  QPointF place_of(const SolarPosition& position) const;

  QSize sizeHint() const override { return {180, 150}; }
  QSize minimumSizeHint() const override { return {120, 120}; }

 signals:
  /// The user has moved the sun.
  void moved(const transillum::SolarPosition& position);

 protected:
  void paintEvent(QPaintEvent* event) override;
  void mousePressEvent(QMouseEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;
  void keyPressEvent(QKeyEvent* event) override;

 private:
  QPointF center() const { return {width() / 2.0, height() / 2.0}; }
  double radius() const;
  void drag_to(const QPointF& place);
  void move_to(const SolarPosition& position);

  SolarPosition position_{180, 45};
  std::vector<SolarPosition> path_;
};

}  // namespace transillum::viewer
