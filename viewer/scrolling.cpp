// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "scrolling.h"

#include <QEvent>
#include <QScrollArea>
#include <QStyle>
#include <algorithm>

namespace transillum::viewer {

namespace {

/// Never so narrow that something is cut off at the right, however large the type is.
class VerticalScrollArea : public QScrollArea {
 public:
  explicit VerticalScrollArea(QWidget* content) {
    setWidget(content);
    setWidgetResizable(true);
    setFrameShape(QFrame::NoFrame);
    setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
    widen();
  }

  bool eventFilter(QObject* watched, QEvent* event) override {
    if (event->type() == QEvent::LayoutRequest) widen();
    return QScrollArea::eventFilter(watched, event);
  }

 private:
  void widen() {
    setMinimumWidth(std::max(widget()->minimumSizeHint().width(), widget()->minimumWidth()) +
                    style()->pixelMetric(QStyle::PM_ScrollBarExtent));
  }
};

}  // namespace

QWidget* scrollable(QWidget* content) { return new VerticalScrollArea(content); }

void scroll_to(QWidget* part) {
  for (QWidget* about = part->parentWidget(); about; about = about->parentWidget()) {
    if (auto* area = qobject_cast<QScrollArea*>(about)) {
      area->ensureWidgetVisible(part, 0, part->height());
      return;
    }
  }
}

}  // namespace transillum::viewer
