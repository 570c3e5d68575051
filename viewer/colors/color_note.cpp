// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "colors/color_note.h"

#include <QFileInfo>
#include <QHBoxLayout>
#include <QLabel>
#include <QPushButton>

#include "widgets/theme.h"

namespace transillum::viewer {

namespace {

QString words_on_file(const LoadedScene& loaded) {
  const QString name = QFileInfo(QString::fromStdString(loaded.file)).fileName();
  return loaded.stored->complete
             ? ColorNote::tr("Figures of the file %1. Run (F5) solves its scene from zero.")
                   .arg(name)
             : ColorNote::tr(
                   "Figures of the file %1, of a solve that was stopped early. Run (F5) "
                   "solves its scene from zero.")
                   .arg(name);
}

}  // namespace

ColorNote::ColorNote(const ColorChoice& colors, QWidget* parent) : QFrame(parent), colors_(colors) {
  words_ = new QLabel;
  words_->setObjectName("color_note");
  words_->setAlignment(Qt::AlignCenter);
  words_->setWordWrap(true);
  replicas_ = new QPushButton(tr("Solve anew with replicas"));
  replicas_->setObjectName("solve_with_replicas");
  replicas_->setToolTip(
      tr("Sets 8 replicas in the solve settings and runs: the same number of directions, as 8 sets "
         "each turned by a rotation of its own"));
  QPalette words = words_->palette();
  words.setColor(QPalette::WindowText, theme::on_dark);
  words_->setPalette(words);
  QPalette surroundings = palette();
  surroundings.setColor(QPalette::Window, theme::scene_background.lighter(140));
  setPalette(surroundings);
  setAutoFillBackground(true);
  auto* layout = new QHBoxLayout(this);
  layout->setContentsMargins(10, 5, 10, 5);
  layout->setSpacing(10);
  layout->addWidget(words_, 1);
  layout->addWidget(replicas_);
  connect(replicas_, &QPushButton::clicked, this, &ColorNote::replicas_requested);
  connect(&colors_, &ColorChoice::changed, this, &ColorNote::show_note);
  connect(&colors_, &ColorChoice::fitted, this, &ColorNote::show_note);
  hide();
}

QString ColorNote::words() const {
  const auto snapshot = colors_.snapshot();
  if (snapshot && snapshot->of_file && colors_.missing().isEmpty()) {
    return words_on_file(*snapshot->loaded);
  }
  return colors_.missing();
}

void ColorNote::show_note() {
  const QString note = words();
  words_->setText(note);
  replicas_->setVisible(colors_.quantity() == Quantity::error && !colors_.missing().isEmpty() &&
                        colors_.snapshot() && colors_.snapshot()->options.replicas < 2);
  setVisible(!note.isEmpty());
}

}  // namespace transillum::viewer
