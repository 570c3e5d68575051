// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QImage>
#include <QWidget>
#include <memory>

#include "io/drawing/study_chart.h"
#include "model/solver/study_runner.h"

namespace transillum::viewer {

/// The plot of a study.
class StudyChart : public QWidget {
  Q_OBJECT

 public:
  explicit StudyChart(QWidget* parent = nullptr);

  void show_study(std::shared_ptr<const StudySnapshot> snapshot);
  void set_measure(ErrorMeasure measure);
  void set_axis(StudyAxis axis);

  QSize sizeHint() const override { return {800, 480}; }
  QSize minimumSizeHint() const override { return {500, 300}; }

 protected:
  void paintEvent(QPaintEvent* event) override;
  void changeEvent(QEvent* event) override;

 private:
  void discard_picture();

  std::shared_ptr<const StudySnapshot> snapshot_;
  ErrorMeasure measure_ = ErrorMeasure::rms;
  StudyAxis axis_ = StudyAxis::passes;
  QImage picture_;  ///< in device pixels; null until it is drawn
};

}  // namespace transillum::viewer
