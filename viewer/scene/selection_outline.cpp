// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "scene/selection_outline.h"

#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>

#include "scene/scene_mesh.h"
#include "widgets/theme.h"

namespace transillum::viewer {

namespace {

vtkSmartPointer<vtkActor> line_actor(vtkRenderer& renderer, const QColor& color) {
  vtkNew<vtkPolyDataMapper> mapper;
  vtkNew<vtkPolyData> empty;
  mapper->SetInputData(empty);
  auto actor = vtkSmartPointer<vtkActor>::New();
  actor->SetMapper(mapper);
  actor->GetProperty()->LightingOff();
  actor->GetProperty()->SetColor(color.redF(), color.greenF(), color.blueF());
  actor->VisibilityOff();
  renderer.AddActor(actor);
  return actor;
}

}  // namespace

SelectionOutline::SelectionOutline(vtkRenderer& renderer)
    : halo_(line_actor(renderer, Qt::black)), outline_(line_actor(renderer, theme::selection)) {}

void SelectionOutline::show(const LoadedScene* loaded, const std::vector<PatchId>& patches,
                            double lift) {
  const bool any = loaded && !patches.empty() && patches.front() >= 0 &&
                   patches.back() < loaded->scene->patch_count();
  halo_->SetVisibility(any);
  outline_->SetVisibility(any);
  if (!any) {
    return;
  }
  const auto lines = patch_outlines(*loaded->scene, patches, lift);
  for (const auto& actor : {halo_, outline_}) {
    vtkPolyDataMapper::SafeDownCast(actor->GetMapper())->SetInputData(lines);
  }
}

void SelectionOutline::follow_camera(const Vec3& eye) {
  outline_->SetOrigin(eye.x, eye.y, eye.z);
  outline_->SetScale(1 - 5e-4);
}

void SelectionOutline::set_line_width(double pixels) {
  halo_->GetProperty()->SetLineWidth(static_cast<float>(5 * pixels));
  outline_->GetProperty()->SetLineWidth(static_cast<float>(2.5 * pixels));
}

}  // namespace transillum::viewer
