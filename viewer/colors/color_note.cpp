// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "colors/color_note.h"

#include <QFileInfo>
#include <QPushButton>
#include <QVBoxLayout>

#include "transillum/at.h"
#include "widgets/build.h"
#include "widgets/elided.h"
#include "widgets/theme.h"

namespace transillum::viewer {

namespace {

QString text_on_file(const LoadedScene& loaded) {
  if (loaded.description) {
    return ColorNote::tr(
        "Light of an earlier solve. Run (F5) solves it again, for form factors and steps.");
  }
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
  text_ = named("color_note", new ElidedLabel);
  text_->setAlignment(Qt::AlignCenter);
  text_->setWordWrap(true);
  replicas_ = named("solve_with_replicas", new QPushButton(tr("Solve again with replicas")),
                    tr("Set 8 replicas in the solve settings and run: the same number of "
                       "directions, split into 8 rotated sets"));
  QPalette text_palette = text_->palette();
  text_palette.setColor(QPalette::WindowText, theme::on_dark);
  text_->setPalette(text_palette);
  QPalette surroundings = palette();
  surroundings.setColor(QPalette::Window, theme::scene_background.lighter(140));
  setPalette(surroundings);
  setAutoFillBackground(true);
  auto* layout = make_row(this, {10, 5, 10, 5}, 10);
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
  return colors_.missing().isEmpty() ? colors_.note() : colors_.missing();
}

QString ColorNote::text_on_selection() const {
  const PatchId patch = colors_.selection().patch();
  return patch == no_patch
             ? tr("Click a patch to see its numbers.")
             : tr("Patch %1 is selected; click another one to see its values.").arg(patch);
}

void ColorNote::show_note() {
  const bool held = colors_.snapshot() && follows_selection(colors_.quantity());
  QString note = text();
  if (held && note.isEmpty()) {
    note = text_on_selection();
  }
  text_->setWordWrap(!held);
  text_->setText(note);
  replicas_->setVisible(colors_.quantity() == Quantity::error && !colors_.missing().isEmpty() &&
                        colors_.snapshot() && colors_.snapshot()->options.replicas < 2);
  setVisible(!note.isEmpty());
}

KeptRunLabel::KeptRunLabel(const ColorChoice& colors, QWidget* canvas) : Plate(canvas) {
  setObjectName("kept_run_label");
  auto* over = new QVBoxLayout(canvas);
  over->addWidget(this, 0, Qt::AlignHCenter | Qt::AlignTop);
  connect(&colors, &ColorChoice::changed, this, [this, &colors] {
    setVisible(colors.shows_kept_run());
    if (colors.shows_kept_run()) {
      const KeptRun& run = at(colors.kept_runs().all(), colors.kept_runs().first());
      setText(tr("A: %1, while the key is held").arg(run.name));
    }
  });
}

}  // namespace transillum::viewer
