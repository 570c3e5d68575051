// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "widgets/scrolling.h"

#include <QEvent>
#include <QPointer>
#include <QScrollArea>
#include <QStyle>
#include <algorithm>

namespace transillum::viewer {

namespace {

/// Its minimum width grows with the content, so that nothing is cut off at the right.
class VerticalScrollArea : public QScrollArea {
 public:
  explicit VerticalScrollArea(QWidget* content) {
    setWidget(content);
    setWidgetResizable(true);
    setFrameShape(QFrame::NoFrame);
    setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
    widen();
  }

  void keep_visible(QWidget* part) {
    kept_ = part;
    ensureWidgetVisible(part, 0, part->height());
  }

  bool eventFilter(QObject* watched, QEvent* event) override {
    if (event->type() == QEvent::LayoutRequest) {
      widen();
    }
    return QScrollArea::eventFilter(watched, event);
  }

 protected:
  void resizeEvent(QResizeEvent* event) override {
    QScrollArea::resizeEvent(event);
    if (!kept_) {
      return;
    }
    QMetaObject::invokeMethod(
        this,
        [this] {
          if (kept_) {
            ensureWidgetVisible(kept_, 0, kept_->height());
          }
        },
        Qt::QueuedConnection);
  }

 private:
  void widen() {
    setMinimumWidth(std::max(widget()->minimumSizeHint().width(), widget()->minimumWidth()) +
                    style()->pixelMetric(QStyle::PM_ScrollBarExtent));
  }

  QPointer<QWidget> kept_;  ///< last argument of scroll_to()
};

}  // namespace

QWidget* scrollable(QWidget* content) { return new VerticalScrollArea(content); }

void scroll_to(QWidget* part) {
  for (QWidget* parent = part->parentWidget(); parent; parent = parent->parentWidget()) {
    if (auto* area = dynamic_cast<VerticalScrollArea*>(parent)) {
      area->keep_visible(part);
      return;
    }
  }
}

}  // namespace transillum::viewer
