// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QImage>
#include <QWidget>
#include <memory>
#include <vector>

#include "colors/color_map.h"
#include "model/hemicube_comparison.h"
#include "state/selection.h"
#include "support/request_worker.h"

namespace transillum::viewer {

/// What the selected patch sees through the pixels of a hemicube on its middle, unfolded as a cross
/// and seen from inside: in the patches' colors, or by how much more (or less) of a patch is seen
/// than there is. A thread of its own makes it.
class HemicubeView : public QWidget {
  Q_OBJECT

 public:
  explicit HemicubeView(const Selection& selection, QWidget* parent = nullptr);

  struct Content {
    std::shared_ptr<const LoadedScene> loaded;
    int resolution = 64;  ///< even
    bool differences = true;
    std::shared_ptr<const std::vector<Color8>> patch_colors;
  };
  void show_scene(Content content);
  void clear();
  bool up_to_date() const { return done_ == asked_.number; }
  /// What is shown; null where nothing is.
  std::shared_ptr<const HemicubeComparison> comparison() const { return comparison_; }
  /// What there is to say of it.
  QString words() const;

  QSize sizeHint() const override { return {200, 110}; }

 signals:
  void shown();  ///< or words() have changed

 protected:
  bool event(QEvent* event) override;
  void paintEvent(QPaintEvent* event) override;

 private:
  struct Order {
    HemicubeComparison::Request request;
    quint64 number = 0;
  };
  void ask();
  void work(const Order& order, const Cancellation& cancellation);
  void post_failure(const QString& message, quint64 number);
  void take(std::shared_ptr<const HemicubeComparison> comparison, quint64 number, bool last);
  void draw_cross();
  bool by_difference() const;
  /// Where the cross is drawn, logical pixels.
  QRectF place() const;
  std::optional<std::size_t> pixel_at(const QPointF& position) const;

  const Selection& selection_;
  Content content_;
  std::shared_ptr<const HemicubeComparison> comparison_;
  QString failure_;
  double progress_ = 0;  ///< of the exact form factors
  QImage cross_;         ///< a pixel a cell
  Order asked_;
  quint64 done_ = 0;
  RequestWorker<Order> worker_;
};

}  // namespace transillum::viewer
