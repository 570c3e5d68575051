// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QByteArray>
#include <string>
#include <vector>

#include "lessons/view_state.h"
#include "state/breakpoints.h"
#include "state/camera_views.h"

namespace transillum::viewer {

/// What a session file keeps: where one was, to go on from there or to hand it on.
struct Session {
  ViewState state;
  std::vector<Breakpoint> breakpoints;
  std::vector<CameraBookmarks::Bookmark> kept_views;
  std::string notes;  ///< the user's own words
  QByteArray docks;   ///< QMainWindow::saveState of `layout`; empty: the layout as it comes
};

/// @param name what messages call the file. @param folder where it lies: its scene may lie there.
/// @throws InputError naming file, key and what is wrong.
Session session_from_text(const std::string& text, const std::string& name,
                          const std::string& folder);
/// A scene file in or below `folder` is named relative to it, so that both can move together.
std::string to_text(const Session& session, const std::string& folder);

/// What a JSON file of the viewer is. @throws InputError where it is neither.
enum class JsonFile { session, lesson };
JsonFile kind_of_json(const std::string& text, const std::string& name);

/// The text of a file, which has to be of a sensible size. @throws InputError
std::string text_of_file(const std::string& path);

}  // namespace transillum::viewer
