// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// The L2 difference of two results whose patches may differ. Input: two Solutions of the same
// faces, which Patch::face connects.
#include "radiosity/analysis/function_comparison.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <string>
#include <vector>

#include "radiosity/analysis/result_comparison.h"
#include "radiosity/channel_sums.h"
#include "radiosity/norms.h"
#include "transillum/at.h"
#include "transillum/errors.h"

namespace transillum {
namespace {

/// The radiosity of a result as a function of the point.
class RadiosityFunction {
 public:
  explicit RadiosityFunction(const Solution& solution)
      : solution_(solution), scene_(*solution.scene) {
    for (std::size_t k = 0; k < scene_.pieces().size(); ++k) {
      pieces_of_[scene_.patch(scene_.pieces()[k].patch).face].push_back(k);
    }
    if (!solution.linear_terms.empty()) {
      bases_ = linear_bases(scene_);
    }
  }

  Rgb at_point(PatchId i, const Vec3& point) const {
    Rgb b = at(solution_.radiosity, i);
    if (!bases_.empty()) {
      const auto [first, second] = at(bases_, i).at(point);
      const LinearTerm& term = at(solution_.linear_terms, i);
      b += first * term.first + second * term.second;
    }
    return b;
  }
  /// The patch of a face that holds a point of it, or comes nearest to it.
  /// @param near tried first; no_patch: none
  PatchId patch_at(std::int32_t face, const Vec3& normal, const Vec3& point, PatchId near) const {
    if (near != no_patch && scene_.patch(near).face == face &&
        dot(scene_.patch(near).normal, normal) > 0) {
      for (const std::size_t k : pieces_of_.at(face)) {
        if (scene_.pieces()[k].patch == near && depth(scene_.pieces()[k], point) > 0) {
          return near;
        }
      }
    }
    PatchId best = no_patch;
    double deepest = -std::numeric_limits<double>::infinity();
    const auto found = pieces_of_.find(face);
    if (found == pieces_of_.end()) {
      return no_patch;
    }
    for (const std::size_t k : found->second) {
      const Piece& piece = scene_.pieces()[k];
      if (dot(scene_.patch(piece.patch).normal, normal) <= 0) {
        continue;
      }
      const double inside = depth(piece, point);
      if (inside > deepest) {
        deepest = inside;
        best = piece.patch;
      }
      if (inside > 0) {
        break;
      }
    }
    return best;
  }

 private:
  /// Least distance of a point from the lines of a piece's edges, > 0 inside.
  double depth(const Piece& piece, const Vec3& point) const {
    const auto corners = scene_.corners(piece);
    const Vec3& normal = scene_.patch(piece.patch).normal;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < corners.size(); ++k) {
      const Vec3 &a = scene_.point(corners[k]),
                 &b = scene_.point(corners[k + 1 < corners.size() ? k + 1 : 0]);
      least = std::min(least, dot(normal, cross(normalized(b - a), point - a)));
    }
    return least;
  }

  const Solution& solution_;
  const Scene& scene_;
  std::map<std::int32_t, std::vector<std::size_t>> pieces_of_;  ///< by face
  std::vector<LinearBasis> bases_;
};

/// Integrals of squares.
struct Squares {
  Rgb difference, reference;

  void add(double weight, const Rgb& of_difference, const Rgb& of_reference) {
    difference += weight * of_difference * of_difference;
    reference += weight * of_reference * of_reference;
  }
  double relative() const {
    if (max_abs(difference) == 0) {
      return 0;
    }
    return max_abs(reference) > 0 ? largest_ratio(root(difference), channel_units(root(reference)))
                                  : std::numeric_limits<double>::infinity();
  }
};

}  // namespace

FunctionDifference compare_functions(const Solution& reference, const Solution& other) {
  const double area = total_area(*reference.scene), other_area = total_area(*other.scene);
  if (!(std::abs(area - other_area) <= 1e-9 * area)) {
    throw InputError(fmt::format(
        "the results are of different scenes: their patches have {} and {} m2", area, other_area));
  }
  const bool other_is_finer = other.scene->patch_count() > reference.scene->patch_count();
  const Solution& fine = other_is_finer ? other : reference;
  const Solution& coarse = other_is_finer ? reference : other;
  const RadiosityFunction of_fine(fine), of_coarse(coarse);
  Squares of_all, of_others;  // others: patches that do not emit
  PatchId near = no_patch;
  for (const Piece& piece : fine.scene->pieces()) {
    const Patch& patch = fine.scene->patch(piece.patch);
    const auto corners = fine.scene->corners(piece);
    for (std::size_t k = 2; k < corners.size(); ++k) {
      const Vec3 &a = fine.scene->point(corners[0]), &b = fine.scene->point(corners[k - 1]),
                 &c = fine.scene->point(corners[k]);
      const double weight = norm(cross(b - a, c - a)) / 6;
      // A rule of degree 2 whose points are inside.
      for (const Vec3& point : {(4 * a + b + c) / 6, (a + 4 * b + c) / 6, (a + b + 4 * c) / 6}) {
        near = of_coarse.patch_at(patch.face, patch.normal, point, near);
        if (near == no_patch) {
          throw InputError(fmt::format(
              "the results are of different scenes: face {} has patches in one only", patch.face));
        }
        const std::string material =
            other_is_finer ? material_difference(*coarse.scene, near, *fine.scene, piece.patch)
                           : material_difference(*fine.scene, piece.patch, *coarse.scene, near);
        if (!material.empty()) {
          throw InputError(fmt::format("the results are of different scenes: face {} has {}",
                                       patch.face, material));
        }
        const Rgb one = of_fine.at_point(piece.patch, point), two = of_coarse.at_point(near, point);
        const Rgb& exitance = fine.scene->exitance(piece.patch);
        const Rgb value = (other_is_finer ? two : one) - exitance;
        of_all.add(weight, one - two, value);
        if (max_abs(exitance) == 0) {
          of_others.add(weight, one - two, value);
        }
      }
    }
  }
  return {(max_abs(of_others.reference) > 0 ? of_others : of_all).relative(), area};
}

}  // namespace transillum
