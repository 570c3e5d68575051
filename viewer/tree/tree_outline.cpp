// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "tree/tree_outline.h"

#include <QCoreApplication>
#include <cmath>
#include <utility>

#include "support/number_text.h"
#include "transillum/at.h"

namespace transillum::viewer {

TreeOutline::TreeOutline(std::shared_ptr<const BspTree> tree)
    : tree_(std::move(tree)),
      sizes_(tree_->nodes().size()),
      parents_(tree_->nodes().size(), BspTree::no_node) {
  // Parents come before their children.
  for (std::size_t n = sizes_.size(); n-- > 0;) {
    const BspTree::Node& node = tree_->nodes()[n];
    sizes_[n] = size(node.front) + size(node.back) + (node.end - node.begin);
    for (const std::int32_t child : {node.front, node.back}) {
      if (child != BspTree::no_node) {
        at(parents_, child) = static_cast<std::int32_t>(n);
      }
    }
  }
}

std::int32_t TreeOutline::size(std::int32_t node) const {
  return node == BspTree::no_node ? 0 : at(sizes_, node);
}

TreeVisit TreeOutline::visit(std::int32_t n, std::int32_t begin, const Vec3& omega) const {
  const BspTree::Node& node = this->node(n);
  TreeVisit visit{n, dot(node.plane.normal, omega), begin, 0, 0, begin + size(n)};
  visit.plane_begin = begin + size(sides(visit).near);
  visit.plane_end = visit.plane_begin + (node.end - node.begin);
  return visit;
}

TreeOutline::Sides TreeOutline::sides(const TreeVisit& visit) const {
  const BspTree::Node& node = this->node(visit.node);
  return visit.cosine >= 0 ? Sides{node.front, node.back} : Sides{node.back, node.front};
}

std::vector<std::int32_t> TreeOutline::children(const TreeVisit& visit) const {
  std::vector<std::int32_t> children;
  const auto [near, far] = sides(visit);
  for (const std::int32_t side : {near, far}) {
    if (side != BspTree::no_node) {
      children.push_back(side);
    }
  }
  return children;
}

std::vector<TreeVisit> TreeOutline::visits(const Vec3& omega) const {
  std::vector<TreeVisit> visits(sizes_.size());
  if (!visits.empty()) {
    visits.front() = visit(tree_->root(), 0, omega);
  }
  // Parents come before their children.
  for (const TreeVisit& above : visits) {
    const auto [near, far] = sides(above);
    if (near != BspTree::no_node) {
      at(visits, near) = visit(near, above.begin, omega);
    }
    if (far != BspTree::no_node) {
      at(visits, far) = visit(far, above.plane_end, omega);
    }
  }
  return visits;
}

std::vector<TreeVisit> TreeOutline::path_to(std::int32_t step, const Vec3& omega) const {
  std::vector<TreeVisit> path;
  if (step < 0 || step >= size(tree_->root())) {
    return path;
  }
  std::int32_t begin = 0;
  for (std::int32_t n = tree_->root(); n != BspTree::no_node;) {
    path.push_back(visit(n, begin, omega));
    const TreeVisit& last = path.back();
    switch (last.place_of(step)) {
      case TreeVisit::Place::near_side:
        n = sides(last).near;
        break;
      case TreeVisit::Place::plane:
        return path;
      case TreeVisit::Place::far_side:
        begin = last.plane_end;
        n = sides(last).far;
        break;
    }
  }
  return path;
}

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
