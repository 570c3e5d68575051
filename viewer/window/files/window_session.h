// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QObject>

#include "lessons/session_file.h"
#include "window/base/window_views.h"

class QPlainTextEdit;

namespace transillum::viewer {

class ViewStateApplier;

/// The state of the window that a session file holds: reads it from the window, and restores it.
class WindowSession : public QObject {
  Q_OBJECT

 public:
  WindowSession(const WindowFrame& frame, DockLayouts& docks, QPlainTextEdit& notes,
                ViewStateApplier& applier);

  Session current() const;
  void restore(const Session& session);
  /// The notes are in a file now, so that closing the window loses nothing.
  void set_notes_saved();
  bool has_unsaved_notes() const;

 private:
  WindowFrame frame_;
  DockLayouts& docks_;
  QPlainTextEdit& notes_;
  ViewStateApplier& applier_;
};

}  // namespace transillum::viewer
