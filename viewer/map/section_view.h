// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QWidget>
#include <memory>
#include <optional>
#include <vector>

#include "colors/color_choice.h"
#include "state/callout.h"
#include "state/focus.h"
#include "state/section.h"
#include "state/selection.h"

namespace transillum::viewer {

/// The direction in focus in two dimensions (Section): patches as segments, V as intervals of a
/// line below them, and the strips along omega that join an interval with the patch seen there.
/// Without a step, the strips join the patches that exchange light.
class SectionView : public QWidget {
  Q_OBJECT

 public:
  SectionView(Focus& focus, Selection& selection, const ColorChoice& colors,
              QWidget* parent = nullptr);

  /// Shows these callouts until the next call.
  void show_callouts(const std::vector<Callout>& callouts);

  /// An interval of the line, or of a patch that receives.
  struct Shown {
    Section::Interval interval;
    PatchId receiver = no_patch;  ///< no_patch: on the line
  };
  /// The intervals shown; empty without a direction.
  std::vector<Shown> shown() const;
  /// The section shown; null without a direction.
  const Section* section() const;

  /// The part of a segment that the hand holds.
  struct Grip {
    PatchId patch = no_patch;
    Vec2 held;                  ///< an end of the segment, or the point under the pointer, m
    std::optional<Vec2> fixed;  ///< the other end; not set where the whole segment is held
  };
  /// The pixel of a point of the section; requires a section.
  QPointF pixel_of(const Vec2& point) const;

  QSize sizeHint() const override { return {420, 340}; }
  QSize minimumSizeHint() const override { return {120, 80}; }

 signals:
  /// A segment is dragged: `to` is where the held point is wanted, m.
  void grabbed(const SectionView::Grip& grip);
  void dragged(const Vec2& to);
  void released();

 protected:
  void paintEvent(QPaintEvent* event) override;
  void mousePressEvent(QMouseEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;
  void mouseReleaseEvent(QMouseEvent* event) override;

 private:
  std::optional<Grip> grip_at(const QPointF& position) const;
  /// Under the pressed button, from the pixel where it was pressed.
  struct Drag {
    Grip grip;
    QPointF pressed;
    Vec2 offset;  ///< from the pointer to the held point, m
    bool moves = false;
  };
  Focus& focus_;
  Selection& selection_;
  const ColorChoice& colors_;
  std::vector<Callout> callouts_;
  std::optional<Drag> drag_;
  /// The section of a direction, kept while its steps are shown.
  struct Known {
    std::shared_ptr<const RecordedMap> map;
    Section section;
  };
  mutable std::optional<Known> known_;
};

}  // namespace transillum::viewer
