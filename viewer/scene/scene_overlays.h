// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <vtkActor.h>
#include <vtkPolyData.h>
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "model/snapshot.h"
#include "transillum/at.h"
#include "visibility/map/shadow_edges.h"

namespace transillum {
class Scene;
}  // namespace transillum

namespace transillum::viewer {

/// The edges of the fragments of all patches that `tree` cuts, `lift` meters in front of them.
/// @param hidden  whether a patch is omitted, one per patch
vtkSmartPointer<vtkPolyData> fragment_lines(const Scene& scene, const BspTree& tree, double lift,
                                            const std::vector<bool>& hidden);
/// A line from the center of each patch along its normal, half as long as the patch is wide.
/// @param hidden  whether a patch is omitted, one per patch
vtkSmartPointer<vtkPolyData> normal_lines(const Scene& scene, const std::vector<bool>& hidden);

/// The edges of shadows, `lift` meters in front of their patches.
/// @param hidden  whether a patch is omitted, one per patch
vtkSmartPointer<vtkPolyData> shadow_lines(const Scene& scene, const std::vector<ShadowEdge>& edges,
                                          double lift, const std::vector<bool>& hidden);

/// Geometry drawn in addition to the colored patches; computed when it is first shown.
class SceneOverlays {
 public:
  enum class Kind { fragments, normals, back_sides, shadows };

  explicit SceneOverlays(vtkRenderer& renderer);

  /// @param surface the scene's polygons, to draw their back sides
  /// @param lift meters by which lines are drawn in front of their patches
  void show_scene(std::shared_ptr<const LoadedScene> loaded, vtkPolyData* surface, double lift);
  /// Omits the lines of patches; back sides follow `surface`.
  /// @param hidden  one per patch
  void leave_out(const std::vector<bool>& hidden);
  void set_shown(Kind kind, bool shown);
  bool shown(Kind kind) const { return at(overlays_, kind).shown; }
  /// Draws these with Kind::shadows, until other edges or another scene are shown.
  void show_shadows(const std::vector<ShadowEdge>& edges);
  void set_line_width(double pixels);
  std::vector<vtkActor*> actors() const;

 private:
  void update(Kind kind);

  struct Overlay {
    vtkSmartPointer<vtkActor> actor;
    bool shown = false;
    bool made = false;
  };
  Overlay& overlay(Kind kind) { return at(overlays_, kind); }

  std::array<Overlay, 4> overlays_;
  std::vector<ShadowEdge> shadows_;
  std::shared_ptr<const LoadedScene> loaded_;
  vtkSmartPointer<vtkPolyData> surface_;
  double lift_ = 0;
  std::vector<bool> hidden_;
};

/// Faces that a change would treat, by their number in the file, and how they are shown.
struct MarkedFaces {
  std::vector<std::int32_t> inside, outside;  ///< in theme::inside and theme::outside; ascending
  bool inside_turned = false;                 ///< the faces in `inside` are shaded from behind
  bool are_covered = false;                   ///< by others: all but `inside` are drawn as outlines
};

/// Marked faces, drawn over the scene and seen from both sides.
class FacePreview {
 public:
  explicit FacePreview(vtkRenderer& renderer);

  void show(const Scene& scene, const MarkedFaces& faces);
  void hide();
  bool shown() const { return actor_->GetVisibility() != 0; }

 private:
  vtkSmartPointer<vtkActor> actor_;
};

}  // namespace transillum::viewer
