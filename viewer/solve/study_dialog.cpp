// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// The dialog "Study". A StudyRunner computes on its own thread and posts snapshots; this
// dialog shows the newest one as plot, table and progress.
#include "solve/study_dialog.h"

#include <QComboBox>
#include <QFileInfo>
#include <QGuiApplication>
#include <QHeaderView>
#include <QLabel>
#include <QProgressBar>
#include <QPushButton>
#include <QScreen>
#include <QTableWidget>
#include <cmath>
#include <utility>

#include "io/drawing/study_chart.h"
#include "io/results/study_csv.h"
#include "model/material_edits.h"
#include "solve/study_chart.h"
#include "solve/study_choices.h"
#include "support/failure_text.h"
#include "support/number_text.h"
#include "transillum/files.h"
#include "widgets/banner.h"
#include "widgets/build.h"
#include "widgets/dialogs.h"
#include "widgets/scrolling.h"

namespace transillum::viewer {

namespace {

constexpr int controls_width = 276;

QString cost_text(const std::optional<StudyCost>& cost, StudyAxis axis) {
  if (!cost) {
    return QStringLiteral("–");
  }
  const QString text = axis == StudyAxis::passes ? count_text(std::llround(cost->passes))
                                                 : number_text(cost->seconds);
  return cost->at_most ? StudyDialog::tr("≤ %1").arg(text) : text;
}

QStringList headings(StudyAxis axis) {
  const bool passes = axis == StudyAxis::passes;
  return {StudyDialog::tr("Series"), StudyDialog::tr("Slope"),
          passes ? StudyDialog::tr("Passes for 1 %") : StudyDialog::tr("Seconds for 1 %"),
          passes ? StudyDialog::tr("Passes for 0.1 %") : StudyDialog::tr("Seconds for 0.1 %")};
}

Qt::Alignment alignment_of(int column) {
  return (column == 0 ? Qt::AlignLeft : Qt::AlignRight) | Qt::AlignVCenter;
}

QTableWidget* make_table() {
  const QStringList names = headings(StudyAxis::passes);
  auto* table = named("study_table", new QTableWidget(0, names.size()));
  for (int column = 0; column < names.size(); ++column) {
    auto* item = new QTableWidgetItem(names[column]);
    item->setTextAlignment(alignment_of(column));
    table->setHorizontalHeaderItem(column, item);
  }
  table->setEditTriggers(QAbstractItemView::NoEditTriggers);
  table->setSelectionBehavior(QAbstractItemView::SelectRows);
  table->verticalHeader()->hide();
  table->verticalHeader()->setDefaultSectionSize(table->fontMetrics().height() + 8);
  QHeaderView* header = table->horizontalHeader();
  header->setHighlightSections(false);
  header->setDefaultSectionSize(140);
  header->setSectionResizeMode(0, QHeaderView::Stretch);
  return table;
}

}  // namespace

StudyDialog::StudyDialog(const std::filesystem::path& cache, const MaterialEdits& edits,
                         QWidget* parent)
    : QDialog(parent), edits_(edits), runner_(cache) {
  setWindowTitle(tr("Study of directions – transillum"));
  setWindowFlags(windowFlags() | Qt::WindowMaximizeButtonHint);
  banner_ = new Banner;
  auto* row = make_row({12, 12, 12, 12}, 12);
  row->addWidget(make_controls());
  row->addWidget(make_results(), 1);
  auto* layout = make_column(this, {}, 0);
  layout->addWidget(banner_);
  layout->addLayout(row, 1);
  const QSize room = QGuiApplication::primaryScreen()->availableSize() - QSize(16, 48);  // a frame
  resize(QSize(1180, 760).boundedTo(room));
  connect(&edits_, &MaterialEdits::changed, this, &StudyDialog::show_buttons);
  connect(&runner_, &StudyRunner::snapshot_ready, this, &StudyDialog::show_snapshot);
  connect(&runner_, &StudyRunner::failed, this,
          [this](const QString& message) { banner_->show_message(Banner::Kind::error, message); });
  show_scene(nullptr);
}

QWidget* StudyDialog::make_controls() {
  scene_ = new QLabel;
  scene_->setWordWrap(true);
  choices_ = new StudyChoices;
  run_ = named("study_run", new QPushButton);
  run_->setDefault(true);
  connect(run_, &QPushButton::clicked, this, &StudyDialog::run_or_stop);
  connect(choices_, &StudyChoices::changed, this, &StudyDialog::show_buttons);
  auto* controls = new QWidget;
  controls->setFixedWidth(controls_width);
  auto* layout = make_column(controls, {}, 12);
  layout->addWidget(scene_);
  layout->addWidget(scrollable(choices_), 1);
  layout->addWidget(run_);
  return controls;
}

QWidget* StudyDialog::make_results() {
  error_ = named("study_error", new QComboBox,
                 tr("RMS: relative to the RMS of the reflected light, B - E\nLargest: relative to "
                    "the largest reflected light\nPatches that emit do not count."));
  error_->addItems({tr("RMS error"), tr("Largest error")});
  connect(error_, qOverload<int>(&QComboBox::currentIndexChanged), this, [this] {
    chart_->set_measure(measure());
    show_table();
  });
  axis_ = named("study_axis", new QComboBox,
                tr("Show the error against the number of passes, or against the processor time "
                   "of passes\nand iteration, which compares engines"));
  axis_->addItems({tr("Against passes"), tr("Against seconds")});
  connect(axis_, qOverload<int>(&QComboBox::currentIndexChanged), this, [this] {
    chart_->set_axis(axis());
    show_table();
  });
  phase_ = named("study_phase", new QLabel);
  progress_ = new QProgressBar;
  progress_->setRange(0, 1000);
  progress_->setFixedSize(180, 16);
  save_ = named("study_save", new QPushButton(tr("Save…")),
                tr("Save the plot as SVG or PNG, or the values as CSV"));
  save_->setAutoDefault(false);
  connect(save_, &QPushButton::clicked, this, &StudyDialog::choose_file);
  auto* bar = make_row({}, 12);
  bar->addWidget(error_);
  bar->addWidget(axis_);
  bar->addWidget(phase_, 1);
  bar->addWidget(progress_);
  bar->addWidget(save_);

  chart_ = new StudyChart;
  table_ = make_table();

  auto* results = new QWidget;
  auto* layout = make_column(results, {}, 8);
  layout->addLayout(bar);
  layout->addWidget(chart_, 4);
  layout->addWidget(table_, 1);
  return results;
}

ErrorMeasure StudyDialog::measure() const {
  return error_->currentIndex() == 0 ? ErrorMeasure::rms : ErrorMeasure::max;
}

StudyAxis StudyDialog::axis() const {
  return axis_->currentIndex() == 0 ? StudyAxis::passes : StudyAxis::seconds;
}

void StudyDialog::present() {
  show();
  raise();
  activateWindow();
}

void StudyDialog::show_scene(std::shared_ptr<const LoadedScene> loaded) {
  runner_.stop();
  loaded_ = std::move(loaded);
  running_ = false;
  snapshot_ = nullptr;
  banner_->dismiss();
  if (loaded_) {
    const QString name = QFileInfo(QString::fromStdString(loaded_->scene->name())).fileName();
    scene_->setText(tr("<b>%1</b>, %2 patches")
                        .arg(name.toHtmlEscaped(), count_text(loaded_->scene->patch_count())));
  } else {
    scene_->setText(tr("No scene is open"));
  }
  chart_->show_study(nullptr);
  show_phase();
  show_table();
  show_buttons();
}

void StudyDialog::show_solve(const SolverSnapshot& solve) {
  choices_->set_solve(solve.options);
  show_buttons();
}

void StudyDialog::run_or_stop() {
  if (running_) {
    runner_.stop();
    return;
  }
  banner_->dismiss();
  const std::string why = SolveOptions().why_dark(loaded_->scene->has_light());
  if (!why.empty()) {
    banner_->show_message(Banner::Kind::offer,
                          tr("Not started: %1. Make a face, material or group emit, and solve the "
                             "scene again.")
                              .arg(QString::fromStdString(why)));
    return;
  }
  running_ = true;
  runner_.start({loaded_, choices_->options()});
  show_buttons();
  show_phase();
}

void StudyDialog::show_snapshot(std::shared_ptr<const StudySnapshot> snapshot) {
  if (snapshot->loaded != loaded_) {
    return;  // another scene has been opened since
  }
  snapshot_ = std::move(snapshot);
  running_ = snapshot_->running;
  chart_->show_study(snapshot_);
  show_phase();
  show_table();
  show_buttons();
  if (running_) {
    return;
  }
  QStringList failures;
  const std::vector<std::string> names = names_of(snapshot_->series);
  for (const StudyPoint& point : snapshot_->study.points) {
    if (point.failure.empty()) {
      continue;
    }
    failures << tr("%1 with %2 passes failed: %3")
                    .arg(QString::fromStdString(names[point.series]), count_text(point.passes),
                         QString::fromStdString(point.failure) + remedy_hint(point.remedy));
  }
  if (!failures.isEmpty()) {
    banner_->show_message(Banner::Kind::warning, failures.front(), failures.join('\n'));
  }
}

void StudyDialog::show_phase() {
  progress_->setVisible(running_);
  const bool has_progress = running_ && snapshot_ && snapshot_->running;
  progress_->setValue(has_progress ? static_cast<int>(1000 * snapshot_->fraction) : 0);
  if (has_progress) {
    const QString what =
        snapshot_->reference
            ? tr("Reference, pass %1 of %2")
                  .arg(count_text(snapshot_->directions), count_text(snapshot_->passes))
            : tr("%1, %2 passes")
                  .arg(QString::fromStdString(names_of(snapshot_->series)[snapshot_->under_way]),
                       count_text(snapshot_->directions));
    phase_->setText(tr("%1: %2 passes/s, %3 left")
                        .arg(what, QString::number(snapshot_->passes_per_second, 'f', 1),
                             duration_text(snapshot_->seconds_left)));
  } else if (running_) {
    phase_->setText(tr("Starting"));
  } else if (!has_points()) {
    phase_->setText(snapshot_ ? tr("Stopped") : QString());
  } else {
    phase_->setText(snapshot_->study.complete ? tr("Done") : tr("Stopped early"));
  }
}

void StudyDialog::show_table() {
  const QStringList names_of_columns = headings(axis());
  for (int column = 0; column < names_of_columns.size(); ++column) {
    table_->horizontalHeaderItem(column)->setText(names_of_columns[column]);
  }
  const std::size_t rows = has_points() ? snapshot_->series.size() : 0;
  table_->setRowCount(static_cast<int>(rows));
  if (rows == 0) {
    return;
  }
  const std::vector<std::string> names = names_of(snapshot_->series);
  for (std::size_t series = 0; series < rows; ++series) {
    std::vector<StudyPoint> points = points_of(snapshot_->study, series);
    const auto law = fitted_power_law(points, measure());
    const QString texts[] = {
        QString::fromStdString(names[series]),
        law ? QString::number(law->slope, 'f', 2).replace('-', QStringLiteral("−"))
            : QStringLiteral("–"),
        cost_text(cost_of(points, 0.01, measure()), axis()),
        cost_text(cost_of(points, 0.001, measure()), axis())};
    for (int column = 0; column < 4; ++column) {
      auto* item = new QTableWidgetItem(texts[column]);
      item->setTextAlignment(alignment_of(column));
      table_->setItem(static_cast<int>(series), column, item);
    }
  }
}

void StudyDialog::show_buttons() {
  const StudyOptions options = choices_->options();
  run_->setText(running_ ? tr("Stop") : tr("Run the study"));
  const bool chosen = !options.series.empty() && !options.directions.empty();
  const QString unsolved = edits_.why_unsolved();
  enable_if(*run_, running_ || (loaded_ && chosen && unsolved.isEmpty()),
            !loaded_              ? tr("No scene is open")
            : !unsolved.isEmpty() ? unsolved
                                  : tr("No sampling or number of passes is chosen"));
  enable_if(*save_, has_points(), tr("No study has been run yet"));
}

void StudyDialog::choose_file() {
  const QString path = ask_where_to_write(
      this, tr("Save the study"),
      tr("Plot as vector graphics (*.svg);;Plot as PDF (*.pdf);;Plot as an image (*.png);;Values "
         "(*.csv)"),
      "study.svg");
  if (!path.isEmpty()) {
    save(path);
  }
}

void StudyDialog::save(const QString& path) {
  if (!has_points()) {
    return;
  }
  banner_->dismiss();
  try {
    const std::string file = path.toStdString();
    if (path.endsWith(QStringLiteral(".csv"), Qt::CaseInsensitive)) {
      write_file_whole(file, [&](std::ostream& out) {
        write_study_csv(out, snapshot_->series, snapshot_->study);
      });
    } else {
      check_chart_path(file);
      write_charts(file, {study_chart(snapshot_->loaded->scene->name(), snapshot_->series,
                                      snapshot_->study, measure(), axis())});
    }
  } catch (const std::exception& error) {
    banner_->show_message(Banner::Kind::error, QString::fromUtf8(error.what()));
  }
}

}  // namespace transillum::viewer
