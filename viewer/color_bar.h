// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QWidget>

#include "color_choice.h"

namespace transillum::viewer {

/// The labelled bar of the colour map; not there in true colour.
class ColorBar : public QWidget {
  Q_OBJECT

 public:
  explicit ColorBar(const ColorChoice& colors, QWidget* parent = nullptr);

  QSize sizeHint() const override { return {96, 320}; }

 protected:
  void paintEvent(QPaintEvent* event) override;

 private:
  const ColorChoice& colors_;
};

}  // namespace transillum::viewer
