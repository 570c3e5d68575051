// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "window/window_session.h"

#include <QPlainTextEdit>
#include <QTextDocument>
#include <QUndoStack>

#include "scene/scene_page.h"
#include "window/dock_layouts.h"
#include "window/notifier.h"
#include "window/view_state_applier.h"

namespace transillum::viewer {

WindowSession::WindowSession(const WindowParts& parts, ViewStateApplier& applier)
    : QObject(&parts.window), parts_(parts), applier_(applier) {}

Session WindowSession::current() const {
  return {applier_.state(),
          parts_.breakpoints.list(),
          parts_.page.bookmarks().all(),
          parts_.notes.toPlainText().toStdString(),
          parts_.docks.state(),
          parts_.watches.list()};
}

void WindowSession::restore(const Session& session) {
  parts_.notifier.dismiss();
  applier_.show(session.state);
  if (session.state.layout && !session.docks.isEmpty()) {
    if (!parts_.docks.restore(static_cast<int>(*session.state.layout), session.docks)) {
      parts_.docks.arrange(*session.state.layout);
      parts_.notifier.show_warnings(
          {tr("docks: damaged, or of another version; the panels are in their usual places")});
    }
  }
  const std::string& scene = session.state.scene;
  const std::string& shown = scene.empty() ? parts_.scene.spec() : scene;
  parts_.breakpoints.set_list_of(shown, session.breakpoints);
  parts_.watches.set_list_of(shown, session.watches);
  parts_.page.bookmarks().set(session.saved_views);
  parts_.relighting.edits().undo_stack().clear();
  parts_.notes.setPlainText(QString::fromStdString(session.notes));
}

void WindowSession::set_notes_saved() { parts_.notes.document()->setModified(false); }

bool WindowSession::has_unsaved_notes() const {
  return parts_.notes.document()->isModified() && !parts_.notes.document()->isEmpty();
}

}  // namespace transillum::viewer
