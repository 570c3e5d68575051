// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Table model of the planes from the root of the BSP tree to one fragment (TreeOutline::path_to()).
#include "tree/tree_path_table.h"

#include <utility>

#include "support/number_text.h"
#include "tree/tree_text.h"
#include "widgets/table_cells.h"

namespace transillum::viewer {

void TreePathTable::show_path(std::shared_ptr<const TreeOutline> outline,
                              std::vector<TreeVisit> path, std::int32_t step) {
  // A reset between two clicks would lose a double-click.
  if (outline == outline_ && step == step_ && path == path_) {
    return;
  }
  beginResetModel();
  outline_ = std::move(outline);
  path_ = std::move(path);
  step_ = step;
  endResetModel();
}

int TreePathTable::rowCount(const QModelIndex& parent) const {
  return parent.isValid() ? 0 : static_cast<int>(path_.size());
}

int TreePathTable::columnCount(const QModelIndex& parent) const {
  return parent.isValid() ? 0 : column_count;
}

QString TreePathTable::text(int row, int column) const {
  const TreeVisit& v = visit(row);
  switch (column) {
    case of_plane:
      return plane_name(*outline_, v);
    case of_cosine:
      return cosine_text(v.cosine);
    case of_part: {
      const bool front_first = v.cosine >= 0;
      switch (v.part_of(step_)) {
        case TreeVisit::Part::near_side:
          return front_first ? tr("before: front") : tr("before: back");
        case TreeVisit::Part::plane:
          return tr("in the plane");
        case TreeVisit::Part::far_side:
          return front_first ? tr("after: back") : tr("after: front");
      }
      return {};
    }
    case of_count:
      return count_text(v.end - v.begin);
    default:
      return {};
  }
}

QVariant TreePathTable::data(const QModelIndex& index, int role) const {
  const bool last = index.row() == rowCount() - 1;
  switch (role) {
    case Qt::DisplayRole:
      return text(index.row(), index.column());
    case Qt::ToolTipRole:
      return explanation(*outline_, visit(index.row()));
    case tree_visit_role:
      return QVariant::fromValue(visit(index.row()));
    case Qt::TextAlignmentRole:
      return QVariant(index.column() == of_cosine || index.column() == of_count
                          ? Qt::AlignRight | Qt::AlignVCenter
                          : Qt::AlignLeft | Qt::AlignVCenter);
    case Qt::FontRole:
      return font_cell(last);
    default:
      return {};
  }
}

QVariant TreePathTable::headerData(int section, Qt::Orientation orientation, int role) const {
  if (orientation != Qt::Horizontal) {
    return {};
  }
  const auto pick = [role](const QString& name, const QString& tip) {
    return header_cell(role, name, tip);
  };
  switch (section) {
    case of_plane:
      return pick(
          tr("Plane"),
          tr("Patch in the plane, and number of further fragments in it; a free plane holds none"));
    case of_cosine:
      return pick(tr("n·ω"),
                  tr("The sign gives the side of the plane that ω points to: + front, − back"));
    case of_part:
      return pick(
          tr("Fragment is"),
          tr("Side of the plane that holds the current fragment, and so its place in the order"));
    case of_order:
      return pick(
          tr("Order"),
          tr("Fragments in and below the plane in order: the side that ω points to, fragments in "
             "the plane (yellow), the other side"));
    default:
      return pick(tr("Fragments"), tr("Number of fragments in and below the plane"));
  }
}

}  // namespace transillum::viewer
