// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QObject>
#include <QString>

class QTimer;

namespace transillum::viewer {

class MainWindow;

/// Writes the whole window once all that it shows has settled.
class Screenshot : public QObject {
  Q_OBJECT

 public:
  Screenshot(MainWindow& window, const QString& path);

 signals:
  void done();
  void failed(const QString& message);

 private:
  void look();
  void write();

  MainWindow& window_;
  QString path_;
  QTimer* timer_;
  int settled_looks_ = 0;
};

}  // namespace transillum::viewer
