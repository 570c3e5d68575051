// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Edits of faces. place() shows a moved scene in the picture and the map alone: all other views
// keep the solve from before. The scene of an edit then replaces it as a scene with other patches,
// on the way of a round of refinement, and is solved with the same options.
#include "window/editing/scene_edits.h"

#include <QMainWindow>
#include <QTimer>
#include <QUndoCommand>
#include <algorithm>
#include <utility>

#include "model/snapshot_values.h"
#include "scene/scene_page.h"
#include "scene/scene_view.h"
#include "scene/sharp_view.h"
#include "transillum/at.h"

namespace transillum::viewer {

namespace {

constexpr int rest_ms = 300;  // from the last change until the scene is solved
constexpr const char* edited_mark = " (edited)";

Vec3 center_of(const Bounds& bounds) { return 0.5 * (bounds.low + bounds.high); }

}  // namespace

class SceneEdits::Command : public QUndoCommand {
 public:
  Command(SceneEdits& edits, const QString& text, State before, State after)
      : QUndoCommand(text), edits_(edits), before_(std::move(before)), after_(std::move(after)) {}

  void undo() override { edits_.apply(before_); }
  void redo() override { edits_.apply(after_); }

 private:
  SceneEdits& edits_;
  State before_, after_;
};

// While the hand moves, a late picture is better than none: a running job is finished.
SceneEdits::SceneEdits(const WindowFrame& frame)
    : FilmedChange(&frame.window),
      frame_(frame),
      rest_timer_(new QTimer(this)),
      scenes_(
          *this, &live_scene,
          [this](const LiveRequest& request, const std::shared_ptr<const LiveScene>& scene,
                 const QString& error) { take_scene(request, scene, error); },
          CurrentJob::finish),
      lights_(
          *this, &live_light,
          [this](const LiveLightRequest& request, const std::shared_ptr<const Solution>& light,
                 const QString& error) {
            if (!light) {
              lose_film(error);
            }
            take_light(request, light);
          },
          CurrentJob::finish) {
  rest_timer_->setSingleShot(true);
  rest_timer_->setInterval(rest_ms);
  connect(rest_timer_, &QTimer::timeout, this, &SceneEdits::finish);
  connect(&frame_.state.scene, &OpenScene::scene_loaded, this, &SceneEdits::follow_scene);
  connect(&frame_.state.scene, &OpenScene::patches_changed, this, &SceneEdits::follow_patches);
  connect(&frame_.state.scene, &OpenScene::snapshot_shown, this, [this] {
    Focus& focus = frame_.state.focus;
    if (pinned_ && pinned_->iteration < focus.iterations()) {
      const RunPosition place = *std::exchange(pinned_, std::nullopt);
      if (pinned_step_) {
        focus.go_to(place);
      } else {
        focus.go_to_direction(place.iteration, place.direction);
      }
    }
  });
  connect(&frame_.state.selection, &Selection::patches_changed, this,
          &SceneEdits::follow_selection);
}

SceneEdits::~SceneEdits() = default;

QString SceneEdits::why_unavailable() const {
  if (!frame_.state.scene.loaded()) {
    return tr("Open a scene to move its faces.");
  }
  return state_.description ? QString()
                            : tr("A result file has patches alone: open its scene to move faces.");
}

/// After a change of the scene, not before its first snapshot is here.
bool SceneEdits::can_begin() const { return state_.description && frame_.state.scene.snapshot(); }

bool SceneEdits::busy() const {
  return scenes_.busy() || lights_.busy() || awaits_solve_ || pinned_ || rest_timer_->isActive();
}

int SceneEdits::vertical_axis() const {
  const Vec3& up = frame_.state.vertical.up();
  int axis = 0;
  for (int k = 1; k < 3; ++k) {
    axis = std::abs(coordinate(up, k)) > std::abs(coordinate(up, axis)) ? k : axis;
  }
  return axis;
}

void SceneEdits::set_active(bool active) {
  if (active == active_) {
    return;
  }
  if (!active) {
    finish();
  }
  active_ = active;
  choose_target();
}

void SceneEdits::set_reach(Reach reach) {
  if (reach == state_.reach) {
    return;
  }
  finish();
  state_.reach = reach;
  choose_target();
}

void SceneEdits::choose(PatchId patch, Reach reach) {
  finish();
  selecting_ = true;
  frame_.state.selection.select(patch);
  selecting_ = false;
  active_ = true;
  state_.reach = reach;
  choose_target();
}

/// Another scene is open.
void SceneEdits::follow_scene() {
  rest_timer_->stop();
  scenes_.clear();
  end_live();
  lose_film(tr("Another scene was opened"));
  awaits_solve_ = false;
  solved_edit_ = edit_;
  pinned_.reset();
  const Reach reach = state_.reach;
  state_ = {};
  state_.reach = reach;
  state_.description = state_.base = whole_of(frame_.state.scene.loaded())->description;
  placement_ = {};
  moved_from_.reset();
  emit changed();
}

/// The patches of an edit, or of a round of refinement, are shown.
void SceneEdits::follow_patches() {
  if (!awaits_solve_) {
    return;
  }
  awaits_solve_ = false;
  if (!scenes_.busy() && placement_ == state_.placement && solved_edit_ == edit_) {
    end_live();
  } else {
    frame_.state.runner.pause();  // the hand moves again
    was_running_ = true;
  }
  select_target();
  emit changed();
}

void SceneEdits::follow_selection() {
  if (!selecting_ && active_ && !awaits_solve_) {
    finish();
    choose_target();
  }
}

/// The faces that the selection means, as they are now.
void SceneEdits::choose_target() {
  state_.base = state_.description;
  state_.faces.clear();
  state_.placement = placement_ = {};
  moved_from_.reset();
  const auto loaded = frame_.state.scene.loaded();
  const PatchId patch = frame_.state.selection.patch();
  if (active_ && state_.base && patch != no_patch && patch < loaded->scene->patch_count()) {
    const SceneDescription& d = *state_.base;
    FaceList& faces = state_.faces;
    for (const PatchId i : frame_.state.selection.patches()) {
      const std::int32_t number = loaded->scene->patch(i).face;
      if (faces.empty() || d.number_of(static_cast<std::size_t>(faces.back())) != number) {
        const FaceList found = faces_of_number(d, number);
        faces.insert(faces.end(), found.begin(), found.end());
      }
    }
    if (state_.reach != Reach::face && !faces.empty()) {
      const FaceList clicked = faces_of_number(d, loaded->scene->patch(patch).face);
      const std::int32_t face = clicked.empty() ? faces.front() : clicked.front();
      faces = state_.reach == Reach::object ? faces_of_object(d, face)
              : state_.reach == Reach::lamp
                  ? faces_of_lamp(d, face)
                  : faces_of_group(d, d.group_of(static_cast<std::size_t>(face)));
    }
    std::sort(faces.begin(), faces.end());
    faces.erase(std::unique(faces.begin(), faces.end()), faces.end());
    const Bounds bounds = bounds_of(d, faces);
    state_.pivot = center_of(bounds);
    extents_ = bounds.high - bounds.low;
    select_target();
  }
  emit changed();
}

/// Selects the patches of the target.
void SceneEdits::select_target() {
  if (!active_ || state_.faces.empty()) {
    return;
  }
  const SceneDescription& d = *state_.base;
  const Scene& scene = *frame_.state.scene.loaded()->scene;
  std::vector<std::int32_t> numbers;
  for (const std::int32_t face : state_.faces) {
    numbers.push_back(d.number_of(static_cast<std::size_t>(face)));
  }
  std::vector<PatchId> patches;
  for (PatchId i = 0; i < scene.patch_count(); ++i) {
    if (std::binary_search(numbers.begin(), numbers.end(), scene.patch(i).face)) {
      patches.push_back(i);
    }
  }
  if (patches.empty()) {
    return;
  }
  selecting_ = true;
  if (!std::binary_search(patches.begin(), patches.end(), frame_.state.selection.patch())) {
    frame_.state.selection.select(patches.front());
  }
  frame_.state.selection.select_all(std::move(patches));
  selecting_ = false;
}

void SceneEdits::begin_live() {
  if (live_) {
    return;
  }
  live_ = true;
  was_running_ = frame_.state.runner.state() == RunState::running;
  solved_ = frame_.state.scene.snapshot();
  map_before_ = frame_.state.focus.map();
  light_ = nullptr;
  frame_.state.scene.hold(true);
  frame_.state.runner.pause();
  frame_.page.sharp()->set_solving(true);
}

void SceneEdits::place(const FacePlacement& placement) {
  if (state_.faces.empty() || !can_begin() || placement == placement_) {
    return;
  }
  lose_film(tr("The faces were moved"));
  begin_live();
  show_placed(placement);
  rest_timer_->start();
}

void SceneEdits::show_placed(const FacePlacement& placement) {
  placement_ = placement;
  State now = state_;
  now.placement = placement;
  request(now, {});
  emit changed();
}

void SceneEdits::begin_film(int count) {
  film_pictures_ = count;
  frame_.state.colors.hold_range(true);
  begin_live();
}

void SceneEdits::show_picture(int index) {
  if (film_pictures_ > 0) {
    const FacePlacement &from = *moved_from_, &to = state_.placement;
    const double t = index / (film_pictures_ - 1.0);
    const auto between = [t](const Vec3& a, const Vec3& b) { return (1 - t) * a + t * b; };
    show_placed(
        {between(from.move, to.move), between(from.turn, to.turn), between(from.scale, to.scale)});
  }
}

void SceneEdits::end_film() {
  if (std::exchange(film_pictures_, 0) > 0) {
    frame_.state.colors.hold_range(false);
    cancel();
  }
}

/// Whether the scene that is open is the one whose faces move.
bool SceneEdits::shows_solved_scene() const {
  return solved_ && is_same_origin(solved_->loaded, frame_.state.scene.loaded());
}

void SceneEdits::lose_film(const QString& why) {
  if (film_pictures_ > 0) {
    emit film_lost(shows_solved_scene() ? why : tr("Another scene was opened"));
  }
}

void SceneEdits::request(const State& state, std::optional<int> edit) {
  LiveRequest live{
      .before = whole_of(frame_.state.scene.loaded()),
      .base = state.base,
      .faces = state.faces,
      .pivot = state.pivot,
      .placement = state.placement,
      .divided = edit ? state.document.input.divided : edited_document(nullptr).input.divided,
      .map = {},
      .edit = edit};
  if (edit) {
    live.base = state.description;
    live.placement = {};
  }
  const Focus& focus = frame_.state.focus;
  if (focus.map() && solved_) {
    live.map = MapRequest{.loaded = nullptr,
                          .omega = focus.map()->record().frame.omega,
                          .iteration = focus.map()->iteration,
                          .direction = focus.map()->direction,
                          .passes = focus.map()->passes,
                          .memory = solved_->options.memory};
  }
  scenes_.request(std::move(live));
}

void SceneEdits::take_scene(const LiveRequest& request,
                            const std::shared_ptr<const LiveScene>& scene, const QString& error) {
  if (!live_) {
    return;
  }
  if (!scene) {
    lose_film(error);
    emit failed(error);
    if (request.edit) {
      solved_edit_ = edit_;
    }
    if (!scenes_.busy()) {
      cancel();
    }
    return;
  }
  newest_ = scene;
  show_live();
  if (request.edit && *request.edit == edit_) {
    lights_.clear();
    awaits_solve_ = true;
    solved_edit_ = edit_;
    const Focus& focus = frame_.state.focus;
    if (focus.map() && !focus.following()) {
      pinned_ = focus.position();
      pinned_step_ = focus.at_step();
    }
    frame_.state.scene.solve_faces(scene->loaded, state_.document, *solved_, was_running_);
  } else if (!request.edit) {
    const MaterialEdits& edits = frame_.state.relighting.edits();
    lights_.request({scene->loaded, solved_->options, edits.any() ? edits.materials() : nullptr});
  }
}

void SceneEdits::take_light(const LiveLightRequest&, const std::shared_ptr<const Solution>& light) {
  if (light && live_ && newest_) {
    light_ = light;
    show_live();
    emit lit();
  }
}

/// Shows the newest scene with the newest light, in one picture.
void SceneEdits::show_live() {
  const MaterialEdits& edits = frame_.state.relighting.edits();
  const bool fits =
      light_ && std::ssize(light_->radiosity) == newest_->loaded->scene->patch_count();
  const auto snapshot = live_snapshot(*solved_, *newest_, fits ? light_.get() : nullptr,
                                      edits.any() ? edits.materials() : nullptr);
  SceneView* view = frame_.page.scene_view();
  view->hold(true);
  if (view->loaded() != newest_->loaded) {
    view->show_scene(newest_->loaded);
  }
  frame_.state.colors.fit_moved(snapshot);
  view->show_snapshot(snapshot);
  if (newest_->map && newest_->map != frame_.state.focus.map()) {
    frame_.state.focus.replace_map(newest_->map);
  }
  view->hold(false);
  emit moved();
}

void SceneEdits::end_live() {
  if (!live_) {
    return;
  }
  live_ = false;
  map_before_ = nullptr;
  solved_ = nullptr;
  newest_ = nullptr;
  light_ = nullptr;
  lights_.clear();
  frame_.state.scene.hold(false);
}

void SceneEdits::cancel() {
  lose_film(tr("The move was canceled"));
  rest_timer_->stop();
  scenes_.clear();
  placement_ = state_.placement;
  return_to_edit();
  emit changed();
}

void SceneEdits::return_to_edit() {
  if (!live_ || awaits_solve_) {
    return;
  }
  if (solved_edit_ != edit_) {
    request(state_, edit_);
    return;
  }
  frame_.page.scene_view()->show_scene(frame_.state.scene.loaded());
  if (map_before_) {
    frame_.state.focus.replace_map(map_before_);
  }
  const bool runs_on = was_running_ && shows_solved_scene();
  end_live();
  if (runs_on) {
    frame_.state.runner.run();
  }
}

void SceneEdits::finish() {
  lose_film(tr("The faces were edited"));
  rest_timer_->stop();
  if (placement_ == state_.placement) {
    if (!scenes_.busy()) {
      return_to_edit();
    }
    return;
  }
  auto description = std::make_shared<SceneDescription>(*state_.base);
  try {
    place_faces(*description, state_.faces, state_.pivot, placement_);
  } catch (const std::exception& error) {
    emit failed(QString::fromUtf8(error.what()));
    cancel();
    return;
  }
  State after = state_;
  after.description = std::move(description);
  after.placement = placement_;
  push(tr("move of %1").arg(name_of_target()), std::move(after));
}

OpenScene::Faces SceneEdits::edited_document(
    std::shared_ptr<const SceneDescription> description) const {
  const OpenScene::Faces before = frame_.state.scene.faces();
  OpenScene::Faces after{before.spec, {}, std::move(description)};
  if (!before.edited) {
    after.spec += edited_mark;
  }
  // Patches have other numbers, so divisions by numbers mean others.
  for (const std::string& name : before.input.divided) {
    if (name.rfind("patch:", 0) != 0) {
      after.input.divided.push_back(name);
    }
  }
  return after;
}

/// Carries out an edit. Its document follows from its description.
void SceneEdits::push(const QString& text, State after) {
  State before = state_;
  before.document = frame_.state.scene.faces();
  after.document = edited_document(after.description);
  frame_.state.undo.push(new Command(*this, text, std::move(before), std::move(after)));
}

void SceneEdits::apply(const State& state) {
  lose_film(tr("The faces were edited"));
  rest_timer_->stop();
  begin_live();
  moved_from_.reset();
  if (state.base == state_.base && state.faces == state_.faces && !state.faces.empty()) {
    moved_from_ = state_.placement;
  }
  state_ = state;
  placement_ = state.placement;
  if (!state.faces.empty()) {
    const Bounds bounds = bounds_of(*state.base, state.faces);
    extents_ = bounds.high - bounds.low;
  }
  request(state_, ++edit_);
  emit changed();
}

QString SceneEdits::name_of_target() const {
  switch (state_.reach) {
    case Reach::face:
      return state_.faces.size() == 1 ? tr("a face") : tr("faces");
    case Reach::object:
      return tr("an object");
    case Reach::group:
      return tr("a group");
    case Reach::lamp:
      break;
  }
  return tr("a lamp");
}

void SceneEdits::copy() {
  finish();
  if (state_.faces.empty()) {
    return;
  }
  State after = state_;
  auto description = std::make_shared<SceneDescription>(*state_.description);
  const Bounds bounds = bounds_of(*description, state_.faces);
  const int up = vertical_axis();
  const int across = (up + 1) % 3;
  Vec3 beside;
  coordinate(beside, across) =
      1.1 * (coordinate(bounds.high, across) - coordinate(bounds.low, across));
  if (coordinate(beside, across) == 0) {
    coordinate(beside, up) = 0.1 * norm(bounds.high - bounds.low);
  }
  after.faces = copy_faces(*description, state_.faces, beside);
  after.pivot = center_of(bounds) + beside;
  after.placement = {};
  after.description = after.base = std::move(description);
  push(tr("copy of %1").arg(name_of_target()), std::move(after));
}

void SceneEdits::remove() {
  finish();
  if (state_.faces.empty() || state_.faces.size() == state_.description->face_count()) {
    return;
  }
  State after = state_;
  auto description = std::make_shared<SceneDescription>(*state_.description);
  remove_faces(*description, state_.faces);
  after.faces.clear();
  after.placement = {};
  after.description = after.base = std::move(description);
  push(tr("removal of %1").arg(name_of_target()), std::move(after));
}

void SceneEdits::add(AddedSolid solid) {
  finish();
  if (!can_begin()) {
    return;
  }
  const Bounds all = frame_.state.scene.loaded()->scene->bounds();
  const Vec3 extents = all.high - all.low;
  const double length = std::max({extents.x, extents.y, extents.z});
  const bool around = solid == AddedSolid::room;
  constexpr double fraction = 0.2, margin = 1.25;
  const Vec3 size = around ? margin * extents + Vec3{0.01, 0.01, 0.01} * length
                           : fraction * Vec3{length, length, length};
  State after = state_;
  auto description = std::make_shared<SceneDescription>(*state_.description);
  after.pivot = center_of(all);
  after.faces = add_solid(*description, solid, after.pivot, size, vertical_axis());
  after.placement = {};
  after.description = after.base = std::move(description);
  push(tr("addition of faces"), std::move(after));
}

}  // namespace transillum::viewer
