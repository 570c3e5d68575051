// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "patches/beside_view.h"

#include <QClipboard>
#include <QComboBox>
#include <QGuiApplication>
#include <QHeaderView>
#include <QLabel>
#include <QSignalBlocker>
#include <QTableWidget>
#include <QToolButton>
#include <algorithm>
#include <cmath>

#include "support/number_text.h"
#include "widgets/build.h"
#include "widgets/value_table.h"

namespace transillum::viewer {

namespace {

constexpr std::ptrdiff_t most_rows = 200;

}  // namespace

BesideView::BesideView(const RunBeside& beside, Selection& selection, QWidget* parent)
    : QWidget(parent), beside_(beside), selection_(selection) {
  words_ = named("beside_words", note_label());
  copy_ = named("copy_beside", new QToolButton,
                tr("Copy the comparison as text: a sentence, and the tables"));
  copy_->setText(tr("Copy"));
  connect(copy_, &QToolButton::clicked, this,
          [this] { QGuiApplication::clipboard()->setText(beside_.summary()); });
  shown_ = named("beside_quantity", new QComboBox,
                 tr("The values that are compared, patch by patch: along ω, after all directions, "
                    "or of all that the selected patch sees"));
  shown_->addItems({tr("Area along ω, m²"), tr("Sum of form factors ΣF"), tr("B, W/m²"),
                    tr("F of the selected patch")});
  connect(shown_, qOverload<int>(&QComboBox::currentIndexChanged), this, &BesideView::show_state);
  const QStringList header{tr("Patch"), tr("There"), tr("Here"), tr("Change")};
  table_ = named("beside_table", new QTableWidget(0, static_cast<int>(header.size())),
                 tr("Values of the run beside (there) and of the open scene (here), the largest "
                    "change first; a click selects the patch"));
  table_->setHorizontalHeaderLabels(header);
  table_->setSelectionBehavior(QAbstractItemView::SelectRows);
  table_->setSelectionMode(QAbstractItemView::SingleSelection);
  table_->setEditTriggers(QAbstractItemView::NoEditTriggers);
  table_->setMinimumHeight(60);
  set_up_value_table(*table_, {"888888", "0.000000", "0.000000", "-0.000000"});
  connect(table_, &QTableWidget::currentCellChanged, this, &BesideView::select_row);
  auto* row = make_row({10, 0, 8, 2});
  row->addWidget(shown_, 1);
  row->addWidget(copy_);
  auto* layout = make_column(this, {}, 2);
  layout->addWidget(words_);
  layout->addLayout(row);
  layout->addWidget(table_, 1);
  words_->setContentsMargins(10, 0, 8, 0);
  connect(&beside_, &RunBeside::changed, this, &BesideView::show_state);
  show_state();
}

/// In a table of form factors, both patches of the pair are selected: the receiver stays.
void BesideView::select_row(int row) {
  const auto* item = table_->item(row, 0);
  if (item == nullptr) {
    return;
  }
  const PatchId patch = item->text().toInt(), receiver = selection_.patch();
  if (static_cast<Shown>(shown_->currentIndex()) == Shown::factors && receiver != no_patch) {
    selection_.select_all({std::min(patch, receiver), std::max(patch, receiver)});
  } else {
    selection_.select(patch);
  }
}

std::vector<BesideView::Line> BesideView::lines(const DirectionComparison& comparison) const {
  std::vector<Line> lines;
  const auto add = [&](PatchId patch, const std::array<double, 2>& value) {
    lines.push_back({patch, value[0], value[1], value[1] - value[0]});
  };
  const auto shown = static_cast<Shown>(shown_->currentIndex());
  if (shown == Shown::factors) {
    for (const DirectionComparison::Factor& factor : comparison.factors) {
      add(factor.source, factor.value);
    }
  } else {
    for (const DirectionComparison::Row& row : comparison.rows) {
      add(row.patch, shown == Shown::area         ? row.seen
                     : shown == Shown::factor_sum ? row.factors
                                                  : row.radiosity);
      lines.back().change = shown == Shown::area ? row.change() : lines.back().change;
    }
  }
  std::stable_sort(lines.begin(), lines.end(), [](const Line& a, const Line& b) {
    return std::abs(a.change) > std::abs(b.change);
  });
  return lines;
}

void BesideView::show_state() {
  setVisible(beside_.run() != nullptr);
  const auto comparison = beside_.comparison();
  enable_if(*copy_, comparison != nullptr, tr("No direction is compared yet"));
  if (!comparison) {
    words_->setText(beside_.error().isEmpty() ? tr("Recording the same direction…")
                                              : beside_.error());
  } else if (static_cast<Shown>(shown_->currentIndex()) != Shown::factors) {
    words_->setText(beside_.summary().section('\n', 0, 0));
  } else if (comparison->receiver == no_patch) {
    words_->setText(
        tr("Select a patch that both scenes have, to compare its form factors. They "
           "exist once an iteration has ended."));
  } else {
    words_->setText(tr("F of patch %1 to each other patch, in %2 (there) and in the open scene "
                       "(here), with the same directions.")
                        .arg(comparison->receiver)
                        .arg(beside_.name()));
  }
  show_table();
}

void BesideView::show_table() {
  const auto comparison = beside_.comparison();
  const std::vector<Line> all = comparison ? lines(*comparison) : std::vector<Line>();
  const QSignalBlocker quiet(table_);
  table_->setRowCount(static_cast<int>(std::min(std::ssize(all), most_rows)));
  for (int k = 0; k < table_->rowCount(); ++k) {
    const Line& line = all[static_cast<std::size_t>(k)];
    const QStringList texts{QString::number(line.patch), number_text(line.there),
                            number_text(line.here), number_text(line.change)};
    for (int column = 0; column < table_->columnCount(); ++column) {
      table_->setItem(k, column, new QTableWidgetItem(texts[column]));
    }
  }
}

}  // namespace transillum::viewer
