// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "patches/beside_view.h"

#include <QClipboard>
#include <QGuiApplication>
#include <QHeaderView>
#include <QLabel>
#include <QSignalBlocker>
#include <QTableWidget>
#include <QToolButton>
#include <algorithm>

#include "support/number_text.h"
#include "widgets/build.h"
#include "widgets/value_table.h"

namespace transillum::viewer {

namespace {

constexpr std::ptrdiff_t most_rows = 200;

}  // namespace

BesideView::BesideView(const RunBeside& beside, Selection& selection, QWidget* parent)
    : QWidget(parent), beside_(beside) {
  words_ = named("beside_words", note_label());
  copy_ = named("copy_beside", new QToolButton,
                tr("Copy the comparison as text: a sentence and a table"));
  copy_->setText(tr("Copy"));
  connect(copy_, &QToolButton::clicked, this,
          [this] { QGuiApplication::clipboard()->setText(beside_.summary()); });
  const QStringList header{tr("Patch"),  tr("A, m²"), tr("change"), tr("ΣF"),
                           tr("change"), tr("B"),     tr("change")};
  table_ = named("beside_table", new QTableWidget(0, static_cast<int>(header.size())),
                 tr("Along ω: the area over which a patch exchanges light, its sum of form factors "
                    "and its B (luminance, W/m²), in the open scene, and their changes from the "
                    "run beside it"));
  table_->setHorizontalHeaderLabels(header);
  table_->setSelectionBehavior(QAbstractItemView::SelectRows);
  table_->setSelectionMode(QAbstractItemView::SingleSelection);
  table_->setEditTriggers(QAbstractItemView::NoEditTriggers);
  table_->setMinimumHeight(60);
  set_up_value_table(*table_,
                     {"8888", "0.0000", "-0.0000", "0.0000", "-0.0000", "88.88", "-88.88"});
  connect(table_, &QTableWidget::currentCellChanged, this, [this, &selection](int row) {
    if (const auto* item = table_->item(row, 0)) {
      selection.select(item->text().toInt());
    }
  });
  auto* row = make_row({10, 0, 8, 2});
  row->addWidget(words_, 1);
  row->addWidget(copy_);
  auto* layout = make_column(this, {}, 2);
  layout->addLayout(row);
  layout->addWidget(table_, 1);
  connect(&beside_, &RunBeside::changed, this, &BesideView::show_state);
  show_state();
}

void BesideView::show_state() {
  setVisible(beside_.run() != nullptr);
  const auto shown = beside_.comparison();
  const QSignalBlocker quiet(table_);
  enable_if(*copy_, shown != nullptr, tr("No direction is compared yet"));
  if (!shown) {
    words_->setText(beside_.error().isEmpty() ? tr("Recording the same direction…")
                                              : beside_.error());
    table_->setRowCount(0);
    return;
  }
  words_->setText(beside_.summary().section('\n', 0, 0));
  const auto rows = std::min(std::ssize(shown->rows), most_rows);
  table_->setRowCount(static_cast<int>(rows));
  for (int k = 0; k < table_->rowCount(); ++k) {
    const DirectionComparison::Row& row = shown->rows[static_cast<std::size_t>(k)];
    QStringList texts{QString::number(row.patch), number_text(row.seen[1]),
                      number_text(row.change())};
    for (const auto& pair : {row.factors, row.radiosity}) {
      texts << number_text(pair[1]) << number_text(pair[1] - pair[0]);
    }
    for (int column = 0; column < table_->columnCount(); ++column) {
      table_->setItem(k, column, new QTableWidgetItem(texts[column]));
    }
  }
}

}  // namespace transillum::viewer
