// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// The table of the rounds of a refinement, below the settings that start them. Everything in it
// comes from snapshots.
#include "solve/round_panel.h"

#include <QHeaderView>
#include <QLabel>
#include <QProgressBar>
#include <QPushButton>
#include <QScrollArea>
#include <QTableWidget>
#include <QTimer>
#include <algorithm>

#include "support/number_text.h"
#include "widgets/build.h"
#include "widgets/value_table.h"

namespace transillum::viewer {

namespace {

enum Column { round_column, patches_column, measure_column, seconds_column, column_count };

constexpr int most_rows = 9;  // shown without scrolling
constexpr int bar_steps = 1000;

QString seconds_text(double seconds) {
  return QString::number(seconds, 'f', seconds < 10 ? 2 : seconds < 100 ? 1 : 0);
}

bool is_under_way(const SolverSnapshot& snapshot) {
  return snapshot.refinement.left || !snapshot.progress.finished;
}

}  // namespace

RoundsAhead rounds_ahead(PatchId patches, const RefineChoice& refine) {
  RoundsAhead ahead;
  double now = patches;
  while (now < refine.patches) {
    ++ahead.rounds;
    ahead.patches += now;
    now *= 2;
  }
  ahead.patches += refine.patches;
  if (refine.by == RefineBy::error) {
    ++ahead.rounds;  // the last round tells the error of the mesh that is solved then
    ahead.patches += 0.25 * refine.patches;
  }
  return ahead;
}

RoundPanel::RoundPanel(QWidget* parent) : QWidget(parent) {
  table_ = named("round_table", new QTableWidget(0, column_count));
  table_->setEditTriggers(QAbstractItemView::NoEditTriggers);
  table_->setSelectionMode(QAbstractItemView::NoSelection);
  table_->setFocusPolicy(Qt::NoFocus);
  table_->horizontalHeader()->setSectionResizeMode(QHeaderView::Stretch);
  table_->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  table_->setHorizontalHeaderLabels({tr("Round"), tr("Patches"), QString(), tr("Time, s")});
  set_up_value_table(*table_, {QString(), QString(), QString(), QString()});
  phase_ = named("round_phase", new QLabel);
  bar_ = named("round_progress", new QProgressBar);
  bar_->setRange(0, bar_steps);
  bar_->setTextVisible(false);
  bar_->setFixedHeight(8);
  cancel_ = named("cancel_rounds", new QPushButton(tr("Cancel")),
                  tr("Discard the rounds and return to the faces as they were"));
  connect(cancel_, &QPushButton::clicked, this, &RoundPanel::canceled);
  // A text that grows must not widen the panel.
  phase_->setWordWrap(true);
  phase_->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Preferred);
  auto* row = make_row({}, 8);
  row->addWidget(bar_, 1);
  row->addWidget(cancel_);
  auto* layout = make_column(this, {}, 6);
  // The buttons are above the table, because the table grows.
  layout->addWidget(phase_);
  layout->addLayout(row);
  layout->addWidget(table_);
  hide();
}

void RoundPanel::show_snapshot(const SolverSnapshot& snapshot) {
  const int rows = isHidden() ? 0 : table_->rowCount();
  setVisible(snapshot.refine.is_set());
  if (!snapshot.refine.is_set()) {
    return;
  }
  show_table(snapshot);
  show_progress(snapshot);
  if (table_->rowCount() != rows && is_under_way(snapshot)) {
    // The call is made later: the layout does not know the new height yet.
    QTimer::singleShot(0, this, &RoundPanel::scroll_here);
  }
}

void RoundPanel::show_table(const SolverSnapshot& snapshot) {
  const bool jump = snapshot.refine.by == RefineBy::jump;
  table_->horizontalHeaderItem(measure_column)->setText(jump ? tr("Jump, %") : tr("Error, %"));
  table_->horizontalHeaderItem(measure_column)
      ->setToolTip(
          jump ? tr("RMS of the jumps across edges, relative to B")
               : tr("L2 norm of the part of B that the patches cannot represent, relative to B"));
  const auto& rounds = snapshot.statistics.refinement;
  const int done = static_cast<int>(rounds.size());
  // The last row: the round, or the solve, that is under way or done.
  table_->setRowCount(done + 1);
  const auto set_row = [this](int row, const QStringList& texts) {
    for (int column = 0; column < column_count; ++column) {
      auto* item = new QTableWidgetItem(texts[column]);
      item->setTextAlignment(Qt::AlignRight | Qt::AlignVCenter);
      table_->setItem(row, column, item);
    }
  };
  for (int k = 0; k < done; ++k) {
    const RefinementRound& round = rounds[static_cast<std::size_t>(k)];
    set_row(k, {count_text(k + 1), count_text(round.patches), number_text(100 * round.measure),
                seconds_text(round.seconds)});
  }
  set_row(done, {snapshot.refinement.left ? count_text(done + 1) : tr("Solve"),
                 count_text(snapshot.refinement.patches), QString(),
                 is_under_way(snapshot) ? QStringLiteral("…")
                                        : seconds_text(snapshot.statistics.seconds_total)});
  QFont bold = table_->font();
  bold.setBold(true);
  for (int column = 0; column < column_count; ++column) {
    table_->item(done, column)->setFont(bold);
  }
  fit_height();
  table_->scrollToBottom();
}

/// In a panel that is higher than its dock, the rounds are below the settings that started them.
void RoundPanel::scroll_here() {
  for (QWidget* around = parentWidget(); around; around = around->parentWidget()) {
    if (auto* area = qobject_cast<QScrollArea*>(around)) {
      area->ensureWidgetVisible(this, 0, 12);
      return;
    }
  }
}

void RoundPanel::fit_height() {
  const int rows = std::min(table_->rowCount(), most_rows);
  table_->setFixedHeight(table_->horizontalHeader()->sizeHint().height() +
                         rows * table_->verticalHeader()->defaultSectionSize() + 2);
}

void RoundPanel::show_progress(const SolverSnapshot& snapshot) {
  const auto& rounds = snapshot.statistics.refinement;
  double spent = snapshot.statistics.seconds_total;
  for (const RefinementRound& round : rounds) {
    spent += round.seconds;
  }
  const bool left = snapshot.refinement.left;
  cancel_->setVisible(left);
  bar_->setVisible(left);
  if (!left) {
    phase_->setText(is_under_way(snapshot)
                        ? tr("Rounds done, solving")
                        : tr("%1 patches in %2 s")
                              .arg(count_text(snapshot.refinement.patches), seconds_text(spent)));
    return;
  }
  const int done = static_cast<int>(rounds.size());
  const RoundsAhead ahead = rounds_ahead(snapshot.refinement.patches, snapshot.refine);
  QString text = tr("Round %1 of about %2")
                     .arg(count_text(done + 1), count_text(done + std::max(ahead.rounds, 1)));
  double fraction = 0;
  if (done > 0 && rounds.back().patches > 0) {
    const double per_patch = rounds.back().seconds / static_cast<double>(rounds.back().patches);
    const double needed =
        std::max(0.0, per_patch * ahead.patches - snapshot.statistics.seconds_total);
    fraction = spent / std::max(spent + needed, 1e-9);
    text += tr(", about %1 left").arg(duration_text(needed));
  }
  phase_->setText(text);
  bar_->setValue(static_cast<int>(bar_steps * fraction));
}

}  // namespace transillum::viewer
