// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QString>
#include <memory>
#include <optional>
#include <vector>

#include "scene/edit/face_edits.h"
#include "support/newest_result.h"
#include "window/base/filmed_change.h"
#include "window/base/window_views.h"
#include "window/editing/live_scene.h"

class QTimer;

namespace transillum::viewer {

/// Edits of the open scene's faces: a target that follows the selection is moved, turned and
/// scaled; faces are copied, removed and added. While the target moves, the picture, the map of the
/// direction shown and the light of a draft follow; when the hand rests, the scene is solved. Each
/// edit can be undone. A film shows the last move of the target.
///
/// Threads: the main thread only.
class SceneEdits : public FilmedChange {
  Q_OBJECT

 public:
  /// The faces that the selection means.
  enum class Reach { face, object, group, lamp };

  /// @param frame must outlive this object
  explicit SceneEdits(const WindowFrame& frame);
  ~SceneEdits() override;

  /// While inactive, there is no target.
  void set_active(bool active);
  bool active() const { return active_; }
  void set_reach(Reach reach);
  /// Makes this active, with what a patch means as its target.
  void choose(PatchId patch, Reach reach);
  Reach reach() const { return state_.reach; }
  /// Why faces cannot be edited; empty if they can.
  QString why_unavailable() const;

  /// Whether there are faces to edit.
  bool has_target() const { return !state_.faces.empty(); }
  std::size_t face_count() const { return state_.faces.size(); }
  /// Edges of the target's box as it was chosen, m.
  Vec3 extents() const { return extents_; }
  /// The point about which the target turns, m.
  Vec3 center() const { return state_.pivot + placement_.move; }
  /// The target's move, turn and scale since it was chosen.
  const FacePlacement& placement() const { return placement_; }
  /// Shows the target as placed, and solves the scene when no further call comes for a while.
  void place(const FacePlacement& placement);
  /// Solves the scene now.
  void finish();
  /// Goes back to the last edit.
  void cancel();

  void copy();
  void remove();
  void add(AddedSolid solid);

  /// The axis of the vertical: 0 is x, 1 is y, 2 is z.
  int vertical_axis() const;
  const WindowFrame& frame() const { return frame_; }
  bool busy() const override;
  bool can_film() const override {
    return moved_from_ && !state_.faces.empty() && can_begin() && !live_ && !busy();
  }
  void begin_film(int count) override;
  void show_picture(int index) override;
  QString caption(int /*index*/) const override { return {}; }
  void end_film() override;
  /// The moved scene shown; null while none is.
  const std::shared_ptr<const LiveScene>& shown() const { return newest_; }

 signals:
  void changed();  ///< the target, or its placement
  void failed(const QString& message);
  void moved();  ///< a moved scene is shown

 private:
  class Command;
  /// The scene after an edit.
  struct State {
    std::shared_ptr<const SceneDescription> description;
    OpenScene::Faces document;
    Reach reach = Reach::object;
    /// The target is placed in `base`, which gives `description`.
    std::shared_ptr<const SceneDescription> base;
    FaceList faces = {};
    Vec3 pivot = {};
    FacePlacement placement = {};
  };

  void follow_scene();
  void follow_patches();
  void follow_selection();
  void choose_target();
  void select_target();
  bool can_begin() const;
  void begin_live();
  void show_placed(const FacePlacement& placement);
  bool shows_solved_scene() const;
  void lose_film(const QString& why);
  void request(const State& state, std::optional<int> edit);
  void take_scene(const LiveRequest& request, const std::shared_ptr<const LiveScene>& scene,
                  const QString& error);
  void take_light(const LiveLightRequest& request, const std::shared_ptr<const Solution>& light);
  void show_live();
  void end_live();
  /// Ends moving where the last edit left the target: shows its scene again, or has it solved.
  void return_to_edit();
  /// The document of a new description.
  OpenScene::Faces edited_document(std::shared_ptr<const SceneDescription> description) const;
  void push(const QString& text, State after);
  void apply(const State& state);
  QString name_of_target() const;

  WindowFrame frame_;
  bool active_ = false;
  bool selecting_ = false;                   ///< this object changes the selection
  State state_;                              ///< after the newest edit
  FacePlacement placement_;                  ///< the target's, now
  std::optional<FacePlacement> moved_from_;  ///< before the newest edit, if that moved the target
  int film_pictures_ = 0;                    ///< 0 while there is no film
  Vec3 extents_;
  int edit_ = 0;         ///< number of the newest edit
  int solved_edit_ = 0;  ///< the newest one that was handed to the solver
  bool live_ = false;    ///< a moved scene is shown, or will be
  bool awaits_solve_ = false;
  bool was_running_ = false;
  std::optional<RunPosition> pinned_;             ///< direction to show again in the new solve
  bool pinned_step_ = false;                      ///< and its step, rather than all of it
  std::shared_ptr<const SolverSnapshot> solved_;  ///< from before the moves
  std::shared_ptr<const RecordedMap> map_before_;
  std::shared_ptr<const LiveScene> newest_;
  std::shared_ptr<const Solution> light_;
  QTimer* rest_timer_;
  NewestResult<LiveRequest, LiveScene> scenes_;
  NewestResult<LiveLightRequest, Solution> lights_;
};

}  // namespace transillum::viewer
