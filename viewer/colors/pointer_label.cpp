// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// The plate beside the pointer, over the scene and over the map. Values come from ColorChoice and
// its snapshot, so they agree with the colors shown.
#include "colors/pointer_label.h"

#include <QMouseEvent>
#include <QStringList>
#include <algorithm>
#include <cmath>
#include <utility>

#include "model/snapshot_values.h"
#include "support/has_index.h"
#include "support/number_text.h"
#include "transillum/at.h"

namespace transillum::viewer {

namespace {

// The distance from the pointer's tip to the plate, logical pixels: the plate does not cover the
// arrow.
constexpr QPoint offset{14, 18};

QString value_text(const ColorChoice& colors, const QString& symbol, const Rgb& value) {
  const QuantityTraits& traits = traits_of(colors.quantity());
  if (std::isnan(value.r)) {
    return PointerLabel::tr("%1  omitted: the patch emits, or reflects nothing").arg(symbol);
  }
  const bool channels = colors.scale().mode == ColorMode::true_color;
  const QString number = channels ? rgb_text(value) : number_text(colors.scale().value(value));
  return QStringLiteral("%1  %2 %3").arg(symbol, number, QString::fromUtf8(traits.unit)).trimmed();
}

// The value of the quantity: one line, or three lines for a linear quantity at a known point.
QStringList value_lines(const ColorChoice& colors, const PointedPatch& pointed) {
  const QString symbol = QString::fromUtf8(traits_of(colors.quantity()).symbol);
  const Rgb& mean = at(colors.values(), pointed.patch);
  if (!colors.linear() || colors.is_fitted() || !pointed.point || std::isnan(mean.r)) {
    return {value_text(colors, symbol, mean)};
  }
  return {PointerLabel::tr("x  %1 m").arg(vector_text(*pointed.point)),
          value_text(colors, PointerLabel::tr("%1 at x").arg(symbol),
                     colors.value_at(pointed.patch, *pointed.point)),
          value_text(colors, PointerLabel::tr("mean %1").arg(symbol), mean)};
}

QString form_factor_text(const SolverSnapshot& snapshot, PatchId from, PatchId to) {
  return QStringLiteral("F %1→%2  %3")
      .arg(from)
      .arg(to)
      .arg(snapshot.form_factors ? number_text(form_factor(*snapshot.form_factors, from, to))
                                 : why_no_form_factors(snapshot));
}

// The patch to which a form factor is shown; no_patch if no form factor is shown.
PatchId target_of(const ColorChoice& colors, PatchId patch) {
  const PatchId selected = colors.selection().patch();
  return selected == patch || selected >= colors.snapshot()->loaded->scene->patch_count()
             ? no_patch
             : selected;
}

}  // namespace

QString pointer_text(const ColorChoice& colors, const PointedPatch& pointed) {
  const PatchId patch = pointed.patch;
  const auto snapshot = colors.snapshot();
  if (!snapshot || patch < 0 || patch >= snapshot->loaded->scene->patch_count()) {
    return {};
  }
  QStringList lines{PointerLabel::tr("Patch %1").arg(patch)};
  if (has_index(colors.values(), patch)) {
    lines << value_lines(colors, pointed);
  }
  if (const PatchId target = target_of(colors, patch); target != no_patch) {
    lines << form_factor_text(*snapshot, patch, target);
  }
  return lines.join(QLatin1Char('\n'));
}

PointerLabel::PointerLabel(const ColorChoice& colors, QWidget& canvas,
                           std::function<PointedPatch(const QPoint&)> patch_at)
    : Plate(&canvas), colors_(colors), canvas_(canvas), patch_at_(std::move(patch_at)) {
  setObjectName("pointer_label");
  rest_.setSingleShot(true);
  rest_.setInterval(rest_ms);
  connect(&rest_, &QTimer::timeout, this, &PointerLabel::show_details);
  canvas_.setMouseTracking(true);
  canvas_.installEventFilter(this);
  const auto update_text = [this] {
    if (isVisible()) {
      show_patch(pointed_);
    }
  };
  connect(&colors_, &ColorChoice::changed, this, update_text);
  connect(&colors_, &ColorChoice::fitted, this, update_text);
  connect(&colors_.selection(), &Selection::changed, this, update_text);
}

void PointerLabel::set_details(std::function<QString(const QPoint&)> details,
                               std::function<QRect(const QPoint&)> explained) {
  details_ = std::move(details);
  explained_ = std::move(explained);
}

void PointerLabel::point_again() {
  end_rest();
  if (isVisible()) {
    show_patch(patch_at_(pointer_));
    rest_.start();
  }
}

void PointerLabel::show_details() {
  const QString details = isVisible() && details_ ? details_(pointer_) : QString();
  if (details.isEmpty()) {
    return;
  }
  detailed_ = true;
  setText(pointer_text(colors_, pointed_) + QLatin1Char('\n') + details);
  place();
  emit rested(pointer_);
}

void PointerLabel::end_rest() {
  rest_.stop();
  if (std::exchange(detailed_, false)) {
    emit left();
  }
}

bool PointerLabel::eventFilter(QObject* watched, QEvent* event) {
  if (event->type() == QEvent::MouseMove) {
    end_rest();
    rest_.start();
    const auto* mouse = static_cast<QMouseEvent*>(event);
    pointer_ = mouse->pos();
    show_patch(mouse->buttons() == Qt::NoButton ? patch_at_(pointer_) : PointedPatch{});
  } else if (event->type() == QEvent::Leave || event->type() == QEvent::Wheel ||
             event->type() == QEvent::MouseButtonPress) {
    end_rest();
    hide();
  }
  return Plate::eventFilter(watched, event);
}

void PointerLabel::show_patch(const PointedPatch& pointed) {
  pointed_ = pointed;
  const QString text = pointer_text(colors_, pointed_);
  setVisible(!text.isEmpty());
  if (text.isEmpty()) {
    return;
  }
  setText(text);
  place();
  const auto snapshot = colors_.snapshot();
  if (!snapshot->form_factors && target_of(colors_, pointed_.patch) != no_patch) {
    emit form_factors_requested();
  }
}

namespace {

/// The place in `canvas` for a plate that covers the least of `explained`: `first`, or a place
/// beside it, or a corner.
QPoint place_beside(const QRect& explained, const QRect& first, const QRect& canvas) {
  QRect best = first;
  const auto covered = [&explained](const QRect& plate) {
    const QRect common = plate.intersected(explained);
    return common.isEmpty() ? 0 : qint64{common.width()} * common.height();
  };
  constexpr int gap = 6;
  const int right = explained.right() + gap, left = explained.left() - gap - first.width();
  const int below = explained.bottom() + gap, above = explained.top() - gap - first.height();
  const QPoint ends = QPoint(canvas.right() - first.width(), canvas.bottom() - first.height());
  for (const QPoint& corner : {QPoint(right, first.top()), QPoint(left, first.top()),
                               QPoint(first.left(), below), QPoint(first.left(), above), ends,
                               QPoint(0, ends.y()), QPoint(ends.x(), 0), QPoint(0, 0)}) {
    const QRect plate(corner, first.size());
    if (canvas.contains(plate) && covered(plate) < covered(best)) {
      best = plate;
    }
  }
  return best.topLeft();
}

}  // namespace

// To the right of the pointer and below, or on the other side where there is no room.
void PointerLabel::place() {
  adjustSize();
  QPoint corner = pointer_ + offset;
  if (corner.x() + width() > canvas_.width()) {
    corner.setX(std::max(0, pointer_.x() - offset.x() / 2 - width()));
  }
  if (corner.y() + height() > canvas_.height()) {
    corner.setY(std::max(0, pointer_.y() - offset.x() / 2 - height()));
  }
  if (detailed_ && explained_) {
    corner = place_beside(explained_(pointer_), QRect(corner, size()), canvas_.rect());
  }
  move(corner);
  raise();
}

}  // namespace transillum::viewer
