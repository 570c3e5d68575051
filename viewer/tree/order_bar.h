// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QRect>
#include <QStyledItemDelegate>

#include "state/focus.h"
#include "state/selection.h"
#include "tree/tree_outline.h"

namespace transillum::viewer {

/// Draws the fragments in and below a plane (tree_visit_role) as a bar in BSP order: processed
/// fragments dark, later ones pale, fragments in the plane yellow; the fragments of the selected
/// patch are marked below the bar.
class OrderBar : public QStyledItemDelegate {
 public:
  /// A click on a step selects its patch, a double-click goes to it.
  OrderBar(Focus& focus, Selection& selection, QObject* parent);

  /// The step drawn at `x`, and the left end of a step, pixels.
  static std::int32_t step_at(const TreeVisit& visit, const QRectF& bar, double x);
  static double left_of(const TreeVisit& visit, const QRectF& bar, std::int32_t step);
  static QRectF bar_in(const QRect& cell);

  void paint(QPainter* painter, const QStyleOptionViewItem& option,
             const QModelIndex& index) const override;

 protected:
  bool editorEvent(QEvent* event, QAbstractItemModel* model, const QStyleOptionViewItem& option,
                   const QModelIndex& index) override;

 private:
  Focus& focus_;
  Selection& selection_;
};

}  // namespace transillum::viewer
