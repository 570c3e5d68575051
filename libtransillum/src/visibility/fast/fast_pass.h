// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Engine fast. Each front-facing fragment (a receiver) runs a visibility query toward its sources:
// the fragments above it, nearest first, are subtracted from its projection until nothing remains.
// The area that a candidate removes is the area of it that the receiver sees. Candidates come from
// bins over the plane (FragmentBins).
//
// Visibility is symmetric: what a front-facing fragment sees of a back-facing one is also what that
// one sees of it. Therefore only back-facing fragments with area not accounted for run queries of
// their own, toward their receivers; in a scene of closed surfaces there are none.
//
// Notation: a fragment is an index into ProjectedFragments::fragments, whose order is BSP order, so
// that toward omega indices decrease. An entry is a position in the lists of FragmentBins.
#pragma once

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "base/invariant.h"
#include "transillum/at.h"
#include "visibility/fast/candidate_search.h"
#include "visibility/fast/exchange_rows.h"
#include "visibility/fast/patch_blocks.h"
#include "visibility/fast/visible_areas.h"
#include "visibility/queries/boundary_view.h"
#include "visibility/queries/cut_corners.h"
#include "visibility/queries/exact_view.h"
#include "visibility/queries/fragment_bins.h"
#include "visibility/queries/patch_shaft.h"
#include "visibility/queries/projected_fragments.h"
#include "visibility/queries/query_cost.h"

namespace transillum {

/// Data that all passes share.
struct FastScene {
  std::shared_ptr<const Scene> scene;         ///< whose patches exchange light
  std::shared_ptr<const PatchBlocks> blocks;  ///< if set, its scene is queried in place of `scene`
  std::shared_ptr<const BspTree> tree;        ///< the tree of queried()
  FragmentOutlines outlines;
  bool backs_hidden = false;        ///< fronts_see_no_backs()
  std::optional<PatchShaft> shaft;  ///< if set, only fragments in it take part
  /// Bases of all patches, if passes have moments; else null.
  std::shared_ptr<const std::vector<LinearBasis>> bases;

  FastScene(std::shared_ptr<const Scene> of_scene, std::shared_ptr<const BspTree> of_tree,
            std::shared_ptr<const PatchBlocks> of_blocks = nullptr)
      : scene(std::move(of_scene)),
        blocks(std::move(of_blocks)),
        tree(std::move(of_tree)),
        outlines(queried(), *tree) {
    if (blocks) {
      outlines.median_area = FragmentOutlines::median_area_of(*scene);
      outlines.smallest_part = blocks->smallest_shares();
    }
  }

  const Scene& queried() const { return blocks ? *blocks->scene : *scene; }
};

/// Runs passes, one at a time; reuses its memory from pass to pass.
class FastPass {
 public:
  /// @param costs per patch: the cost of its queries is added; null measures nothing
  explicit FastPass(const FastScene& shared, std::vector<PatchCost>* costs = nullptr)
      : shared_(shared),
        costs_(costs),
        bins_(projected_, shared.backs_hidden),
        search_(shared.queried(), bins_, projected_),
        cut_corners_(shared.outlines, projected_),
        exact_view_(shared.outlines, projected_, transfers_.counts,
                    shared.bases != nullptr || shared.blocks != nullptr),
        boundary_view_(projected_, cut_corners_, transfers_.counts, shared.backs_hidden,
                       BoundaryView::Frame::plane),
        needle_view_(projected_, cut_corners_, transfers_.counts, shared.backs_hidden,
                     BoundaryView::Frame::needle),
        visible_(*shared.scene, shared.blocks.get(), shared.bases, projected_) {}

  Transfers run(const Vec3& omega, const Cancellation& cancellation) {
    const Clock::time_point start = Clock::now();
    projected_.project(shared_.queried(), *shared_.tree, shared_.outlines, omega, cancellation,
                       shared_.shaft ? &*shared_.shaft : nullptr);
    const Clock::time_point ordered = Clock::now();
    bins_.fill(cancellation);
    search_.fill();
    const Clock::time_point binned = Clock::now();
    begin(omega);
    run_queries<Toward::source>(cancellation);
    run_smaller<Toward::source, Toward::receiver>(cancellation);
    if (!shared_.backs_hidden) {
      run_queries<Toward::receiver>(cancellation);
      run_smaller<Toward::receiver, Toward::source>(cancellation);
    }
    // With a shaft, fragments that would hide others may be missing.
    TRANSILLUM_INVARIANT(shared_.shaft || nothing_is_covered_twice(),
                         "more is covered than projected");
    sort_exchanges(cancellation);
    const auto seconds = [](Clock::time_point from, Clock::time_point to) {
      return std::chrono::duration<double>(to - from).count();
    };
    transfers_.counts.seconds_order = seconds(start, ordered);
    transfers_.counts.seconds_bins = seconds(ordered, binned);
    transfers_.counts.seconds_clip = seconds(binned, Clock::now());
    return std::move(transfers_);
  }

 private:
  using Clock = std::chrono::steady_clock;

  /// Fragments in more bins than this run one query per bin.
  static constexpr std::int32_t max_bins_per_query = 8;

  static double perimeter_of(const Scene& scene, PatchId patch) {
    const auto outline = scene.outline(patch);
    double sum = 0;
    for (std::size_t k = 0; k < outline.size(); ++k) {
      sum += norm(scene.point(outline[(k + 1) % outline.size()]) - scene.point(outline[k]));
    }
    return sum;
  }

  bool nothing_is_covered_twice() const {
    // Corners are about a grid unit off their lines: allows 2^10 units times the scene's 2^60.
    const double rounding = 0x1p10 * 0x1p60 * area_unit_;
    // Fragments nearer to each other than planes are thick, as the parts of a patch that rounding
    // has bent, may be in any order.
    const auto unordered = [this](std::size_t i) {
      return BspTree::thickness(*shared_.scene) *
             perimeter_of(*shared_.scene, static_cast<PatchId>(i));
    };
    const auto holds = [&](const Coverage& side, std::size_t i) {
      const double limit = side.projected * (1 + 1e-9) + rounding;
      return side.covered <= limit || side.covered <= limit + unordered(i);
    };
    for (std::size_t i = 0; i < transfers_.forward.size(); ++i) {
      if (!holds(transfers_.forward[i], i) || !holds(transfers_.backward[i], i)) {
        return false;
      }
    }
    return true;
  }

  void begin(const Vec3& omega) {
    const auto patches = static_cast<std::size_t>(shared_.scene->patch_count());
    transfers_ = {};
    transfers_.direction = omega;
    transfers_.forward.resize(patches);
    transfers_.backward.resize(patches);
    transfers_.back_seen.resize(patches);
    found_.clear();
    smaller_.clear();
    cut_corners_.begin();
    largest_bin_ = 0;
    for (const FragmentBins::Bin& bin : bins_.bins()) {
      largest_bin_ = std::max(largest_bin_, static_cast<double>(bin.size));
    }
    surely_resolved_ = BoundaryView::largest_error(largest_bin_) / ProjectedFragments::accuracy;
    seen_from_front_.assign(projected_.fragments.size(), 0);
    area_unit_ = projected_.grid.unit * projected_.grid.unit;
    if (visible_.have_moments()) {
      found_moments_.clear();
      transfers_.forward_moments.resize(patches);
      transfers_.backward_moments.resize(patches);
    }
    visible_.begin([this](const ProjectedFragments::Fragment& fragment, PatchId patch, double area,
                          const std::array<double, 2>& moments) {
      auto& side = fragment.front ? transfers_.forward : transfers_.backward;
      at(side, patch).projected += area_unit_ * area;
      if (visible_.have_moments()) {
        auto& of_side = fragment.front ? transfers_.forward_moments : transfers_.backward_moments;
        for (std::size_t a = 0; a < 2; ++a) {
          at(of_side, patch).projected[a] += moments[a];
        }
      }
    });
  }

  /// A fragment, and a larger one that it sees, or may see.
  struct SmallerOfTwo {
    std::int32_t smaller, larger;
    // NOLINTNEXTLINE(modernize-use-nullptr)
    auto operator<=>(const SmallerOfTwo&) const = default;
  };
  /// An entry of found_ with its index.
  struct NumberedTransfer : Transfer {
    std::uint32_t number = 0;
  };

  /// Runs the queries bin by bin, for locality of memory accesses. A fragment in few bins gets one
  /// query with the candidates of all of them, in the bin of its first entry; a fragment in many
  /// bins gets one query per bin, for its part in that bin.
  template <Toward toward>
  void run_queries(const Cancellation& cancellation) {
    std::int32_t queries = 0;
    const std::vector<FragmentBins::Bin>& bins = bins_.bins();
    for (std::size_t b = 0; b < bins.size(); ++b) {
      const FragmentBins::Bin& bin = bins[b];
      if (b + 2 < bins.size()) {
        prefetch_fragments(bins[b + 2]);
      }
      if (b + 1 < bins.size()) {
        prefetch_corners(bins[b + 1]);
      }
      for (FragmentBins::Entry e = bin.begin; e < bin.end; ++e) {
        const std::int32_t fragment = bins_.fragment(e);
        if (!needs_query(toward, fragment)) {
          continue;
        }
        if (++queries % 256 == 0) {
          cancellation.throw_if_canceled();
        }
        if (bins_.entry_count(fragment) > max_bins_per_query) {
          run_query<toward>(fragment, &bin, e);
        } else if (bins_.entry_before(e) == FragmentBins::none) {
          run_query<toward>(fragment, nullptr, e);
        }
      }
    }
  }

  /// The queries use the fragments of a bin in an order that the processor cannot predict.
  void prefetch_fragments(const FragmentBins::Bin& bin) const {
    for (FragmentBins::Entry e = bin.begin; e < bin.end; ++e) {
      __builtin_prefetch(projected_.fragments.data() + bins_.fragment(e));
    }
  }
  void prefetch_corners(const FragmentBins::Bin& bin) const {
    for (FragmentBins::Entry e = bin.begin; e < bin.end; ++e) {
      const ProjectedFragments::Fragment& fragment = at(projected_.fragments, bins_.fragment(e));
      __builtin_prefetch(projected_.corners.data() + fragment.begin);
      __builtin_prefetch(projected_.corners.data() + fragment.end - 1);
    }
  }

  bool needs_query(Toward toward, std::int32_t k) const {
    const ProjectedFragments::Fragment& fragment = at(projected_.fragments, k);
    if (toward == Toward::source) {
      return fragment.front;
    }
    // The rest counts beside the patches of a block, but for the rounding of its sum.
    const double rounding =
        0x1p-43 * fragment.area * std::max(0x1p-6, projected_.smallest_part(fragment.patch));
    return !fragment.front && fragment.area - at(seen_from_front_, k) > rounding;
  }

  template <Toward toward>
  void run_query(std::int32_t fragment, const FragmentBins::Bin* bin, FragmentBins::Entry entry) {
    find_visible<toward>(fragment, bin, entry);
    for (std::size_t k = 0; k < visible_.areas().size(); ++k) {
      const VisibleAreas::Area& visible = visible_.areas()[k];
      if (visible.too_small) {
        smaller_.push_back({visible.fragment, fragment});
      } else {
        accumulate<toward>(visible.fragment, k, false);
      }
    }
  }

  /// Fills visible_.
  template <Toward toward>
  void find_visible(std::int32_t fragment, const FragmentBins::Bin* bin,
                    FragmentBins::Entry entry) {
    if (costs_ == nullptr) {
      find_by_views<toward>(fragment, bin, entry);
      return;
    }
    PatchCost spent;
    const std::int64_t pairs = transfers_.counts.pairs;
    const Clock::time_point start = Clock::now();
    find_by_views<toward>(fragment, bin, entry);
    spent.seconds = std::chrono::duration<double>(Clock::now() - start).count();
    spent.queries = 1;
    spent.candidates = transfers_.counts.pairs - pairs;
    if (boundary_view_.failed()) {
      ++at(spent.repeated, boundary_view_.failure());
      if (needle_view_.failed()) {
        ++at(spent.exact, needle_view_.failure());
      }
    }
    visible_.share_cost(
        at(projected_.fragments, fragment), spent,
        [this](PatchId patch, const PatchCost& cost) { at(*costs_, patch) += cost; });
  }

  /// The first view that does not fail fills visible_.
  template <Toward toward>
  void find_by_views(std::int32_t fragment, const FragmentBins::Bin* bin,
                     FragmentBins::Entry entry) {
    if (query_with<toward>(boundary_view_, fragment, bin, entry) ||
        query_with<toward>(needle_view_, fragment, bin, entry)) {
      return;
    }
    ++transfers_.counts.exact_queries;
    query_with<toward>(exact_view_, fragment, bin, entry);
  }

  /// Returns false if the view fails.
  template <Toward toward, class View>
  bool query_with(View& view, std::int32_t fragment, const FragmentBins::Bin* bin,
                  FragmentBins::Entry entry) {
    visible_.clear();
    if (bin) {
      view.begin_query(fragment, *bin);
    } else {
      view.begin_query(fragment);
    }
    search_.begin<toward>(fragment, bin != nullptr, entry, view.window());
    waiting_.clear();
    while (subtract_candidates<toward>(view, fragment, bin != nullptr)) {
      if (view.waiting_parts() == 0) {
        return true;
      }
      view.next_part();
      search_.resume(std::move(waiting_.back()));
      waiting_.pop_back();
      if (view.is_crowded() && !divide(view)) {
        return false;
      }
    }
    return false;
  }

  /// Divides the view's region; the search continues from here for each of its parts.
  template <class View>
  bool divide(View& view) {
    if (!view.divide()) {
      return false;
    }
    waiting_.resize(view.waiting_parts(), search_.cursors());
    return true;
  }

  /// Subtracts the remaining candidates. Returns false if the view fails.
  template <Toward toward, class View>
  bool subtract_candidates(View& view, std::int32_t fragment, bool in_one_bin) {
    for (std::int32_t candidate = search_.next<toward>(view.window()); candidate >= 0;
         candidate = search_.next<toward>(view.window())) {
      const double area = view.subtract(candidate);
      if (view.failed()) {
        return false;
      }
      if (area > 0 || view.is_too_small()) {
        const bool too_small = in_one_bin ? is_too_small_in_bins(candidate) : view.is_too_small();
        if (area > 0 || too_small) {
          visible_.add(view, fragment, {candidate, area, too_small});
        }
      }
      if (view.is_crowded() && !divide(view)) {
        return false;
      }
      if (view.done()) {
        break;
      }
    }
    return true;
  }

  /// Whether a candidate is too small beside a fragment that is queried bin by bin: the same for
  /// all bins, so that one of the two fragments finds all of the area.
  bool is_too_small_in_bins(std::int32_t candidate) const {
    const ProjectedFragments::Fragment& other = at(projected_.fragments, candidate);
    if (other.area * projected_.smallest_part(other.patch) >= surely_resolved_ ||
        !boundary_view_.is_too_small_beside(candidate, largest_bin_)) {
      return false;
    }
    std::int64_t size = 0;
    for (auto e = bins_.last_entry(candidate); e != FragmentBins::none; e = bins_.entry_before(e)) {
      size = std::max(size, bin_of(e).size);
    }
    return boundary_view_.is_too_small_beside(candidate, static_cast<double>(size));
  }

  const FragmentBins::Bin& bin_of(FragmentBins::Entry entry) const {
    const auto after = std::upper_bound(
        bins_.bins().begin(), bins_.bins().end(), entry,
        [](FragmentBins::Entry e, const FragmentBins::Bin& bin) { return e < bin.begin; });
    return *(after - 1);
  }

  /// A small fragment and a large one exchange what the smaller one finds: its query, in the
  /// opposite direction, finds the areas that the queries `toward` have left to it.
  template <Toward toward, Toward opposite>
  void run_smaller(const Cancellation& cancellation) {
    std::sort(smaller_.begin(), smaller_.end());
    smaller_.erase(std::unique(smaller_.begin(), smaller_.end()), smaller_.end());
    for (std::size_t begin = 0, end = 0; begin < smaller_.size(); begin = end) {
      const std::int32_t fragment = smaller_[begin].smaller;
      while (end < smaller_.size() && smaller_[end].smaller == fragment) {
        ++end;
      }
      cancellation.throw_if_canceled();
      const auto first = smaller_.begin() + static_cast<std::ptrdiff_t>(begin);
      const auto last = smaller_.begin() + static_cast<std::ptrdiff_t>(end);
      const auto accumulate_found = [&] {
        for (std::size_t k = 0; k < visible_.areas().size(); ++k) {
          const VisibleAreas::Area& visible = visible_.areas()[k];
          if (!(visible.area > 0) ||
              !std::binary_search(first, last, SmallerOfTwo{fragment, visible.fragment})) {
            continue;
          }
          accumulate<toward>(fragment, k, true);
        }
      };
      if (bins_.entry_count(fragment) <= max_bins_per_query) {
        find_visible<opposite>(fragment, nullptr, bins_.last_entry(fragment));
        accumulate_found();
        continue;
      }
      for (auto e = bins_.last_entry(fragment); e != FragmentBins::none;
           e = bins_.entry_before(e)) {
        find_visible<opposite>(fragment, &bin_of(e), e);
        accumulate_found();
      }
    }
    smaller_.clear();
  }

  /// Counts that a fragment sees `seen`, by the parts of visible area k.
  /// @param turned whether the area was found by a query of `seen`
  template <Toward toward>
  void accumulate(std::int32_t seen, std::size_t k, bool turned) {
    const bool seen_front = at(projected_.fragments, seen).front;
    if (toward == Toward::source && !seen_front) {
      at(seen_from_front_, seen) += visible_.areas()[k].area;
    }
    visible_.for_each_part(k, [&](const VisibleAreas::PatchArea& part,
                                  const TransferMoments* moments) {
      const PatchId own = turned ? part.other : part.own, other = turned ? part.own : part.other;
      accumulate<toward>(own, other, seen_front, area_unit_ * part.area);
      if (moments != nullptr) {
        accumulate_moments<toward>(own, other, seen_front,
                                   turned ? transposed(*moments) : *moments);
      }
    });
  }

  /// @param area m²
  template <Toward toward>
  void accumulate(PatchId own, PatchId other, bool other_front, double area) {
    if (toward == Toward::source) {
      at(transfers_.forward, own).covered += area;
      if (other_front) {
        at(transfers_.back_seen, other) += area;
      } else {
        at(transfers_.backward, other).covered += area;
        found_.push_back({own, other, area});
      }
    } else if (!other_front) {
      at(transfers_.backward, own).covered += area;
      at(transfers_.back_seen, other) += area;
    }
  }

  /// The same for the integrals with basis functions; the exchange is in found_ already.
  template <Toward toward>
  void accumulate_moments(PatchId own, PatchId other, bool other_front,
                          const TransferMoments& moments) {
    if (toward == Toward::receiver && other_front) {
      return;
    }
    CoverageMoments& below = toward == Toward::source ? at(transfers_.forward_moments, own)
                                                      : at(transfers_.backward_moments, own);
    const bool exchanged = toward == Toward::source && !other_front;
    for (std::size_t a = 0; a < 2; ++a) {
      below.covered[a] += moments.of(a + 1, 0);
      if (exchanged) {
        at(transfers_.backward_moments, other).covered[a] += moments.of(0, a + 1);
      }
    }
    if (exchanged) {
      found_moments_.push_back(moments);
    }
  }

  /// Sorts found_ into transfers_.exchanges.
  void sort_exchanges(const Cancellation& cancellation) {
    if (!visible_.have_moments()) {
      rows_.sort(found_, transfers_.forward.size(), sorted_, transfers_.exchanges, cancellation,
                 [](const Transfer&, bool) {});
      return;
    }
    numbered_.clear();
    for (std::size_t k = 0; k < found_.size(); ++k) {
      numbered_.push_back({found_[k], static_cast<std::uint32_t>(k)});
    }
    std::vector<TransferMoments>& moments = transfers_.moments;
    rows_.sort(numbered_, transfers_.forward.size(), sorted_numbered_, transfers_.exchanges,
               cancellation, [&](const NumberedTransfer& t, bool added) {
                 const TransferMoments& found = found_moments_[t.number];
                 if (!added) {
                   moments.push_back(found);
                   return;
                 }
                 for (std::size_t k = 0; k < found.value.size(); ++k) {
                   moments.back().value[k] += found.value[k];
                 }
               });
  }

  const FastScene& shared_;
  std::vector<PatchCost>* const costs_;   ///< one per patch; null: nothing is measured
  double area_unit_ = 1;                  ///< m² per square grid unit
  std::vector<double> seen_from_front_;   ///< per fragment: square grid units
  std::vector<Transfer> found_, sorted_;  ///< one entry per visible area
  ExchangeRows rows_;
  double largest_bin_ = 0;             ///< size, grid units
  double surely_resolved_ = 0;         ///< area that is not too small in any bin
  std::vector<SmallerOfTwo> smaller_;  ///< areas that the smaller fragment finds
  std::vector<std::vector<CandidateSearch::Cursor>>
      waiting_;                                 ///< one search per waiting part of the view
  std::vector<TransferMoments> found_moments_;  ///< for each of found_, if there are moments
  std::vector<NumberedTransfer> numbered_, sorted_numbered_;
  Transfers transfers_;
  ProjectedFragments projected_;
  FragmentBins bins_;
  CandidateSearch search_;
  CutCorners cut_corners_;
  ExactView exact_view_;
  BoundaryView boundary_view_;
  BoundaryView needle_view_;  ///< for fragments that are too thin for boundary_view_
  VisibleAreas visible_;      ///< found by the current query
};

}  // namespace transillum
