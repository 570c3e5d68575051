// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Connected components of patches, made consistent: along a shared edge, two consistent patches
// run in opposite directions. Input: a Scene, whose points are distinct, so that faces are
// connected by equal coordinates. A union-find structure keeps the parity of each patch relative to
// its root: a cycle with the wrong parity is a surface with one side only, such as a Moebius strip.
#include "radiosity/orientation/connected_components.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "base/bit_mixing.h"
#include "transillum/at.h"

namespace transillum {
namespace {

/// Disjoint sets whose members have a parity relative to each other.
class ParitySets {
 public:
  explicit ParitySets(std::size_t count) : parent_(count), parity_(count, 0) {
    std::iota(parent_.begin(), parent_.end(), PatchId{0});
  }
  /// The root of i, and the parity of i relative to it.
  std::pair<PatchId, std::uint8_t> find(PatchId i) {
    PatchId root = i;
    std::uint8_t parity = 0;
    while (at(parent_, root) != root) {
      parity ^= at(parity_, root);
      root = at(parent_, root);
    }
    const std::uint8_t whole = parity;
    while (at(parent_, i) != root) {
      parity ^= std::exchange(at(parity_, i), parity);
      i = std::exchange(at(parent_, i), root);
    }
    return {root, whole};
  }
  /// Joins the sets of a and b. Returns whether the parities agree with what is known. The smaller
  /// root stays.
  bool join(PatchId a, PatchId b, bool opposite) {
    const auto [root_a, parity_a] = find(a);
    const auto [root_b, parity_b] = find(b);
    const auto parity = static_cast<std::uint8_t>(parity_a ^ parity_b ^ (opposite ? 1 : 0));
    if (root_a == root_b) {
      return parity == 0;
    }
    at(parent_, std::max(root_a, root_b)) = std::min(root_a, root_b);
    at(parity_, std::max(root_a, root_b)) = parity;
    return true;
  }

 private:
  std::vector<PatchId> parent_;
  std::vector<std::uint8_t> parity_;  ///< 1: opposite to the parent
};

/// One use of an edge by a patch.
struct EdgeUse {
  std::uint64_t edge;  ///< both points
  PatchId patch;
  std::int8_t sign;  ///< 1 from the lower point to the higher
};

class ComponentFinder {
 public:
  ComponentFinder(const Scene& scene, const Cancellation& cancellation)
      : scene_(scene),
        cancellation_(cancellation),
        takes_part_(scene.patches().size(), true),
        sets_(scene.patches().size()) {}

  ConnectedComponents find() {
    find_coincident();
    list_edges();
    join_faces();
    for_each_edge([this](std::span<const EdgeUse> uses) { join_across(uses); });
    number_parts();
    for_each_edge([this](std::span<const EdgeUse> uses) { check_closed(uses); });
    measure();
    return std::move(found_);
  }

 private:
  /// Sets `first`; patches on the points of an earlier one take no component, and if they face
  /// opposite ways, neither does that one.
  void find_coincident() {
    found_.first.resize(scene_.patches().size());
    std::iota(found_.first.begin(), found_.first.end(), PatchId{0});
    std::vector<std::pair<std::uint64_t, PatchId>> keys;
    for (PatchId i = 0; i < scene_.patch_count(); ++i) {
      // Independent of the order; different sets have the same key once in 2^64 pairs.
      std::uint64_t key = 0;
      for (const PointId p : scene_.outline(i)) {
        key += mixed(mixed(static_cast<std::uint64_t>(p) + 1) + golden_step);
      }
      keys.emplace_back(key, i);
    }
    std::sort(keys.begin(), keys.end());
    for (std::size_t k = 1; k < keys.size(); ++k) {
      const PatchId i = keys[k].second, before = keys[k - 1].second;
      if (keys[k].first != keys[k - 1].first) {
        continue;
      }
      const PatchId first = at(found_.first, i) = at(found_.first, before);
      at(takes_part_, i) = false;
      if (dot(scene_.patch(i).normal, scene_.patch(first).normal) < 0) {
        at(takes_part_, first) = false;
      }
    }
  }

  void list_edges() {
    for (PatchId i = 0; i < scene_.patch_count(); ++i) {
      if (!at(takes_part_, i)) {
        continue;
      }
      const auto outline = scene_.outline(i);
      for (std::size_t k = 0; k < outline.size(); ++k) {
        const auto a = static_cast<std::uint64_t>(outline[k]);
        const auto b = static_cast<std::uint64_t>(outline[k + 1 < outline.size() ? k + 1 : 0]);
        edges_.push_back(
            {std::min(a, b) << 32 | std::max(a, b), i, static_cast<std::int8_t>(a < b ? 1 : -1)});
      }
    }
    cancellation_.throw_if_canceled();
    std::sort(edges_.begin(), edges_.end(), [](const EdgeUse& a, const EdgeUse& b) {
      return std::pair(a.edge, a.patch) < std::pair(b.edge, b.patch);
    });
    cancellation_.throw_if_canceled();
  }

  template <class Visit>
  void for_each_edge(const Visit& visit) {
    for (std::size_t begin = 0, end = 0; begin < edges_.size(); begin = end) {
      while (end < edges_.size() && edges_[end].edge == edges_[begin].edge) {
        ++end;
      }
      visit(std::span<const EdgeUse>(edges_).subspan(begin, end - begin));
    }
    cancellation_.throw_if_canceled();
  }

  /// A non-planar face has a patch for each of its triangles.
  void join_faces() {
    for (PatchId i = 1; i < scene_.patch_count(); ++i) {
      if (scene_.patch(i).face == scene_.patch(i - 1).face && at(takes_part_, i) &&
          at(takes_part_, i - 1)) {
        sets_.join(i - 1, i, false);
      }
    }
  }

  /// Where more than two patches meet, none is the other's continuation.
  void join_across(std::span<const EdgeUse> uses) {
    if (uses.size() == 2 && uses[0].patch != uses[1].patch &&
        !sets_.join(uses[0].patch, uses[1].patch, uses[0].sign == uses[1].sign)) {
      inconsistent_.push_back(uses[0].patch);
    }
  }

  void number_parts() {
    found_.component.assign(scene_.patches().size(), ConnectedComponents::none);
    found_.sign.assign(scene_.patches().size(), 1);
    for (PatchId i = 0; i < scene_.patch_count(); ++i) {
      if (!at(takes_part_, i)) {
        continue;
      }
      const auto [root, parity] = sets_.find(i);
      if (root == i) {
        at(found_.component, i) = static_cast<std::int32_t>(found_.components.size());
        found_.components.emplace_back();
      }
      at(found_.component, i) = at(found_.component, root);
      at(found_.sign, i) = parity == 0 ? 1 : -1;
    }
    for (const PatchId i : inconsistent_) {
      at(found_.components, at(found_.component, i)).orientable = false;
    }
  }

  /// An edge is closed within a component if the component's patches use it in both directions
  /// alike.
  void check_closed(std::span<const EdgeUse> uses) {
    const auto component_of = [this](const EdgeUse& use) {
      return at(found_.component, use.patch);
    };
    std::vector<std::pair<std::int32_t, int>> balance;
    for (const EdgeUse& use : uses) {
      balance.emplace_back(component_of(use), use.sign * at(found_.sign, use.patch));
    }
    std::sort(balance.begin(), balance.end());
    for (std::size_t k = 0; k < balance.size();) {
      const std::int32_t component = balance[k].first;
      int sum = 0;
      for (; k < balance.size() && balance[k].first == component; ++k) {
        sum += balance[k].second;
      }
      if (sum != 0) {
        at(found_.components, component).closed = false;
      }
    }
  }

  /// Areas, and signs such that most of a component's area has sign 1; then volumes.
  void measure() {
    std::vector<double> signed_area(found_.components.size());
    const Vec3 center = scene_.bounds().center();
    for (PatchId i = 0; i < scene_.patch_count(); ++i) {
      if (const std::int32_t component = at(found_.component, i);
          component != ConnectedComponents::none) {
        const Patch& patch = scene_.patch(i);
        const double sign = at(found_.sign, i);
        at(found_.components, component).area += patch.area;
        for (const PointId p : scene_.outline(i)) {
          at(found_.components, component).bounds.add(scene_.point(p));
        }
        at(found_.components, component).volume +=
            sign * patch.area * dot(patch.normal, patch.center - center) / 3;
        at(signed_area, component) += sign * patch.area;
      }
    }
    for (std::size_t p = 0; p < found_.components.size(); ++p) {
      if (signed_area[p] < 0) {
        found_.components[p].volume = -found_.components[p].volume;
      }
    }
    for (PatchId i = 0; i < scene_.patch_count(); ++i) {
      const std::int32_t component = at(found_.component, i);
      if (component != ConnectedComponents::none && at(signed_area, component) < 0) {
        at(found_.sign, i) = static_cast<std::int8_t>(-at(found_.sign, i));
      }
    }
  }

  const Scene& scene_;
  const Cancellation& cancellation_;
  std::vector<bool> takes_part_;  ///< by patch
  ParitySets sets_;
  std::vector<EdgeUse> edges_;
  std::vector<PatchId> inconsistent_;
  ConnectedComponents found_;
};

}  // namespace

ConnectedComponents find_connected_components(const Scene& scene,
                                              const Cancellation& cancellation) {
  return ComponentFinder(scene, cancellation).find();
}

}  // namespace transillum
