// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "window/files/thumbnails.h"

#include <QCryptographicHash>
#include <QDir>
#include <QFileInfo>
#include <QImage>
#include <QMainWindow>
#include <QStandardPaths>
#include <utility>

#include "scene/scene_page.h"
#include "scene/scene_view.h"

namespace transillum::viewer {

namespace {

constexpr QSize thumbnail_size(186, 120);

}  // namespace

Thumbnails::Thumbnails(const WindowFrame& frame, const QString& folder,
                       std::function<bool()> in_lesson)
    : QObject(&frame.window), frame_(frame), folder_(folder), in_lesson_(std::move(in_lesson)) {
  connect(&frame_.state.scene, &OpenScene::opening, this, &Thumbnails::save);
  connect(&frame_.state.runner, &SolveRunner::state_changed, this, [this](RunState state) {
    if (state == RunState::finished) {
      save();
    }
  });
}

QString Thumbnails::usual_folder() {
  return QStandardPaths::writableLocation(QStandardPaths::CacheLocation) +
         QStringLiteral("/thumbnails");
}

QString Thumbnails::file_for(const QString& path) const {
  const QByteArray name = QCryptographicHash::hash(QFileInfo(path).absoluteFilePath().toUtf8(),
                                                   QCryptographicHash::Sha1)
                              .toHex();
  return QStringLiteral("%1/%2.png").arg(folder_, QString::fromLatin1(name));
}

QPixmap Thumbnails::picture_of(const QString& path) const { return QPixmap(file_for(path)); }

// A picture that cannot be saved is no loss: the next solve makes another.
void Thumbnails::save() {
  const QString spec = QString::fromStdString(frame_.state.scene.spec());
  if (spec.isEmpty() || in_lesson_() || frame_.page.shows_start() ||
      !frame_.state.scene.snapshot() || !QFileInfo(spec).isFile()) {
    return;
  }
  QDir().mkpath(folder_);
  frame_.page.scene_view()
      ->picture(1)
      .scaled(thumbnail_size, Qt::KeepAspectRatioByExpanding, Qt::SmoothTransformation)
      .save(file_for(spec), "PNG");
}

}  // namespace transillum::viewer
