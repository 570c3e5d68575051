// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "tree/tree_text.h"

#include <QCoreApplication>
#include <cmath>

#include "support/number_text.h"

namespace transillum::viewer {

namespace {

QString tr(const char* text) { return QCoreApplication::translate("TreeText", text); }

}  // namespace

PatchId patch_of(const TreeOutline& outline, const TreeVisit& visit) {
  const BspTree::Node& node = outline.node(visit.node);
  return node.begin == node.end ? no_patch : outline.tree().fragment(node.begin).patch;
}

QString plane_name(const TreeOutline& outline, const TreeVisit& visit) {
  const PatchId patch = patch_of(outline, visit);
  const std::int32_t others = visit.plane_end - visit.plane_begin - 1;
  if (patch == no_patch) {
    return tr("free plane");
  }
  return others > 0 ? tr("patch %1 + %2").arg(patch).arg(others) : tr("patch %1").arg(patch);
}

QString plane_phrase(const TreeOutline& outline, const TreeVisit& visit) {
  const PatchId patch = patch_of(outline, visit);
  return patch == no_patch ? tr("a free plane") : tr("the plane of patch %1").arg(patch);
}

QString cosine_text(double cosine) {
  const QString digits = QString::number(std::abs(cosine), 'f', 3);
  return (cosine < 0 ? QStringLiteral("−") : QStringLiteral("+")) + digits;
}

QString explanation(const TreeOutline& outline, const TreeVisit& visit) {
  const BspTree::Plane& plane = outline.node(visit.node).plane;
  return tr("%1: n·p = %2 m with n = %3.\n"
            "n·ω = %4, so the %5 side comes first, with %6 fragments;\n"
            "then %7 in the plane, then %8 on the other side.")
      .arg(plane_phrase(outline, visit), number_text(plane.offset), vector_text(plane.normal),
           cosine_text(visit.cosine), visit.cosine >= 0 ? tr("front") : tr("back"),
           count_text(visit.plane_begin - visit.begin),
           count_text(visit.plane_end - visit.plane_begin),
           count_text(visit.end - visit.plane_end));
}

}  // namespace transillum::viewer
