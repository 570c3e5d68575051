// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "scene/patch_surface.h"

#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>

#include <utility>

namespace transillum::viewer {

PatchSurface::PatchSurface(vtkRenderer& renderer, const HiddenPatches& hidden)
    : hidden_(hidden), actor_(vtkSmartPointer<vtkActor>::New()) {
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetColorModeToDirectScalars();
  actor_->SetMapper(mapper);
  actor_->GetProperty()->LightingOff();  // the colors are B: no shading
  actor_->GetProperty()->BackfaceCullingOn();
  actor_->GetProperty()->SetEdgeColor(0.1, 0.11, 0.13);
  actor_->VisibilityOff();
  renderer.AddActor(actor_);
  linear_ = std::make_unique<LinearSurface>(renderer, *actor_->GetProperty());
}

void PatchSurface::show_scene(std::shared_ptr<const Scene> scene) {
  scene_ = std::move(scene);
  mesh_ = std::make_unique<SceneMesh>(scene_);
  smooth_mesh_ = nullptr;
  linear_->show_scene(scene_);
  leave_out_hidden();
  choose_mesh();
  actor_->VisibilityOn();
}

void PatchSurface::leave_out_hidden() {
  mesh_->leave_out(hidden_.flags());
  linear_->leave_out(hidden_.flags());
  if (smooth_mesh_) {
    smooth_mesh_->leave_out(*scene_, hidden_.flags());
  }
}

void PatchSurface::set_smooth(bool smooth) {
  smooth_ = smooth;
  if (scene_) {
    choose_mesh();
  }
}

void PatchSurface::choose_mesh() {
  if (smooth_ && !smooth_mesh_) {
    smooth_mesh_ = std::make_unique<SmoothMesh>(*scene_);
    smooth_mesh_->leave_out(*scene_, hidden_.flags());
  }
  auto* mapper = vtkPolyDataMapper::SafeDownCast(actor_->GetMapper());
  if (smooth_) {
    mapper->SetScalarModeToUsePointData();
    mapper->SetInputData(smooth_mesh_->surface());
  } else {
    mapper->SetScalarModeToUseCellData();
    mapper->SetInputData(mesh_->surface());
  }
}

void PatchSurface::set_wireframe(bool wireframe) {
  actor_->GetProperty()->SetRepresentation(wireframe ? VTK_WIREFRAME : VTK_SURFACE);
}

void PatchSurface::set_invisible(bool invisible) {
  actor_->GetProperty()->SetOpacity(invisible ? 0 : 1);
}

void PatchSurface::set_outlined(bool outlined) {
  actor_->GetProperty()->SetEdgeVisibility(outlined);
}

bool PatchSurface::outlined() const { return actor_->GetProperty()->GetEdgeVisibility() != 0; }

bool PatchSurface::draws_edges() const {
  return outlined() || actor_->GetProperty()->GetRepresentation() == VTK_WIREFRAME;
}

void PatchSurface::set_line_width(double pixels) {
  actor_->GetProperty()->SetLineWidth(static_cast<float>(pixels));
}

void PatchSurface::color(const ColorChoice& colors, std::span<const Color8> patch_colors,
                         const std::vector<bool>& dimmed) {
  actor_->SetVisibility(!colors.linear());
  if (colors.linear()) {
    linear_->show(colors, dimmed);
    return;
  }
  linear_->hide();
  if (smooth_) {
    smooth_mesh_->color(patch_colors);
  } else {
    mesh_->color(patch_colors);
  }
}

void PatchSurface::color(const ColorChoice& colors, std::shared_ptr<const LightMap> map,
                         double factor, const std::function<bool(PatchId)>& without_map) {
  actor_->VisibilityOff();
  linear_->show(colors, std::move(map), factor, without_map);
}

}  // namespace transillum::viewer
