// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <memory>

#include "model/snapshot.h"
#include "transillum/solve_session.h"

namespace transillum::viewer {

/// A snapshot with the values and statistics of the present stage of a session. Before the first
/// pass, it has the values of the result file, if one was opened.
/// @param session prepared
/// @param loaded of the session's scene
SolverSnapshot snapshot_of(const SolveSession& session, std::shared_ptr<const LoadedScene> loaded);

}  // namespace transillum::viewer
