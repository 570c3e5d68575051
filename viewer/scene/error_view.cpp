// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// The panel "Error": pictures of the error of B for several sets of directions. Each is solved and
// compared with a reference of many passes; the pictures are traced by the scene's picker.
#include "scene/error_view.h"

#include <QPainter>
#include <QPushButton>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <utility>

#include "colors/color_map.h"
#include "colors/color_scale.h"
#include "model/material_edits.h"
#include "support/number_text.h"
#include "transillum/at.h"
#include "transillum/first_shot.h"
#include "transillum/study.h"
#include "widgets/build.h"
#include "widgets/theme.h"

namespace transillum::viewer {

namespace {

constexpr int picture_side = 320;  // pixels
constexpr int reference_factor = 8;
constexpr ColorMap error_map = ColorMap::inferno;

// The patch at each pixel, row by row; no_patch where there is none.
std::vector<PatchId> patches_in_view(const LoadedScene& loaded, const ViewPoint& view,
                                     const Cancellation& cancellation) {
  const Vec3 forward = normalized(view.target - view.eye);
  const Vec3 right = normalized(cross(forward, view.up));
  const Vec3 up = cross(right, forward);
  const double slope = std::tan(view.view_angle / 2 * std::numbers::pi / 180);
  std::vector<PatchId> patches;
  patches.reserve(picture_side * picture_side);
  for (int y = 0; y < picture_side; ++y) {
    cancellation.throw_if_canceled();
    for (int x = 0; x < picture_side; ++x) {
      const double a = slope * (2 * (x + 0.5) / picture_side - 1);
      const double b = slope * (1 - 2 * (y + 0.5) / picture_side);
      const auto hit = loaded.picker->first_lit_hit(view.eye, forward + a * right + b * up);
      patches.push_back(hit ? hit->patch : no_patch);
    }
  }
  return patches;
}

// |B - reference| over the RMS of reflected light, luminance.
std::vector<double> errors_of(const Scene& scene, const std::vector<Rgb>& radiosity,
                              const std::vector<Rgb>& reference) {
  double squares = 0;
  for (const Rgb& b : reflected_light(scene, reference)) {
    squares += luminance(b) * luminance(b);
  }
  const double rms = std::sqrt(squares / static_cast<double>(reference.size()));
  std::vector<double> errors;
  for (std::size_t i = 0; i < reference.size(); ++i) {
    errors.push_back(std::abs(luminance(radiosity[i]) - luminance(reference[i])) / rms);
  }
  return errors;
}

QImage picture_of(const std::vector<PatchId>& patches, const std::vector<double>& errors,
                  double most) {
  QImage image(picture_side, picture_side, QImage::Format_RGB32);
  for (int k = 0; k < picture_side * picture_side; ++k) {
    const PatchId patch = at(patches, k);
    QRgb pixel = theme::scene_background.rgb();
    if (patch != no_patch) {
      const Color8 color = color_of(error_map, std::min(1.0, at(errors, patch) / most));
      pixel = qRgb(color[0], color[1], color[2]);
    }
    image.setPixel(k % picture_side, k / picture_side, pixel);
  }
  return image;
}

// The scale ends at nearly the largest error of all runs: a single patch does not set it.
double scale_of(const std::vector<std::vector<double>>& errors) {
  constexpr double fraction = 0.95;
  double most = 1e-12;
  for (std::vector<double> sorted : errors) {
    std::sort(sorted.begin(), sorted.end());
    const auto place = static_cast<std::size_t>(fraction * static_cast<double>(sorted.size() - 1));
    most = std::max(most, sorted[place]);
  }
  return most;
}

QString percent_text(double fraction) { return number_text(100 * fraction) + QStringLiteral(" %"); }

}  // namespace

ErrorView::ErrorView(std::function<ViewPoint()> view, const MaterialEdits& edits, QWidget* parent)
    : QWidget(parent),
      view_(std::move(view)),
      edits_(edits),
      button_(named("measure_errors", new QPushButton(this),
                    tr("Solve with each set of directions, and compare with a reference of many "
                       "passes"))),
      worker_(
          [this](const Job& job, const Cancellation& cancellation) { measure(job, cancellation); },
          [this](const Job& job, const QString& message) {
            QMetaObject::invokeMethod(
                this,
                [this, number = job.number, message] {
                  if (number == number_) {
                    drop();
                    emit failed(message);
                  }
                },
                Qt::QueuedConnection);
          }) {
  setObjectName("error_view");
  connect(button_, &QPushButton::clicked, this, [this] {
    if (busy_) {
      drop();
    } else if (snapshot_) {
      start(wanted_.runs.empty() ? usual_runs() : wanted_);
    }
  });
  connect(&edits_, &MaterialEdits::changed, this, &ErrorView::show_state);
  place_button();
}

ErrorRuns ErrorView::usual_runs() const {
  SolveOptions options = snapshot_->options;
  options.goal = {};
  ErrorRuns runs{{}, reference_factor * options.directions};
  const auto add = [&](const QString& label, Sampling sampling, bool two_way) {
    options.sampling = sampling;
    options.two_way = two_way;
    runs.runs.push_back({label.toStdString(), options});
  };
  add(tr("random"), Sampling::random, false);
  add(tr("Hammersley"), Sampling::hammersley, false);
  add(tr("default"), default_sampling(true), true);
  return runs;
}

void ErrorView::show_snapshot(std::shared_ptr<const SolverSnapshot> snapshot) {
  snapshot_ = std::move(snapshot);
  show_state();
}

void ErrorView::show_state() {
  if (running_scene_ && (running_scene_ != snapshot_->loaded || !why_not().isEmpty())) {
    drop();
  }
  if (button_->isEnabled() != why_not().isEmpty()) {
    place_button();
  }
  start_if_wanted();
}

void ErrorView::set_runs(const ErrorRuns& runs) {
  if (runs == wanted_) {
    return;
  }
  wanted_ = runs;
  drop();
  start_if_wanted();
}

void ErrorView::start_if_wanted() {
  const bool known = (busy_ || result_) && running_ == wanted_;
  if (isVisible() && why_not().isEmpty() && !wanted_.runs.empty() && !known) {
    start(wanted_);
  }
}

void ErrorView::start(const ErrorRuns& runs) {
  result_ = nullptr;
  busy_ = true;
  share_ = 0;
  running_ = runs;
  running_scene_ = snapshot_->loaded;
  worker_.request({snapshot_->loaded, runs, view_(), ++number_});
  place_button();
}

void ErrorView::drop() {
  ++number_;
  worker_.clear();
  busy_ = false;
  result_ = nullptr;
  running_ = {};
  running_scene_ = nullptr;
  place_button();
}

void ErrorView::measure(const Job& job, const Cancellation& cancellation) {
  const auto& loaded = *job.loaded;
  const double passes =
      std::accumulate(job.runs.runs.begin(), job.runs.runs.end(), double(job.runs.reference),
                      [](double sum, const auto& run) { return sum + run.solve.directions; });
  SolveOptions reference_run = reference_options(job.runs.reference);
  reference_run.first_shot = first_shot_where_it_pays;
  const std::vector<Rgb> reference = solve_reference(
      loaded.scene, loaded.tree, reference_run,
      [&](const SolveProgress& now) { show_progress(job.number, now.direction / passes); },
      cancellation);
  std::vector<std::vector<double>> errors;
  auto result = std::make_shared<Result>();
  for (const ErrorRuns::Run& run : job.runs.runs) {
    RadiositySolver solver(loaded.scene, run.solve, {.tree = loaded.tree}, cancellation);
    solver.advance(RadiositySolver::Until::finished);
    errors.push_back(errors_of(*loaded.scene, solver.radiosity(), reference));
    result->rms.push_back(radiosity_error(*loaded.scene, solver.radiosity(), reference).rms);
  }
  result->most = scale_of(errors);
  const std::vector<PatchId> patches = patches_in_view(loaded, job.view, cancellation);
  for (const std::vector<double>& of_run : errors) {
    result->pictures.push_back(picture_of(patches, of_run, result->most));
  }
  QMetaObject::invokeMethod(
      this,
      [this, number = job.number, result] {
        if (number == number_) {
          busy_ = false;
          result_ = result;
          place_button();
        }
      },
      Qt::QueuedConnection);
}

void ErrorView::show_progress(int number, double fraction) {
  const auto percent = [](double value) { return static_cast<int>(100 * value); };
  if (percent(fraction) == percent(share_)) {
    return;
  }
  QMetaObject::invokeMethod(
      this,
      [this, number, fraction] {
        if (number == number_) {
          share_ = fraction;
          update();
        }
      },
      Qt::QueuedConnection);
}

QString ErrorView::why_not() const {
  return snapshot_ ? edits_.why_unsolved() : tr("No scene is open");
}

void ErrorView::place_button() {
  button_->setText(busy_ ? tr("Stop") : result_ ? tr("Measure again") : tr("Measure the errors"));
  enable_if(*button_, why_not().isEmpty(), why_not());
  button_->adjustSize();
  button_->move(width() - button_->width() - 8, height() - button_->height() - 6);
  update();
}

void ErrorView::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  painter.setRenderHint(QPainter::SmoothPixmapTransform);
  painter.setPen(theme::ink);
  if (!result_) {
    const QString text =
        busy_ ? tr("Solving and comparing: %1 %").arg(static_cast<int>(100 * share_))
        : snapshot_ && !why_not().isEmpty()
            ? why_not()
            : tr("The error of B by set of directions: random, Hammersley and the default");
    painter.drawText(rect().adjusted(16, 8, -16, -button_->height() - 12),
                     Qt::AlignCenter | Qt::TextWordWrap, text);
    return;
  }
  const double foot = button_->height() + 12.0;
  const auto count = static_cast<double>(result_->pictures.size());
  const double column = width() / count;
  for (std::size_t k = 0; k < result_->pictures.size(); ++k) {
    paint_run(painter, {static_cast<double>(k) * column, 0, column, height() - foot}, k);
  }
  paint_scale(painter, {10, height() - foot + 4, width() - button_->width() - 40.0, foot - 8});
}

void ErrorView::paint_run(QPainter& painter, const QRectF& box, std::size_t run) const {
  const double line = painter.fontMetrics().height();
  const QRectF title(box.left() + 4, box.top() + 4, box.width() - 8, 2 * line);
  painter.setPen(theme::ink);
  QFont bold = font();
  bold.setBold(true);
  painter.setFont(bold);
  painter.drawText(
      title, Qt::AlignHCenter | Qt::AlignTop,
      painter.fontMetrics().elidedText(QString::fromStdString(running_.runs[run].label),
                                       Qt::ElideRight, static_cast<int>(title.width())));
  painter.setFont(font());
  painter.drawText(title, Qt::AlignHCenter | Qt::AlignBottom,
                   tr("RMS error %1").arg(percent_text(result_->rms[run])));
  const double room = box.bottom() - title.bottom() - 6;
  const double side = std::min(box.width() - 8, room);
  painter.drawImage(QRectF(box.center().x() - side / 2, title.bottom() + 4, side, side),
                    result_->pictures[run]);
}

void ErrorView::paint_scale(QPainter& painter, const QRectF& box) const {
  const QString zero = QStringLiteral("0");
  const QString most = tr("%1 of the RMS of reflected light").arg(percent_text(result_->most));
  const double left = box.left() + painter.fontMetrics().horizontalAdvance(zero) + 8;
  const double right = box.right() - painter.fontMetrics().horizontalAdvance(most) - 8;
  const QRectF bar(left, box.center().y() - 5, std::max(20.0, right - left), 10);
  QLinearGradient gradient(bar.topLeft(), bar.topRight());
  for (int k = 0; k <= 16; ++k) {
    const Color8 color = color_of(error_map, k / 16.0);
    gradient.setColorAt(k / 16.0, QColor(color[0], color[1], color[2]));
  }
  painter.fillRect(bar, gradient);
  painter.setPen(theme::ink);
  painter.drawText(box, Qt::AlignLeft | Qt::AlignVCenter, zero);
  painter.drawText(QRectF(bar.right() + 8, box.top(), width(), box.height()),
                   Qt::AlignLeft | Qt::AlignVCenter, most);
}

void ErrorView::resizeEvent(QResizeEvent* event) {
  QWidget::resizeEvent(event);
  place_button();
}

void ErrorView::showEvent(QShowEvent* event) {
  QWidget::showEvent(event);
  start_if_wanted();
}

// Errors are computed only while the panel is visible.
void ErrorView::hideEvent(QHideEvent* event) {
  if (busy_) {
    drop();
  }
  QWidget::hideEvent(event);
}

}  // namespace transillum::viewer
