// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "window/files/screenshot.h"

#include <QPixmap>
#include <QSaveFile>
#include <QTimer>
#include <QWidget>
#include <utility>

namespace transillum::viewer {

Screenshot::Screenshot(QWidget& window, std::function<bool()> settled, const QString& path)
    : window_(window), settled_(std::move(settled)), path_(path) {
  timer_ = new QTimer(this);
  connect(timer_, &QTimer::timeout, this, &Screenshot::check);
  timer_->start(50);
}

void Screenshot::check() {
  // Several checks in a row: a view may be about to request a new picture.
  constexpr int enough_checks = 4;
  settled_checks_ = settled_() ? settled_checks_ + 1 : 0;
  if (settled_checks_ < enough_checks) {
    return;
  }
  timer_->stop();
  write();
}

void Screenshot::write() {
  const QPixmap picture = window_.grab();
  QSaveFile file(path_);
  if (!file.open(QIODevice::WriteOnly) || !picture.save(&file, "PNG") || !file.commit()) {
    emit failed(tr("%1: %2").arg(path_, file.errorString()));
    return;
  }
  emit done();
}

}  // namespace transillum::viewer
