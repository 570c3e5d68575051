// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// SceneView's pictures for files.
#include <QVTKOpenGLNativeWidget.h>
#include <vtkCamera.h>

#include <QPainter>
#include <algorithm>

#include "scene/callout_layer.h"
#include "scene/direction_glyph.h"
#include "scene/scene_view.h"
#include "scene/window_image.h"
#include "widgets/theme.h"

namespace transillum::viewer {

namespace {

Vec3 vec3_of(const double p[3]) { return {p[0], p[1], p[2]}; }

}  // namespace

/// The snapshot whose light is shown in true color; null where something else is.
std::shared_ptr<const SolverSnapshot> SceneView::lit_snapshot() const {
  auto shown = colors_.shows_kept_run() ? colors_.run_a() : colors_.snapshot();
  const bool by_eye = colors_.quantity() == Quantity::eye_radiance;
  const bool of_light = by_eye || (colors_.quantity() == Quantity::radiosity && shown &&
                                   shown->glossy == nullptr);  // else B is not what is seen
  if (!snapshot_ || !of_light || colors_.scale().mode != ColorMode::true_color ||
      colors_.values().empty() || shown->loaded->scene != loaded_->scene ||
      !(shown->passes_done > 0 || shown->of_file) || stepping() || surface_->draws_edges()) {
    return nullptr;
  }
  return shown;
}

std::optional<SharpSubject> SceneView::sharp_subject() const {
  const auto shown = lit_snapshot();
  if (!shown) {
    return std::nullopt;
  }
  const int* size = window_->GetSize();
  SharpSubject subject{.loaded = loaded_,
                       .snapshot = shown,
                       .by_eye = colors_.quantity() == Quantity::eye_radiance,
                       .scale = colors_.scale(),
                       .view = view_point(),
                       .size = {size[0], size[1]}};
  if (hidden_.any()) {
    subject.hidden = hidden_.flags();
  }
  if (clip_) {
    subject.half = ShownHalf{vec3_of(clip_plane_->GetOrigin()), vec3_of(clip_plane_->GetNormal())};
  }
  return subject;
}

void SceneView::show_callouts(const std::vector<Callout>& callouts) {
  callouts_ = callouts;
  place_callouts();
}

std::optional<Vec3> SceneView::anchor_of(const Callout& callout) const {
  switch (callout.anchor) {
    case Callout::Anchor::patch:
      if (callout.patch < 0 || callout.patch >= loaded_->scene->patch_count()) {
        return std::nullopt;
      }
      return loaded_->scene->patch(callout.patch).center;
    case Callout::Anchor::point:
      return callout.point;
    case Callout::Anchor::direction:
      return glyph_->shown() ? std::optional(glyph_->tip()) : std::nullopt;
    default:
      return std::nullopt;
  }
}

void SceneView::draw_callouts(QImage& image) const {
  if (image.isNull() || callout_layer_->empty()) {
    return;
  }
  QPainter painter(&image);
  painter.setFont(callout_layer_->font());
  painter.scale(image.width() / drawn_size_.width(), image.height() / drawn_size_.height());
  callout_layer_->draw(painter, QRectF(QPointF(0, 0), drawn_size_));
}

QImage SceneView::picture(int scale) {
  if (!drawn()) {
    draw();
  }
  taking_picture_ = true;
  QImage image = image_of_window(*window_, scale);
  if (scale > 1) {
    window_->Render();  // the filter leaves its last tile on the screen
  }
  taking_picture_ = false;
  draw_callouts(image);
  return image;
}

namespace {

/// The picture with alpha, from the same picture before black and before white.
QImage without_background(const QImage& on_black, const QImage& on_white) {
  QImage image(on_black.size(), QImage::Format_ARGB32);
  for (int y = 0; y < image.height(); ++y) {
    for (int x = 0; x < image.width(); ++x) {
      const QRgb black = on_black.pixel(x, y), white = on_white.pixel(x, y);
      const int alpha = std::clamp(255 - qGreen(white) + qGreen(black), 0, 255);
      const auto channel = [&](int value) {
        return alpha > 0 ? std::min(255, 255 * value / alpha) : 0;
      };
      image.setPixel(
          x, y, qRgba(channel(qRed(black)), channel(qGreen(black)), channel(qBlue(black)), alpha));
    }
  }
  return image;
}

}  // namespace

QImage SceneView::picture(const SceneLook& look) {
  const QImage shown = sharp_layer_->picture();
  vtkCamera* camera = renderer_->GetActiveCamera();
  const double angle = camera->GetViewAngle();
  const QSize before(window_->GetSize()[0], window_->GetSize()[1]);
  // A window of this size can be drawn everywhere; larger pictures are drawn in tiles.
  constexpr int largest_side = 2048;
  const int tiles = 1 + (std::max(look.size.width(), look.size.height()) - 1) / largest_side;
  taking_picture_ = true;
  sharp_layer_->set_picture(look.sharp);
  camera->SetViewAngle(
      widened(view_point(), aspect(), 1.0 * look.size.width() / look.size.height()).view_angle);
  window_->SetSize((look.size.width() + tiles - 1) / tiles,
                   (look.size.height() + tiles - 1) / tiles);
  drawn_size_ = QSizeF(look.size) / (look.line_scale * canvas_->devicePixelRatioF());
  if (!look.direction) {
    glyph_->hide();
    step_glyph_->hide();
  }
  prepare_picture(look.line_scale, antialiased_);
  const auto draw = [&](const QColor& background) {
    renderer_->SetBackground(background.redF(), background.greenF(), background.blueF());
    return image_of_window(*window_, tiles).copy(QRect(QPoint(0, 0), look.size));
  };
  const bool opaque = look.background.alpha() > 0;
  QImage image = draw(opaque ? look.background : QColor(Qt::black));
  if (!opaque) {
    image = without_background(image, draw(Qt::white));
  }
  draw_callouts(image);
  drawn_size_ = canvas_->size();
  window_->SetSize(before.width(), before.height());
  camera->SetViewAngle(angle);
  const QColor& usual = theme::scene_background;
  renderer_->SetBackground(usual.redF(), usual.greenF(), usual.blueF());
  sharp_layer_->set_picture(shown);
  if (!look.direction) {
    show_direction();
  }
  render();
  taking_picture_ = false;
  return image;
}

/// @param line_scale  factor of the widths of lines
void SceneView::prepare_picture(double line_scale, bool smooth) {
  const auto scale = static_cast<float>(line_scale * canvas_->devicePixelRatioF() * theme::scale());
  selected_->set_line_width(scale);
  glyph_->set_line_width(1.5 * scale);
  step_glyph_->set_line_width(2.5 * scale);
  overlays_->set_line_width(1.2 * scale);
  feature_edges_->set_line_width(1.2 * scale);
  path_glyph_->set_line_width(1.5 * scale);
  surface_->set_line_width(scale);
  renderer_->SetUseFXAA(smooth);
  renderer_->ResetCameraClippingRange();
}

}  // namespace transillum::viewer
