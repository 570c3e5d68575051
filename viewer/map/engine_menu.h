// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QToolButton>

#include "map/map_picture.h"

class QActionGroup;

namespace transillum::viewer {

/// A button with a menu that chooses the V that the map shows (the exact V, or the V of another
/// engine), its resolution and whether errors are marked.
class EngineMenu : public QToolButton {
  Q_OBJECT

 public:
  explicit EngineMenu(QWidget* parent = nullptr);

  const MapEngineChoice& choice() const { return choice_; }

 signals:
  void changed();

 private:
  void add_engines(QMenu& menu);
  void add_resolutions(QMenu& menu);
  void change(const MapEngineChoice& choice);

  MapEngineChoice choice_;
  QActionGroup* resolutions_;
  QAction* differences_;
};

}  // namespace transillum::viewer
