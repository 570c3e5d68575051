// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// The 3-D view of the scene, on VTK. Scene and snapshots come from the window, colors from
// ColorChoice, the current step from Focus.
#pragma once

#include <vtkGenericOpenGLRenderWindow.h>
#include <vtkNew.h>
#include <vtkPlane.h>
#include <vtkRenderer.h>

#include <QImage>
#include <QPoint>
#include <QSizeF>
#include <QWidget>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "colors/color_choice.h"
#include "model/snapshot.h"
#include "scene/direction_glyph.h"
#include "scene/feature_edges.h"
#include "scene/patch_surface.h"
#include "scene/path_glyph.h"
#include "scene/scene_overlays.h"
#include "scene/selection_outline.h"
#include "scene/sharp/sharp_layer.h"
#include "scene/sharp/sharp_picture.h"
#include "scene/sharp/surface_map.h"
#include "state/callout.h"
#include "state/camera_views.h"
#include "state/focus.h"
#include "state/hidden_patches.h"
#include "state/map_sketch.h"
#include "state/selection.h"
#include "state/view_choices.h"
#include "widgets/theme.h"

class QTimer;
class QVTKOpenGLNativeWidget;

namespace transillum::viewer {

class CalloutLayer;
class ShadowFinder;

/// The 3-D view of the scene, colored by a quantity of its patches. A click selects a patch, a drag
/// turns the scene. While stepping, the patches of later steps are dimmed and the current fragment
/// is highlighted.
class SceneView : public QWidget {
  Q_OBJECT

 public:
  SceneView(const Focus& focus, Selection& selection, const ColorChoice& colors,
            const HiddenPatches& hidden, QWidget* parent = nullptr);
  ~SceneView() override;

  void show_scene(std::shared_ptr<const LoadedScene> loaded);
  /// The scene shown; null before the first.
  const std::shared_ptr<const LoadedScene>& loaded() const { return loaded_; }
  void show_snapshot(std::shared_ptr<const SolverSnapshot> snapshot);
  void set_direction_shown(bool shown);
  /// Whether the newest direction is shown, too, while nothing is stepped.
  void set_direction_followed(bool followed);
  /// Whether the step and the direction in focus are shown while one steps.
  void set_steps_shown(bool shown) {
    steps_shown_ = shown;
    show_step();
  }
  void set_outlines_shown(bool shown);
  void set_overlay_shown(SceneOverlays::Kind kind, bool shown);
  void set_wireframe(bool wireframe);
  /// Interpolates colors across patches, instead of drawing one color per patch. For quantities
  /// that are linear on patches, this changes nothing.
  void set_smooth_shading(bool smooth);
  /// Antialiases edges while the scene is at rest; doubles the time per picture without a GPU.
  void set_antialiased(bool antialiased);
  /// Goes back to the scene's initial view.
  void reset_view();
  /// Draws marked faces over the scene, until hide_preview() or another scene.
  void preview(const MarkedFaces& faces);
  void hide_preview();
  /// Draws light paths of the scene over it, until other paths or another scene are shown.
  /// @param paths  null if there are none
  /// @param emphasized  index of a path, or -1
  void show_paths(const std::shared_ptr<const LightPaths>& paths, int emphasized);
  /// While hidden, paths are not drawn.
  void set_paths_hidden(bool hidden);
  bool shows_preview() const { return face_preview_->shown(); }
  /// Keeps the viewing direction and fits the whole scene.
  void fit_all();
  void fit_selected();
  void view_from_side(Side side);
  /// Shows these callouts until the next call.
  void show_callouts(const std::vector<Callout>& callouts);
  /// Draws a polygon on a patch, and the region that it should match, until the next call.
  void show_sketch(const SceneSketch& sketch);
  /// The point in the scene that a callout points at, m; not set where the named object is not
  /// shown.
  std::optional<Vec3> anchor_of(const Callout& callout) const;
  /// The camera; set_view_point() keeps the radius of the scene's part of interest.
  ViewPoint view_point() const;
  void set_view_point(const ViewPoint& view);
  /// The camera, as a square picture has it. What is in that is in the picture of any shape, also
  /// after a change of size.
  ViewPoint square_view() const { return widened(view_point(), aspect(), 1); }
  void set_square_view(const ViewPoint& view) {
    if (loaded_) {
      fit([this, view] { return widened(view, 1, aspect()); });
    }
  }
  /// How a drag rotates: as a trackball, or as a turntable, about the vertical of the scene, which
  /// stays upright.
  void set_turntable(bool turntable);
  /// Sets the vertical of the scene, and goes to the initial view with it.
  void set_vertical(const Vec3& up) {
    if (!(vertical_ == up)) {
      vertical_ = up;
      reset_view();
    }
  }
  /// Clips the picture by a plane; shows all of it if no plane is given.
  void set_clip(const std::optional<ClipPlane>& clip);
  bool turntable() const { return turntable_; }
  /// Turns the camera about the vertical of the scene, and above or below it, degrees.
  void turn(double azimuth, double elevation);
  /// The edges drawn where the colors do not show the shape.
  const FeatureEdges& feature_edges() const { return *feature_edges_; }

  /// The picture shown, with its callouts, with `scale` times as many pixels per side.
  QImage picture(int scale);
  /// The look of the scene in a file.
  struct SceneLook {
    QSize size;                                   ///< pixels
    QColor background = theme::scene_background;  ///< transparent where its alpha is 0
    double line_scale = 1;                        ///< factor of the widths of lines
    bool direction = true;                        ///< with the direction and the step, if shown
    QImage sharp = {};  ///< the sharp picture in that size; null for the surfaces
  };
  /// The picture shown, with its callouts, in another size; what is in the smaller side stays.
  QImage picture(const SceneLook& look);
  /// While held, changes are not drawn: picture() alone draws.
  void hold(bool held);
  /// The subject of a sharp picture of this view; none where the surfaces show something else than
  /// light in true color.
  std::optional<SharpSubject> sharp_subject() const;
  /// Shows a sharp picture in the next picture, in place of the surfaces; null hides it.
  void set_sharp(const QImage& picture) { sharp_layer_->set_picture(picture); }
  const QImage& sharp() const { return sharp_layer_->picture(); }
  /// Shows the map of a snapshot wherever its light would be shown in a sharp picture, from the
  /// next picture on. Without a map, patches are shown again.
  void show_map(const SurfaceMap& map);
  /// Draws the picture again, once for all changes until the event loop is reached.
  void render();
  /// Whether all changes are drawn.
  bool drawn() const;
  /// The patch drawn at a point of canvas(), in logical pixels; no_patch if none.
  PatchId patch_at(const QPoint& position) const;
  /// The patch drawn at a point of canvas(), and its point there.
  std::optional<PickedPoint> hit_at(const QPoint& position) const;
  QWidget* canvas() const;
  /// A line of sight.
  struct Ray {
    Vec3 origin;     ///< its first point in the picture, m
    Vec3 direction;  ///< unit
  };
  /// The line of sight through a point of canvas(), in logical pixels.
  Ray ray_at(const QPointF& position) const;
  /// The point of canvas() at which a point is drawn, in logical pixels.
  QPointF pixel_of(const Vec3& point) const;
  /// Whether the picture is final: no button is held, and no further step has come for a while.
  bool at_rest() const;
  /// Whether the left button is held in the picture.
  bool pressed() const { return pressed_; }

 signals:
  /// The left button was clicked: the line of sight through that point, from the eye on.
  void ray_clicked(const transillum::Vec3& begin, const transillum::Vec3& direction);
  /// The right button was clicked at a point of canvas().
  void menu_requested(const QPoint& position);
  /// Other faces are about to be marked instead of the faces of the last preview().
  void preview_replaced();
  /// The picture is about to be drawn; what is shown may have changed.
  void about_to_draw();
  /// The camera is at another point than in the picture before; emitted while a picture is drawn.
  void eye_moved(const transillum::Vec3& eye);

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  void set_camera(const ViewPoint& view);
  double aspect() const;
  void fit(std::function<ViewPoint()> view);
  void follow_size(const QSize& before);
  void recolor();
  void redraw();
  std::shared_ptr<const SolverSnapshot> lit_snapshot() const;
  void show_direction();
  void draw_paths();
  bool stepping() const;
  void show_step();
  void leave_out_hidden();
  bool in_picture(const PickedPoint& point) const;
  void show_edges();
  void request_shadows();
  void show_shadows();
  Vec3 vertical_ = {0, 1, 0};
  void follow_camera();
  void place_callouts();
  void draw_callouts(QImage& image) const;
  void draw();
  void prepare_picture(double line_scale, bool smooth);

  const Focus& focus_;
  Selection& selection_;
  const ColorChoice& colors_;
  const HiddenPatches& hidden_;
  std::shared_ptr<const LoadedScene> loaded_;
  std::shared_ptr<const SolverSnapshot> snapshot_;
  SurfaceMap map_;
  bool turntable_ = false;
  std::vector<Color8> patch_colors_;
  Vec3 focus_point_;                  ///< center of the part of interest, meters
  double radius_ = 1;                 ///< its radius, meters
  std::optional<Vec3> eye_;           ///< eye of the newest picture
  ViewPoint fitted_;                  ///< the camera has not been moved while it is there
  std::function<ViewPoint()> refit_;  ///< fitted_ for the present size; empty if it stays
  bool direction_shown_ = true;
  bool direction_followed_ = false;
  bool antialiased_ = true;
  bool steps_shown_ = true;
  bool stepped_ = false;  ///< a step is drawn
  QTimer* rest_timer_;    ///< runs while steps follow each other quickly
  QTimer* draw_timer_;    ///< runs from a change until it is drawn
  QPoint press_position_;
  bool pressed_ = false;

  int holds_ = 0;

  std::vector<Callout> callouts_;
  SceneSketch sketch_;
  QSizeF drawn_size_;  ///< logical size of the picture that is drawn
  CalloutLayer* callout_layer_;
  QVTKOpenGLNativeWidget* canvas_;
  vtkNew<vtkGenericOpenGLRenderWindow> window_;
  vtkNew<vtkRenderer> renderer_;
  std::optional<ClipPlane> clip_;
  vtkNew<vtkPlane> clip_plane_;
  std::unique_ptr<PatchSurface> surface_;
  vtkNew<SharpLayer> sharp_layer_;
  bool taking_picture_ = false;  ///< picture() draws
  std::unique_ptr<SelectionOutline> selected_;
  std::unique_ptr<FeatureEdges> feature_edges_;
  std::unique_ptr<DirectionGlyph> glyph_;
  std::unique_ptr<StepGlyph> step_glyph_;
  std::unique_ptr<SceneOverlays> overlays_;
  ShadowFinder* shadow_finder_;
  std::unique_ptr<FacePreview> face_preview_;
  bool wireframe_ = false;         ///< chosen by the user
  bool previews_covered_ = false;  ///< outlines of faces are drawn instead of the scene
  std::unique_ptr<PathGlyph> path_glyph_;
  std::shared_ptr<const LightPaths> paths_;  ///< given to show_paths()
  int emphasized_path_ = -1;
  bool paths_hidden_ = false;
};

}  // namespace transillum::viewer
