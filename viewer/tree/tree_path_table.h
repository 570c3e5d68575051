// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QAbstractTableModel>
#include <memory>
#include <vector>

#include "transillum/at.h"
#include "tree/tree_outline.h"

namespace transillum::viewer {

/// The path from the root of the BSP tree to one fragment as a table, one row per plane.
class TreePathTable : public QAbstractTableModel {
  Q_OBJECT

 public:
  using QAbstractTableModel::QAbstractTableModel;
  enum Column { of_plane, of_cosine, of_part, of_order, of_count, column_count };

  void show_path(std::shared_ptr<const TreeOutline> outline, std::vector<TreeVisit> path,
                 std::int32_t step);
  const TreeVisit& visit(int row) const { return at(path_, row); }
  std::int32_t step() const { return step_; }
  const TreeOutline& outline() const { return *outline_; }

  int rowCount(const QModelIndex& parent = {}) const override;
  int columnCount(const QModelIndex& parent = {}) const override;
  QVariant data(const QModelIndex& index, int role) const override;
  QVariant headerData(int section, Qt::Orientation orientation, int role) const override;

 private:
  QString text(int row, int column) const;

  std::shared_ptr<const TreeOutline> outline_;
  std::vector<TreeVisit> path_;
  std::int32_t step_ = -1;
};

}  // namespace transillum::viewer
