// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QFrame>

#include "colors/color_choice.h"

class QLabel;
class QPushButton;

namespace transillum::viewer {

/// A line above the scene: why there are no colors, what brings them, and whose figures they are
/// where they are not the run's. Hidden where there is nothing to tell.
class ColorNote : public QFrame {
  Q_OBJECT

 public:
  explicit ColorNote(const ColorChoice& colors, QWidget* parent = nullptr);

 signals:
  void replicas_requested();

 private:
  void show_note();
  QString words() const;

  const ColorChoice& colors_;
  QLabel* words_;
  QPushButton* replicas_;  ///< what the error estimate wants
};

}  // namespace transillum::viewer
