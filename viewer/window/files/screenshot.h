// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QObject>
#include <QString>
#include <functional>

class QTimer;
class QWidget;

namespace transillum::viewer {

/// Writes a picture of a window once all that it shows is up to date.
class Screenshot : public QObject {
  Q_OBJECT

 public:
  /// @param settled whether every view shows the newest state
  /// @param path of the PNG file, written whole or not at all
  Screenshot(QWidget& window, std::function<bool()> settled, const QString& path);

 signals:
  void done();
  void failed(const QString& message);

 private:
  void check();
  void write();

  QWidget& window_;
  std::function<bool()> settled_;
  QString path_;
  QTimer* timer_;
  int settled_checks_ = 0;
};

}  // namespace transillum::viewer
