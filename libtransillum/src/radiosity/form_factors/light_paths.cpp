// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Best-first search for the strongest light paths, backward from the receiver. An unfinished path
// from patch k to the receiver has a weight, the product of rho and F along it, so that it carries
// weight * B_k in all: weight * E_k starts at k, and the rest arrives at k from the patches l of
// row k, each with the weight * rho_k F_kl.
#include "radiosity/form_factors/light_paths.h"

#include <fmt/format.h>

#include <algorithm>
#include <compare>
#include <cstdint>
#include <functional>
#include <iterator>
#include <queue>
#include <utility>

#include "geometry/luminance.h"
#include "radiosity/form_factors/jacobi.h"
#include "transillum/at.h"
#include "transillum/errors.h"

namespace transillum {
namespace {

constexpr std::size_t most_unfinished = 4'000'000;  // about 250 MB

void check(const Scene& scene, PatchId receiver, const LightPathOptions& options) {
  check_receiver(scene, receiver);
  if (options.count < 1 || options.count > 1'000'000) {
    throw InputError(fmt::format("number of paths: {} is not in 1 … 1000000", options.count));
  }
  if (!(options.smallest_fraction > 0 && options.smallest_fraction < 1)) {
    throw InputError(
        fmt::format("smallest share: {} is not between 0 and 1", options.smallest_fraction));
  }
  if (!options.start.empty() && options.start.size() != scene.patches().size()) {
    throw InputError(
        "the initial radiosity belongs to another scene: the number of patches differs");
  }
  if (!options.sun_irradiance.empty() &&
      options.sun_irradiance.size() != options.sky_irradiance.size()) {
    throw InputError("the light of the sun is of another number of patches than that of the sky");
  }
}

/// An unfinished path; the part toward the receiver is shared.
struct Node {
  PatchId patch;
  std::int64_t toward;  ///< index of the next node toward the receiver; -1: `patch` is it
  Rgb weight;
};

class Search {
 public:
  Search(const Scene& scene, const FormFactors& form_factors,
         const std::vector<Material>& materials, const LightPathOptions& options,
         const std::vector<Rgb>& b)
      : scene_(scene),
        form_factors_(form_factors),
        materials_(materials),
        options_(options),
        b_(b) {}

  LightPaths run(PatchId receiver, const Cancellation& cancellation) {
    result_.radiosity = at(b_, receiver);
    smallest_ = options_.smallest_fraction * luminance(result_.radiosity);
    push({receiver, -1, {1, 1, 1}});
    while (!unfinished_.empty()) {
      cancellation.throw_if_canceled();
      const auto [total, order] = unfinished_.top();
      unfinished_.pop();
      const std::int64_t index = -order;
      if (total <= threshold() || !result_.complete) {
        cut_off(at(nodes_, index));
      } else {
        finish(index);
        extend(index);
      }
    }
    return collect();
  }

 private:
  const Material& material(PatchId k) const {
    return material_of_patch(scene_, materials_, options_.patch_materials, k);
  }
  /// Light with which paths from it begin.
  Rgb emission(PatchId k, LightOrigin origin) const {
    const Material& of_patch = material(k);
    if (origin == LightOrigin::emission) {
      return of_patch.exitance;
    }
    const auto received = [k](std::span<const Rgb> irradiance) {
      return irradiance.empty() ? Rgb() : at(irradiance, k);
    };
    const Rgb sun = received(options_.sun_irradiance);
    return of_patch.reflectance *
           (origin == LightOrigin::sun ? sun : received(options_.sky_irradiance) - sun);
  }
  /// Paths that carry no more need not be found.
  double threshold() const {
    const bool full = std::ssize(found_) == options_.count;
    return full ? std::max(smallest_, found_.top().luminance) : smallest_;
  }
  void cut_off(const Node& node) { result_.cut_off += node.weight * at(b_, node.patch); }

  void push(const Node& node) {
    const double total = luminance(node.weight * at(b_, node.patch));
    if (total <= threshold()) {
      cut_off(node);
    } else if (nodes_.size() == most_unfinished) {
      result_.complete = false;
      cut_off(node);
    } else {
      nodes_.push_back(node);
      unfinished_.emplace(total, -(std::ssize(nodes_) - 1));
    }
  }
  /// The light of the path that starts at the node.
  Rgb light_of(const Node& node, LightOrigin origin) const {
    return node.weight * emission(node.patch, origin);
  }
  /// The paths that start at the node.
  void finish(std::int64_t index) {
    for (const LightOrigin origin : {LightOrigin::emission, LightOrigin::sky, LightOrigin::sun}) {
      finish(index, origin);
    }
  }
  void finish(std::int64_t index, LightOrigin origin) {
    const Rgb light = light_of(at(nodes_, index), origin);
    if (luminance(light) <= threshold()) {
      result_.cut_off += light;
      return;
    }
    if (std::ssize(found_) == options_.count) {
      const Found& weakest = found_.top();
      result_.cut_off += light_of(at(nodes_, weakest.first), weakest.origin);
      found_.pop();
    }
    found_.push({luminance(light), index, origin});
  }
  void extend(std::int64_t index) {
    const Node node = at(nodes_, index);  // a copy: push() may move them
    const Rgb reflected = node.weight * material(node.patch).reflectance;
    const auto end = at(form_factors_.row_begin, node.patch + 1);
    for (auto entry = at(form_factors_.row_begin, node.patch); entry < end; ++entry) {
      push({form_factors_.source[entry], index, form_factors_.value[entry] * reflected});
    }
  }
  LightPaths collect() {
    for (; !found_.empty(); found_.pop()) {
      const Found& weakest = found_.top();
      LightPath path{{}, light_of(at(nodes_, weakest.first), weakest.origin), weakest.origin};
      for (std::int64_t k = weakest.first; k >= 0; k = at(nodes_, k).toward) {
        path.patches.push_back(at(nodes_, k).patch);
      }
      result_.paths.push_back(std::move(path));
    }
    std::reverse(result_.paths.begin(), result_.paths.end());
    return std::move(result_);
  }

  const Scene& scene_;
  const FormFactors& form_factors_;
  const std::vector<Material>& materials_;
  const LightPathOptions& options_;
  const std::vector<Rgb>& b_;
  double smallest_ = 0;  ///< luminance below which paths are cut off
  std::vector<Node> nodes_;
  /// Light that a node carries, and minus its index: of equal ones the oldest is next.
  std::priority_queue<std::pair<double, std::int64_t>> unfinished_;
  /// A path: its luminance, the index of its first node, and where it begins.
  struct Found {
    double luminance;
    std::int64_t first;
    LightOrigin origin;
    // NOLINTNEXTLINE(modernize-use-nullptr)
    auto operator<=>(const Found&) const = default;
  };
  std::priority_queue<Found, std::vector<Found>, std::greater<>> found_;  ///< the weakest on top
  LightPaths result_;
};

}  // namespace

LightPaths find_light_paths(const Scene& scene, const FormFactors& form_factors, PatchId receiver,
                            const std::vector<Material>& materials, const LightPathOptions& options,
                            const Cancellation& cancellation) {
  check_form_factor_input(scene, form_factors, materials, options.patch_materials);
  check(scene, receiver, options);
  JacobiIteration solve(scene, form_factors, materials, options.threads, options.patch_materials);
  if (!options.start.empty()) {
    solve.b.assign(options.start.begin(), options.start.end());
  }
  solve.add_sky(options.sky_irradiance);
  solve.run_to(options.tolerance, cancellation);
  return Search(scene, form_factors, materials, options, solve.b).run(receiver, cancellation);
}

}  // namespace transillum
