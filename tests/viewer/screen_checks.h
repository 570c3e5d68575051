// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QAbstractScrollArea>
#include <QLabel>
#include <QPushButton>
#include <QSize>
#include <QToolButton>

namespace transillum::viewer::test {

/// The room of a window on a screen of 1280 x 720 and of 1600 x 1000, less its frame.
constexpr QSize small_screen(1280 - 16, 720 - 48), large_screen(1600 - 16, 1000 - 48);

inline bool is_on_screen(const QWidget& widget) {
  return widget.isVisible() && !widget.visibleRegion().isEmpty();
}

/// Whether a widget is on the screen as a whole, not cut off by the window or by a column.
inline bool is_whole(const QWidget& widget) {
  return widget.isVisible() && widget.visibleRegion().boundingRect() == widget.rect();
}

/// Whether a widget can be scrolled into view.
inline bool scrolls(const QWidget& widget) {
  for (const QWidget* around = widget.parentWidget(); around; around = around->parentWidget()) {
    if (qobject_cast<const QAbstractScrollArea*>(around)) {
      return true;
    }
  }
  return false;
}

/// The buttons of a window or panel that are cut off and cannot be scrolled into view.
inline QStringList cut_buttons(const QWidget& window) {
  QStringList cut;
  for (const auto* button : window.findChildren<QAbstractButton*>()) {
    if (button->isVisible() && !is_whole(*button) && !scrolls(*button)) {
      cut << button->objectName() + ' ' + button->text();
    }
  }
  return cut;
}

/// The labels and buttons on the screen whose text has less width than it needs.
inline QStringList cut_texts(const QWidget& window) {
  QStringList cut;
  const auto check = [&cut](const QWidget& part, const QString& text, int needed) {
    const bool may_be_elided = part.sizePolicy().horizontalPolicy() == QSizePolicy::Ignored;
    if (is_on_screen(part) && !may_be_elided && !text.isEmpty() && part.width() < needed) {
      cut << part.objectName() + ' ' + text;
    }
  };
  for (const auto* label : window.findChildren<QLabel*>()) {
    if (!label->wordWrap()) {
      check(*label, label->text(), label->minimumSizeHint().width());
    }
  }
  for (const auto* button : window.findChildren<QPushButton*>()) {
    check(*button, button->text(), button->fontMetrics().horizontalAdvance(button->text()));
  }
  for (const auto* button : window.findChildren<QToolButton*>()) {
    check(*button, button->text(), button->sizeHint().width());
  }
  return cut;
}

}  // namespace transillum::viewer::test
