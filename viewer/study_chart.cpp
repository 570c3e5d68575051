// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "study_chart.h"

#include <QPainter>
#include <cstring>
#include <utility>

#include "theme.h"
#include "transillum/study_files.h"

namespace transillum::viewer {

StudyChart::StudyChart(QWidget* parent) : QWidget(parent) {
  setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Expanding);
}

void StudyChart::show_study(std::shared_ptr<const StudySnapshot> snapshot) {
  const auto points = [](const auto& s) { return s ? s->study.points.size() : 0; };
  // Progress alone changes no picture.
  const bool same = snapshot && snapshot_ && snapshot->loaded == snapshot_->loaded &&
                    snapshot->series == snapshot_->series && snapshot->running &&
                    points(snapshot) == points(snapshot_) && !picture_.isNull();
  snapshot_ = std::move(snapshot);
  if (!same) forget_picture();
}

void StudyChart::set_measure(ErrorMeasure measure) {
  measure_ = measure;
  forget_picture();
}

void StudyChart::forget_picture() {
  picture_ = {};
  update();
}

void StudyChart::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  painter.fillRect(rect(), theme::paper);
  if (!snapshot_ || snapshot_->study.points.empty()) {
    painter.setPen(theme::ink_dim);
    painter.drawText(rect().adjusted(24, 24, -24, -24), Qt::AlignCenter | Qt::TextWordWrap,
                     snapshot_ && snapshot_->running
                         ? tr("First, what others are compared with; then a point for each number "
                              "of passes")
                         : tr("Error of B against the number of passes M, for each choice of "
                              "directions\nChoose at the left, then run the study"));
    return;
  }
  const QSize pixels = size() * devicePixelRatioF();
  if (picture_.size() != pixels) {
    const PlotPicture plot =
        draw_study_plot(snapshot_->loaded->scene->name(), snapshot_->series, snapshot_->study,
                        measure_, pixels.width(), pixels.height());
    picture_ = QImage(pixels, QImage::Format_RGB32);
    for (int y = 0; y < plot.height; ++y) {
      const auto width = static_cast<std::size_t>(plot.width);
      std::memcpy(picture_.scanLine(y), &plot.pixels[static_cast<std::size_t>(y) * width],
                  width * sizeof(std::uint32_t));
    }
  }
  painter.drawImage(rect(), picture_);
}

}  // namespace transillum::viewer
