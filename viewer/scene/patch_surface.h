// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <vtkActor.h>
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>

#include <memory>
#include <span>
#include <vector>

#include "colors/color_choice.h"
#include "scene/linear_surface.h"
#include "scene/scene_mesh.h"
#include "state/hidden_patches.h"

namespace transillum::viewer {

/// The colored patches in the 3-D view: with one color per patch, with colors interpolated across
/// patches, with a quantity that is linear on patches, or with a light map.
class PatchSurface {
 public:
  /// @param hidden  patches that are omitted
  PatchSurface(vtkRenderer& renderer, const HiddenPatches& hidden);

  void show_scene(std::shared_ptr<const Scene> scene);
  /// One cell per piece, with the scalars of its color.
  vtkPolyData* pieces() const { return mesh_->surface(); }
  /// Follows a change of the hidden patches.
  void leave_out_hidden();
  /// Interpolates colors across patches, instead of one color per patch.
  void set_smooth(bool smooth);
  void set_wireframe(bool wireframe);
  void set_invisible(bool invisible);
  void set_outlined(bool outlined);
  void set_line_width(double pixels);
  /// @param patch_colors  one per patch
  /// @param dimmed  whether to dim a patch where the quantity is linear, one per patch; empty if
  /// none is
  void color(const ColorChoice& colors, std::span<const Color8> patch_colors,
             const std::vector<bool>& dimmed);
  /// Shows a light map, `factor` times its B, until color() is called.
  /// @param without_map  whether a patch shows its value of `colors` all the same
  void color(const ColorChoice& colors, std::shared_ptr<const LightMap> map, double factor,
             const std::function<bool(PatchId)>& without_map);
  bool outlined() const;
  /// Whether edges of patches are drawn, with the surfaces or in their place.
  bool draws_edges() const;
  bool smooth() const { return smooth_; }
  std::vector<vtkActor*> actors() const { return {actor_, linear_->actor()}; }

 private:
  void choose_mesh();

  const HiddenPatches& hidden_;
  std::shared_ptr<const Scene> scene_;
  std::unique_ptr<SceneMesh> mesh_;
  std::unique_ptr<SmoothMesh> smooth_mesh_;  ///< made when first shown
  bool smooth_ = false;
  vtkSmartPointer<vtkActor> actor_;
  std::unique_ptr<LinearSurface> linear_;
};

}  // namespace transillum::viewer
