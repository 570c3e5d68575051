// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QRect>
#include <QStyledItemDelegate>
#include <functional>

#include "state/focus.h"
#include "state/selection.h"
#include "tree/tree_outline.h"

namespace transillum::viewer {

/// Draws the polygons below a plane (tree_visit_role) as a bar in their order: those done dark,
/// those to come pale, the plane's own yellow, the selected patch's marked below.
class OrderBar : public QStyledItemDelegate {
 public:
  using StepWish = std::function<void(std::int32_t step)>;

  OrderBar(const Focus& focus, const Selection& selection, QObject* parent);
  /// Hears of the step whose place is clicked, and double clicked.
  void set_wishes(StepWish clicked, StepWish double_clicked);

  /// The step drawn at `x`, and where a step's place begins.
  static std::int32_t step_at(const TreeVisit& visit, const QRectF& bar, double x);
  static double left_of(const TreeVisit& visit, const QRectF& bar, std::int32_t step);
  static QRectF bar_in(const QRect& cell);

  void paint(QPainter* painter, const QStyleOptionViewItem& option,
             const QModelIndex& index) const override;

 protected:
  bool editorEvent(QEvent* event, QAbstractItemModel* model, const QStyleOptionViewItem& option,
                   const QModelIndex& index) override;

 private:
  const Focus& focus_;
  const Selection& selection_;
  StepWish clicked_, double_clicked_;
};

}  // namespace transillum::viewer
