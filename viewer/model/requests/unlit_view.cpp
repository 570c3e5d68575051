// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// A picture of a result as programs show it that open its export: triangles without lighting, whose
// colors are B times an exposure. One ray per pixel finds the patch; another exposure needs no new
// rays.
#include "model/requests/unlit_view.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "model/snapshot_values.h"
#include "transillum/files.h"

namespace transillum::viewer {

namespace {

/// The sRGB transfer function (IEC 61966-2-1), as bytes.
int srgb_byte(double linear) {
  const double x = std::clamp(linear, 0.0, 1.0);
  const double s = x <= 0.0031308 ? 12.92 * x : 1.055 * std::pow(x, 1 / 2.4) - 0.055;
  return static_cast<int>(std::lround(255 * s));
}

}  // namespace

UnlitView unlit_view(const UnlitRequest& request, const Cancellation& cancellation) {
  UnlitView view{request.snapshot, request.size, {}};
  view.automatic_exposure = automatic_exposure(solution_of(*request.snapshot));
  const Vec3 back = normalized(request.eye - request.target);
  const Vec3 right = normalized(cross(request.up, back));
  const Vec3 above = cross(back, right);
  const double tangent = std::tan(request.view_angle / 2 * std::numbers::pi / 180);
  const int width = request.size.width(), height = request.size.height();
  const double pixel = 2 * tangent / height;
  view.patches.reserve(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  for (int y = 0; y < height; ++y) {
    cancellation.throw_if_canceled();
    for (int x = 0; x < width; ++x) {
      const Vec3 ray =
          pixel * (x + 0.5 - 0.5 * width) * right + pixel * (0.5 * height - y - 0.5) * above - back;
      const auto hit = request.snapshot->loaded->picker->first_lit_hit(request.eye, ray);
      view.patches.push_back(hit ? hit->patch : no_patch);
      if (!request.snapshot->linear_terms.empty()) {
        view.points.push_back(hit ? hit->point : Vec3{});
      }
    }
  }
  return view;
}

QImage UnlitView::picture(double exposure, QRgb background) const {
  const auto color_of = [exposure](const Rgb& b) {
    return qRgb(srgb_byte(exposure * b.r), srgb_byte(exposure * b.g), srgb_byte(exposure * b.b));
  };
  std::vector<QRgb> colors;
  colors.reserve(snapshot->radiosity.size());
  for (const Rgb& b : snapshot->radiosity) {
    colors.push_back(color_of(b));
  }
  QImage image(size, QImage::Format_RGB32);
  std::size_t next = 0;
  for (int y = 0; y < size.height(); ++y) {
    auto* line = reinterpret_cast<QRgb*>(image.scanLine(y));
    for (int x = 0; x < size.width(); ++x) {
      const PatchId patch = patches[next];
      line[x] = patch == no_patch ? background
                : points.empty()  ? at(colors, patch)
                                  : color_of(radiosity_at(*snapshot, patch, points[next]));
      ++next;
    }
  }
  return image;
}

double UnlitView::white_fraction(double exposure) const {
  double white = 0, all = 0;
  for (PatchId i = 0; i < snapshot->loaded->scene->patch_count(); ++i) {
    if (max_abs(material_of(*snapshot, i).exitance) > 0) {
      continue;
    }
    const double area = snapshot->loaded->scene->patch(i).area;
    all += area;
    white += exposure * max_abs(at(snapshot->radiosity, i)) > 1 ? area : 0;
  }
  return all > 0 ? white / all : 0;
}

}  // namespace transillum::viewer
