// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QRectF>
#include <QWidget>

#include "colors/color_choice.h"

class QPainter;

namespace transillum::viewer {

/// The labeled color map with a histogram of area over values. Hidden in true color, and while
/// there are no values.
class ColorBar : public QWidget {
  Q_OBJECT

 public:
  explicit ColorBar(const ColorChoice& colors, QWidget* parent = nullptr);

  QSize sizeHint() const override { return {128, 320}; }

 protected:
  void paintEvent(QPaintEvent* event) override;

 private:
  void paint_title(QPainter& painter) const;
  void paint_bar(QPainter& painter, const QRectF& bar) const;
  void paint_histogram(QPainter& painter, const QRectF& box) const;
  void paint_zero(QPainter& painter, const QRectF& box) const;
  void paint_ticks(QPainter& painter, const QRectF& bar) const;

  const ColorChoice& colors_;
};

}  // namespace transillum::viewer
