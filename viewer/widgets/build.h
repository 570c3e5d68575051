// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Makes widgets, actions and layouts with the settings that most of them get.
#pragma once

#include <QAction>
#include <QBoxLayout>
#include <QKeySequence>
#include <QLabel>
#include <QMargins>
#include <QToolButton>

namespace transillum::viewer {

/// Gives a widget or a menu its object name, by which tests find it, and its tool tip.
template <class Widget>
Widget* named(const QString& name, Widget* widget, const QString& tip = {}) {
  widget->setObjectName(name);
  widget->setToolTip(tip);
  return widget;
}

inline QAction* make_action(QObject* parent, const QString& name, const QString& text,
                            const QString& tip, const QKeySequence& key = {}) {
  auto* action = new QAction(text, parent);
  action->setObjectName(name);
  action->setToolTip(tip);
  action->setShortcut(key);
  return action;
}

/// The tool tip ends with the key.
inline QAction* make_key_action(QObject* parent, const QString& name, const QString& text,
                                const QString& tip, const QKeySequence& key) {
  const QString key_text = key.toString(QKeySequence::NativeText);
  return make_action(parent, name, text, QStringLiteral("%1 (%2)").arg(tip, key_text), key);
}

/// The property of a widget or an action that says why it is disabled.
inline constexpr const char* why_disabled = "why_disabled";

/// Enables a widget or an action, or disables it and says why in its tool tip.
template <class Control>
void enable_if(Control& control, bool enabled, const QString& why) {
  constexpr const char* usual_tip = "usual_tip";
  if (!control.property(usual_tip).isValid()) {
    control.setProperty(usual_tip, control.toolTip());
  }
  const QString tip = control.property(usual_tip).toString();
  control.setEnabled(enabled);
  control.setToolTip(enabled ? tip : tip.isEmpty() ? why : QStringLiteral("%1\n%2").arg(tip, why));
  control.setProperty(why_disabled, enabled ? QString() : why);
}

/// Writes a label in bold type. A font of its own would be lost when the theme changes.
inline void set_strong(QLabel& label) { label.setProperty("strong", true); }

/// A label of dim text in as many lines as it needs.
inline QLabel* note_label(const QString& text = {}, const QMargins& margins = {}) {
  auto* label = new QLabel(text);
  label->setWordWrap(true);
  label->setContentsMargins(margins);
  label->setForegroundRole(QPalette::PlaceholderText);
  return label;
}

inline QToolButton* button_for(QAction* action) {
  auto* button = new QToolButton;
  button->setDefaultAction(action);
  return button;
}

/// @param parent  gets the layout; null if the layout is part of another one
/// @param spacing  pixels; -1 for the spacing of the style
template <class Layout>
Layout* make_layout(QWidget* parent, const QMargins& margins, int spacing) {
  auto* layout = parent ? new Layout(parent) : new Layout;
  layout->setContentsMargins(margins);
  layout->setSpacing(spacing);
  return layout;
}
inline QHBoxLayout* make_row(QWidget* parent, const QMargins& margins, int spacing = -1) {
  return make_layout<QHBoxLayout>(parent, margins, spacing);
}
inline QHBoxLayout* make_row(const QMargins& margins, int spacing = -1) {
  return make_row(nullptr, margins, spacing);
}
inline QVBoxLayout* make_column(QWidget* parent, const QMargins& margins, int spacing = -1) {
  return make_layout<QVBoxLayout>(parent, margins, spacing);
}
inline QVBoxLayout* make_column(const QMargins& margins, int spacing = -1) {
  return make_column(nullptr, margins, spacing);
}

/// A tool tip that explains a symbol or an equation, with the section of ALGORITHM.md that derives
/// it on a line of its own.
/// @param section number of the section, such as "6.1"; empty if none is to be named
inline QString symbol_tip(const QString& meaning, const char* section) {
  return *section
             ? meaning + QStringLiteral("\nALGORITHM.md, section ") + QString::fromLatin1(section)
             : meaning;
}

}  // namespace transillum::viewer
