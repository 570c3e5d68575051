// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// The panel "Kept runs". It shows the list of KeptRuns and changes it; the difference itself is
// shown in color by ColorChoice, as one of its quantities.
#include "patches/kept_run_panel.h"

#include <QComboBox>
#include <QHeaderView>
#include <QLabel>
#include <QLocale>
#include <QSignalBlocker>
#include <QStandardItemModel>
#include <QTableWidget>
#include <QToolButton>
#include <algorithm>
#include <cmath>

#include "colors/run_beside.h"
#include "model/command_text.h"
#include "model/run_comparison.h"
#include "model/snapshot_values.h"
#include "patches/beside_view.h"
#include "support/number_text.h"
#include "transillum/at.h"
#include "widgets/build.h"
#include "widgets/elided.h"
#include "widgets/engine_text.h"
#include "widgets/value_table.h"

namespace transillum::viewer {

namespace {

constexpr int name_column = 0, column_count = 6;

QString settings_tip(const KeptRun& run) {
  const SolverSnapshot& snapshot = *run.snapshot;
  const Scene& scene = *snapshot.loaded->scene;
  const RunOptions options = run_options_of(snapshot, scene.options(), {});
  return snapshot.of_file
             ? KeptRunPanel::tr("Values of the file %1").arg(QString::fromStdString(scene.name()))
             : KeptRunPanel::tr("Settings: %1")
                   .arg(QString::fromStdString(solve_command(scene.name(), options, {})));
}

QStringList texts_of(const KeptRun& run) {
  const SolverSnapshot& snapshot = *run.snapshot;
  const SolveOptions& options = snapshot.options;
  const bool by_directions = !snapshot.of_file && takes_directions(options.engine);
  const QString none = QStringLiteral("–");
  return {
      run.name,
      by_directions ? count_text(options.directions) : none,
      by_directions ? capitalized(QString::fromStdString(name_of(options.used_sampling()))) : none,
      snapshot.of_file && !snapshot.loaded->description ? KeptRunPanel::tr("a file")
                                                        : engine_label(options.engine),
      count_text(snapshot.progress.iteration),
      QLocale::c().toString(run.kept, QStringLiteral("HH:mm:ss"))};
}

void set_choosable(const QComboBox& box, int index, const QString& reason) {
  QStandardItem* item = qobject_cast<QStandardItemModel*>(box.model())->item(index);
  item->setEnabled(reason.isEmpty());
  item->setToolTip(reason);
}

QString dark_text(bool is_dark) {
  return is_dark
             ? KeptRunPanel::tr(" of a thousandth of the brightest surface, as it is in the dark")
             : QString();
}

/// All surfaces, the worst first, as far as a tool tip has room.
QString tip_of(const ResultComparison& comparison) {
  constexpr int most = 20;
  constexpr int longest_name = 40;
  QStringList lines{
      KeptRunPanel::tr("RMS of B − A by surface, relative to the RMS of its reflected "
                       "light in A;\npatches that emit, or reflect nothing, are omitted")};
  for (const SurfaceDifference& surface : comparison.surfaces) {
    if (lines.size() > most) {
      lines << QStringLiteral("…");
      break;
    }
    lines << KeptRunPanel::tr("%1: %2 %%3")
                 .arg(elided_name(QString::fromStdString(surface.name), longest_name),
                      number_text(100 * surface.rms), dark_text(surface.is_dark));
  }
  return lines.join(QLatin1Char('\n'));
}

QComboBox* make_choice(const char* name, const QString& tip) {
  auto* box = named(name, new ElidedComboBox, tip);
  box->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
  box->setMinimumContentsLength(8);
  return box;
}

}  // namespace

KeptRunPanel::KeptRunPanel(ColorChoice& colors, Selection& selection, RunBeside& beside,
                           QAction& keep, QAction& difference, QWidget* parent)
    : QWidget(parent),
      colors_(colors),
      runs_(colors.kept_runs()),
      selection_(selection),
      beside_(beside) {
  make_table();
  hint_ = named("run_hint", note_label({}, {10, 0, 10, 2}));
  // A layout does not count further lines of wrapped text, and would lay the table over them.
  hint_->setMinimumHeight(2 * hint_->fontMetrics().lineSpacing() + 2);
  table_->setMinimumHeight(38);
  auto* list = new QWidget;
  auto* of_list = make_column(list, {}, 2);
  of_list->addWidget(table_, 1);
  of_list->addWidget(hint_);
  of_list->addLayout(make_choices());
  of_list->addLayout(make_values());
  auto* layout = make_column(this, {}, 2);
  layout->addLayout(make_buttons(keep, difference));
  layout->addWidget(list, 1);
  layout->addWidget(named("beside_view", new BesideView(beside, selection)), 1);
  connect(&runs_, &KeptRuns::changed, this, &KeptRunPanel::show_list);
  connect(&beside_, &RunBeside::changed, this, [this, list] {
    const bool shown = beside_.run() != nullptr;
    side_->setChecked(shown);
    list->setVisible(!shown);  // one comparison at a time
    remove_->setVisible(!shown);
  });
  connect(&runs_, &KeptRuns::compared_changed, this, &KeptRunPanel::show_choices);
  connect(&colors_, &ColorChoice::fitted, this, &KeptRunPanel::show_difference);
  connect(&colors_, &ColorChoice::changed, this, &KeptRunPanel::show_difference);
  show_list();
}

void KeptRunPanel::make_table() {
  table_ = named("run_table", new QTableWidget(0, column_count));
  table_->setHorizontalHeaderLabels(
      {tr("Name"), tr("M"), tr("Sampling"), tr("Engine"), tr("Iterations"), tr("Kept")});
  table_->setSelectionBehavior(QAbstractItemView::SelectRows);
  table_->setSelectionMode(QAbstractItemView::SingleSelection);
  table_->setEditTriggers(QAbstractItemView::DoubleClicked | QAbstractItemView::EditKeyPressed);
  table_->horizontalHeader()->setStretchLastSection(true);
  set_up_value_table(*table_, {QStringLiteral("Name of a run"), QStringLiteral("8888"),
                               QStringLiteral("antipodal"), QStringLiteral("Z-buffer"),
                               QStringLiteral("88"), QStringLiteral("88:88:88")});
  connect(table_, &QTableWidget::itemChanged, this,
          [this](const QTableWidgetItem* item) { rename(*item); });
  connect(table_, &QTableWidget::itemSelectionChanged, this, &KeptRunPanel::show_hint);
  table_->setContextMenuPolicy(Qt::ActionsContextMenu);
  const auto add = [this](const char* name, const QString& text, const QKeySequence& key) {
    QAction* action = make_action(table_, name, text, {}, key);
    action->setShortcutContext(Qt::WidgetShortcut);
    table_->addAction(action);
    return action;
  };
  connect(add("rename_run", tr("Rename"), Qt::Key_F2), &QAction::triggered, this, [this] {
    if (table_->currentRow() >= 0) {
      table_->editItem(table_->item(table_->currentRow(), name_column));
    }
  });
  connect(add("remove_kept_run", tr("Remove"), QKeySequence::Delete), &QAction::triggered, this,
          &KeptRunPanel::remove_current);
}

QLayout* KeptRunPanel::make_buttons(QAction& keep, QAction& difference) {
  remove_ = named("remove_run", new QToolButton,
                  tr("Remove the run chosen in the list (Del); Undo restores it"));
  remove_->setText(tr("Remove"));
  connect(remove_, &QToolButton::clicked, this, &KeptRunPanel::remove_current);
  side_ = named("run_beside", new QToolButton,
                tr("Show the map of the run chosen in the list, also of another scene, beside the "
                   "map of the open scene, along the same direction"));
  side_->setText(tr("Beside"));
  side_->setCheckable(true);
  connect(side_, &QToolButton::clicked, this, &KeptRunPanel::show_beside);
  auto* row = make_row({8, 4, 8, 0});
  for (QAction* action : {&keep, &difference}) {
    row->addWidget(button_for(action));
  }
  row->addWidget(side_);
  row->addStretch(1);
  row->addWidget(remove_);
  return row;
}

QLayout* KeptRunPanel::make_choices() {
  second_ = make_choice("run_b", tr("The run whose difference from A is shown"));
  first_ =
      make_choice("run_a", tr("Run A, which is subtracted, and shown while the key A is held"));
  auto* row = make_row({10, 0, 8, 2}, 6);
  row->addWidget(second_, 1);
  row->addWidget(new QLabel(tr("minus A:")));
  row->addWidget(first_, 1);
  connect(first_, qOverload<int>(&QComboBox::activated), &runs_, &KeptRuns::set_first);
  connect(second_, qOverload<int>(&QComboBox::activated), this,
          [this](int index) { runs_.set_second(index - 1); });
  return row;
}

QLayout* KeptRunPanel::make_values() {
  values_ = named("run_difference", new QLabel);
  values_->setWordWrap(true);
  values_->setTextInteractionFlags(Qt::TextSelectableByMouse);
  go_ = named("go_to_difference", new QToolButton,
              tr("Select the patch with the largest difference on the worst surface, and turn the "
                 "scene to it"));
  go_->setText(tr("Go to the patch"));
  connect(go_, &QToolButton::clicked, this, &KeptRunPanel::go_to_worst);
  auto* row = make_row({10, 0, 8, 4});
  row->addWidget(values_, 1);
  row->addWidget(go_);
  return row;
}

void KeptRunPanel::show_list() {
  {
    const QSignalBlocker quiet(table_);
    const int current = table_->currentRow();
    table_->setRowCount(static_cast<int>(runs_.all().size()));
    for (int row = 0; row < table_->rowCount(); ++row) {
      const KeptRun& run = at(runs_.all(), row);
      const QString& reason = runs_.reason_against(static_cast<std::size_t>(row));
      const QStringList texts = texts_of(run);
      for (int column = 0; column < column_count; ++column) {
        auto* item = new QTableWidgetItem(texts[column]);
        const Qt::ItemFlags read_only = Qt::ItemIsEnabled | Qt::ItemIsSelectable;
        item->setFlags(column == name_column ? read_only | Qt::ItemIsEditable : read_only);
        item->setToolTip(reason.isEmpty() ? settings_tip(run)
                                          : settings_tip(run) + QLatin1Char('\n') + reason);
        if (!reason.isEmpty()) {
          item->setForeground(palette().placeholderText());
        }
        table_->setItem(row, column, item);
      }
    }
    table_->setCurrentCell(std::min(current, table_->rowCount() - 1), name_column);
  }
  show_hint();
  show_choices();
}

void KeptRunPanel::show_hint() {
  const int row = table_->currentRow();
  enable_if(*remove_, row >= 0, tr("No run is chosen in the list"));
  enable_if(*side_, row >= 0 || beside_.run(), tr("No run is chosen in the list"));
  hint_->setText(table_->rowCount() == 0 ? tr("No runs are kept. Keep one (K), change the "
                                              "settings, and solve again.")
                 : row >= 0              ? runs_.reason_against(static_cast<std::size_t>(row))
                                         : QString());
  hint_->setVisible(!hint_->text().isEmpty());
}

void KeptRunPanel::show_beside(bool shown) {
  const int row = table_->currentRow();
  if (shown && row >= 0) {
    const KeptRun& run = at(runs_.all(), row);
    beside_.show(run.snapshot, run.name);
  } else {
    beside_.show(nullptr, {});
  }
}

void KeptRunPanel::show_choices() {
  first_->clear();
  second_->clear();
  second_->addItem(tr("Current run"));
  for (std::size_t k = 0; k < runs_.all().size(); ++k) {
    for (QComboBox* box : {first_, second_}) {
      box->addItem(runs_.all()[k].name);
      set_choosable(*box, box->count() - 1, runs_.reason_against(k));
    }
  }
  first_->setCurrentIndex(runs_.first());
  second_->setCurrentIndex(runs_.second() + 1);
  for (QComboBox* box : {first_, second_}) {
    enable_if(*box, runs_.first() >= 0, tr("No run is kept"));
  }
  show_difference();
}

void KeptRunPanel::show_difference() {
  const auto a = colors_.run_a(), b = colors_.run_b();
  worst_ = no_patch;
  values_->clear();
  values_->setToolTip({});
  // Comparing takes a moment where there are many patches, and each snapshot needs it again.
  if (a && b && isVisible()) {
    show_comparison(compare_runs(*a, *b));
  }
  enable_if(*go_, worst_ != no_patch, tr("No run is compared with another"));
}

void KeptRunPanel::show_comparison(const ResultComparison& comparison) {
  const SurfaceDifference& worst = comparison.surfaces.front();
  worst_ = worst.worst;
  if (worst_ == no_patch) {
    values_->setText(tr("No difference: both have the same B."));
    return;
  }
  if (!std::isfinite(worst.rms)) {
    values_->setText(tr("A reflects no light, which differences would be relative to."));
    return;
  }
  constexpr int longest_name = 24;
  values_->setText(tr("%1: RMS %2 %%3, largest %4 % at patch %5. RMS over all surfaces: %6 %")
                       .arg(elided_name(QString::fromStdString(worst.name), longest_name),
                            number_text(100 * worst.rms), dark_text(worst.is_dark),
                            number_text(100 * worst.largest), QString::number(worst_),
                            number_text(100 * comparison.rms)));
  values_->setToolTip(tip_of(comparison));
}

void KeptRunPanel::showEvent(QShowEvent* event) {
  QWidget::showEvent(event);
  show_difference();
}

void KeptRunPanel::rename(const QTableWidgetItem& item) {
  if (item.column() != name_column) {
    return;
  }
  const auto k = static_cast<std::size_t>(item.row());
  const QString name = item.text().trimmed();
  if (name.isEmpty()) {
    // The change is made later: the table still edits the item.
    QMetaObject::invokeMethod(this, &KeptRunPanel::show_list, Qt::QueuedConnection);
    return;
  }
  QMetaObject::invokeMethod(
      this, [this, k, name] { runs_.rename(k, name); }, Qt::QueuedConnection);
}

void KeptRunPanel::remove_current() {
  if (table_->currentRow() >= 0) {
    runs_.remove(static_cast<std::size_t>(table_->currentRow()));
  }
}

void KeptRunPanel::go_to_worst() {
  selection_.select(worst_);
  emit patch_chosen();
}

}  // namespace transillum::viewer
