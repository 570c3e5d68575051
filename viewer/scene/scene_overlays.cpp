// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Fragment edges, normals and back sides of a scene, as VTK actors built on first use from the
// loaded scene and its BSP tree.
#include "scene/scene_overlays.h"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

#include "colors/neutral_light.h"
#include "transillum/at.h"
#include "transillum/scene.h"
#include "widgets/theme.h"

namespace transillum::viewer {

namespace {

const QColor back_side_color{0x8c, 0x3a, 0x4a};

class Lines {
 public:
  void add(const Vec3& a, const Vec3& b) {
    lines_->InsertNextCell(2);
    lines_->InsertCellPoint(points_->InsertNextPoint(a.x, a.y, a.z));
    lines_->InsertCellPoint(points_->InsertNextPoint(b.x, b.y, b.z));
  }
  vtkSmartPointer<vtkPolyData> data() const {
    auto data = vtkSmartPointer<vtkPolyData>::New();
    data->SetPoints(points_);
    data->SetLines(lines_);
    return data;
  }

 private:
  vtkNew<vtkPoints> points_;
  vtkNew<vtkCellArray> lines_;
};

}  // namespace

vtkSmartPointer<vtkPolyData> fragment_lines(const Scene& scene, const BspTree& tree, double lift,
                                            const std::vector<bool>& hidden) {
  std::vector<int> fragments(static_cast<std::size_t>(scene.patch_count()));
  for (const BspTree::Fragment& f : tree.fragments()) {
    ++at(fragments, f.patch);
  }
  std::vector<int> pieces(fragments.size());
  for (const Piece& piece : scene.pieces()) {
    ++at(pieces, piece.patch);
  }
  Lines lines;
  for (const BspTree::Fragment& f : tree.fragments()) {
    // A non-convex patch has several pieces without being cut.
    if (at(fragments, f.patch) == at(pieces, f.patch) || at(hidden, f.patch)) {
      continue;
    }
    const auto corners = tree.corners(f);
    const Vec3 lifted = lift * scene.patch(f.patch).normal;
    const auto point = [&](std::size_t k) {
      return at(tree.points(), corners[k % corners.size()].point) + lifted;
    };
    for (std::size_t k = 0; k < corners.size(); ++k) {
      lines.add(point(k), point(k + 1));
    }
  }
  return lines.data();
}

vtkSmartPointer<vtkPolyData> normal_lines(const Scene& scene, const std::vector<bool>& hidden) {
  Lines lines;
  for (PatchId i = 0; i < scene.patch_count(); ++i) {
    if (at(hidden, i)) {
      continue;
    }
    const Patch& patch = scene.patch(i);
    lines.add(patch.center, patch.center + 0.5 * std::sqrt(patch.area) * patch.normal);
  }
  return lines.data();
}

vtkSmartPointer<vtkPolyData> shadow_lines(const Scene& scene, const std::vector<ShadowEdge>& edges,
                                          double lift, const std::vector<bool>& hidden) {
  Lines lines;
  for (const ShadowEdge& edge : edges) {
    if (!at(hidden, edge.patch)) {
      const Vec3 lifted = lift * scene.patch(edge.patch).normal;
      lines.add(edge.a + lifted, edge.b + lifted);
    }
  }
  return lines.data();
}

SceneOverlays::SceneOverlays(vtkRenderer& renderer) {
  for (Overlay& overlay : overlays_) {
    vtkNew<vtkPolyDataMapper> mapper;
    mapper->ScalarVisibilityOff();
    vtkNew<vtkPolyData> empty;
    mapper->SetInputData(empty);
    overlay.actor = vtkSmartPointer<vtkActor>::New();
    overlay.actor->SetMapper(mapper);
    overlay.actor->GetProperty()->LightingOff();
    overlay.actor->VisibilityOff();
    renderer.AddActor(overlay.actor);
  }
  const auto set_color = [this](Kind kind, const QColor& color) {
    overlay(kind).actor->GetProperty()->SetColor(color.redF(), color.greenF(), color.blueF());
  };
  set_color(Kind::fragments, theme::outside);
  set_color(Kind::normals, theme::processed);
  set_color(Kind::shadows, theme::inside);
  set_color(Kind::back_sides, back_side_color);
  overlay(Kind::back_sides).actor->GetProperty()->FrontfaceCullingOn();
}

void SceneOverlays::show_scene(std::shared_ptr<const LoadedScene> loaded, vtkPolyData* surface,
                               double lift) {
  loaded_ = std::move(loaded);
  surface_ = surface;
  lift_ = lift;
  hidden_.assign(loaded_->scene->patches().size(), false);
  shadows_.clear();
  for (const Kind kind : {Kind::fragments, Kind::normals, Kind::back_sides, Kind::shadows}) {
    overlay(kind).made = false;
    update(kind);
  }
}

void SceneOverlays::leave_out(const std::vector<bool>& hidden) {
  if (hidden == hidden_) {
    return;
  }
  hidden_ = hidden;
  for (const Kind kind : {Kind::fragments, Kind::normals, Kind::shadows}) {
    overlay(kind).made = false;
    update(kind);
  }
}

std::vector<vtkActor*> SceneOverlays::actors() const {
  std::vector<vtkActor*> actors;
  for (const Overlay& overlay : overlays_) {
    actors.push_back(overlay.actor);
  }
  return actors;
}

void SceneOverlays::set_shown(Kind kind, bool shown) {
  overlay(kind).shown = shown;
  update(kind);
}

void SceneOverlays::show_shadows(const std::vector<ShadowEdge>& edges) {
  shadows_ = edges;
  overlay(Kind::shadows).made = false;
  update(Kind::shadows);
}

void SceneOverlays::set_line_width(double pixels) {
  for (Overlay& overlay : overlays_) {
    overlay.actor->GetProperty()->SetLineWidth(static_cast<float>(pixels));
  }
  const double bold = 1.5;  // on edges of patches, which are as wide as the others
  overlay(Kind::shadows).actor->GetProperty()->SetLineWidth(static_cast<float>(bold * pixels));
}

void SceneOverlays::update(Kind kind) {
  Overlay& changed = overlay(kind);
  const bool visible = changed.shown && loaded_;
  changed.actor->SetVisibility(visible);
  if (!visible || changed.made) {
    return;
  }
  changed.made = true;
  auto* mapper = vtkPolyDataMapper::SafeDownCast(changed.actor->GetMapper());
  switch (kind) {
    case Kind::fragments:
      mapper->SetInputData(fragment_lines(*loaded_->scene, *loaded_->tree, lift_, hidden_));
      break;
    case Kind::normals:
      mapper->SetInputData(normal_lines(*loaded_->scene, hidden_));
      break;
    case Kind::shadows:
      mapper->SetInputData(shadow_lines(*loaded_->scene, shadows_, lift_, hidden_));
      break;
    case Kind::back_sides:
      mapper->SetInputData(surface_);
      break;
  }
}

namespace {

/// The edges of pieces by face and points, and how many pieces of the face have each.
std::map<std::array<std::int32_t, 3>, int> edges_of_faces(const Scene& scene) {
  std::map<std::array<std::int32_t, 3>, int> edges;
  for (const Piece& piece : scene.pieces()) {
    const auto corners = scene.corners(piece);
    for (std::size_t k = 0; k < corners.size(); ++k) {
      const auto [p, q] = std::minmax(corners[k], corners[(k + 1) % corners.size()]);
      ++edges[{scene.patch(piece.patch).face, p, q}];
    }
  }
  return edges;
}

}  // namespace

FacePreview::FacePreview(vtkRenderer& renderer) {
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
  actor_->GetProperty()->SetLineWidth(2);
  actor_->VisibilityOff();
  renderer.AddActor(actor_);
}

void FacePreview::show(const Scene& scene, const MarkedFaces& faces) {
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  for (const Vec3& p : scene.points()) {
    points->InsertNextPoint(p.x, p.y, p.z);
  }
  vtkNew<vtkCellArray> lines, polygons;
  vtkNew<vtkUnsignedCharArray> colors;  // first the lines, then the polygons
  colors->SetNumberOfComponents(3);
  const auto add_color = [&](const QColor& color, double brightness) {
    colors->InsertNextTuple3(brightness * color.red(), brightness * color.green(),
                             brightness * color.blue());
  };
  const auto is_in = [](const std::vector<std::int32_t>& numbers, std::int32_t face) {
    return std::binary_search(numbers.begin(), numbers.end(), face);
  };
  if (faces.are_covered) {
    for (const auto& [edge, count] : edges_of_faces(scene)) {
      const auto& [face, p, q] = edge;
      if (count == 1) {  // else between two patches of the face
        lines->InsertNextCell(2);
        lines->InsertCellPoint(p);
        lines->InsertCellPoint(q);
        add_color(is_in(faces.outside, face) ? theme::outside : QColor(Qt::gray), 1);
      }
    }
  }
  for (const Piece& piece : scene.pieces()) {
    const Patch& patch = scene.patch(piece.patch);
    const bool inside = is_in(faces.inside, patch.face);
    if (!inside && (faces.are_covered || !is_in(faces.outside, patch.face))) {
      continue;
    }
    const auto corners = scene.corners(piece);
    polygons->InsertNextCell(static_cast<int>(corners.size()));
    for (const PointId p : corners) {
      polygons->InsertCellPoint(p);
    }
    const bool turned = inside && faces.inside_turned;
    add_color(inside ? theme::inside : theme::outside,
              neutral_brightness(turned ? -patch.normal : patch.normal));
  }
  vtkNew<vtkPolyData> data;
  data->SetPoints(points);
  data->SetLines(lines);
  data->SetPolys(polygons);
  data->GetCellData()->SetScalars(colors);
  vtkPolyDataMapper::SafeDownCast(actor_->GetMapper())->SetInputData(data);
  actor_->VisibilityOn();
}

void FacePreview::hide() { actor_->VisibilityOff(); }

}  // namespace transillum::viewer
