// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QColor>
#include <QString>
#include <QWidget>
#include <functional>

namespace transillum::viewer {

/// A color bar with its range as text, below a picture.
class ColorLegend : public QWidget {
 public:
  /// @param color of a place on the bar, 0 to 1
  ColorLegend(std::function<QColor(double)> color, const QString& range);

 protected:
  void paintEvent(QPaintEvent* event) override;

 private:
  std::function<QColor(double)> color_;
  QString range_;
};

}  // namespace transillum::viewer
