// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <vtkActor.h>
#include <vtkGenericOpenGLRenderWindow.h>
#include <vtkNew.h>
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>

#include <QImage>
#include <QPoint>
#include <QWidget>
#include <memory>
#include <vector>

#include "colors/color_choice.h"
#include "model/snapshot.h"
#include "scene/direction_glyph.h"
#include "scene/scene_mesh.h"
#include "scene/scene_overlays.h"
#include "scene/smooth_mesh.h"
#include "scene/step_glyph.h"
#include "state/camera_views.h"
#include "state/focus.h"
#include "state/initial_view.h"
#include "state/selection.h"

class QTimer;
class QVTKOpenGLNativeWidget;

namespace transillum::viewer {

/// The scene in space, colored by radiosity. A click selects a patch, a drag turns the scene.
/// Stepped through, what is still to come is dimmed, and the polygon in focus lit up.
class SceneView : public QWidget {
  Q_OBJECT

 public:
  SceneView(const Focus& focus, Selection& selection, const ColorChoice& colors,
            QWidget* parent = nullptr);
  ~SceneView() override;

  void show_scene(std::shared_ptr<const LoadedScene> loaded);
  void show_snapshot(std::shared_ptr<const SolverSnapshot> snapshot);
  void set_direction_shown(bool shown);
  void set_outlines_shown(bool shown);
  void set_overlay_shown(SceneOverlays::Kind kind, bool shown);
  void set_wireframe(bool wireframe);
  /// Colors run over the patches; in place of one color a patch.
  void set_smooth_shading(bool smooth);
  /// Smooths edges: for a scene at rest, since it doubles what a picture costs without a GPU.
  void set_smooth(bool smooth);
  void reset_view();
  void look_at_all();
  void look_at_selected();
  void look_from_side(Side side);
  /// Where it is looked from; look_from() keeps the radius of what is worth looking at.
  ViewPoint view_point() const;
  void look_from(const ViewPoint& view);

  /// What is drawn, in `scale` times as many pixels a side.
  QImage picture(int scale) const;
  /// The patch drawn at a point of canvas(), in Qt's own (logical) pixels; no_patch for none.
  PatchId patch_at(const QPoint& position) const;
  QWidget* canvas() const;

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  void place_camera(const ViewPoint& view);
  double aspect() const;
  void show_surface();
  void recolor();
  void show_direction();
  bool stepping() const;
  void show_step();
  void show_selection();
  void draw_outline_nearer();
  void render();

  const Focus& focus_;
  Selection& selection_;
  const ColorChoice& colors_;
  std::shared_ptr<const LoadedScene> loaded_;
  std::shared_ptr<const SolverSnapshot> snapshot_;
  std::unique_ptr<SceneMesh> mesh_;
  std::unique_ptr<SmoothMesh> smooth_mesh_;  ///< made when it is first shown
  bool smooth_shading_ = false;
  std::vector<Color8> patch_colors_;
  Vec3 focus_point_;
  double radius_ = 1;
  ViewPoint first_look_;  ///< of reset_view()
  bool direction_shown_ = true;
  bool smooth_ = true;
  bool stepped_ = false;  ///< a step is drawn
  QTimer* rest_;          ///< runs while steps follow one another
  QPoint press_position_;
  bool pressed_ = false;

  QVTKOpenGLNativeWidget* canvas_;
  vtkNew<vtkGenericOpenGLRenderWindow> window_;
  vtkNew<vtkRenderer> renderer_;
  vtkSmartPointer<vtkActor> surface_;
  vtkSmartPointer<vtkActor> halo_, outline_;
  std::unique_ptr<DirectionGlyph> glyph_;
  std::unique_ptr<StepGlyph> step_glyph_;
  std::unique_ptr<SceneOverlays> overlays_;
};

}  // namespace transillum::viewer
