// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Messages above and over the picture of the scene.
#pragma once

#include <QFrame>

#include "colors/color_choice.h"
#include "widgets/plate.h"

class QPushButton;

namespace transillum::viewer {

class ElidedLabel;

/// A line above the scene. It says why there are no values and how to get them, what they
/// omit, or that they are from a result file. Hidden without a message, except for quantities that
/// depend on the selection: it then is one line all the time, so that selecting moves no picture.
class ColorNote : public QFrame {
  Q_OBJECT

 public:
  explicit ColorNote(const ColorChoice& colors, QWidget* parent = nullptr);

 signals:
  void replicas_requested();

 private:
  void show_note();
  QString text() const;
  QString text_on_selection() const;

  const ColorChoice& colors_;
  ElidedLabel* text_;
  QPushButton* replicas_;  ///< shown if the error estimate needs replicas
};

/// A label over the picture while it shows the kept run. It is an overlay, so that both runs are
/// shown at the same place.
class KeptRunLabel : public Plate {
  Q_OBJECT

 public:
  KeptRunLabel(const ColorChoice& colors, QWidget* canvas);
};

}  // namespace transillum::viewer
