// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "widgets/scrolling.h"

#include <QAbstractSpinBox>
#include <QApplication>
#include <QComboBox>
#include <QEvent>
#include <QPointer>
#include <QScrollArea>
#include <QScrollBar>
#include <QSlider>

namespace transillum::viewer {

namespace {

/// Its width does not depend on the content: a panel whose values become longer must not move the
/// scene beside it.
class VerticalScrollArea : public QScrollArea {
 public:
  explicit VerticalScrollArea(QWidget* content) {
    setWidget(content);
    setWidgetResizable(true);
    setFrameShape(QFrame::NoFrame);
  }

  void keep_visible(QWidget* part) {
    kept_ = part;
    show_kept();
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
            show_kept();
          }
        },
        Qt::QueuedConnection);
  }

 private:
  /// The upper side cuts none of the lines among which the part is.
  void show_kept() {
    ensureWidgetVisible(kept_, 0, kept_->height());
    const int top = verticalScrollBar()->value();
    for (const QObject* child : kept_->parentWidget()->children()) {
      const auto* line = qobject_cast<const QWidget*>(child);
      if (!line || line == kept_ || line->isHidden()) {
        continue;
      }
      const int above = line->mapTo(widget(), QPoint()).y(), below = above + line->height();
      if (above < top && top < below && below <= kept_->mapTo(widget(), QPoint()).y()) {
        verticalScrollBar()->setValue(below);
        return;
      }
    }
  }

  QPointer<QWidget> kept_;  ///< last argument of scroll_to()
};

}  // namespace

namespace {

class WheelGuard : public QObject {
 public:
  using QObject::QObject;

  bool eventFilter(QObject* watched, QEvent* event) override {
    const bool concerned = event->type() == QEvent::Wheel || event->type() == QEvent::Polish;
    auto* field = concerned ? changed_by_wheel(watched) : nullptr;
    if (!field) {
      return false;
    }
    if (event->type() == QEvent::Polish) {
      if (field->focusPolicy() == Qt::WheelFocus) {
        field->setFocusPolicy(Qt::StrongFocus);  // the wheel must not give it the focus
      }
      return false;
    }
    if (field->hasFocus()) {
      return false;
    }
    event->ignore();  // Qt then sends it to the parent
    return true;
  }

 private:
  static QWidget* changed_by_wheel(QObject* object) {
    const bool is_field = qobject_cast<QComboBox*>(object) ||
                          qobject_cast<QAbstractSpinBox*>(object) || qobject_cast<QSlider*>(object);
    return is_field ? static_cast<QWidget*>(object) : nullptr;
  }
};

}  // namespace

void guard_wheel(QApplication& application) {
  const QString name = QStringLiteral("wheel_guard");
  if (!application.findChild<QObject*>(name, Qt::FindDirectChildrenOnly)) {
    auto* guard = new WheelGuard(&application);
    guard->setObjectName(name);
    application.installEventFilter(guard);
  }
}

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
