// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Edges of the shape: found from the outlines of the patches when a quantity first needs them, and
// drawn by SceneView where its colors do not tell the two sides apart.
#include "scene/feature_edges.h"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkPoints.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include "transillum/at.h"

namespace transillum::viewer {

namespace {

constexpr double cos_bend = 0.94;     // cosine of 20 degrees
constexpr int largest_contrast = 24;  // sum over channels, of colors that look the same

std::vector<FeatureEdge> sides_of(const Scene& scene) {
  std::vector<FeatureEdge> sides;
  for (PatchId i = 0; i < scene.patch_count(); ++i) {
    const auto outline = scene.outline(i);
    for (std::size_t k = 0; k < outline.size(); ++k) {
      const PointId a = outline[k], b = outline[(k + 1) % outline.size()];
      sides.push_back({std::min(a, b), std::max(a, b), i, no_patch});
    }
  }
  std::sort(sides.begin(), sides.end(), [](const FeatureEdge& a, const FeatureEdge& b) {
    return std::tie(a.begin, a.end, a.first) < std::tie(b.begin, b.end, b.first);
  });
  return sides;
}

// Whether the surface continues in the plane of the edge's patch on both sides of the edge.
bool continues(const LoadedScene& loaded, const FeatureEdge& edge) {
  const Scene& scene = *loaded.scene;
  const Vec3& normal = scene.patch(edge.first).normal;
  const Vec3 a = scene.point(edge.begin), b = scene.point(edge.end);
  // This distance is large enough that the picker cannot confuse two surfaces.
  const double small = 1e-4 * scene.bounds().diagonal();
  const auto covered = [&](const Vec3& aside) {
    const auto hit =
        loaded.picker->first_hit(0.5 * (a + b) + small * aside + 2 * small * normal, -normal);
    return hit && hit->distance < 4 * small &&
           std::abs(dot(scene.patch(hit->patch).normal, normal)) > cos_bend;
  };
  const Vec3 aside = normalized(cross(b - a, normal));
  return covered(aside) && covered(-aside);
}

bool look_alike(const Color8& a, const Color8& b) {
  int contrast = 0;
  for (std::size_t c = 0; c < a.size(); ++c) {
    contrast += std::abs(a[c] - b[c]);
  }
  return contrast <= largest_contrast;
}

// Lighter than a dark color, darker than a light one.
Color8 line_color(const Color8& surface) {
  const bool dark = surface[0] + surface[1] + surface[2] < 330;
  Color8 line;
  for (std::size_t c = 0; c < line.size(); ++c) {
    const int end = dark ? 255 : 0;
    line[c] = static_cast<std::uint8_t>(surface[c] + 45 * (end - surface[c]) / 100);
  }
  return line;
}

}  // namespace

std::vector<FeatureEdge> feature_edges(const LoadedScene& loaded) {
  const std::vector<FeatureEdge> sides = sides_of(*loaded.scene);
  std::vector<FeatureEdge> edges;
  for (std::size_t k = 0; k < sides.size();) {
    std::size_t next = k + 1;
    while (next < sides.size() && sides[next].begin == sides[k].begin &&
           sides[next].end == sides[k].end) {
      ++next;
    }
    FeatureEdge edge = sides[k];
    if (next == k + 1) {
      if (!continues(loaded, edge)) {
        edges.push_back(edge);
      }
    } else {
      edge.second = sides[k + 1].first;
      const double bend =
          dot(loaded.scene->patch(edge.first).normal, loaded.scene->patch(edge.second).normal);
      if (next > k + 2 || bend < cos_bend) {
        edges.push_back(edge);
      }
    }
    k = next;
  }
  return edges;
}

FeatureEdges::FeatureEdges(vtkRenderer& renderer) {
  lines_ = vtkSmartPointer<vtkPolyData>::New();
  colors_ = vtkSmartPointer<vtkUnsignedCharArray>::New();
  colors_->SetNumberOfComponents(3);
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetColorModeToDirectScalars();
  mapper->SetScalarModeToUseCellData();
  mapper->SetInputData(lines_);
  actor_ = vtkSmartPointer<vtkActor>::New();
  actor_->SetMapper(mapper);
  actor_->GetProperty()->LightingOff();
  actor_->VisibilityOff();
  renderer.AddActor(actor_);
}

void FeatureEdges::show_scene(std::shared_ptr<const LoadedScene> loaded) {
  loaded_ = std::move(loaded);
  found_ = false;
  hide();
}

void FeatureEdges::show(std::span<const Color8> colors, const std::vector<bool>& hidden) {
  if (!found_) {
    all_ = feature_edges(*loaded_);
    found_ = true;
  }
  flat_.clear();
  flat_colors_.clear();
  for (FeatureEdge edge : all_) {
    if (edge.second != no_patch && at(hidden, edge.second)) {
      edge.second = no_patch;
    }
    if (at(hidden, edge.first)) {
      if (edge.second == no_patch) {
        continue;
      }
      edge.first = std::exchange(edge.second, no_patch);
    }
    const Color8& color = at(colors, edge.first);
    if (edge.second == no_patch || look_alike(color, at(colors, edge.second))) {
      flat_.push_back(edge);
      flat_colors_.push_back(line_color(color));
    }
  }
  drawn_ = false;
  actor_->VisibilityOn();
}

void FeatureEdges::hide() {
  flat_.clear();
  actor_->VisibilityOff();
}

void FeatureEdges::follow_camera(const Vec3& eye) {
  if (!shown()) {
    return;
  }
  if (!drawn_ || norm(eye - eye_) > 0) {
    draw(eye);
  }
  // Scaled about the camera, the lines stay in place in the picture. The scale is chosen so that in
  // an inner corner, a floor seen at a grazing angle does not hide half of the line's width.
  actor_->SetOrigin(eye.x, eye.y, eye.z);
  actor_->SetScale(1 - 3e-3);
}

void FeatureEdges::draw(const Vec3& eye) {
  const Scene& scene = *loaded_->scene;
  const auto toward_eye = [&](PatchId i) {
    return i != no_patch && dot(scene.patch(i).normal, eye - scene.patch(i).center) > 0;
  };
  vtkNew<vtkPoints> points;
  vtkNew<vtkCellArray> lines;
  colors_->Reset();
  const auto add_point = [&](PointId id) {
    const Vec3 p = scene.point(id);
    return points->InsertNextPoint(p.x, p.y, p.z);
  };
  for (std::size_t k = 0; k < flat_.size(); ++k) {
    const FeatureEdge& edge = flat_[k];
    if (toward_eye(edge.first) || toward_eye(edge.second)) {
      const vtkIdType ends[2] = {add_point(edge.begin), add_point(edge.end)};
      lines->InsertNextCell(2, ends);
      colors_->InsertNextTypedTuple(flat_colors_[k].data());
    }
  }
  lines_->SetPoints(points);
  lines_->SetLines(lines);
  lines_->GetCellData()->SetScalars(colors_);
  colors_->Modified();
  lines_->Modified();
  eye_ = eye;
  drawn_ = true;
}

void FeatureEdges::set_line_width(double pixels) {
  actor_->GetProperty()->SetLineWidth(static_cast<float>(pixels));
}

}  // namespace transillum::viewer
