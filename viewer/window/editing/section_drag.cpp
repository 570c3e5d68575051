// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "window/editing/section_drag.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace transillum::viewer {

namespace {

/// An object may shrink to this fraction in one drag.
constexpr double least_scale = 0.02;

/// The number of a coordinate axis.
int number_of(const Vec3& axis) { return axis.x != 0 ? 0 : axis.y != 0 ? 1 : 2; }

/// The vector without its part along an axis.
Vec3 across(Vec3 v, int axis) {
  coordinate(v, axis) = 0;
  return v;
}

/// The placement that turns about an axis and stretches `from` to `to`; both are across the axis.
/// Where `from` is along another axis, only lengths along that one change; else those along both
/// other axes change alike.
FacePlacement stretched(const Vec3& from, const Vec3& to, int axis) {
  const int u = (axis + 1) % 3, v = (axis + 2) % 3;
  const double ratio = std::max(norm(to) / norm(from), least_scale);
  const double angle = std::atan2(coordinate(to, v), coordinate(to, u)) -
                       std::atan2(coordinate(from, v), coordinate(from, u));
  FacePlacement placement;
  coordinate(placement.turn, axis) = angle * 180 / std::numbers::pi;
  constexpr double aligned = 1e-9;
  for (const int k : {u, v}) {
    if (std::abs(coordinate(from, k)) > aligned * norm(from)) {
      coordinate(placement.scale, k) = ratio;
    }
  }
  return placement;
}

}  // namespace

SectionDrag::SectionDrag(SceneEdits& edits, SectionView& view)
    : QObject(&edits), edits_(edits), view_(view) {
  connect(&view_, &SectionView::grabbed, this, &SectionDrag::begin);
  connect(&view_, &SectionView::dragged, this, &SectionDrag::move_to);
  connect(&view_, &SectionView::released, this, &SectionDrag::end);
}

void SectionDrag::begin(const SectionView::Grip& grip) {
  held_.reset();
  const Section* section = view_.section();
  const QString reason = edits_.why_unavailable();
  if (!section || !reason.isEmpty()) {
    emit edits_.failed(reason);
    return;
  }
  was_active_ = edits_.active();
  reach_before_ = edits_.reach();
  Held held{.held = section->in_space(grip.held),
            .center = {},
            .fixed = {},
            .axis = number_of(section->axis)};
  if (grip.fixed) {
    held.fixed = section->in_space(*grip.fixed);
  }
  edits_.choose(grip.patch, SceneEdits::Reach::object);
  const Bounds all = edits_.frame().state.scene.loaded()->scene->bounds();
  if (norm(edits_.extents()) >= norm(all.high - all.low)) {
    edits_.choose(grip.patch, SceneEdits::Reach::face);
  }
  held.center = edits_.center();
  if (held.fixed && (is_cut_off(held.held, held.axis) || is_cut_off(*held.fixed, held.axis))) {
    held.fixed.reset();
  }
  held_ = held;
}

/// Whether the target is deeper than the section there: where this looks aslant, it leaves a board
/// through a long side, and what it shows is no end of the board.
bool SectionDrag::is_cut_off(const Vec3& end, int axis) const {
  const double depth = coordinate(edits_.extents(), axis);
  const double beside = std::abs(coordinate(end, axis) - coordinate(edits_.center(), axis));
  return beside > 0.5 * (1 - 1e-9) * depth;
}

void SectionDrag::move_to(const Vec2& to) {
  const Section* section = view_.section();
  if (!held_ || !section || !edits_.has_target()) {
    return;
  }
  const Vec3 wanted = section->in_space(to);
  const int axis = held_->axis;
  if (!held_->fixed) {
    edits_.place({.move = across(wanted - held_->held, axis)});
    return;
  }
  const Vec3 from = across(held_->held - *held_->fixed, axis);
  const Vec3 goal = across(wanted - *held_->fixed, axis);
  if (norm(goal) < least_scale * norm(from)) {
    return;
  }
  FacePlacement placement = stretched(from, goal, axis);
  // The fixed end stays where it is.
  placement.move = across(*held_->fixed - placed(*held_->fixed, held_->center, placement), axis);
  edits_.place(placement);
}

void SectionDrag::end() {
  if (!held_) {
    return;
  }
  held_.reset();
  edits_.finish();
  edits_.set_reach(reach_before_);
  edits_.set_active(was_active_);
}

}  // namespace transillum::viewer
