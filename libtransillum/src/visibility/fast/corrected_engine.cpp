// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// The future work of section 8: "avoid the majority of the cuttings of the patches. Instead of
// cutting, the radiosity of the patch can be corrected". A fragment that is partly hidden stays
// whole; of it is only known how much is still open, as if that were spread evenly. What two
// fragments exchange is their overlap, corrected by what is open of them. Where this leaves a
// receiver with less than must lie above it, all that lies there gives more: what is received stays
// right.
#include "transillum/corrected_map.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include "transillum/at.h"
#include "visibility/fast/convex_overlap.h"
#include "visibility/fast/fast_engine.h"
#include "visibility/fast/fragment_bins.h"
#include "visibility/fast/projected_fragments.h"
#include "visibility/transfers/transfer_sums.h"

namespace transillum {
namespace {

/// A fragment of which less is open counts as hidden.
constexpr double hidden = 1e-6;

/// What all passes share.
struct CorrectedScene {
  std::shared_ptr<const Scene> scene;
  std::shared_ptr<const BspTree> tree;
  FragmentOutlines outlines;
  bool backs_hidden;  ///< no lit side queries at a back, whatever the direction

  CorrectedScene(std::shared_ptr<const Scene> of_scene, std::shared_ptr<const BspTree> of_tree)
      : scene(std::move(of_scene)),
        tree(std::move(of_tree)),
        outlines(*tree),
        backs_hidden(fronts_see_no_backs(scene, tree)) {}
};

/// One direction.
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
      sums.project(below.patch, below.front, unit() * below.area);
      look(k);
      for (const Above& above : above_) {
        if (!(above.seen > 0)) {
          continue;
        }
        const ProjectedFragments::Fragment& other = fragment(above.fragment);
        sums.accumulate(below.patch, below.front, other.patch, other.front, unit() * above.seen);
      }
    }
    return sums.finish(omega, cancellation);
  }

  // The same fragment by fragment, for those who want to watch.

  void begin(const Vec3& omega, const Cancellation& cancellation) {
    projected_.project(*shared_.scene, *shared_.tree, shared_.outlines, omega, cancellation);
    bins_.fill(cancellation);
    open_below_.clear();
    met_by_.assign(projected_.fragments.size(), -1);
  }
  std::int32_t fragment_count() const {
    return static_cast<std::int32_t>(projected_.fragments.size());
  }
  const ProjectedFragments::Fragment& fragment(std::int32_t k) const {
    return at(projected_.fragments, k);
  }
  /// m² of a step squared.
  double unit() const { return projected_.grid.unit * projected_.grid.unit; }
  /// Finds what fragment k sees; those before it have looked.
  void look(std::int32_t k) {
    open_below_.push_back(fragment(k).area);
    above_.clear();
    if (shared_.backs_hidden && !fragment(k).front) {
      return;
    }
    find_above(k);
    exchange(fragment(k));
  }
  /// Of a fragment that has looked, what queries down unhindered; steps squared.
  double open_below(std::int32_t k) const { return at(open_below_, k); }

 private:
  /// A fragment above the one that queries.
  struct Above {
    std::int32_t fragment;
    double overlap;  ///< steps squared; < 0: not looked for yet
    double seen;
  };

  /// Those whose boxes overlap that of fragment k, nearest first.
  void find_above(std::int32_t k) {
    FragmentWindow window;
    const FragmentBox& box = at(projected_.boxes, k);
    for (std::size_t d = 0; d < 4; ++d) {
      window.ends[d] = -box.ends[d + 4];
      window.ends[d + 4] = -box.ends[d];
    }
    above_.clear();
    for (auto own = bins_.last_entry(k); own != FragmentBins::none; own = bins_.entry_before(own)) {
      for (FragmentBins::Entry e = own - 1; bins_.fragment(e) >= 0; --e) {
        if (!window.overlaps(bins_.box(e))) {
          continue;
        }
        const std::int32_t other = bins_.fragment(e);
        if (std::exchange(at(met_by_, other), k) == k) {
          continue;
        }
        above_.push_back({other, -1, 0});
      }
    }
    std::sort(above_.begin(), above_.end(),
              [](const Above& a, const Above& b) { return a.fragment > b.fragment; });
  }

  double overlap(Above& above) const {
    if (above.overlap < 0) {
      above.overlap = overlap_.area_with(fragment(above.fragment));
    }
    return above.overlap;
  }

  /// Fills in what is seen of each fragment above.
  void exchange(const ProjectedFragments::Fragment& below) {
    overlap_.set_subject(below);
    open_ = below.area;
    const double least = hidden * below.area;
    for (Above& above : above_) {
      if (open_ <= least) {
        return;
      }
      const double area = fragment(above.fragment).area, left = open_below(above.fragment);
      if (left > hidden * area) {
        take(above, corrected(overlap(above), below.area, open_, area, left));
      }
    }
    // What was not found open but must be covered: from the nearest that has room, ...
    for (Above& above : above_) {
      if (open_ <= least) {
        return;
      }
      const double room = std::max(open_below(above.fragment), 0.0);
      take(above, std::min({open_, room, overlap(above) - above.seen}));
    }
    // ... and then a little more than there is, from all.
    double rest = 0;
    for (Above& above : above_) {
      rest += overlap(above) - above.seen;
    }
    if (!(rest > 0) || open_ <= least) {
      return;
    }
    const double share = std::min(1.0, open_ / rest);
    for (Above& above : above_) {
      take(above, share * (above.overlap - above.seen));
    }
  }

  void take(Above& above, double seen) {
    above.seen += seen;
    at(open_below_, above.fragment) -= seen;
    open_ -= seen;
  }

  /// What of an overlap is open, from what of both fragments is: as much of it as of the fragment
  /// of which it is the larger part, but within what both leave possible.
  static double corrected(double overlap, double area, double open, double other_area,
                          double other_open) {
    const double share = area < other_area ? open / area : other_open / other_area;
    const double least =
        std::max({0.0, overlap - (area - open), overlap - (other_area - other_open)});
    return std::min({std::max(overlap * share, least), overlap, open, other_open});
  }

  const CorrectedScene& shared_;
  ProjectedFragments projected_;
  FragmentBins bins_;
  ConvexOverlap overlap_;
  std::vector<double> open_below_;    ///< a fragment: of its area what queries down unhindered
  std::vector<std::int32_t> met_by_;  ///< a fragment: the last one that found it
  std::vector<Above> above_;
  double open_ = 0;  ///< of the fragment that queries
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

/// Of each step's polygon, what is open in V after step `step`, m².
std::vector<double> open_in_map(const MapRecord& record, std::int32_t step) {
  std::vector<double> open(record.order.size(), 0);
  std::vector<std::int32_t> origin;  // of each row: the step that put it, or what it is of, into V
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

/// The step that takes each outline's fragment.
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
  std::vector<std::size_t> part_of_step(record.order.size(), exact.size());
  std::vector<std::pair<std::int32_t, std::size_t>> parts;  // fragment, and the part that it is of
  for (std::int32_t f = 0; f < pass.fragment_count(); ++f) {
    if (f % 64 == 0) {
      cancellation.throw_if_canceled();
    }
    const ProjectedFragments::Fragment& fragment = pass.fragment(f);
    const std::int32_t own_step = steps[fragment.outline];
    if (own_step > step) {
      break;
    }
    pass.look(f);
    std::size_t& part = at(part_of_step, own_step);
    if (part == exact.size()) {
      part = map.parts.size();
      const auto begin = static_cast<std::uint32_t>(map.corners.size());
      const FragmentId fragment = at(record.order, own_step);
      for (const BspTree::Corner& corner : tree->corners(tree->fragment(fragment))) {
        map.corners.push_back(map.frame.project(at(tree->points(), corner.point)));
      }
      map.parts.push_back({fragment.patch, fragment.front, 0, 0, at(exact, own_step), begin,
                           static_cast<std::uint32_t>(map.corners.size())});
    }
    map.parts[part].area += pass.unit() * fragment.area;
    parts.emplace_back(f, part);
  }
  for (const auto& [f, part] : parts) {
    map.parts[part].open += pass.unit() * pass.open_below(f);
  }
  return map;
}

double CorrectedMap::wrong_share() const {
  double wrong = 0, all = 0;
  for (const Part& part : parts) {
    if (part.front_facing) {
      continue;
    }
    wrong += std::abs(part.open - part.exact);
    all += std::max(part.open, 0.0) + part.exact;
  }
  return all > 0 ? wrong / all : 0;
}

}  // namespace transillum
