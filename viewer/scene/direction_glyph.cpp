// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Arrows and plane of a transillumination direction, as VTK actors. SceneView passes direction,
// place and size.
#include "scene/direction_glyph.h"

#include <vtkArrowSource.h>
#include <vtkCellArray.h>
#include <vtkMatrix4x4.h>
#include <vtkPoints.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>

#include <cmath>

namespace transillum::viewer {

namespace {

vtkSmartPointer<vtkActor> flat_actor(vtkPolyData* data, vtkRenderer& renderer) {
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(data);
  auto actor = vtkSmartPointer<vtkActor>::New();
  actor->SetMapper(mapper);
  actor->GetProperty()->LightingOff();
  actor->GetProperty()->SetColor(direction_color[0], direction_color[1], direction_color[2]);
  actor->PickableOff();
  actor->VisibilityOff();
  renderer.AddActor(actor);
  return actor;
}

vtkSmartPointer<vtkActor> arrow_actor(vtkRenderer& renderer) {
  vtkNew<vtkArrowSource> arrow;
  arrow->SetTipLength(0.38);
  arrow->SetTipRadius(0.11);
  arrow->SetShaftRadius(0.032);
  arrow->SetTipResolution(32);
  arrow->SetShaftResolution(24);
  arrow->Update();
  auto actor = flat_actor(arrow->GetOutput(), renderer);
  actor->GetProperty()->LightingOn();
  actor->GetProperty()->SetAmbient(0.45);
  actor->GetProperty()->SetDiffuse(0.65);
  return actor;
}

// Maps the arrow source's x axis to `axis`, scaled by `length`, with its tail at `tail`.
vtkSmartPointer<vtkMatrix4x4> arrow_matrix(const Vec3& tail, const Vec3& axis, double length) {
  const Vec3 other = std::abs(axis.x) < 0.7 ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
  const Vec3 v = normalized(cross(axis, other));
  const Vec3 w = cross(axis, v);
  auto matrix = vtkSmartPointer<vtkMatrix4x4>::New();
  const Vec3 columns[3] = {length * axis, length * v, length * w};
  for (int c = 0; c < 3; ++c) {
    matrix->SetElement(0, c, columns[c].x);
    matrix->SetElement(1, c, columns[c].y);
    matrix->SetElement(2, c, columns[c].z);
  }
  matrix->SetElement(0, 3, tail.x);
  matrix->SetElement(1, 3, tail.y);
  matrix->SetElement(2, 3, tail.z);
  return matrix;
}

}  // namespace

DirectionGlyph::DirectionGlyph(vtkRenderer& renderer) {
  quad_ = vtkSmartPointer<vtkPolyData>::New();
  frame_ = vtkSmartPointer<vtkPolyData>::New();
  vtkNew<vtkPoints> points;
  points->SetNumberOfPoints(4);
  for (vtkIdType corner = 0; corner < 4; ++corner) {
    points->SetPoint(corner, 0, 0, 0);
  }
  const vtkIdType loop[5] = {0, 1, 2, 3, 0};
  vtkNew<vtkCellArray> polygon, line;
  polygon->InsertNextCell(4, loop);
  line->InsertNextCell(5, loop);
  quad_->SetPoints(points);
  quad_->SetPolys(polygon);
  frame_->SetPoints(points);
  frame_->SetLines(line);

  forward_ = arrow_actor(renderer);
  backward_ = arrow_actor(renderer);
  // Blended with what has been drawn before. Translucent actors would need another pass over all
  // pixels, a fifth of a frame without a GPU.
  fill_ = flat_actor(quad_, renderer);
  fill_->GetProperty()->SetOpacity(0.20);
  fill_->ForceOpaqueOn();
  border_ = flat_actor(frame_, renderer);
  border_->GetProperty()->SetOpacity(0.85);
  border_->ForceOpaqueOn();
}

void DirectionGlyph::show(const Vec3& omega, bool two_way, const Vec3& center, double radius,
                          double distance, const Vec3& eye) {
  const Vec3 side = dot(omega, eye - center) >= 0 ? omega : -omega;
  show_at(omega, two_way, center + distance * side, radius);
}

void DirectionGlyph::show_at(const Vec3& omega, bool two_way, const Vec3& middle, double radius) {
  const Vec3 other = std::abs(omega.z) < 0.9 ? Vec3{0, 0, 1} : Vec3{1, 0, 0};
  const Vec3 u = normalized(cross(other, omega));
  const Vec3 v = cross(omega, u);
  const double half = 0.34 * radius;
  const Vec3 corners[4] = {middle - half * u - half * v, middle + half * u - half * v,
                           middle + half * u + half * v, middle - half * u + half * v};
  for (vtkIdType k = 0; k < 4; ++k) {
    quad_->GetPoints()->SetPoint(k, corners[k].x, corners[k].y, corners[k].z);
  }
  quad_->GetPoints()->Modified();
  quad_->Modified();
  frame_->Modified();

  const double length = 0.26 * radius;
  tip_ = middle + length * omega;
  forward_->SetUserMatrix(arrow_matrix(middle, -omega, length));
  backward_->SetUserMatrix(arrow_matrix(middle, omega, length));
  for (vtkActor* actor : {border_.Get(), forward_.Get()}) {
    actor->VisibilityOn();
  }
  fill_->SetVisibility(filled_);
  shown_ = true;
  backward_->SetVisibility(two_way);
}

void DirectionGlyph::hide() {
  for (vtkActor* actor : {fill_.Get(), border_.Get(), forward_.Get(), backward_.Get()}) {
    actor->VisibilityOff();
  }
  shown_ = false;
}

void DirectionGlyph::set_filled(bool filled) {
  filled_ = filled;
  fill_->SetVisibility(filled_ && shown_);
}

void DirectionGlyph::set_line_width(double pixels) {
  border_->GetProperty()->SetLineWidth(static_cast<float>(pixels));
}

}  // namespace transillum::viewer
