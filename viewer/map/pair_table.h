// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <vector>

#include "support/number_text.h"
#include "transillum/at.h"
#include "visibility/transfers/transfer_comparison.h"
#include "widgets/flat_table.h"

namespace transillum::viewer {

/// The pairs of patches in which two engines differ, as a table, the largest difference first.
class PairTable : public FlatTable {
  Q_OBJECT

 public:
  using FlatTable::FlatTable;
  enum Column { of_receiver, of_source, of_first, of_other, of_difference, column_count };

  void set_pairs(std::vector<PairDifference> pairs);
  const PairDifference& pair(int row) const { return at(pairs_, row); }

  QVariant data(const QModelIndex& index, int role) const override;

 private:
  int rows() const override { return static_cast<int>(pairs_.size()); }
  int columns() const override { return column_count; }
  ColumnHeader header(int column) const override;
  std::vector<PairDifference> pairs_;
  ColumnFormat area_format_, difference_format_;
};

}  // namespace transillum::viewer
