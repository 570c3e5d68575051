// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QMetaType>
#include <QString>

#include "tree/tree_outline.h"

Q_DECLARE_METATYPE(transillum::viewer::TreeVisit)

namespace transillum::viewer {

/// Role under which the tree's models return a row's TreeVisit.
constexpr int tree_visit_role = Qt::UserRole;

/// A patch in the node's plane; no_patch for a free plane.
PatchId patch_of(const TreeOutline& outline, const TreeVisit& visit);
/// "patch 12 + 3", "free plane".
QString plane_name(const TreeOutline& outline, const TreeVisit& visit);
/// "the plane of patch 12", "a free plane".
QString plane_phrase(const TreeOutline& outline, const TreeVisit& visit);
/// n·omega with its sign.
QString cosine_text(double cosine);
/// The plane's equation, and the order of its sides; three lines, for a tool tip.
QString explanation(const TreeOutline& outline, const TreeVisit& visit);

}  // namespace transillum::viewer
