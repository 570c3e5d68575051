// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Renders the hemicube of the selected patch on a worker thread and shows it unfolded. The image
// comes from render_hemicube(), the errors from with_exact().
#include "map/hemicube_view.h"

#include <QHelpEvent>
#include <QPainter>
#include <QToolTip>
#include <algorithm>
#include <utility>

#include "map/engine_drawing.h"
#include "support/number_text.h"
#include "transillum/at.h"
#include "widgets/theme.h"

namespace transillum::viewer {

namespace {

constexpr int legend_height = 34;
const QColor no_front_color{0x43, 0x4a, 0x55};

}  // namespace

HemicubeView::HemicubeView(const Selection& selection, QWidget* parent)
    : QWidget(parent),
      selection_(selection),
      worker_(
          [this](const Task& task, const Cancellation& cancellation) { work(task, cancellation); },
          [this](const Task& task, const QString& message) {
            post_failure(message, task.number);
          }) {
  setMinimumSize(200, 80);
  setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Expanding);
  setAttribute(Qt::WA_OpaquePaintEvent);
  connect(&selection_, &Selection::changed, this, &HemicubeView::send_request);
}

void HemicubeView::show_scene(Content content) {
  content_ = std::move(content);
  send_request();
  render_cross();
}

void HemicubeView::clear() {
  content_ = {};
  send_request();
}

void HemicubeView::send_request() {
  const HemicubeComparison::Request request{content_.loaded, selection_.patch(),
                                            content_.resolution, content_.differences};
  if (request == sent_.request) {
    return;
  }
  sent_ = {request, sent_.number + 1};
  failure_.clear();
  progress_ = 0;
  if (!request.loaded || request.eye == no_patch) {
    worker_.clear();
    show_comparison(nullptr, sent_.number, true);
  } else {
    worker_.request(sent_);
  }
}

void HemicubeView::work(const Task& task, const Cancellation& cancellation) {
  const auto post = [this](auto message) {
    QMetaObject::invokeMethod(this, std::move(message), Qt::QueuedConnection);
  };
  const auto comparison = render_hemicube(task.request, cancellation);
  const bool last = !task.request.differences;
  post([this, comparison, number = task.number, last] {
    show_comparison(comparison, number, last);
  });
  if (last) {
    return;
  }
  const auto progress = [&](double fraction) {
    post([this, fraction, number = task.number] {
      if (number != sent_.number) {
        return;
      }
      progress_ = fraction;
      emit shown();
    });
  };
  const auto compared = with_exact(*comparison, cancellation, progress);
  post([this, compared, number = task.number] { show_comparison(compared, number, true); });
}

// Runs on the worker's thread; what it posts runs on the window's thread.
void HemicubeView::post_failure(const QString& message, quint64 number) {
  const auto show = [this, message, number] {
    if (number != sent_.number) {
      return;
    }
    failure_ = message;
    show_comparison(nullptr, number, true);
  };
  QMetaObject::invokeMethod(this, show, Qt::QueuedConnection);
}

void HemicubeView::show_comparison(std::shared_ptr<const HemicubeComparison> comparison,
                                   quint64 number, bool last) {
  if (number != sent_.number) {
    return;  // the request is outdated
  }
  comparison_ = std::move(comparison);
  if (last) {
    done_ = number;
  }
  render_cross();
  emit shown();
}

bool HemicubeView::by_difference() const {
  return comparison_ && content_.differences && !comparison_->exact.empty();
}

// x to the left, as seen from inside; y up.
void HemicubeView::render_cross() {
  update();
  if (!comparison_ || !content_.patch_colors) {
    return;
  }
  const HemicubeImage& image = comparison_->image;
  const int size = image.cross();
  cross_ = QImage(size, size, QImage::Format_RGB32);
  cross_.fill(theme::scene_background);
  for (int row = 0; row < size; ++row) {
    auto* line = reinterpret_cast<QRgb*>(cross_.scanLine(size - 1 - row));
    for (int column = 0; column < size; ++column) {
      const auto pixel = image.pixel_at(column, row);
      if (!pixel) {
        continue;
      }
      const PatchId patch = image.items[*pixel];
      QRgb color = no_front_color.rgb();
      if (patch != no_patch && by_difference()) {
        color = color_of_surplus(comparison_->surplus(patch)).rgb();
      } else if (patch != no_patch) {
        const Color8& c = at(*content_.patch_colors, patch);
        color = qRgb(c[0], c[1], c[2]);
      }
      line[size - 1 - column] = color;
    }
  }
}

QRectF HemicubeView::cross_rect() const {
  const double side = std::max(std::min(width(), height() - legend_height) - 16.0, 10.0);
  return {(width() - side) / 2, (height() - legend_height - side) / 2, side, side};
}

std::optional<std::size_t> HemicubeView::pixel_at(const QPointF& position) const {
  if (!comparison_ || !cross_rect().contains(position)) {
    return std::nullopt;
  }
  const int size = comparison_->image.cross();
  const auto cell = [size](double fraction) {
    return std::clamp(static_cast<int>(fraction * size), 0, size - 1);
  };
  const QPointF at = (position - cross_rect().topLeft()) / cross_rect().width();
  return comparison_->image.pixel_at(size - 1 - cell(at.x()), size - 1 - cell(at.y()));
}

QString HemicubeView::status_text() const {
  if (!failure_.isEmpty()) {
    return failure_;
  }
  if (!content_.loaded || selection_.patch() == no_patch) {
    return tr("Select a patch to place the hemicube on");
  }
  if (!comparison_) {
    return tr("Rendering the hemicube of patch %1…").arg(selection_.patch());
  }
  const QString eye = tr("On patch %1").arg(comparison_->request.eye);
  if (!content_.differences) {
    return tr("%1: %2 pixels").arg(eye).arg(comparison_->image.items.size());
  }
  if (comparison_->exact.empty()) {
    return tr("%1: computing exact form factors… %2 %").arg(eye).arg(100 * progress_, 0, 'f', 0);
  }
  const QString wrong =
      tr("%1: form factor error %2 %").arg(eye).arg(100 * comparison_->wrong_share(), 0, 'g', 2);
  return comparison_->missed() == 0
             ? wrong
             : tr("%1, %2 patches missed").arg(wrong).arg(comparison_->missed());
}

bool HemicubeView::event(QEvent* event) {
  if (event->type() != QEvent::ToolTip) {
    return QWidget::event(event);
  }
  const auto* help = static_cast<QHelpEvent*>(event);
  const auto pixel = pixel_at(help->pos());
  const PatchId patch = pixel ? comparison_->image.items[*pixel] : no_patch;
  if (patch == no_patch) {
    QToolTip::hideText();
    return true;
  }
  QString text = tr("Patch %1: form factor %2")
                     .arg(patch)
                     .arg(number_text(at(comparison_->image.form_factors, patch)));
  if (!comparison_->exact.empty()) {
    text += tr(", exact %1").arg(number_text(at(comparison_->exact, patch)));
  }
  QToolTip::showText(help->globalPos(), text, this);
  return true;
}

void HemicubeView::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  painter.fillRect(rect(), theme::scene_background);
  if (!comparison_) {
    painter.setPen(theme::on_dark_dim);
    painter.drawText(rect().adjusted(20, 20, -20, -20), Qt::AlignCenter | Qt::TextWordWrap,
                     status_text());
    return;
  }
  const QRectF cross = cross_rect();
  painter.drawImage(cross, cross_);  // without smoothing
  // The edges of the cube's top.
  const double half = cross.width() / 4;
  painter.setPen(QPen(theme::on_dark, theme::scale()));
  painter.setBrush(Qt::NoBrush);
  painter.drawRect(cross.adjusted(half, half, -half, -half));
  draw_legend(painter);
}

void HemicubeView::draw_legend(QPainter& painter) const {
  double x = 14;
  const auto draw_entry = [&](const QColor& color, const QString& text) {
    const double advance = painter.fontMetrics().horizontalAdvance(text);
    if (x + 24 + advance > width()) {
      return;
    }
    const QRectF box(x, height() - 23, 16, 12);
    painter.fillRect(box, color);
    painter.setPen(theme::on_dark_dim);
    painter.drawRect(box);
    painter.setPen(theme::on_dark);
    painter.drawText(box.bottomRight() + QPointF(8, -1), text);
    x += 16 + 16 + advance;
  };
  if (by_difference()) {
    draw_entry(color_of_surplus(1), tr("too much"));
    draw_entry(color_of_surplus(-1), tr("too little"));
  }
  draw_entry(no_front_color, tr("no front side"));
}

}  // namespace transillum::viewer
