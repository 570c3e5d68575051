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

  QSize sizeHint() const override { return {420, 340}; }
  QSize minimumSizeHint() const override { return {120, 80}; }

 protected:
  void paintEvent(QPaintEvent* event) override;
  void mousePressEvent(QMouseEvent* event) override;

 private:
  Focus& focus_;
  Selection& selection_;
  const ColorChoice& colors_;
  std::vector<Callout> callouts_;
  /// The section of a direction, kept while its steps are shown.
  struct Known {
    std::shared_ptr<const RecordedMap> map;
    Section section;
  };
  mutable std::optional<Known> known_;
};

}  // namespace transillum::viewer
