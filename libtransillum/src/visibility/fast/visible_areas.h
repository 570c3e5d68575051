// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// The result of one visibility query of engine fast: the areas in which its fragment sees other
// fragments. Where fragments are blocks of patches, each area is divided among the patches.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "transillum/at.h"
#include "transillum/linear_basis.h"
#include "transillum/transfers.h"
#include "visibility/fast/block_overlay.h"
#include "visibility/fast/fragment_moments.h"
#include "visibility/fast/patch_blocks.h"
#include "visibility/queries/projected_fragments.h"
#include "visibility/queries/query_cost.h"

namespace transillum {

/// The moments with receiver and source exchanged.
inline TransferMoments transposed(const TransferMoments& moments) {
  TransferMoments turned;
  for (std::size_t a = 0; a < 3; ++a) {
    for (std::size_t b = 0; b < 3; ++b) {
      turned.of(a, b) = moments.of(b, a);
    }
  }
  return turned;
}

/// Collects what a query finds.
class VisibleAreas {
 public:
  struct Area {
    std::int32_t fragment;
    double area;            ///< square grid units
    bool too_small;         ///< the fragment is too small for this area to be accurate
    std::uint32_t end = 0;  ///< its parts end here, and begin where the area before it ends
  };
  /// The area in which one patch sees another.
  struct PatchArea {
    PatchId own, other;
    double area;  ///< square grid units
  };

  /// @param blocks of the patches of the fragments; null where these are the patches themselves
  /// @param bases if set, parts have moments
  VisibleAreas(const Scene& scene, const PatchBlocks* blocks,
               const std::shared_ptr<const std::vector<LinearBasis>>& bases,
               const ProjectedFragments& projected)
      : projected_(projected), blocks_(blocks) {
    if (bases) {
      moments_.emplace(scene, bases, projected);
    }
    if (blocks != nullptr) {
      overlay_.emplace(*blocks, projected);
    }
  }

  /// Begins a direction. Calls visit(fragment, patch, area, moments) for each patch of each
  /// fragment: its projected area, square grid units, and its integrals of phi_1 and phi_2 over it,
  /// m², if there are moments.
  template <class Visit>
  void begin(Visit visit) {
    if (moments_) {
      moments_->begin();
    }
    for (const ProjectedFragments::Fragment& fragment : projected_.fragments) {
      if (!is_block(fragment)) {
        const PatchId patch = patch_of(fragment);
        visit(fragment, patch, fragment.area,
              moments_ ? moments_->of_fragment(patch, fragment) : std::array<double, 2>{});
        continue;
      }
      if (moments_) {
        for_each_patch(fragment, [&](PatchId patch, double) { moments_->prepare(patch); });
      }
      // The integrals over whole patches are 0.
      for_each_share(fragment, [&](PatchId patch, double area) {
        visit(fragment, patch, area, std::array<double, 2>{});
      });
    }
  }

  bool is_block(const ProjectedFragments::Fragment& fragment) const {
    return blocks_ != nullptr && !at(blocks_->blocks, fragment.patch).is_single();
  }
  /// Calls visit(patch, cost) for each patch of the fragment of a query: equal shares of time and
  /// candidates, as far as these are whole numbers; the first one has the rest.
  template <class Visit>
  void share_cost(const ProjectedFragments::Fragment& fragment, const PatchCost& cost,
                  Visit visit) const {
    if (!is_block(fragment)) {
      visit(patch_of(fragment), cost);
      return;
    }
    std::int32_t count = 0;
    for_each_patch(fragment, [&](PatchId, double) { ++count; });
    PatchCost share;
    share.seconds = cost.seconds / count;
    share.candidates = cost.candidates / count;
    PatchCost rest = cost;
    rest.seconds = 0;
    rest.candidates -= count * share.candidates;
    visit(patch_of(fragment), rest);
    for_each_patch(fragment, [&](PatchId patch, double) { visit(patch, share); });
  }

  bool have_moments() const { return moments_.has_value(); }

  /// To be called when a view begins a query.
  void clear() {
    areas_.clear();
    parts_.clear();
    part_moments_.clear();
    if (overlay_) {
      overlay_->begin_query();
    }
  }
  /// Adds what the last subtract() of a view has found.
  template <class View>
  void add(const View& view, std::int32_t fragment, Area area) {
    if (is_plain()) {
      fragment_ = fragment;
      areas_.push_back(area);
      return;
    }
    const ProjectedFragments::Fragment& own = at(projected_.fragments, fragment);
    const ProjectedFragments::Fragment& other = at(projected_.fragments, area.fragment);
    if (area.area > 0 && (is_block(own) || is_block(other))) {
      add_cells(view, own, other, area.area);
    } else if (area.area > 0) {
      add_part(view, {patch_of(own), patch_of(other), area.area});
    }
    area.end = static_cast<std::uint32_t>(parts_.size());
    areas_.push_back(area);
  }

  const std::vector<Area>& areas() const { return areas_; }
  /// Calls visit(part, moments) for each part of area k; moments is null if there are none.
  template <class Visit>
  void for_each_part(std::size_t k, Visit visit) const {
    if (is_plain()) {
      visit(PatchArea{at(projected_.fragments, fragment_).patch,
                      at(projected_.fragments, areas_[k].fragment).patch, areas_[k].area},
            nullptr);
      return;
    }
    for (std::size_t p = k == 0 ? 0 : areas_[k - 1].end; p < areas_[k].end; ++p) {
      visit(parts_[p], moments_ ? &part_moments_[p] : nullptr);
    }
  }

 private:
  /// Whether each area has one part, without moments: parts are not stored.
  bool is_plain() const { return blocks_ == nullptr && !moments_; }

  /// Parts below this, relative to the area of a patch, are the rounding of lines.
  static constexpr double negligible = 0x1p-46;

  /// The patch of a fragment, or the first one of its block.
  PatchId patch_of(const ProjectedFragments::Fragment& fragment) const {
    return blocks_ != nullptr ? blocks_->patches[at(blocks_->blocks, fragment.patch).patches]
                              : fragment.patch;
  }
  /// Calls visit(patch, share) for each patch of a block, with its share of the area.
  template <class Visit>
  void for_each_patch(const ProjectedFragments::Fragment& fragment, Visit visit) const {
    const PatchBlock& block = at(blocks_->blocks, fragment.patch);
    for (std::int32_t k = 0; k < block.size(); ++k) {
      const std::size_t index = block.patches + static_cast<std::size_t>(k);
      if (blocks_->patches[index] != no_patch) {
        visit(blocks_->patches[index], blocks_->shares[index]);
      }
    }
  }

  /// Calls visit(patch, area) for each patch of a block, with its part of a fragment's area.
  template <class Visit>
  void for_each_share(const ProjectedFragments::Fragment& fragment, Visit visit) {
    if (!overlay_->is_narrow(fragment.patch)) {
      for_each_patch(fragment,
                     [&](PatchId patch, double share) { visit(patch, share * fragment.area); });
      return;
    }
    // Rounding to the grid has changed the shares.
    const auto cells = overlay_->divide_outline(fragment);
    double sum = 0;
    for (const BlockOverlay::Cell& cell : cells) {
      sum += std::max(0.0, cell.area);
    }
    if (!(sum > 0)) {
      visit(patch_of(fragment), fragment.area);
    }
    for (const BlockOverlay::Cell& cell : cells) {
      if (cell.area > 0) {
        visit(cell.own, fragment.area * (cell.area / sum));
      }
    }
  }

  template <class Boundary>
  void add_part(const Boundary& boundary, const PatchArea& part) {
    parts_.push_back(part);
    if (moments_) {
      const double unit = projected_.grid.unit;
      part_moments_.push_back(
          moments_->of_overlap(boundary, part.own, part.other, unit * unit * part.area));
    }
  }

  template <class View>
  void add_cells(const View& view, const ProjectedFragments::Fragment& own,
                 const ProjectedFragments::Fragment& other, double area) {
    const NeedleFrame frame = view.frame();
    const auto cells = overlay_->divide(view, frame, own, other, moments_.has_value());
    const auto smallest = [&](const ProjectedFragments::Fragment& fragment) {
      return projected_.smallest_part(fragment.patch) * fragment.area;
    };
    const double least = negligible * frame.determinant * std::min(smallest(own), smallest(other));
    double sum = 0;
    for (const BlockOverlay::Cell& cell : cells) {
      sum += cell.area > least ? cell.area : 0;
    }
    if (!(sum > 0)) {
      // All of the area goes to patches, however rounding has divided a needle.
      const auto largest = std::max_element(
          cells.begin(), cells.end(), [](const auto& a, const auto& b) { return a.area < b.area; });
      const bool none = largest == cells.end();
      const CellBoundary boundary{
          frame, none ? std::span<const BoundarySegment>() : overlay_->boundary(*largest)};
      add_part(boundary, {none ? patch_of(own) : largest->own,
                          none ? patch_of(other) : largest->other, area});
      return;
    }
    for (const BlockOverlay::Cell& cell : cells) {
      if (cell.area > least) {
        add_part(CellBoundary{frame, overlay_->boundary(cell)},
                 {cell.own, cell.other, area * (cell.area / sum)});
      }
    }
  }

  const ProjectedFragments& projected_;
  const PatchBlocks* blocks_;
  std::optional<FragmentMoments> moments_;
  std::optional<BlockOverlay> overlay_;
  std::int32_t fragment_ = 0;  ///< the one of the query, if is_plain()
  std::vector<Area> areas_;
  std::vector<PatchArea> parts_;
  std::vector<TransferMoments> part_moments_;  ///< for each part, if there are moments
};

}  // namespace transillum
