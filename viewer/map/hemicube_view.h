// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QImage>
#include <QWidget>
#include <memory>
#include <vector>

#include "colors/color_map.h"
#include "model/requests/hemicube_comparison.h"
#include "state/selection.h"
#include "support/request_worker.h"

namespace transillum::viewer {

/// The view from the center of the selected patch through the pixels of a hemicube, unfolded as a
/// cross and seen from inside: in the patches' colors, or colored by the relative error of each
/// patch's form factor. A worker thread renders it.
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
  bool up_to_date() const { return done_ == sent_.number; }
  /// The comparison that is shown; null if there is none.
  std::shared_ptr<const HemicubeComparison> comparison() const { return comparison_; }
  /// Patch and error, progress, or the reason why nothing is shown.
  QString status_text() const;

  QSize sizeHint() const override { return {200, 110}; }

 signals:
  void shown();  ///< a new picture or a new status_text()

 protected:
  bool event(QEvent* event) override;
  void paintEvent(QPaintEvent* event) override;

 private:
  struct Task {
    HemicubeComparison::Request request;
    quint64 number = 0;
  };
  void send_request();
  void work(const Task& task, const Cancellation& cancellation);
  void post_failure(const QString& message, quint64 number);
  /// `last`: the final result of request `number`.
  void show_comparison(std::shared_ptr<const HemicubeComparison> comparison, quint64 number,
                       bool last);
  void render_cross();
  void draw_legend(QPainter& painter) const;
  bool by_difference() const;
  /// The square in which the cross is drawn, logical pixels.
  QRectF cross_rect() const;
  std::optional<std::size_t> pixel_at(const QPointF& position) const;

  const Selection& selection_;
  Content content_;
  std::shared_ptr<const HemicubeComparison> comparison_;
  QString failure_;
  double progress_ = 0;  ///< finished fraction of the exact form factors
  QImage cross_;         ///< one image pixel per hemicube pixel
  Task sent_;            ///< the newest
  quint64 done_ = 0;     ///< number of the request whose final result is shown
  RequestWorker<Task> worker_;
};

}  // namespace transillum::viewer
