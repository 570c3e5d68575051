// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Engine corrected, the future work of the paper's section 8: "avoid the majority of the cuttings
// of the patches. Instead of cutting, the radiosity of the patch can be corrected". A partly hidden
// fragment stays whole; only its open area is stored, as if it were spread evenly over the
// fragment. The exchange of two fragments is the area of their overlap, corrected by their open
// areas. If this leaves less of a receiver covered than its candidates must cover, all of them give
// more, so that the total area received stays right.
//
// The second part of the file compares a pass with the recorded local map (CorrectedMap).
#include "visibility/fast/corrected_map.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include "transillum/at.h"
#include "visibility/fast/fast_engine.h"
#include "visibility/queries/convex_overlap.h"
#include "visibility/queries/fragment_bins.h"
#include "visibility/queries/projected_fragments.h"
#include "visibility/transfers/transfer_sums.h"

namespace transillum {
namespace {

/// A fragment with a smaller fraction of its area open is treated as hidden.
constexpr double hidden = 1e-6;

/// Data that all passes share.
struct CorrectedScene {
  std::shared_ptr<const Scene> scene;
  std::shared_ptr<const BspTree> tree;
  FragmentOutlines outlines;
  bool backs_hidden;  ///< fronts_see_no_backs()

  CorrectedScene(std::shared_ptr<const Scene> of_scene, std::shared_ptr<const BspTree> of_tree)
      : scene(std::move(of_scene)),
        tree(std::move(of_tree)),
        outlines(*scene, *tree),
        backs_hidden(fronts_see_no_backs(scene, tree)) {}
};

/// One pass. run() makes all of it; begin() and query() make it fragment by fragment.
class CorrectedPass {
 public:
  explicit CorrectedPass(const CorrectedScene& shared)
      : shared_(shared), bins_(projected_, shared.backs_hidden), overlap_(projected_) {}

  Transfers run(const Vec3& omega, const Cancellation& cancellation) {
    begin(omega, cancellation);
    TransferSums<double> sums(shared_.scene->patch_count());
    for (std::int32_t k = 0; k < fragment_count(); ++k) {
      if (k % 64 == 0) {
        cancellation.throw_if_canceled();
      }
      const ProjectedFragments::Fragment& below = fragment(k);
      sums.project(below.patch, below.front, area_unit() * below.area);
      query(k);
      for (const Candidate& candidate : candidates_) {
        if (!(candidate.seen > 0)) {
          continue;
        }
        const ProjectedFragments::Fragment& other = fragment(candidate.fragment);
        sums.accumulate(below.patch, below.front, other.patch, other.front,
                        area_unit() * candidate.seen);
      }
    }
    return sums.finish(omega, cancellation);
  }

  void begin(const Vec3& omega, const Cancellation& cancellation) {
    projected_.project(*shared_.scene, *shared_.tree, shared_.outlines, omega, cancellation);
    bins_.fill(cancellation);
    open_below_.clear();
    last_query_.assign(projected_.fragments.size(), -1);
  }
  std::int32_t fragment_count() const {
    return static_cast<std::int32_t>(projected_.fragments.size());
  }
  const ProjectedFragments::Fragment& fragment(std::int32_t k) const {
    return at(projected_.fragments, k);
  }
  /// m² per square grid unit.
  double area_unit() const { return projected_.grid.unit * projected_.grid.unit; }
  /// Finds the areas that fragment k sees; must be called in BSP order.
  void query(std::int32_t k) {
    open_below_.push_back(fragment(k).area);
    candidates_.clear();
    if (shared_.backs_hidden && !fragment(k).front) {
      return;
    }
    find_candidates(k);
    exchange(fragment(k));
  }
  /// The area of fragment k, after its query, that is still visible from below; square grid units.
  double open_below(std::int32_t k) const { return at(open_below_, k); }

 private:
  /// A fragment above the one whose query runs.
  struct Candidate {
    std::int32_t fragment;
    double overlap;  ///< square grid units; < 0: not computed yet
    double seen;     ///< the part of it that is treated as visible
  };

  /// Collects the fragments above whose boxes overlap the box of fragment k, nearest first.
  void find_candidates(std::int32_t k) {
    const FragmentWindow window = window_of(at(projected_.boxes, k));
    candidates_.clear();
    for (auto own = bins_.last_entry(k); own != FragmentBins::none; own = bins_.entry_before(own)) {
      for (FragmentBins::Entry e = own - 1; bins_.fragment(e) >= 0; --e) {
        if (!window.overlaps(bins_.box(e))) {
          continue;
        }
        const std::int32_t other = bins_.fragment(e);
        if (std::exchange(at(last_query_, other), k) == k) {
          continue;
        }
        candidates_.push_back({other, -1, 0});
      }
    }
    std::sort(candidates_.begin(), candidates_.end(),
              [](const Candidate& a, const Candidate& b) { return a.fragment > b.fragment; });
  }

  double overlap(Candidate& candidate) const {
    if (candidate.overlap < 0) {
      candidate.overlap = overlap_.area_with(fragment(candidate.fragment));
    }
    return candidate.overlap;
  }

  /// Sets `seen` of all candidates.
  void exchange(const ProjectedFragments::Fragment& below) {
    overlap_.set_subject(below);
    open_ = below.area;
    const double negligible = hidden * below.area;
    for (Candidate& candidate : candidates_) {
      if (open_ <= negligible) {
        return;
      }
      const double area = fragment(candidate.fragment).area;
      const double open = open_below(candidate.fragment);
      if (open > hidden * area) {
        transfer(candidate, corrected(overlap(candidate), below.area, open_, area, open));
      }
    }
    // The candidates must cover the rest: first from the nearest with open area ...
    for (Candidate& candidate : candidates_) {
      if (open_ <= negligible) {
        return;
      }
      const double open = std::max(open_below(candidate.fragment), 0.0);
      transfer(candidate, std::min({open_, open, overlap(candidate) - candidate.seen}));
    }
    // ... then from all, beyond their open areas.
    double rest = 0;
    for (Candidate& candidate : candidates_) {
      rest += overlap(candidate) - candidate.seen;
    }
    if (!(rest > 0) || open_ <= negligible) {
      return;
    }
    const double fraction = std::min(1.0, open_ / rest);
    for (Candidate& candidate : candidates_) {
      transfer(candidate, fraction * (candidate.overlap - candidate.seen));
    }
  }

  void transfer(Candidate& candidate, double seen) {
    candidate.seen += seen;
    at(open_below_, candidate.fragment) -= seen;
    open_ -= seen;
  }

  /// The open area of an overlap, from both fragments' open areas: the overlap times the open
  /// fraction of the smaller fragment, within the bounds that both impose.
  static double corrected(double overlap, double area, double open, double other_area,
                          double other_open) {
    const double fraction = area < other_area ? open / area : other_open / other_area;
    const double least =
        std::max({0.0, overlap - (area - open), overlap - (other_area - other_open)});
    return std::min({std::max(overlap * fraction, least), overlap, open, other_open});
  }

  const CorrectedScene& shared_;
  ProjectedFragments projected_;
  FragmentBins bins_;
  ConvexOverlap overlap_;
  std::vector<double> open_below_;        ///< per fragment: area visible from below
  std::vector<std::int32_t> last_query_;  ///< per fragment: the last fragment whose query met it
  std::vector<Candidate> candidates_;     ///< candidates of the current query
  double open_ = 0;                       ///< area of the current query's fragment not yet covered
};

}  // namespace

TransferEngine corrected_engine(std::shared_ptr<const Scene> scene,
                                std::shared_ptr<const BspTree> tree) {
  auto shared = std::make_shared<const CorrectedScene>(std::move(scene), std::move(tree));
  return [shared = std::move(shared)](const Vec3& omega, const Cancellation& cancellation) {
    return CorrectedPass(*shared).run(omega, cancellation);
  };
}

namespace {

/// For each step, the area of its fragment that is still in V after step `step`, m².
std::vector<double> open_in_map(const MapRecord& record, std::int32_t step) {
  std::vector<double> open(record.order.size(), 0);
  std::vector<std::int32_t> origin;  // per row: the step that put it, or its first ancestor, into V
  for (const MapRecord::Row& row : record.rows) {
    if (row.made > step) {
      break;
    }
    origin.push_back(row.parent == MapRecord::no_row ? row.made : at(origin, row.parent));
    if (row.consumed > step) {
      at(open, origin.back()) += std::max(record.area(row), 0.0);
    }
  }
  return open;
}

/// For each outline, the step of its fragment.
std::vector<std::int32_t> steps_of(const FragmentOutlines& outlines, const MapRecord& record) {
  std::vector<std::int32_t> steps(outlines.outlines.size());
  for (std::int32_t k = 0; k < record.step_count(); ++k) {
    const auto fragment = static_cast<std::size_t>(at(record.order, k));
    std::fill(steps.begin() + outlines.first[fragment],
              steps.begin() + outlines.first[fragment + 1], k);
  }
  return steps;
}

}  // namespace

CorrectedMap corrected_map_after(const std::shared_ptr<const Scene>& scene,
                                 const std::shared_ptr<const BspTree>& tree,
                                 const MapRecord& record, std::int32_t step,
                                 const Cancellation& cancellation) {
  const CorrectedScene shared(scene, tree);
  CorrectedPass pass(shared);
  pass.begin(record.frame.omega, cancellation);
  CorrectedMap map;
  map.frame = record.frame;
  const std::vector<double> exact = open_in_map(record, step);
  const std::vector<std::int32_t> steps = steps_of(shared.outlines, record);
  std::vector<std::size_t> place_of_step(record.order.size(), exact.size());
  std::vector<std::pair<std::int32_t, std::size_t>> fragments;  // (fragment, its part in the map)
  for (std::int32_t f = 0; f < pass.fragment_count(); ++f) {
    if (f % 64 == 0) {
      cancellation.throw_if_canceled();
    }
    const ProjectedFragments::Fragment& fragment = pass.fragment(f);
    const std::int32_t own_step = steps[fragment.outline];
    if (own_step > step) {
      break;
    }
    pass.query(f);
    std::size_t& place = at(place_of_step, own_step);
    if (place == exact.size()) {
      place = map.fragments.size();
      const auto begin = static_cast<std::uint32_t>(map.corners.size());
      const FragmentId in_tree = at(record.order, own_step);
      for (const BspTree::Corner& corner : tree->corners(tree->fragment(in_tree))) {
        map.corners.push_back(map.frame.project(at(tree->points(), corner.point)));
      }
      map.fragments.push_back({fragment.patch, fragment.front, 0, 0, at(exact, own_step), begin,
                               static_cast<std::uint32_t>(map.corners.size())});
    }
    map.fragments[place].area += pass.area_unit() * fragment.area;
    fragments.emplace_back(f, place);
  }
  for (const auto& [f, place] : fragments) {
    map.fragments[place].open += pass.area_unit() * pass.open_below(f);
  }
  return map;
}

double CorrectedMap::wrong_share() const {
  double wrong = 0, all = 0;
  for (const Fragment& place : fragments) {
    if (place.front_facing) {
      continue;
    }
    wrong += std::abs(place.open - place.exact);
    all += std::max(place.open, 0.0) + place.exact;
  }
  return all > 0 ? wrong / all : 0;
}

}  // namespace transillum
