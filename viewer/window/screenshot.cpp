// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "window/screenshot.h"

#include <QPixmap>
#include <QSaveFile>
#include <QTimer>

#include "window/main_window.h"

namespace transillum::viewer {

Screenshot::Screenshot(MainWindow& window, const QString& path) : window_(window), path_(path) {
  timer_ = new QTimer(this);
  connect(timer_, &QTimer::timeout, this, &Screenshot::look);
  timer_->start(50);
}

void Screenshot::look() {
  // Several looks in a row: a view may only just be about to ask for a new picture.
  settled_looks_ = window_.settled() ? settled_looks_ + 1 : 0;
  if (settled_looks_ < 4) {
    return;
  }
  timer_->stop();
  write();
}

void Screenshot::write() {
  const QPixmap picture = window_.grab();
  // A temporary neighbor, renamed: the file is there whole or not at all.
  QSaveFile file(path_);
  if (!file.open(QIODevice::WriteOnly) || !picture.save(&file, "PNG") || !file.commit()) {
    emit failed(tr("%1: %2").arg(path_, file.errorString()));
    return;
  }
  emit done();
}

}  // namespace transillum::viewer
