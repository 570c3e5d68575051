// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Jumps of the radiosity across the edges of patches. Input: a Solution; neighbors are found by
// their places, since patches of different sizes share no corners.
#include "radiosity/analysis/radiosity_jumps.h"

#include <algorithm>
#include <cmath>

#include "geometry/box_tree.h"
#include "radiosity/channel_sums.h"
#include "transillum/at.h"
#include "transillum/glossy.h"
#include "transillum/refinement.h"

namespace transillum {
namespace {

/// Patches that come nearer than this fraction of their size touch.
constexpr double touching = 1e-6;
/// Cosine of the angle below which two patches are of one plane.
constexpr double same_plane = 1 - 1e-9;
constexpr PatchId patches_between_checks = 256;

Bounds bounds_of(const Scene& scene, const Piece& piece) {
  Bounds bounds;
  for (const PointId p : scene.corners(piece)) {
    bounds.add(scene.point(p));
  }
  return bounds;
}

std::vector<Bounds> bounds_of_pieces(const Scene& scene) {
  std::vector<Bounds> boxes;
  for (const Piece& piece : scene.pieces()) {
    boxes.push_back(bounds_of(scene, piece));
  }
  return boxes;
}

/// Finds the patches that touch a point.
class PiecesByPlace {
 public:
  explicit PiecesByPlace(const Scene& scene) : scene_(scene), tree_(bounds_of_pieces(scene)) {}

  /// Patches within `distance` of a point, in ascending order.
  std::vector<PatchId> near(const Vec3& point, double distance) const {
    std::vector<PatchId> patches;
    tree_.for_each(
        [&](const CenteredBox& box) {
          const Vec3 offset = point - box.center;
          return std::abs(offset.x) <= box.half.x + distance &&
                 std::abs(offset.y) <= box.half.y + distance &&
                 std::abs(offset.z) <= box.half.z + distance;
        },
        [&](std::int32_t number) {
          const Piece& piece = at(scene_.pieces(), number);
          if (touches(piece, point, distance)) {
            patches.push_back(piece.patch);
          }
        });
    std::sort(patches.begin(), patches.end());
    patches.erase(std::unique(patches.begin(), patches.end()), patches.end());
    return patches;
  }

 private:
  bool touches(const Piece& piece, const Vec3& point, double distance) const {
    const auto corners = scene_.corners(piece);
    const Vec3& normal = scene_.patch(piece.patch).normal;
    for (std::size_t k = 0; k < corners.size(); ++k) {
      const Vec3 &a = scene_.point(corners[k]),
                 &b = scene_.point(corners[k + 1 < corners.size() ? k + 1 : 0]);
      if (dot(normal, cross(normalized(b - a), point - a)) < -distance) {
        return false;
      }
    }
    return std::abs(dot(normal, point - scene_.point(corners[0]))) <= distance;
  }

  const Scene& scene_;
  BoxTree tree_;
};

/// The irradiance of a result as a function of the point.
class Irradiance {
 public:
  Irradiance(const Solution& solution, std::span<const Rgb> reflectance)
      : solution_(solution), reflectance_(reflectance) {
    if (!solution.linear_terms.empty()) {
      bases_ = linear_bases(*solution.scene);
    }
  }

  Rgb at_point(PatchId i, const Vec3& point) const {
    Rgb h = at(solution_.irradiance, i);
    if (!bases_.empty()) {
      const auto [first, second] = at(bases_, i).at(point);
      const LinearTerm& term = at(solution_.linear_terms, i);
      const Rgb slope = first * term.first + second * term.second;
      const Rgb& rho = at(reflectance_, i);
      // Where nothing is reflected, B tells nothing about how H varies.
      h.r += rho.r > 0 ? slope.r / rho.r : 0;
      h.g += rho.g > 0 ? slope.g / rho.g : 0;
      h.b += rho.b > 0 ? slope.b / rho.b : 0;
    }
    return h;
  }

 private:
  const Solution& solution_;
  std::span<const Rgb> reflectance_;
  std::vector<LinearBasis> bases_;
};

/// A mean of squares along edges.
struct EdgeMean {
  Rgb sum;
  double length = 0;

  void add(const Rgb& value, double weight) {
    sum = sum + weight * (value * value);
    length += weight;
  }
  Rgb mean() const { return length > 0 ? 1 / length * sum : Rgb{}; }
};

class Jumps {
 public:
  Jumps(const Solution& solution, std::span<const Rgb> reflectance)
      : scene_(*solution.scene),
        reflectance_(reflectance),
        places_(scene_),
        irradiance_(solution, reflectance) {}

  /// The mean of squares, by channel.
  Rgb squares_of(PatchId i) const {
    const auto outline = scene_.outline(i);
    const double near = touching * std::sqrt(scene_.patch(i).area);
    EdgeMean in_plane, at_angle, alone;
    for (std::size_t k = 0; k < outline.size(); ++k) {
      const Vec3 &a = scene_.point(outline[k]),
                 &b = scene_.point(outline[k + 1 < outline.size() ? k + 1 : 0]);
      // Gauss' points of order 2.
      for (const double place : {0.21132486540518712, 0.7886751345948129}) {
        const Vec3 point = a + place * (b - a);
        const double weight = norm(b - a) / 2;
        const Rgb own = irradiance_.at_point(i, point);
        alone.add(at(reflectance_, i) * own, weight);
        for (const PatchId j : places_.near(point, near)) {
          const double cosine = dot(scene_.patch(i).normal, scene_.patch(j).normal);
          if (j == i || cosine < -same_plane) {
            continue;
          }
          EdgeMean& mean = cosine > same_plane ? in_plane : at_angle;
          mean.add(at(reflectance_, i) * (own - irradiance_.at_point(j, point)), weight);
        }
      }
    }
    return in_plane.length > 0   ? in_plane.mean()
           : at_angle.length > 0 ? at_angle.mean()
                                 : alone.mean();
  }

 private:
  const Scene& scene_;
  std::span<const Rgb> reflectance_;
  PiecesByPlace places_;
  Irradiance irradiance_;
};

std::vector<Rgb> reflectance_of(const Solution& solution) {
  std::vector<Rgb> reflectance;
  for (PatchId i = 0; i < solution.scene->patch_count(); ++i) {
    const Material& material = solution.scene->material(i);
    reflectance.push_back(solution.statistics.glossy.patches > 0
                              ? material.reflectance + used_lobe(material).reflectance
                              : material.reflectance);
  }
  return reflectance;
}

std::vector<Rgb> squared_jumps(const Solution& solution, std::span<const Rgb> reflectance,
                               const Cancellation& cancellation) {
  const Jumps jumps(solution, reflectance);
  std::vector<Rgb> result;
  result.reserve(solution.scene->patches().size());
  for (PatchId i = 0; i < solution.scene->patch_count(); ++i) {
    if (i % patches_between_checks == 0) {
      cancellation.throw_if_canceled();
    }
    result.push_back(jumps.squares_of(i));
  }
  return result;
}

}  // namespace

std::vector<double> radiosity_jumps(const Solution& solution, const Cancellation& cancellation) {
  return radiosity_jumps(solution, reflectance_of(solution), cancellation);
}

std::vector<double> radiosity_jumps(const Solution& solution, std::span<const Rgb> reflectance,
                                    const Cancellation& cancellation) {
  std::vector<double> result;
  for (const Rgb& squares : squared_jumps(solution, reflectance, cancellation)) {
    result.push_back(std::sqrt(sum(squares)));
  }
  return result;
}

std::vector<Rgb> squared_jumps(const Solution& solution, const Cancellation& cancellation) {
  return squared_jumps(solution, reflectance_of(solution), cancellation);
}

}  // namespace transillum
