// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QToolButton>

#include "map/map_picture.h"

class QActionGroup;

namespace transillum::viewer {

/// A button with the menu of what the map shows: the exact V, or that of another engine.
class PixelMenu : public QToolButton {
  Q_OBJECT

 public:
  explicit PixelMenu(QWidget* parent = nullptr);

  const PixelChoice& choice() const { return choice_; }

 signals:
  void changed();

 private:
  void add_engines(QMenu& menu);
  void add_resolutions(QMenu& menu);
  void change(const PixelChoice& choice);

  PixelChoice choice_;
  QActionGroup* resolutions_;
  QAction* differences_;
};

}  // namespace transillum::viewer
