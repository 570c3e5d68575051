// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "patches/compare_actions.h"

#include <QAbstractSpinBox>
#include <QAction>
#include <QApplication>
#include <QComboBox>
#include <QKeyEvent>
#include <QLineEdit>
#include <QMainWindow>
#include <QMenu>
#include <QStatusBar>

#include "widgets/build.h"

namespace transillum::viewer {

namespace {

constexpr int show_key = Qt::Key_A;

// Letters typed into an input field are not commands.
bool is_text_input(const QWidget* widget) {
  return qobject_cast<const QLineEdit*>(widget) || qobject_cast<const QAbstractSpinBox*>(widget) ||
         qobject_cast<const QComboBox*>(widget);
}

}  // namespace

CompareActions::CompareActions(ColorChoice& colors, const QWidget* window, QObject* parent)
    : QObject(parent), colors_(colors), window_(window) {
  keep_ = make_action(
      this, "keep_run", tr("Keep this run"),
      tr("Keep this result in the list of kept runs as A, to compare other runs with it (K)"),
      Qt::Key_K);
  show_ = new QAction(tr("Show A (hold key A)"), this);
  show_->setObjectName("show_kept_run");
  show_->setCheckable(true);
  difference_ = make_action(this, "show_difference", tr("Color by difference from A"),
                            tr("Color each patch by the difference between the runs (Shift+K)"),
                            QKeySequence("Shift+K"));
  difference_->setIconText(tr("Difference"));  // the panel is narrow
  difference_->setCheckable(true);
  connect(keep_, &QAction::triggered, this, &CompareActions::keep_run);
  connect(show_, &QAction::triggered, &colors_, &ColorChoice::show_kept_run);
  connect(difference_, &QAction::triggered, this, [this](bool checked) {
    colors_.set_quantity(checked ? Quantity::difference : Quantity::radiosity);
  });
  connect(&colors_, &ColorChoice::changed, this, &CompareActions::show_state);
  connect(&colors_, &ColorChoice::fitted, this, &CompareActions::show_state);
  connect(&colors_.kept_runs(), &KeptRuns::changed, this, &CompareActions::show_state);
  qApp->installEventFilter(this);
  show_state();
}

void CompareActions::add_to(QMenu& menu) const { menu.addActions({keep_, show_, difference_}); }

void CompareActions::keep_run() {
  if (!colors_.keep_run()) {
    emit failed(tr("The kept runs would take more than %1 GB of memory: remove some of them first.")
                    .arg(1e-9 * static_cast<double>(KeptRuns::most_bytes)));
  } else if (const auto* main = qobject_cast<const QMainWindow*>(window_)) {
    main->statusBar()->showMessage(
        tr("%1 is kept as A: hold key A to show it; Shift+K colors by the difference")
            .arg(colors_.kept_runs().all().back().name),
        6000);
  }
}

void CompareActions::show_state() {
  enable_if(*keep_, colors_.snapshot() != nullptr, tr("No scene is solved yet"));
  const QString none_kept = tr("No run is kept");
  enable_if(*show_, colors_.run_a() != nullptr, none_kept);
  show_->setChecked(colors_.shows_kept_run());
  enable_if(*difference_, colors_.run_a() != nullptr || difference_->isChecked(), none_kept);
  difference_->setChecked(colors_.quantity() == Quantity::difference);
}

bool CompareActions::eventFilter(QObject* watched, QEvent* event) {
  if (event->type() == QEvent::WindowDeactivate && watched == window_) {
    colors_.show_kept_run(false);  // another window receives the key's release
  } else if (event->type() == QEvent::KeyPress || event->type() == QEvent::KeyRelease) {
    const auto* key = static_cast<QKeyEvent*>(event);
    const auto* widget = qobject_cast<QWidget*>(watched);
    const bool down = event->type() == QEvent::KeyPress;
    const bool applies = key->key() == show_key && !key->isAutoRepeat() && widget &&
                         widget->window() == window_ && !is_text_input(widget);
    if (applies && (!down || key->modifiers() == Qt::NoModifier)) {
      colors_.show_kept_run(down);
    }
  }
  return QObject::eventFilter(watched, event);
}

}  // namespace transillum::viewer
