// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Implementation of the 3-D view: actors for the colored patches, the selection, the direction and
// the current step; picking by the scene's Embree picker.
#include "scene/scene_view.h"

#include <QVTKOpenGLNativeWidget.h>
#include <vtkCommand.h>
#include <vtkGenericOpenGLRenderWindow.h>
#include <vtkPolyDataMapper.h>
#include <vtkRenderWindowInteractor.h>
#include <vtkRenderer.h>

#include <QApplication>
#include <QMouseEvent>
#include <QResizeEvent>
#include <QTimer>
#include <algorithm>
#include <iterator>
#include <numbers>
#include <utility>

#include "scene/callout_layer.h"
#include "scene/camera_style.h"
#include "scene/shadow_finder.h"
#include "scene/sharp/shown_hit.h"
#include "widgets/build.h"
#include "widgets/theme.h"

namespace transillum::viewer {
namespace {

// Antialiasing is slow without a GPU: it is off until no step has come for this long.
constexpr int rest_ms = 150;

}  // namespace

SceneView::SceneView(const Focus& focus, Selection& selection, const ColorChoice& colors,
                     const HiddenPatches& hidden, QWidget* parent)
    : QWidget(parent), focus_(focus), selection_(selection), colors_(colors), hidden_(hidden) {
  canvas_ = named("scene_canvas", new QVTKOpenGLNativeWidget(this));
  canvas_->setMinimumSize(200, 150);
  auto* layout = make_column(this, {});
  layout->addWidget(canvas_);
  callout_layer_ = new CalloutLayer(canvas_);

  window_->SetMultiSamples(0);
  canvas_->setRenderWindow(window_);
  window_->AddRenderer(renderer_);
  const QColor& background = theme::scene_background;
  renderer_->SetBackground(background.redF(), background.greenF(), background.blueF());
  vtkNew<CameraStyle> style;
  canvas_->interactor()->SetInteractorStyle(style);

  surface_ = std::make_unique<PatchSurface>(*renderer_, hidden_);
  renderer_->AddViewProp(sharp_layer_);
  selected_ = std::make_unique<SelectionOutline>(*renderer_);
  renderer_->AddObserver(vtkCommand::StartEvent, this, &SceneView::follow_camera);
  renderer_->AddObserver(vtkCommand::EndEvent, this, &SceneView::place_callouts);
  overlays_ = std::make_unique<SceneOverlays>(*renderer_);
  feature_edges_ = std::make_unique<FeatureEdges>(*renderer_);
  face_preview_ = std::make_unique<FacePreview>(*renderer_);
  path_glyph_ = std::make_unique<PathGlyph>(*renderer_);
  // The actors are drawn in this order: the translucent ones last.
  glyph_ = std::make_unique<DirectionGlyph>(*renderer_);
  step_glyph_ = std::make_unique<StepGlyph>(*renderer_);

  canvas_->installEventFilter(this);
  connect(&selection_, &Selection::patches_changed, this, [this] {
    selected_->show(loaded_.get(), selection_.patches(), 1.5e-3 * radius_);
    render();
  });
  connect(&hidden_, &HiddenPatches::changed, this, &SceneView::leave_out_hidden);
  rest_timer_ = new QTimer(this);
  rest_timer_->setSingleShot(true);
  rest_timer_->setInterval(rest_ms);
  connect(rest_timer_, &QTimer::timeout, this, &SceneView::render);
  draw_timer_ = new QTimer(this);
  draw_timer_->setSingleShot(true);
  draw_timer_->setInterval(0);
  connect(draw_timer_, &QTimer::timeout, this, &SceneView::draw);
  connect(&focus_, &Focus::moved, this, &SceneView::show_step);
  shadow_finder_ = new ShadowFinder(this);
  connect(shadow_finder_, &ShadowFinder::changed, this, &SceneView::show_shadows);
  connect(&focus_, &Focus::moved, this, &SceneView::request_shadows);
  connect(&colors_, &ColorChoice::changed, this, [this] { redraw(); });
}

SceneView::~SceneView() = default;

QWidget* SceneView::canvas() const { return canvas_; }

bool SceneView::at_rest() const { return !pressed_ && !rest_timer_->isActive(); }

void SceneView::show_scene(std::shared_ptr<const LoadedScene> loaded) {
  // The scene is the same with other patches: the camera stays.
  const bool stays = loaded_ && is_same_origin(loaded, loaded_);
  loaded_ = std::move(loaded);
  snapshot_ = nullptr;
  surface_->show_scene(loaded_->scene);
  previews_covered_ = false;
  set_wireframe(wireframe_);
  set_clip(clip_);
  glyph_->hide();
  face_preview_->hide();
  feature_edges_->show_scene(loaded_);
  paths_ = nullptr;
  path_glyph_->hide();
  selected_->show(loaded_.get(), selection_.patches(), 1.5e-3 * radius_);
  if (!stays) {
    reset_view();
  }
  overlays_->show_scene(loaded_, surface_->pieces(), 5e-4 * radius_);
  overlays_->leave_out(hidden_.flags());
}

void SceneView::show_snapshot(std::shared_ptr<const SolverSnapshot> snapshot) {
  if (snapshot->loaded != loaded_) {
    return;
  }
  const bool same_draft = snapshot_ && snapshot_->of_draft && snapshot->of_draft &&
                          snapshot_->radiosity == snapshot->radiosity;
  snapshot_ = std::move(snapshot);
  if (!same_draft) {  // without a GPU, a picture takes time from the solver
    recolor();
    show_direction();
    render();
  }
  request_shadows();
}

void SceneView::request_shadows() {
  if (!overlays_->shown(SceneOverlays::Kind::shadows)) {
    shadow_finder_->clear();
    overlays_->show_shadows({});
  } else if (snapshot_) {
    shadow_finder_->request(*snapshot_, focus_.map());
  }
}

void SceneView::show_shadows() {
  const auto* edges = loaded_ ? shadow_finder_->edges(*loaded_) : nullptr;
  overlays_->show_shadows(edges ? *edges : std::vector<ShadowEdge>());
  render();
}

void SceneView::set_direction_shown(bool shown) {
  direction_shown_ = shown;
  show_direction();
  render();
}

void SceneView::set_direction_followed(bool followed) {
  direction_followed_ = followed;
  show_direction();
  render();
}

void SceneView::set_outlines_shown(bool shown) {
  surface_->set_outlined(shown);
  redraw();
}

void SceneView::set_overlay_shown(SceneOverlays::Kind kind, bool shown) {
  overlays_->set_shown(kind, shown);
  request_shadows();
  render();
}

void SceneView::set_wireframe(bool wireframe) {
  wireframe_ = wireframe;
  surface_->set_wireframe(wireframe || previews_covered_);
  surface_->set_invisible(previews_covered_);
  redraw();
}

void SceneView::set_smooth_shading(bool smooth) {
  surface_->set_smooth(smooth);
  redraw();
}

void SceneView::leave_out_hidden() {
  // After a new scene was announced, the flags may already belong to it.
  if (!loaded_ || std::ssize(hidden_.flags()) != loaded_->scene->patch_count()) {
    return;
  }
  surface_->leave_out_hidden();
  overlays_->leave_out(hidden_.flags());
  redraw();
}

void SceneView::set_clip(const std::optional<ClipPlane>& clip) {
  clip_ = clip;
  if (clip_ && loaded_) {
    using Axis = ClipPlane::Axis;
    const Bounds bounds = loaded_->scene->bounds();
    const Vec3 place = bounds.low + clip_->place * (bounds.high - bounds.low);
    const double side = clip_->other_side ? -1 : 1;
    clip_plane_->SetNormal(clip_->axis == Axis::x ? side : 0, clip_->axis == Axis::y ? side : 0,
                           clip_->axis == Axis::z ? side : 0);
    clip_plane_->SetOrigin(place.x, place.y, place.z);
  }
  std::vector<vtkActor*> actors = overlays_->actors();
  const std::vector<vtkActor*> of_patches = surface_->actors();
  actors.insert(actors.end(), of_patches.begin(), of_patches.end());
  const std::vector<vtkActor*> of_selection = selected_->actors();
  actors.insert(actors.end(), of_selection.begin(), of_selection.end());
  actors.push_back(feature_edges_->actor());
  for (vtkActor* actor : actors) {
    actor->GetMapper()->RemoveAllClippingPlanes();
    if (clip_ && loaded_) {
      actor->GetMapper()->AddClippingPlane(clip_plane_);
    }
  }
  render();
}

bool SceneView::in_picture(const PickedPoint& point) const {
  double p[3] = {point.point.x, point.point.y, point.point.z};
  return !hidden_.hidden(point.patch) && (!clip_ || clip_plane_->EvaluateFunction(p) >= 0);
}

void SceneView::set_antialiased(bool antialiased) {
  if (std::exchange(antialiased_, antialiased) != antialiased) {
    render();
  }
}

void SceneView::preview(const MarkedFaces& faces) {
  if (loaded_) {
    if (shows_preview()) {
      emit preview_replaced();
    }
    face_preview_->show(*loaded_->scene, faces);
    previews_covered_ = faces.are_covered;
    set_wireframe(wireframe_);
  }
}

void SceneView::hide_preview() {
  face_preview_->hide();
  previews_covered_ = false;
  set_wireframe(wireframe_);
}

void SceneView::show_paths(const std::shared_ptr<const LightPaths>& paths, int emphasized) {
  paths_ = paths;
  emphasized_path_ = emphasized;
  draw_paths();
}

void SceneView::set_paths_hidden(bool hidden) {
  paths_hidden_ = hidden;
  draw_paths();
}

void SceneView::draw_paths() {
  const bool drawn = paths_ && !paths_hidden_;
  if (!loaded_ || (!drawn && !path_glyph_->shown())) {
    return;
  }
  if (drawn) {
    path_glyph_->show(*loaded_->scene, *paths_, emphasized_path_);
  } else {
    path_glyph_->hide();
  }
  render();
}

void SceneView::recolor() {
  if (!snapshot_) {
    return;
  }
  patch_colors_ = colors_.patch_colors();
  std::vector<bool> dimmed;
  if (stepping()) {
    dimmed = later_patches(*focus_.map(), focus_.position().step);
    dim_patches(dimmed, patch_colors_);
  }
  if (map_.light && map_.snapshot == lit_snapshot()) {
    const bool by_eye = colors_.quantity() == Quantity::eye_radiance;
    const GlossyLight* glossy = map_.snapshot->glossy.get();
    // The light of a lobe depends on the eye, and is no part of the map.
    surface_->color(colors_, map_.light, by_eye ? 1 / std::numbers::pi : 1,
                    [&](PatchId patch) { return glossy != nullptr && glossy->is_glossy(patch); });
  } else {
    surface_->color(colors_, patch_colors_, dimmed);
  }
  show_edges();
}

void SceneView::redraw() {
  recolor();
  render();
}

void SceneView::show_map(const SurfaceMap& map) {
  if (!(map == map_)) {
    map_ = map;
    recolor();
  }
}

// Light in true color shows the shape by itself; other quantities may be the same on all sides.
void SceneView::show_edges() {
  const bool mapped = colors_.scale().mode != ColorMode::true_color;
  const bool of_material =
      colors_.quantity() == Quantity::exitance || colors_.quantity() == Quantity::reflectance;
  glyph_->set_filled(!mapped);
  const bool smooth = surface_->smooth() && !colors_.linear();
  if ((mapped || of_material) && !surface_->outlined() && !smooth) {
    feature_edges_->show(patch_colors_, hidden_.flags());
  } else {
    feature_edges_->hide();
  }
}

bool SceneView::stepping() const {
  return steps_shown_ && !focus_.following() && focus_.map() && focus_.map()->loaded == loaded_;
}

void SceneView::show_step() {
  const bool steps = stepping();
  if (!steps && !stepped_) {
    return;  // a newer direction arrives with its snapshot
  }
  stepped_ = steps;
  rest_timer_->start();
  recolor();
  show_direction();
  render();
}

void SceneView::show_direction() {
  const bool on_a_step = stepping() && focus_.at_step() && focus_.position().step >= 0;
  if (on_a_step) {
    step_glyph_->show(*focus_.map(), focus_.position().step);
  } else {
    step_glyph_->hide();
  }
  if (on_a_step && direction_shown_) {
    // The plane moves with the steps, from the source's side.
    const Vec3& omega = focus_.map()->record().frame.omega;
    const Vec3 center = center_of_step(*focus_.map(), focus_.position().step);
    glyph_->show_at(omega, snapshot_ && snapshot_->options.two_way,
                    focus_point_ + dot(center - focus_point_, omega) * omega, radius_);
    return;
  }
  // Before the first step, it shows the direction of the map, or else the last direction of the
  // run.
  const Vec3 omega = !snapshot_   ? Vec3{}
                     : stepping() ? focus_.map()->record().frame.omega
                                  : snapshot_->progress.last_direction;
  if (norm(omega) < 0.5 || !direction_shown_ || !(stepping() || direction_followed_)) {
    glyph_->hide();
    return;
  }
  glyph_->show(omega, snapshot_->options.two_way, *loaded_->scene, focus_point_, radius_,
               view_point().eye);
}

void SceneView::follow_camera() {
  const Vec3 eye = view_point().eye;
  feature_edges_->follow_camera(eye);
  selected_->follow_camera(eye);
  if (loaded_ && !(eye_ && *eye_ == eye)) {
    eye_ = eye;
    emit eye_moved(eye);
  }
  if (!taking_picture_) {
    emit about_to_draw();
  }
}

// After each rendering: the camera may have moved.
void SceneView::place_callouts() {
  std::vector<CalloutLayer::Placed> placed;
  for (const Callout& callout : callouts_) {
    const auto anchor = loaded_ ? anchor_of(callout) : std::nullopt;
    if (!anchor) {
      continue;
    }
    const QPointF position = pixel_of(*anchor);
    if (QRectF(QPointF(0, 0), drawn_size_).contains(position)) {
      placed.push_back({QString::fromStdString(callout.text), position});
    }
  }
  callout_layer_->show_callouts(std::move(placed));
  const auto polygon = [this](const std::vector<Vec3>& corners) {
    QPolygonF pixels;
    for (const Vec3& p : corners) {
      pixels.append(pixel_of(p));
    }
    return pixels;
  };
  std::vector<QPolygonF> right;
  std::transform(sketch_.right.begin(), sketch_.right.end(), std::back_inserter(right), polygon);
  callout_layer_->show_sketch(polygon(sketch_.outline), std::move(right));
}

QPointF SceneView::pixel_of(const Vec3& point) const {
  const int* size = window_->GetSize();
  renderer_->SetWorldPoint(point.x, point.y, point.z, 1);
  renderer_->WorldToDisplay();
  const double* p = renderer_->GetDisplayPoint();
  return {p[0] / size[0] * drawn_size_.width(), (1 - p[1] / size[1]) * drawn_size_.height()};
}

void SceneView::show_sketch(const SceneSketch& sketch) {
  sketch_ = sketch;
  render();
}

void SceneView::render() {
  renderer_->ResetCameraClippingRange();
  draw_timer_->start();
}

bool SceneView::drawn() const { return !draw_timer_->isActive() && !shadow_finder_->busy(); }

void SceneView::draw() {
  draw_timer_->stop();
  prepare_picture(1, antialiased_ && at_rest());
  if (canvas_->isVisible() && holds_ == 0) {
    window_->Render();
  }
}

void SceneView::hold(bool held) {
  holds_ += held ? 1 : -1;
  if (holds_ == 0) {
    render();
  }
}

PatchId SceneView::patch_at(const QPoint& position) const {
  const auto hit = hit_at(position);
  return hit ? hit->patch : no_patch;
}

std::optional<PickedPoint> SceneView::hit_at(const QPoint& position) const {
  if (!loaded_) {
    return std::nullopt;
  }
  // Back sides are culled in the picture.
  auto [begin, direction] = ray_at(position);
  return first_shown_hit(*loaded_, begin, direction,
                         [this](const PickedPoint& point) { return in_picture(point); });
}

SceneView::Ray SceneView::ray_at(const QPointF& position) const {
  // VTK counts device pixels from the bottom.
  const double scale = canvas_->devicePixelRatioF();
  const double x = (position.x() + 0.5) * scale;
  const double y = (canvas_->height() - position.y() - 0.5) * scale;
  const auto world = [&](double depth) {
    renderer_->SetDisplayPoint(x, y, depth);
    renderer_->DisplayToWorld();
    const double* p = renderer_->GetWorldPoint();
    return Vec3{p[0] / p[3], p[1] / p[3], p[2] / p[3]};
  };
  const Vec3 begin = world(0);
  return {begin, normalized(world(1) - begin)};
}

bool SceneView::eventFilter(QObject* watched, QEvent* event) {
  if (watched == canvas_) {
    if (event->type() == QEvent::MouseButtonPress) {
      const auto* mouse = static_cast<QMouseEvent*>(event);
      pressed_ = mouse->button() == Qt::LeftButton;
      press_position_ = mouse->pos();
      renderer_->UseFXAAOff();  // while the scene turns
    } else if (event->type() == QEvent::MouseButtonRelease && pressed_) {
      pressed_ = false;
      const auto* mouse = static_cast<QMouseEvent*>(event);
      const int moved = (mouse->pos() - press_position_).manhattanLength();
      if (moved < QApplication::startDragDistance()) {
        if (mouse->modifiers() & Qt::ControlModifier) {
          selection_.toggle(patch_at(mouse->pos()));
        } else {
          selection_.select(patch_at(mouse->pos()));
        }
        const auto [begin, direction] = ray_at(mouse->pos());
        emit ray_clicked(begin, direction);
      }
      render();
    } else if (event->type() == QEvent::MouseButtonRelease) {
      const auto* mouse = static_cast<QMouseEvent*>(event);
      if (mouse->button() == Qt::RightButton &&
          (mouse->pos() - press_position_).manhattanLength() < QApplication::startDragDistance()) {
        emit menu_requested(mouse->pos());
      }
    } else if (event->type() == QEvent::Resize) {
      drawn_size_ = canvas_->size();
      follow_size(static_cast<QResizeEvent*>(event)->oldSize());
    }
  }
  return QWidget::eventFilter(watched, event);
}

}  // namespace transillum::viewer
