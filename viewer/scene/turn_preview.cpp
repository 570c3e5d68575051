// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "scene/turn_preview.h"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkUnsignedCharArray.h>

#include <set>

#include "colors/neutral_light.h"
#include "transillum/orientation.h"
#include "transillum/scene.h"
#include "widgets/theme.h"

namespace transillum::viewer {

TurnPreview::TurnPreview(vtkRenderer& renderer) {
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetColorModeToDirectScalars();
  mapper->SetScalarModeToUseCellData();
  // In front of the same patches of the scene.
  mapper->SetResolveCoincidentTopologyToPolygonOffset();
  mapper->SetRelativeCoincidentTopologyPolygonOffsetParameters(-1, -4);
  vtkNew<vtkPolyData> empty;
  mapper->SetInputData(empty);
  actor_ = vtkSmartPointer<vtkActor>::New();
  actor_->SetMapper(mapper);
  actor_->GetProperty()->LightingOff();
  actor_->VisibilityOff();
  renderer.AddActor(actor_);
}

void TurnPreview::show(const Scene& scene, const OrientationPlan& plan) {
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  for (const Vec3& p : scene.points()) {
    points->InsertNextPoint(p.x, p.y, p.z);
  }
  vtkNew<vtkCellArray> polygons;
  vtkNew<vtkUnsignedCharArray> colors;
  colors->SetNumberOfComponents(3);
  std::set<std::int32_t> turned_faces, two_sided_faces;
  for (std::size_t f = 0; f < plan.numbers.size(); ++f) {
    if (plan.turned[f]) {
      turned_faces.insert(plan.numbers[f]);
    } else if (plan.two_sided[f]) {
      two_sided_faces.insert(plan.numbers[f]);
    }
  }
  for (const Piece& piece : scene.pieces()) {
    const Patch& patch = scene.patch(piece.patch);
    const bool turned = turned_faces.count(patch.face) > 0;
    if (!turned && two_sided_faces.count(patch.face) == 0) {
      continue;
    }
    const auto corners = scene.corners(piece);
    polygons->InsertNextCell(static_cast<int>(corners.size()));
    for (const PointId p : corners) {
      polygons->InsertCellPoint(p);
    }
    const QColor& color = turned ? theme::inside : theme::outside;
    const double brightness = neutral_brightness(turned ? -patch.normal : patch.normal);
    colors->InsertNextTuple3(brightness * color.red(), brightness * color.green(),
                             brightness * color.blue());
  }
  vtkNew<vtkPolyData> data;
  data->SetPoints(points);
  data->SetPolys(polygons);
  data->GetCellData()->SetScalars(colors);
  vtkPolyDataMapper::SafeDownCast(actor_->GetMapper())->SetInputData(data);
  actor_->VisibilityOn();
}

void TurnPreview::hide() { actor_->VisibilityOff(); }

}  // namespace transillum::viewer
