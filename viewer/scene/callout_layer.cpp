// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "scene/callout_layer.h"

#include <QEvent>
#include <QPainter>
#include <utility>

#include "widgets/callout_painter.h"
#include "widgets/sketch_painter.h"

namespace transillum::viewer {

CalloutLayer::CalloutLayer(QWidget* under) : QWidget(under) {
  setObjectName("callout_layer");
  setAttribute(Qt::WA_TransparentForMouseEvents);
  setAttribute(Qt::WA_NoSystemBackground);
  under->installEventFilter(this);
  hide();
}

void CalloutLayer::show_callouts(std::vector<Placed> callouts) {
  if (callouts == callouts_) {
    return;
  }
  callouts_ = std::move(callouts);
  follow();
}

void CalloutLayer::show_sketch(QPolygonF outline, std::vector<QPolygonF> right) {
  if (outline == outline_ && right == right_) {
    return;
  }
  outline_ = std::move(outline);
  right_ = std::move(right);
  follow();
}

void CalloutLayer::follow() {
  setGeometry(parentWidget()->rect());
  setVisible(!empty());
  update();
}

bool CalloutLayer::eventFilter(QObject* watched, QEvent* event) {
  if (event->type() == QEvent::Resize) {
    setGeometry(parentWidget()->rect());
  }
  return QWidget::eventFilter(watched, event);
}

void CalloutLayer::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  draw(painter, rect());
}

void CalloutLayer::draw(QPainter& painter, const QRectF& bounds) const {
  painter.setRenderHint(QPainter::Antialiasing);
  draw_sketch(painter, outline_, right_);
  std::vector<QRectF> taken;
  for (const Placed& callout : callouts_) {
    draw_callout(painter, callout.anchor, callout.text, bounds.adjusted(2, 2, -2, -2), taken);
  }
}

}  // namespace transillum::viewer
