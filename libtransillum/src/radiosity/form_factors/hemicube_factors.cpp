// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Form factors by hemicubes (Cohen and Greenberg 1985): from the center of each patch's largest
// piece, all other pieces are drawn onto five sides of half a cube. Input: a Scene, its BspTree and
// HemicubeOptions.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <tuple>
#include <utility>

#include "base/memory_limit.h"
#include "base/power_of_two.h"
#include "radiosity/form_factors/form_factor_rows.h"
#include "radiosity/form_factors/hemicube_image.h"
#include "transillum/at.h"
#include "transillum/errors.h"
#include "visibility/fast/fast_engine.h"
#include "visibility/pixels/hemicube.h"

namespace transillum {
namespace {

/// A point is treated as in a plane within this distance, relative to the scene's diagonal.
constexpr double coplanar_tolerance = 1e-12;
/// Hemicubes per thread between reports of progress.
constexpr PatchId hemicube_batch = 4;

/// A piece to draw; its plane is normal · x = offset, and a sphere around center holds it.
struct DrawnPiece {
  PatchId patch;
  std::uint32_t begin, end;  ///< in HemicubeScene::corners
  Vec3 normal, center;
  double offset, radius;
};

/// The geometry that all hemicubes draw; immutable. Its unit of length is a power of two near the
/// scene's diagonal, so that depths fit single precision whatever the size of the scene.
struct HemicubeScene {
  const Scene& scene;
  const Cancellation& cancellation;
  int resolution;
  double scale;         ///< from meters to units
  double min_distance;  ///< distances from a plane up to this count as 0, units
  bool fronts_only;     ///< no back side is visible from any front side
  std::vector<Vec3> corners;
  std::vector<DrawnPiece> pieces;          ///< where pieces coincide, the covering one is last
  std::vector<std::size_t> largest_piece;  ///< per patch, in `pieces`

  /// Keeps references to the scene and `stop`.
  HemicubeScene(const std::shared_ptr<const Scene>& seen,
                const std::shared_ptr<const BspTree>& tree, int pixels, const Cancellation& stop)
      : scene(*seen),
        cancellation(stop),
        resolution(pixels),
        scale(scale_to_one(seen->bounds().diagonal())),
        min_distance(coplanar_tolerance * (scale * seen->bounds().diagonal())),
        fronts_only(fronts_see_no_backs(seen, tree)) {
    for (const Piece& piece : scene.pieces()) {
      add(piece);
    }
    std::stable_sort(pieces.begin(), pieces.end(), [this](const auto& a, const auto& b) {
      return rank(a.patch) < rank(b.patch);
    });
    std::vector<double> largest(scene.patches().size());
    largest_piece.resize(largest.size());
    for (std::size_t p = 0; p < pieces.size(); ++p) {
      const auto i = static_cast<std::size_t>(pieces[p].patch);
      const double area = area_of(pieces[p]);
      if (area > largest[i]) {
        largest[i] = area;
        largest_piece[i] = p;
      }
    }
  }

  /// Center of gravity of a piece.
  Vec3 middle_of(const DrawnPiece& piece) const {
    Vec3 sum;
    double areas = 0;
    const Vec3& a = corners[piece.begin];
    for (std::uint32_t k = piece.begin + 2; k < piece.end; ++k) {
      const double area = norm(cross(corners[k - 1] - a, corners[k] - a));
      sum = sum + (area / 3) * (corners[k - 1] - a + (corners[k] - a));
      areas += area;
    }
    return areas > 0 ? a + (1 / areas) * sum : piece.center;
  }

 private:
  std::tuple<double, double, PatchId> rank(PatchId patch) const {
    return {max_abs(scene.exitance(patch)), -scene.patch(patch).area, patch};
  }
  double area_of(const DrawnPiece& piece) const {
    double area = 0;
    const Vec3& a = corners[piece.begin];
    for (std::uint32_t k = piece.begin + 2; k < piece.end; ++k) {
      area += norm(cross(corners[k - 1] - a, corners[k] - a));
    }
    return area / 2;
  }
  void add(const Piece& piece) {
    DrawnPiece drawn{piece.patch, static_cast<std::uint32_t>(corners.size()), 0, {}, {}, 0, 0};
    for (const PointId p : scene.corners(piece)) {
      corners.push_back(scale * scene.point(p));
    }
    drawn.end = static_cast<std::uint32_t>(corners.size());
    drawn.normal = scene.patch(piece.patch).normal;
    for (std::uint32_t k = drawn.begin; k < drawn.end; ++k) {
      drawn.center = drawn.center + corners[k];
    }
    drawn.center = (1.0 / (drawn.end - drawn.begin)) * drawn.center;
    for (std::uint32_t k = drawn.begin; k < drawn.end; ++k) {
      drawn.radius = std::max(drawn.radius, norm(corners[k] - drawn.center));
    }
    drawn.offset = dot(drawn.normal, drawn.center);
    pieces.push_back(drawn);
  }
};

/// Draws one hemicube after the other; one object per thread.
class HemicubeRows {
 public:
  explicit HemicubeRows(const HemicubeScene& shared)
      : shared_(shared), cube_(shared.resolution), sums_(shared.scene.patches().size()) {}

  FormFactorRow gather(PatchId i) {
    set_frame(i);
    cube_.clear();
    if (!shared_.fronts_only) {
      for (const DrawnPiece& piece : shared_.pieces) {
        draw(i, piece, false);
      }
    }
    for (const DrawnPiece& piece : shared_.pieces) {
      draw(i, piece, true);
    }
    return add_up();
  }
  /// The hemicube of the last row.
  const Hemicube& cube() const { return cube_; }

 private:
  /// Sets the eye and frame of patch i, rotated about its normal by an angle that differs from
  /// patch to patch: equal pixel errors on neighboring patches would be visible.
  void set_frame(PatchId i) {
    const DrawnPiece& own = shared_.pieces[at(shared_.largest_piece, i)];
    eye_ = shared_.middle_of(own);
    up_ = own.normal;
    const Vec3 u = normalized(cross(std::abs(up_.x) < 0.7 ? Vec3{1, 0, 0} : Vec3{0, 1, 0}, up_));
    const Vec3 v = cross(up_, u);
    const double turns = 0.6180339887498949 * (i + 1);
    const double angle = 2 * std::numbers::pi * (turns - std::floor(turns));
    u_ = std::cos(angle) * u + std::sin(angle) * v;
    v_ = cross(up_, u_);
  }

  /// Components of a vector in the frame.
  Vec3 in_frame(const Vec3& d) const { return {dot(u_, d), dot(v_, d), dot(up_, d)}; }

  /// Draws a piece if the eye is on its lit side (`lit`) or on its back.
  void draw(PatchId own, const DrawnPiece& piece, bool lit) {
    const double offset = piece.offset - dot(piece.normal, eye_);
    if ((lit ? -offset : offset) <= shared_.min_distance || piece.patch == own) {
      return;
    }
    const Vec3 to_center = piece.center - eye_;
    if (dot(up_, to_center) <= -piece.radius) {
      return;
    }
    // Checked per piece: at high resolutions a cube takes seconds.
    shared_.cancellation.throw_if_canceled();
    corners_.clear();
    for (std::uint32_t k = piece.begin; k < piece.end; ++k) {
      corners_.push_back(in_frame(shared_.corners[k] - eye_));
    }
    cube_.draw({corners_, in_frame(piece.normal), offset, in_frame(to_center), piece.radius,
                lit ? piece.patch : no_patch});
  }

  /// Sums the delta form factors of the pixels by patch.
  FormFactorRow add_up() {
    const std::vector<PatchId>& patches = cube_.patches();
    const std::vector<double>& delta = cube_.delta_form_factors();
    seen_.clear();
    for (std::size_t k = 0; k < patches.size(); ++k) {
      if (patches[k] == no_patch) {
        continue;
      }
      double& sum = at(sums_, patches[k]);
      if (sum == 0) {
        seen_.push_back(patches[k]);
      }
      sum += delta[k];
    }
    std::sort(seen_.begin(), seen_.end());
    FormFactorRow row;
    row.reserve(seen_.size());
    for (const PatchId j : seen_) {
      row.emplace_back(j, std::exchange(at(sums_, j), 0.0));
    }
    return row;
  }

  const HemicubeScene& shared_;
  Hemicube cube_;
  std::vector<double> sums_;  ///< by patch, of the current row
  std::vector<PatchId> seen_;
  Vec3 eye_, up_, u_, v_;
  std::vector<Vec3> corners_;
};

}  // namespace

void HemicubeOptions::validate() const {
  if (resolution < 2 || resolution > 2048 || resolution % 2 != 0) {
    throw InputError(
        fmt::format("resolution: {} is not an even number from 2 to 2048", resolution));
  }
  if (threads < 0 || threads > 4096) {
    throw InputError(fmt::format("threads: {} is not in the range 0 to 4096", threads));
  }
}

FormFactors hemicube_form_factors(const Scene& scene, const HemicubeOptions& options,
                                  const Cancellation& cancellation,
                                  const std::function<void(double)>& progress) {
  options.validate();
  // Not owned: the scene outlives this call.
  const std::shared_ptr<const Scene> borrowed(std::shared_ptr<const Scene>(), &scene);
  const HemicubeScene shared(
      borrowed,
      std::make_shared<const BspTree>(scene, cancellation, std::function<void(double)>{},
                                      options.threads),
      options.resolution, cancellation);
  return gather_rows(
      {scene.patch_count(), options.threads, hemicube_batch, memory_limit(options.memory)},
      [&shared] { return HemicubeRows(shared); }, cancellation, progress);
}

HemicubeImage hemicube_image(const std::shared_ptr<const Scene>& scene,
                             const std::shared_ptr<const BspTree>& tree, PatchId eye,
                             const HemicubeOptions& options, const Cancellation& cancellation) {
  options.validate();
  const HemicubeScene shared(scene, tree, options.resolution, cancellation);
  HemicubeRows rows(shared);
  HemicubeImage image{eye, options.resolution, {}, {}, {}};
  image.form_factors.resize(scene->patches().size());
  for (const auto& [j, value] : rows.gather(eye)) {
    at(image.form_factors, j) = value;
  }
  image.items = rows.cube().patches();
  image.delta = rows.cube().delta_form_factors();
  return image;
}

std::optional<std::size_t> HemicubeImage::pixel_at(int column, int row) const {
  const int half = resolution / 2;
  // Relative to the first pixel of the top side.
  const int x = column - half, y = row - half;
  const bool in_x = x >= 0 && x < resolution, in_y = y >= 0 && y < resolution;
  const auto pixel = [this](int side, int a, int b) {
    const int before = side == 0 ? 0 : resolution * resolution * (side + 1) / 2;
    return static_cast<std::size_t>(before + b * resolution + a);
  };
  if (in_x && in_y) {
    return pixel(0, x, y);
  }
  // Rows of a side run from its base, which is outermost, up to the fold.
  if (in_y && x >= resolution) {
    return pixel(1, y, half - 1 - (x - resolution));
  }
  if (in_x && y >= resolution) {
    return pixel(2, resolution - 1 - x, half - 1 - (y - resolution));
  }
  if (in_y) {
    return pixel(3, resolution - 1 - y, column);
  }
  if (in_x) {
    return pixel(4, x, row);
  }
  return std::nullopt;
}

}  // namespace transillum
