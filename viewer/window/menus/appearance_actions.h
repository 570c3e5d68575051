// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QObject>

class QAction;
class QMenu;
class QSettings;

namespace transillum::viewer {

/// Dark or light colors, and projector mode: larger type, thicker lines, more contrast.
class AppearanceActions : public QObject {
  Q_OBJECT

 public:
  explicit AppearanceActions(QObject* parent = nullptr);

  void add_to(QMenu& menu) const;
  /// Whether projector mode is on.
  bool projects() const;
  void set_projects(bool projects);
  void save(QSettings& settings) const;
  void load(const QSettings& settings);

 signals:
  /// The appearance has changed: views that paint with theme colors must repaint.
  void changed();

 private:
  void apply();

  QAction *dark_, *projector_;
};

}  // namespace transillum::viewer
