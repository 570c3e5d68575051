// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "solve/study_chart.h"

#include <QPainter>
#include <algorithm>
#include <utility>

#include "widgets/log_chart.h"
#include "widgets/theme.h"

namespace transillum::viewer {

StudyChart::StudyChart(QWidget* parent) : QWidget(parent) {
  setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Expanding);
}

void StudyChart::show_study(std::shared_ptr<const StudySnapshot> snapshot) {
  const auto points = [](const auto& s) { return s ? s->study.points.size() : 0; };
  // Progress alone does not change the picture.
  const bool same = snapshot && snapshot_ && snapshot->loaded == snapshot_->loaded &&
                    snapshot->series == snapshot_->series && snapshot->running &&
                    points(snapshot) == points(snapshot_) && !picture_.isNull();
  snapshot_ = std::move(snapshot);
  if (!same) {
    discard_picture();
  }
}

void StudyChart::set_measure(ErrorMeasure measure) {
  measure_ = measure;
  discard_picture();
}

void StudyChart::set_axis(StudyAxis axis) {
  axis_ = axis;
  discard_picture();
}

void StudyChart::discard_picture() {
  picture_ = {};
  update();
}

void StudyChart::changeEvent(QEvent* event) {
  discard_picture();  // palette or font may have changed
  QWidget::changeEvent(event);
}

void StudyChart::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  painter.fillRect(rect(), theme::paper);
  if (!snapshot_ || snapshot_->study.points.empty()) {
    painter.setPen(theme::ink_dim);
    painter.drawText(rect().adjusted(24, 24, -24, -24), Qt::AlignCenter | Qt::TextWordWrap,
                     snapshot_ && snapshot_->running
                         ? tr("The reference is solved first; then one point per number of passes "
                              "appears")
                         : tr("Error of B against the number of passes M, one line per set of "
                              "directions\nChoose on the left, then run the study"));
    return;
  }
  const QSize pixels = size() * devicePixelRatioF();
  if (picture_.size() != pixels) {
    ChartStyle style;  // text sizes as in files, colors and font of the window
    const ChartStyle window = chart_style(*this);
    style.paper = window.paper;
    style.ink = window.ink;
    style.dim = window.dim;
    style.grid = window.grid;
    style.font = window.font;
    const double scale = std::min(width() / 800.0, height() / 480.0);
    paint_chart(study_chart(snapshot_->loaded->scene->name(), snapshot_->series, snapshot_->study,
                            measure_, axis_, style),
                picture_, pixels, scale * devicePixelRatioF());
  }
  painter.drawImage(rect(), picture_);
}

}  // namespace transillum::viewer
