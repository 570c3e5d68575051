// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// The BSP tree for views: whole, and the path to one fragment.
#pragma once

#include <QAbstractItemModel>
#include <memory>
#include <vector>

#include "transillum/at.h"
#include "tree/tree_outline.h"
#include "widgets/flat_table.h"

namespace transillum::viewer {

/// The whole BSP tree, one item per node; its children are its sides in the order along the current
/// direction. Items are computed only for the nodes that a view expands.
class TreeModel : public QAbstractItemModel {
  Q_OBJECT

 public:
  using QAbstractItemModel::QAbstractItemModel;
  enum Column { of_plane, of_side, of_order, of_count, column_count };

  /// A new tree resets the model; a new direction through the same tree changes its layout. A new
  /// step emits no signal: the caller repaints its views.
  void show_position(std::shared_ptr<const TreeOutline> outline, const Vec3& omega,
                     std::int32_t step);
  const TreeVisit& visit(const QModelIndex& index) const;
  const TreeOutline& outline() const { return *outline_; }
  QModelIndex index_of(std::int32_t node, int column = of_plane) const;
  /// Nodes from the root to the plane that holds the current fragment.
  const std::vector<std::int32_t>& path() const { return path_; }

  QModelIndex index(int row, int column, const QModelIndex& parent = {}) const override;
  QModelIndex parent(const QModelIndex& index) const override;
  int rowCount(const QModelIndex& parent = {}) const override;
  int columnCount(const QModelIndex& parent = {}) const override;
  QVariant data(const QModelIndex& index, int role) const override;
  QVariant headerData(int section, Qt::Orientation orientation, int role) const override;

 private:
  const TreeVisit& visit_of(std::int32_t node) const { return at(visits_, node); }
  void show_direction(const Vec3& omega);
  bool on_path(std::int32_t node) const;
  QString text(const TreeVisit& visit, int column) const;

  std::shared_ptr<const TreeOutline> outline_;
  Vec3 omega_;
  std::vector<TreeVisit> visits_;  ///< per node
  std::vector<std::int32_t> path_;
  std::int32_t step_ = -1;
};

/// The path from the root of the BSP tree to one fragment as a table, one row per plane.
class TreePathTable : public FlatTable {
  Q_OBJECT

 public:
  using FlatTable::FlatTable;
  enum Column { of_plane, of_cosine, of_part, of_order, of_count, column_count };

  void show_path(std::shared_ptr<const TreeOutline> outline, std::vector<TreeVisit> path,
                 std::int32_t step);
  const TreeVisit& visit(int row) const { return at(path_, row); }
  std::int32_t step() const { return step_; }
  const TreeOutline& outline() const { return *outline_; }

  QVariant data(const QModelIndex& index, int role) const override;

 private:
  int rows() const override { return static_cast<int>(path_.size()); }
  int columns() const override { return column_count; }
  ColumnHeader header(int column) const override;
  QString text(int row, int column) const;

  std::shared_ptr<const TreeOutline> outline_;
  std::vector<TreeVisit> path_;
  std::int32_t step_ = -1;
};

}  // namespace transillum::viewer
