// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Item model of the BSP tree for one direction and step. Input: a TreeOutline, which counts
// fragments.
#include "tree/tree_tables.h"

#include <algorithm>
#include <utility>

#include "support/number_text.h"
#include "transillum/at.h"
#include "tree/tree_outline.h"
#include "widgets/flat_table.h"
#include "widgets/theme.h"

namespace transillum::viewer {

namespace {

std::int32_t node_at(const QModelIndex& index) {
  return static_cast<std::int32_t>(index.internalId());
}

}  // namespace

void TreeModel::show_position(std::shared_ptr<const TreeOutline> outline, const Vec3& omega,
                              std::int32_t step) {
  if (outline != outline_) {
    beginResetModel();
    outline_ = std::move(outline);
    visits_ = outline_ ? outline_->visits(omega) : std::vector<TreeVisit>();
    omega_ = omega;
    endResetModel();
  } else if (outline_ && omega != omega_) {
    show_direction(omega);
  }
  step_ = step;
  path_.clear();
  if (outline_) {
    for (const TreeVisit& visit : outline_->path_to(step, omega)) {
      path_.push_back(visit.node);
    }
  }
}

void TreeModel::show_direction(const Vec3& omega) {
  emit layoutAboutToBeChanged();
  omega_ = omega;
  visits_ = outline_->visits(omega);
  const QModelIndexList before = persistentIndexList();
  QModelIndexList after;
  for (const QModelIndex& index : before) {
    after << index_of(node_at(index), index.column());
  }
  changePersistentIndexList(before, after);
  emit layoutChanged();
}

const TreeVisit& TreeModel::visit(const QModelIndex& index) const {
  return visit_of(node_at(index));
}

QModelIndex TreeModel::index_of(std::int32_t node, int column) const {
  const std::int32_t above = outline_->parent(node);
  int row = 0;
  if (above != BspTree::no_node) {
    const auto sides = outline_->children(visit_of(above));
    row = static_cast<int>(std::find(sides.begin(), sides.end(), node) - sides.begin());
  }
  return createIndex(row, column, static_cast<quintptr>(node));
}

QModelIndex TreeModel::index(int row, int column, const QModelIndex& parent) const {
  if (row < 0 || row >= rowCount(parent) || column < 0 || column >= column_count) {
    return {};
  }
  const std::int32_t node =
      parent.isValid() ? at(outline_->children(visit(parent)), row) : outline_->tree().root();
  return createIndex(row, column, static_cast<quintptr>(node));
}

QModelIndex TreeModel::parent(const QModelIndex& index) const {
  const std::int32_t above = index.isValid() ? outline_->parent(node_at(index)) : BspTree::no_node;
  return above == BspTree::no_node ? QModelIndex() : index_of(above);
}

int TreeModel::rowCount(const QModelIndex& parent) const {
  if (!parent.isValid()) {
    return visits_.empty() ? 0 : 1;
  }
  return parent.column() == 0 ? static_cast<int>(outline_->children(visit(parent)).size()) : 0;
}

int TreeModel::columnCount(const QModelIndex&) const { return column_count; }

bool TreeModel::on_path(std::int32_t node) const {
  return std::find(path_.begin(), path_.end(), node) != path_.end();
}

QString TreeModel::text(const TreeVisit& visit, int column) const {
  switch (column) {
    case of_plane:
      return plane_name(*outline_, visit);
    case of_side: {
      const std::int32_t above = outline_->parent(visit.node);
      if (above == BspTree::no_node) {
        return tr("root");
      }
      const bool front = outline_->node(above).front == visit.node;
      const bool first = visit.begin < visit_of(above).plane_begin;
      const QString side = front ? tr("front") : tr("back");
      return first ? tr("%1, first").arg(side) : tr("%1, last").arg(side);
    }
    case of_count:
      return count_text(visit.end - visit.begin);
    default:
      return {};
  }
}

QVariant TreeModel::data(const QModelIndex& index, int role) const {
  const TreeVisit& visit = this->visit(index);
  const bool later = visit.begin > step_;
  switch (role) {
    case Qt::DisplayRole:
      return text(visit, index.column());
    case Qt::ToolTipRole:
      return explanation(*outline_, visit);
    case tree_visit_role:
      return QVariant::fromValue(visit);
    case Qt::TextAlignmentRole:
      return QVariant(index.column() == of_count ? Qt::AlignRight | Qt::AlignVCenter
                                                 : Qt::AlignLeft | Qt::AlignVCenter);
    case Qt::ForegroundRole:
      return on_path(visit.node) ? QVariant(theme::accent)
             : later             ? QVariant(theme::ink_dim)
                                 : QVariant();
    case Qt::FontRole:
      return font_cell(!path_.empty() && visit.node == path_.back());
    default:
      return {};
  }
}

QVariant TreeModel::headerData(int section, Qt::Orientation orientation, int role) const {
  if (orientation != Qt::Horizontal) {
    return {};
  }
  const auto pick = [role](const QString& name, const QString& tip) {
    return ColumnHeader{name, tip}.data(role);
  };
  switch (section) {
    case of_plane:
      return pick(tr("Plane"),
                  tr("Patch in the plane, and number of further fragments in it; a free "
                     "plane holds none. Blue: on the path to the current fragment"));
    case of_side:
      return pick(tr("Side"),
                  tr("Side of the parent plane, and whether that side comes first or last "
                     "along this direction"));
    case of_order:
      return pick(tr("Order"),
                  tr("Fragments in and below the plane: processed dark, later ones pale, "
                     "in the plane yellow; fragments of the selected patch are marked"));
    default:
      return pick(tr("Fragments"), tr("Number of fragments in and below the plane"));
  }
}

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

QString TreePathTable::text(int row, int column) const {
  const TreeVisit& v = visit(row);
  switch (column) {
    case of_plane:
      return plane_name(*outline_, v);
    case of_cosine:
      return cosine_text(v.cosine);
    case of_part: {
      const bool front_first = v.cosine >= 0;
      switch (v.place_of(step_)) {
        case TreeVisit::Place::near_side:
          return front_first ? tr("before: front") : tr("before: back");
        case TreeVisit::Place::plane:
          return tr("in the plane");
        case TreeVisit::Place::far_side:
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

ColumnHeader TreePathTable::header(int column) const {
  switch (column) {
    case of_plane:
      return {
          tr("Plane"),
          tr("Patch in the plane, and number of further fragments in it; a free plane holds none")};
    case of_cosine:
      return {tr("n·ω"),
              tr("The sign gives the side of the plane that ω points to: + front, − back")};
    case of_part:
      return {
          tr("Fragment is"),
          tr("Side of the plane that holds the current fragment, and so its place in the order")};
    case of_order:
      return {tr("Order"),
              tr("Fragments in and below the plane in order: the side that ω points to, those in "
                 "the plane (yellow), the other side")};
    default:
      return {tr("Fragments"), tr("Number of fragments in and below the plane")};
  }
}

}  // namespace transillum::viewer
