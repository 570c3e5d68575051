// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "widgets/value_table.h"

#include <QEvent>
#include <QHeaderView>
#include <QTableView>
#include <algorithm>
#include <utility>

namespace transillum::viewer {

namespace {

constexpr int row_margin = 6, column_margin = 10;

/// Sets the row height and column widths of a table again when its font changes. Where the table
/// wraps words, rows are as high as their texts.
class SizeByFont : public QObject {
 public:
  SizeByFont(QTableView& table, QStringList widest)
      : QObject(&table), table_(table), widest_(std::move(widest)) {
    table_.installEventFilter(this);
    // Not at once: rows that get other heights may show a scroll bar, which narrows a column.
    connect(table.horizontalHeader(), &QHeaderView::sectionResized, this, &SizeByFont::fit_rows,
            Qt::QueuedConnection);
    if (const QAbstractItemModel* model = table_.model()) {
      // The call is made later: a QTableWidget resets its model while it is being destroyed.
      connect(model, &QAbstractItemModel::headerDataChanged, this, &SizeByFont::measure,
              Qt::QueuedConnection);
      connect(model, &QAbstractItemModel::modelReset, this, &SizeByFont::measure,
              Qt::QueuedConnection);
    }
    measure();
  }

  bool eventFilter(QObject*, QEvent* event) override {
    if (event->type() == QEvent::FontChange || event->type() == QEvent::StyleChange) {
      measure();
    }
    return false;
  }

 private:
  void fit_rows() {
    if (table_.wordWrap()) {
      table_.resizeRowsToContents();
    }
  }

  void measure() {
    table_.verticalHeader()->setDefaultSectionSize(table_.fontMetrics().height() + row_margin);
    QFont bold = table_.font();
    bold.setBold(true);  // the current row is bold
    const QFontMetrics text(bold), header_text(table_.horizontalHeader()->font());
    const QAbstractItemModel* model = table_.model();
    // The sort indicator is beside the name.
    const int arrow = table_.isSortingEnabled() ? 12 : 0;
    for (int column = 0; model && column < model->columnCount(); ++column) {
      if (column < widest_.size() && widest_[column].isEmpty()) {
        continue;
      }
      const QString widest = widest_.value(column, QStringLiteral("0.008888"));
      const QString header = model->headerData(column, Qt::Horizontal).toString();
      table_.setColumnWidth(column, std::max(text.horizontalAdvance(widest),
                                             header_text.horizontalAdvance(header) + arrow) +
                                        column_margin);
    }
    QMetaObject::invokeMethod(this, &SizeByFont::fit_rows, Qt::QueuedConnection);
  }

  QTableView& table_;
  const QStringList widest_;
};

}  // namespace

void set_up_value_table(QTableView& table, QStringList widest) {
  table.setFrameShape(QFrame::NoFrame);
  table.setShowGrid(false);
  table.setAlternatingRowColors(true);
  table.setWordWrap(false);
  table.setMinimumHeight(60);
  table.verticalHeader()->hide();
  table.horizontalHeader()->setHighlightSections(false);
  new SizeByFont(table, std::move(widest));
}

}  // namespace transillum::viewer
