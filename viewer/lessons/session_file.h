// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QByteArray>
#include <string>
#include <vector>

#include "lessons/view_state.h"
#include "state/breakpoints.h"
#include "state/camera_views.h"
#include "state/watches.h"

namespace transillum::viewer {

/// The contents of a session file: everything needed to continue, or to pass on, a work session.
struct Session {
  ViewState state;
  std::vector<Breakpoint> breakpoints;
  std::vector<CameraBookmarks::Bookmark> saved_views;
  std::string notes;  ///< free text
  QByteArray docks;   ///< DockLayouts::state() of state.layout; empty for its default
  std::vector<Watch> watches = {};
};

/// Parses the text of a session file.
/// @param name the file's name in error messages
/// @param folder of the file; a relative scene file is searched there first
/// @throws InputError naming file, key and problem
Session session_from_text(const std::string& text, const std::string& name,
                          const std::string& folder);
/// The text of a session file. A scene file in or below `folder` is named relative to it, so that
/// both can be moved together.
std::string to_text(const Session& session, const std::string& folder);

/// The kind of a JSON file. @throws InputError if it is neither
enum class JsonFile { session, lesson };
JsonFile kind_of_json(const std::string& text, const std::string& name);

}  // namespace transillum::viewer
