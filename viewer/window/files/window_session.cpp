// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "window/files/window_session.h"

#include <QPlainTextEdit>
#include <QTextDocument>
#include <QUndoStack>

#include "scene/scene_page.h"
#include "window/base/dock_layouts.h"
#include "window/base/notifier.h"
#include "window/base/view_state_applier.h"

namespace transillum::viewer {

WindowSession::WindowSession(const WindowFrame& frame, DockLayouts& docks, QPlainTextEdit& notes,
                             ViewStateApplier& applier)
    : QObject(&frame.window), frame_(frame), docks_(docks), notes_(notes), applier_(applier) {}

Session WindowSession::current() const {
  return {applier_.state(),
          frame_.state.breakpoints.list(),
          frame_.page.bookmarks().all(),
          notes_.toPlainText().toStdString(),
          docks_.state(),
          frame_.state.watches.list()};
}

void WindowSession::restore(const Session& session) {
  frame_.notifier.dismiss();
  applier_.show(session.state);
  if (session.state.layout && !session.docks.isEmpty()) {
    if (!docks_.restore(static_cast<int>(*session.state.layout), session.docks)) {
      docks_.arrange(*session.state.layout);
      frame_.notifier.show_warnings(
          {tr("docks: damaged, or of another version; the panels are in their usual places")});
    }
  }
  const std::string& scene = session.state.scene;
  const std::string& shown = scene.empty() ? frame_.state.scene.spec() : scene;
  frame_.state.breakpoints.set_list_of(shown, session.breakpoints);
  frame_.state.watches.set_list_of(shown, session.watches);
  frame_.page.bookmarks().set(session.saved_views);
  frame_.state.undo.clear();
  notes_.setPlainText(QString::fromStdString(session.notes));
}

void WindowSession::set_notes_saved() { notes_.document()->setModified(false); }

bool WindowSession::has_unsaved_notes() const {
  return notes_.document()->isModified() && !notes_.document()->isEmpty();
}

}  // namespace transillum::viewer
