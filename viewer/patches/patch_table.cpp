// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// The model of the two patch tables: sorts, searches and writes as CSV what patch_columns computes.
#include "patches/patch_table.h"

#include <QHeaderView>
#include <QLocale>
#include <QTabWidget>
#include <QTableView>
#include <algorithm>
#include <cmath>
#include <ostream>
#include <utility>

#include "colors/color_scale.h"
#include "support/number_text.h"
#include "transillum/at.h"
#include "widgets/build.h"
#include "widgets/value_table.h"

namespace transillum::viewer {

namespace {

double key_of(const PatchColumn& column, int entry) {
  const Rgb& value = at(column.values, entry);
  return column.kind == PatchColumn::Kind::channels ? luminance(value) : value.r;
}

QString text_of(const PatchColumn& column, int entry) {
  return column.texts.value(static_cast<int>(at(column.values, entry).r));
}

QString percent_text(double percent) {
  constexpr double least = 0.005;
  return percent > 0 && percent < least ? QStringLiteral("≈ 0") : QString::number(percent, 'f', 2);
}

std::string exact_text(double value) {
  return QByteArray::number(value, 'g', QLocale::FloatingPointShortest).toStdString();
}

std::string quoted(const QString& text) {
  if (!text.contains(',') && !text.contains('"') && !text.contains('\n')) {
    return text.toStdString();
  }
  return '"' + QString(text).replace('"', "\"\"").toStdString() + '"';
}

}  // namespace

void PatchTable::set_contents(std::vector<PatchId> patches, std::vector<PatchColumn> columns) {
  const bool same_columns =
      columns.size() == columns_.size() &&
      std::equal(columns.begin(), columns.end(), columns_.begin(),
                 [](const auto& a, const auto& b) { return a.title == b.title; });
  if (same_columns && patches == patches_) {
    // No reset, so that the view keeps its scroll position and selection.
    const std::vector<PatchColumn> before = std::exchange(columns_, std::move(columns));
    set_formats();
    if (!std::equal(before.begin(), before.end(), columns_.begin(),
                    [](const auto& a, const auto& b) { return a.format == b.format; })) {
      emit headerDataChanged(Qt::Horizontal, 0, columnCount() - 1);
    }
    arrange();
    return;
  }
  beginResetModel();
  patches_ = std::move(patches);
  columns_ = std::move(columns);
  set_formats();
  shown_.clear();
  endResetModel();
  arrange();
}

void PatchTable::set_formats() {
  for (PatchColumn& column : columns_) {
    if (column.kind == PatchColumn::Kind::percent) {
      continue;
    }
    double largest = 0;
    for (int entry = 0; entry < size(); ++entry) {
      const double value = std::abs(key_of(column, entry));
      largest = std::isfinite(value) ? std::max(largest, value) : largest;
    }
    column.format = ColumnFormat(largest);
  }
}

void PatchTable::set_search(const QString& text) {
  if (text == search_) {
    return;
  }
  search_ = text;
  arrange();
}

bool PatchTable::matches(int entry) const {
  if (search_.isEmpty()) {
    return true;
  }
  if (QString::number(at(patches_, entry)).startsWith(search_)) {
    return true;
  }
  return std::any_of(columns_.begin(), columns_.end(), [&](const PatchColumn& column) {
    return column.kind == PatchColumn::Kind::text &&
           text_of(column, entry).contains(search_, Qt::CaseInsensitive);
  });
}

void PatchTable::arrange() {
  std::vector<int> shown;
  for (int entry = 0; entry < size(); ++entry) {
    if (matches(entry)) {
      shown.push_back(entry);
    }
  }
  if (sorted_by_ >= 0 && sorted_by_ < columnCount()) {
    const PatchColumn& column = at(columns_, sorted_by_);
    std::vector<double> keys(patches_.size());
    for (const int entry : shown) {
      // NaN would violate the strict weak order.
      const double key = key_of(column, entry);
      at(keys, entry) = std::isnan(key) ? -HUGE_VAL : key;
    }
    const auto key = [&](int entry) { return at(keys, entry); };
    std::stable_sort(shown.begin(), shown.end(), [&](int a, int b) {
      return order_ == Qt::AscendingOrder ? key(a) < key(b) : key(b) < key(a);
    });
  }
  if (shown.size() == shown_.size()) {
    emit layoutAboutToBeChanged();
    const QModelIndexList old = persistentIndexList();
    std::vector<PatchId> kept;
    for (const QModelIndex& index : old) {
      kept.push_back(patch(index.row()));
    }
    shown_ = std::move(shown);
    QModelIndexList now;
    for (int k = 0; k < old.size(); ++k) {
      const int row = row_of(at(kept, k));
      now.push_back(row < 0 ? QModelIndex() : index(row, old[k].column()));
    }
    changePersistentIndexList(old, now);
    emit layoutChanged();
    return;
  }
  beginResetModel();
  shown_ = std::move(shown);
  endResetModel();
}

PatchId PatchTable::patch(int row) const { return at(patches_, at(shown_, row)); }

int PatchTable::row_of(PatchId patch) const {
  const auto found = std::find_if(shown_.begin(), shown_.end(),
                                  [&](int entry) { return at(patches_, entry) == patch; });
  return found == shown_.end() ? -1 : static_cast<int>(found - shown_.begin());
}

void PatchTable::write_csv(std::ostream& out) const {
  const char* separator = "";
  for (const PatchColumn& column : columns_) {
    for (const char* channel : {"_r", "_g", "_b"}) {
      const bool channels = column.kind == PatchColumn::Kind::channels;
      out << std::exchange(separator, ",") << column.csv_name << (channels ? channel : "");
      if (!channels) {
        break;
      }
    }
  }
  out << '\n';
  for (const int entry : shown_) {
    separator = "";
    for (const PatchColumn& column : columns_) {
      const Rgb& value = at(column.values, entry);
      out << std::exchange(separator, ",");
      if (column.kind == PatchColumn::Kind::text) {
        out << quoted(text_of(column, entry));
      } else if (column.kind == PatchColumn::Kind::channels) {
        out << exact_text(value.r) << ',' << exact_text(value.g) << ',' << exact_text(value.b);
      } else {
        out << exact_text(value.r);
      }
    }
    out << '\n';
  }
}

QVariant PatchTable::data(const QModelIndex& index, int role) const {
  const PatchColumn& column = at(columns_, index.column());
  const int entry = at(shown_, index.row());
  switch (role) {
    case Qt::DisplayRole:
      if (column.kind == PatchColumn::Kind::text) {
        return text_of(column, entry);
      }
      // Written as in files, without separators of thousands.
      if (column.kind == PatchColumn::Kind::integer) {
        return QString::number(static_cast<qint64>(key_of(column, entry)));
      }
      if (column.kind == PatchColumn::Kind::percent) {
        return percent_text(key_of(column, entry));
      }
      return column.format.text(key_of(column, entry));
    case Qt::ToolTipRole:
      return column.kind == PatchColumn::Kind::channels
                 ? QVariant(tr("Red, green, blue: %1").arg(rgb_text(at(column.values, entry))))
             : column.kind == PatchColumn::Kind::number || column.kind == PatchColumn::Kind::percent
                 ? QVariant(number_text(key_of(column, entry)))
                 : QVariant();
    case Qt::TextAlignmentRole:
      return QVariant(column.kind == PatchColumn::Kind::text ? Qt::AlignLeft | Qt::AlignVCenter
                                                             : Qt::AlignRight | Qt::AlignVCenter);
    default:
      return {};
  }
}

ColumnHeader PatchTable::header(int column) const {
  const PatchColumn& shown = at(columns_, column);
  return {shown.format.header(shown.title), shown.tip};
}

void PatchTable::sort(int column, Qt::SortOrder order) {
  sorted_by_ = column;
  order_ = order;
  arrange();
}

TablePage add_table_page(QTabWidget& tabs, const QString& title, const QString& name,
                         const QStringList& widest) {
  const TablePage page{new PatchTable(&tabs), named(name, new QTableView),
                       named(name + "_caption", note_label({}, {10, 4, 10, 4}))};
  page.view->setModel(page.table);
  page.view->setSelectionBehavior(QAbstractItemView::SelectRows);
  page.view->setSelectionMode(QAbstractItemView::SingleSelection);
  page.view->horizontalHeader()->setSortIndicator(-1, Qt::AscendingOrder);
  page.view->setSortingEnabled(true);
  set_up_value_table(*page.view, widest);
  auto* widget = new QWidget;
  auto* layout = make_column(widget, {}, 0);
  layout->addWidget(page.caption);
  layout->addWidget(page.view, 1);
  tabs.addTab(widget, title);
  return page;
}

}  // namespace transillum::viewer
