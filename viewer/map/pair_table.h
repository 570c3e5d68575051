// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QAbstractTableModel>
#include <vector>

#include "support/column_format.h"
#include "transillum/at.h"
#include "visibility/transfers/transfer_comparison.h"

namespace transillum::viewer {

/// The pairs of patches in which two engines differ, as a table, the largest difference first.
class PairTable : public QAbstractTableModel {
  Q_OBJECT

 public:
  using QAbstractTableModel::QAbstractTableModel;
  enum Column { of_receiver, of_source, of_first, of_other, of_difference, column_count };

  void set_pairs(std::vector<PairDifference> pairs);
  const PairDifference& pair(int row) const { return at(pairs_, row); }

  int rowCount(const QModelIndex& parent = {}) const override;
  int columnCount(const QModelIndex& parent = {}) const override;
  QVariant data(const QModelIndex& index, int role) const override;
  QVariant headerData(int section, Qt::Orientation orientation, int role) const override;

 private:
  std::vector<PairDifference> pairs_;
  ColumnFormat area_format_, difference_format_;
};

}  // namespace transillum::viewer
