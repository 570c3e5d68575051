// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "map/pair_table.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "support/number_text.h"

namespace transillum::viewer {

namespace {

double value_of(const PairDifference& pair, int column) {
  return column == PairTable::of_first   ? pair.first
         : column == PairTable::of_other ? pair.other
                                         : pair.other - pair.first;
}

}  // namespace

void PairTable::set_pairs(std::vector<PairDifference> pairs) {
  beginResetModel();
  pairs_ = std::move(pairs);
  double area = 0, difference = 0;
  for (const PairDifference& pair : pairs_) {
    area = std::max({area, pair.first, pair.other});
    difference = std::max(difference, std::abs(pair.other - pair.first));
  }
  area_format_ = ColumnFormat(area);
  difference_format_ = ColumnFormat(difference);
  endResetModel();
}

QVariant PairTable::data(const QModelIndex& index, int role) const {
  const PairDifference& pair = this->pair(index.row());
  const int column = index.column();
  const bool number = column == of_first || column == of_other || column == of_difference;
  switch (role) {
    case Qt::DisplayRole:
      return column == of_receiver     ? QString::number(pair.receiver)
             : column == of_source     ? QString::number(pair.source)
             : column == of_difference ? difference_format_.text(value_of(pair, column))
                                       : area_format_.text(value_of(pair, column));
    case Qt::TextAlignmentRole:
      return QVariant(Qt::AlignRight | Qt::AlignVCenter);
    case Qt::ToolTipRole:
      return number ? QVariant(number_text(value_of(pair, column))) : QVariant();
    default:
      return {};
  }
}

ColumnHeader PairTable::header(int column) const {
  switch (column) {
    case of_receiver:
      return {tr("i")};
    case of_source:
      return {tr("j")};
    case of_first:
      return {area_format_.header(tr("First, m²")), tr("A(i, j, ω) by the first engine")};
    case of_other:
      return {area_format_.header(tr("Second, m²")), tr("A(i, j, ω) by the second engine")};
    default:
      return {difference_format_.header(tr("Difference, m²")),
              tr("Area by the second engine minus area by the first")};
  }
}

}  // namespace transillum::viewer
