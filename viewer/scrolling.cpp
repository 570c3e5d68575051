// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "scrolling.h"

#include <QScrollArea>
#include <QStyle>
#include <algorithm>

namespace transillum::viewer {

QWidget* scrollable(QWidget* content) {
  auto* area = new QScrollArea;
  area->setWidget(content);
  area->setWidgetResizable(true);
  area->setFrameShape(QFrame::NoFrame);
  area->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  // Never so narrow that something is cut off at the right.
  area->setMinimumWidth(std::max(content->minimumSizeHint().width(), content->minimumWidth()) +
                        area->style()->pixelMetric(QStyle::PM_ScrollBarExtent));
  return area;
}

void scroll_to(QWidget* part) {
  for (QWidget* about = part->parentWidget(); about; about = about->parentWidget()) {
    if (auto* area = qobject_cast<QScrollArea*>(about)) {
      area->ensureWidgetVisible(part, 0, part->height());
      return;
    }
  }
}

}  // namespace transillum::viewer
