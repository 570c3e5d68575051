// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// The tab "Errors" of the panel "Surfaces". A measurement takes several times as long as the solve,
// so that it begins only when the user asks; a solve that has not finished is finished first.
#include "patches/error_page.h"

#include <QLabel>
#include <QMenu>
#include <QProgressBar>
#include <QPushButton>
#include <QTabWidget>
#include <QToolButton>
#include <algorithm>
#include <utility>

#include "io/results/error_report_files.h"
#include "model/snapshot_values.h"
#include "patches/table_rows.h"
#include "support/number_text.h"
#include "transillum/at.h"
#include "widgets/build.h"
#include "widgets/elided.h"

namespace transillum::viewer {

namespace {

constexpr int total_column = 1;

QString text_of(const NextStep& step) {
  constexpr int longest_name = 24;
  NextStep shown = step;
  shown.surface = elided_name(QString::fromStdString(step.surface), longest_name).toStdString();
  return capitalized(QString::fromStdString(step_text(shown)));
}

}  // namespace

ErrorPage::ErrorPage(ColorChoice& colors, QTabWidget& tabs)
    : QObject(&tabs),
      colors_(colors),
      page_(add_table_page(
          tabs, tr("Errors"), "error_table",
          {QStringLiteral("material"), QStringLiteral("88.88"), QStringLiteral("88.88"),
           QStringLiteral("88.88"), QStringLiteral("88.88"), QStringLiteral("88.88")})),
      measuring_(
          *this,
          [this](const Job& job, const Cancellation& cancellation) {
            return measure_and_report(job, cancellation);
          },
          [this](const Job&, std::shared_ptr<const MeasuredErrors> errors, const QString& error) {
            if (errors) {
              colors_.set_errors(std::move(errors));
            } else {
              emit failed(error);
            }
            show_errors();
          }) {
  page_.view->sortByColumn(total_column, Qt::DescendingOrder);
  page_.view->setMinimumHeight(36);  // for small screens: the foot needs its height
  widget()->layout()->addWidget(make_foot());
  show_errors();
}

QWidget* ErrorPage::make_foot() {
  auto* foot = new QWidget;
  total_ = named("error_total", new ElidedLabel);
  set_strong(*total_);
  step_ = named("error_step", new QToolButton);
  step_->setToolButtonStyle(Qt::ToolButtonTextOnly);
  step_->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Fixed);
  steps_ = new QMenu(step_);
  measure_ = named("measure_surfaces", new QPushButton);
  save_ = named("save_errors", new QPushButton(tr("Save…")),
                tr("Write the report as a page (HTML) or as JSON"));
  progress_ = named("error_progress", new QProgressBar);
  progress_->setRange(0, 100);
  progress_->setTextVisible(false);
  progress_->setFixedHeight(8);
  auto* row = make_row({}, 8);
  row->addWidget(measure_);
  row->addWidget(progress_, 1);
  row->addStretch();
  row->addWidget(save_);
  auto* layout = make_column(foot, {10, 3, 8, 3}, 3);
  layout->addWidget(total_);
  layout->addWidget(step_);
  layout->addLayout(row);
  connect(measure_, &QPushButton::clicked, this, &ErrorPage::start_or_cancel);
  connect(save_, &QPushButton::clicked, this, &ErrorPage::save_wanted);
  return foot;
}

std::shared_ptr<const MeasuredErrors> ErrorPage::errors() const {
  const auto& newest = colors_.errors();
  return newest && snapshot_ && newest->are_of(*snapshot_) ? newest : nullptr;
}

void ErrorPage::show_snapshot(std::shared_ptr<const SolverSnapshot> snapshot) {
  const bool same_scene = snapshot_ && snapshot_->loaded == snapshot->loaded;
  snapshot_ = std::move(snapshot);
  if (busy() && !same_scene) {
    cancel();
  }
  if (!wanted_.empty() && wanted_ != snapshot_->loaded->scene->name()) {
    wanted_.clear();
  }
  start_if_wanted();
  show_errors();
}

void ErrorPage::show_state(RunState state) {
  state_ = state;
  if (busy() && state == RunState::running) {
    cancel();  // a new solve
  }
  start_if_wanted();
  show_buttons();
}

void ErrorPage::start_or_cancel() {
  if (busy() || !wanted_.empty()) {
    cancel();
  } else {
    wanted_ = snapshot_->loaded->scene->name();
    start_if_wanted();
    if (!busy()) {
      emit solve_wanted();
    }
  }
  show_errors();
}

void ErrorPage::start_if_wanted() {
  const bool solved = state_ == RunState::finished && snapshot_ && snapshot_->progress.finished &&
                      !snapshot_->materials;
  if (!wanted_.empty() && solved) {
    wanted_.clear();
    progress_->setValue(0);
    measuring_.request({snapshot_, ++number_});
  }
}

void ErrorPage::cancel() {
  wanted_.clear();
  ++number_;
  measuring_.clear();
}

MeasuredErrors ErrorPage::measure_and_report(const Job& job, const Cancellation& cancellation) {
  return measure(*job.snapshot, cancellation, by_percent([&](Measurement what, int percent) {
    QMetaObject::invokeMethod(
        this, [this, number = job.number, what, percent] { show_progress(number, what, percent); },
        Qt::QueuedConnection);
  }));
}

void ErrorPage::show_progress(int number, Measurement what, int percent) {
  if (busy() && number == number_) {
    page_.caption->setText(viewer::text_of(what) + QStringLiteral("…"));
    progress_->setValue(percent);
  }
}

void ErrorPage::show_errors() {
  const auto errors = this->errors();
  if (errors != shown_ || !errors) {
    shown_ = errors;
    PatchRows rows = errors ? rows_of_errors(errors->report) : PatchRows{};
    page_.table->set_contents(std::move(rows.patches), std::move(rows.columns));
    show_steps(errors ? errors->report : ErrorReport{});
  }
  page_.caption->setText(caption());
  show_buttons();
}

/// The first step is the button's; its menu has all.
void ErrorPage::show_steps(const ErrorReport& report) {
  if (report.worst >= 0) {
    total_->setText(tr("In all, at most %1 (%2)")
                        .arg(QString::fromStdString(error_percentage(report.total())),
                             QString::fromStdString(at(report.surfaces, report.worst).name)));
  }
  step_->setVisible(!report.steps.empty());
  steps_->clear();
  for (const NextStep& step : report.steps) {
    auto* action = steps_->addAction(text_of(step), this, [this, step] { emit step_chosen(step); });
    action->setToolTip(
        tr("%1\nSolves again: number of patches or passes, time, and the error of the worst "
           "surface before and after")
            .arg(QString::fromStdString(step_text(step))));
  }
  const QList<QAction*> actions = steps_->actions();
  step_->setDefaultAction(actions.isEmpty() ? nullptr : actions.front());
  step_->setMenu(actions.size() > 1 ? steps_ : nullptr);
  step_->setPopupMode(actions.size() > 1 ? QToolButton::MenuButtonPopup
                                         : QToolButton::DelayedPopup);
}

void ErrorPage::show_buttons() {
  const bool works = busy() || !wanted_.empty();
  measure_->setText(works ? tr("Cancel") : errors() ? tr("Measure again") : tr("Measure"));
  const bool ready = snapshot_ && state_ != RunState::empty && state_ != RunState::loading &&
                     why_not_measurable(*snapshot_).isEmpty();
  enable_if(*measure_, works || ready,
            snapshot_ ? why_not_measurable(*snapshot_) : tr("No scene is open"));
  progress_->setVisible(busy());
  total_->setVisible(!busy() && shown_ && shown_->report.worst >= 0);
  enable_if(*save_, !works && errors(), tr("No errors have been measured"));
  enable_if(*step_, !works, tr("Errors are being measured"));
}

QString ErrorPage::caption() const {
  if (!snapshot_) {
    return tr("Open a scene to measure how wrong its result is.");
  }
  if (const QString reason = why_not_measurable(*snapshot_); !reason.isEmpty()) {
    return tr("%1.").arg(reason);
  }
  if (busy()) {
    return tr("Measuring…");
  }
  if (!wanted_.empty()) {
    return tr("Solving first; then the errors are measured.");
  }
  if (const auto errors = this->errors()) {
    return tr("In percent of reflected light. Measured in %1.")
        .arg(duration_text(errors->report.measurements.seconds));
  }
  return tr(
      "How wrong is it? Measures the error of each surface by too few directions, too large "
      "patches, too few iterations and the method, and names the step that helps most. It takes "
      "about six times as long as the solve.");
}

}  // namespace transillum::viewer
