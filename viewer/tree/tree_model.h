// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QAbstractItemModel>
#include <memory>
#include <vector>

#include "transillum/at.h"
#include "tree/tree_outline.h"

namespace transillum::viewer {

/// The whole BSP tree, a node an item; below each its sides, in the order that the direction in
/// focus passes them. Views ask only for what they have opened.
class TreeModel : public QAbstractItemModel {
  Q_OBJECT

 public:
  using QAbstractItemModel::QAbstractItemModel;
  enum Column { of_plane, of_side, of_order, of_count, column_count };

  /// Of another tree everything is new; of another direction along the same, sides change places.
  /// The step is not told of by a signal: views paint anew.
  void show_position(std::shared_ptr<const TreeOutline> outline, const Vec3& omega,
                     std::int32_t step);
  const TreeVisit& visit(const QModelIndex& index) const;
  const TreeOutline& outline() const { return *outline_; }
  QModelIndex index_of(std::int32_t node, int column = of_plane) const;
  /// From the root to the plane that holds the polygon in focus.
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
  std::vector<TreeVisit> visits_;  ///< a node
  std::vector<std::int32_t> path_;
  std::int32_t step_ = -1;
};

}  // namespace transillum::viewer
