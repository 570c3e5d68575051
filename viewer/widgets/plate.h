// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QLabel>

#include "widgets/theme.h"

namespace transillum::viewer {

/// A few words on a dark plate over a picture, which receives all events of the pointer. Hidden at
/// first.
class Plate : public QLabel {
 public:
  explicit Plate(QWidget* picture) : QLabel(picture) {
    setAttribute(Qt::WA_TransparentForMouseEvents);
    setTextFormat(Qt::PlainText);
    QPalette colors = palette();
    colors.setColor(QPalette::Window, theme::scene_background.lighter(140));
    colors.setColor(QPalette::WindowText, theme::on_dark);
    setPalette(colors);
    setAutoFillBackground(true);
    setMargin(5);
    hide();
  }
};

}  // namespace transillum::viewer
