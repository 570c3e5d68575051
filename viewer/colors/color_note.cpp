// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "colors/color_note.h"

#include <QFileInfo>
#include <QHBoxLayout>
#include <QLabel>
#include <QPushButton>

#include "widgets/theme.h"

namespace transillum::viewer {

namespace {

QString text_on_file(const LoadedScene& loaded) {
  const QString name = QFileInfo(QString::fromStdString(loaded.file)).fileName();
  return loaded.stored->complete
             ? ColorNote::tr("Values from the file %1. Run (F5) solves its scene from the start.")
                   .arg(name)
             : ColorNote::tr(
                   "Values from the file %1, written by a solve run that was stopped early. "
                   "Run (F5) solves its scene from the start.")
                   .arg(name);
}

}  // namespace

ColorNote::ColorNote(const ColorChoice& colors, QWidget* parent) : QFrame(parent), colors_(colors) {
  text_ = new QLabel;
  text_->setObjectName("color_note");
  text_->setAlignment(Qt::AlignCenter);
  text_->setWordWrap(true);
  replicas_ = new QPushButton(tr("Solve again with replicas"));
  replicas_->setObjectName("solve_with_replicas");
  replicas_->setToolTip(tr(
      "Set 8 replicas in the solve settings and run: the same number of directions, split into 8 "
      "rotated sets"));
  QPalette text_palette = text_->palette();
  text_palette.setColor(QPalette::WindowText, theme::on_dark);
  text_->setPalette(text_palette);
  QPalette surroundings = palette();
  surroundings.setColor(QPalette::Window, theme::scene_background.lighter(140));
  setPalette(surroundings);
  setAutoFillBackground(true);
  auto* layout = new QHBoxLayout(this);
  layout->setContentsMargins(10, 5, 10, 5);
  layout->setSpacing(10);
  layout->addWidget(text_, 1);
  layout->addWidget(replicas_);
  connect(replicas_, &QPushButton::clicked, this, &ColorNote::replicas_requested);
  connect(&colors_, &ColorChoice::changed, this, &ColorNote::show_note);
  connect(&colors_, &ColorChoice::fitted, this, &ColorNote::show_note);
  hide();
}

QString ColorNote::text() const {
  const auto snapshot = colors_.snapshot();
  if (snapshot && snapshot->of_file && colors_.missing().isEmpty()) {
    return text_on_file(*snapshot->loaded);
  }
  return colors_.missing();
}

void ColorNote::show_note() {
  const QString note = text();
  text_->setText(note);
  replicas_->setVisible(colors_.quantity() == Quantity::error && !colors_.missing().isEmpty() &&
                        colors_.snapshot() && colors_.snapshot()->options.replicas < 2);
  setVisible(!note.isEmpty());
}

}  // namespace transillum::viewer
