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

#include "transillum/at.h"
#include "widgets/theme.h"

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

void DirectionGlyph::show(const Vec3& omega, bool two_way, const Scene& scene, const Vec3& center,
                          double radius, const Vec3& eye) {
  double reach = 0;
  for (const Vec3& p : scene.points()) {
    reach = std::max(reach, std::abs(dot(p - center, omega)));
  }
  const double distance = std::min(0.86 * radius, 1.06 * reach);
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

namespace {

vtkSmartPointer<vtkActor> actor_on_top(vtkPolyData* data, const QColor& color, double units,
                                       vtkRenderer& renderer) {
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(data);
  mapper->SetResolveCoincidentTopologyToPolygonOffset();
  mapper->SetRelativeCoincidentTopologyPolygonOffsetParameters(0, units);
  mapper->SetRelativeCoincidentTopologyLineOffsetParameters(0, units);
  auto actor = vtkSmartPointer<vtkActor>::New();
  actor->SetMapper(mapper);
  actor->GetProperty()->LightingOff();
  actor->GetProperty()->SetColor(color.redF(), color.greenF(), color.blueF());
  actor->PickableOff();
  actor->VisibilityOff();
  renderer.AddActor(actor);
  return actor;
}

}  // namespace

StepGlyph::StepGlyph(vtkRenderer& renderer)
    : polygon_(vtkSmartPointer<vtkPolyData>::New()), loop_(vtkSmartPointer<vtkPolyData>::New()) {
  // Depth offsets that put the glyph in front of the whole scene.
  fill_ = actor_on_top(polygon_, theme::processed, -1e5, renderer);
  fill_->GetProperty()->SetOpacity(0.55);
  fill_->ForceOpaqueOn();  // like DirectionGlyph
  halo_ = actor_on_top(loop_, Qt::black, -1.1e5, renderer);
  border_ = actor_on_top(loop_, theme::processed, -1.2e5, renderer);
}

void StepGlyph::show(const RecordedMap& map, std::int32_t step) {
  const BspTree& tree = *map.loaded->tree;
  const auto& fragment = tree.fragment(at(map.record().order, step));
  vtkNew<vtkPoints> points;
  std::vector<vtkIdType> corners;
  for (const BspTree::Corner& corner : tree.corners(fragment)) {
    const Vec3& p = at(tree.points(), corner.point);
    corners.push_back(points->InsertNextPoint(p.x, p.y, p.z));
  }
  vtkNew<vtkCellArray> polygon, loop;
  polygon->InsertNextCell(static_cast<vtkIdType>(corners.size()), corners.data());
  corners.push_back(corners.front());
  loop->InsertNextCell(static_cast<vtkIdType>(corners.size()), corners.data());
  polygon_->SetPoints(points);
  polygon_->SetPolys(polygon);
  loop_->SetPoints(points);
  loop_->SetLines(loop);
  for (vtkActor* actor : {fill_.Get(), halo_.Get(), border_.Get()}) {
    actor->VisibilityOn();
  }
}

void StepGlyph::hide() {
  for (vtkActor* actor : {fill_.Get(), halo_.Get(), border_.Get()}) {
    actor->VisibilityOff();
  }
}

void StepGlyph::set_line_width(double pixels) {
  halo_->GetProperty()->SetLineWidth(static_cast<float>(2 * pixels));
  border_->GetProperty()->SetLineWidth(static_cast<float>(pixels));
}

Vec3 center_of_step(const RecordedMap& map, std::int32_t step) {
  const BspTree& tree = *map.loaded->tree;
  const auto corners = tree.corners(tree.fragment(at(map.record().order, step)));
  Vec3 sum;
  for (const BspTree::Corner& corner : corners) {
    sum = sum + at(tree.points(), corner.point);
  }
  return (1.0 / static_cast<double>(corners.size())) * sum;
}

std::vector<bool> later_patches(const RecordedMap& map, std::int32_t step) {
  const auto& patches = map.record().step_patch;
  std::vector<bool> is_later(map.loaded->scene->patches().size(), false);
  for (std::int32_t k = step + 1; k < std::ssize(patches); ++k) {
    at(is_later, at(patches, k)) = true;
  }
  return is_later;
}

void dim_patches(const std::vector<bool>& dimmed, std::vector<Color8>& colors) {
  const int background[3] = {theme::scene_background.red(), theme::scene_background.green(),
                             theme::scene_background.blue()};
  for (std::size_t p = 0; p < colors.size(); ++p) {
    if (!dimmed[p]) {
      continue;
    }
    Color8& color = colors[p];
    // Gray and dark, but still visible against the background.
    const int gray = (2 * color[0] + 5 * color[1] + color[2]) / 8;
    for (std::size_t c = 0; c < 3; ++c) {
      color[c] = static_cast<unsigned char>(background[c] + 14 + (gray - background[c]) / 5);
    }
  }
}

}  // namespace transillum::viewer
