// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// The fast engine. Each front-facing face looks toward the light: the faces above it, nearest
// first, eat up its polygon, and once nothing is left no further one is looked at. What was eaten
// is what it sees. The faces above come from bins over the plane.
//
// Light goes both ways along a line, so what front-facing faces see of back-facing ones is also
// what these see of them. Only back-facing faces that are left with something open look
// for themselves: in a scene of closed surfaces, none.
#include <algorithm>
#include <chrono>
#include <memory>
#include <mutex>
#include <optional>
#include <utility>

#include "base/invariant.h"
#include "scene/build/closed_surface.h"
#include "transillum/at.h"
#include "visibility/fast/exact_view.h"
#include "visibility/fast/fast_bins.h"
#include "visibility/fast/fast_engine.h"
#include "visibility/fast/outline_view.h"
#include "visibility/fast/projected_fragments.h"

namespace transillum {
namespace {

using Clock = std::chrono::steady_clock;

/// Faces in more bins than this look bin by bin.
constexpr std::int32_t most_bins = 8;

/// What all passes share.
struct FastScene {
  std::shared_ptr<const Scene> scene;
  std::shared_ptr<const BspTree> tree;
  FastOutlines outlines;
  bool in_air = false;              ///< no lit side looks at a back, whatever the direction
  std::optional<PatchShaft> shaft;  ///< all that is looked at, if not everything

  FastScene(std::shared_ptr<const Scene> of_scene, std::shared_ptr<const BspTree> of_tree)
      : scene(std::move(of_scene)), tree(std::move(of_tree)), outlines(*tree) {}
};

/// Makes one pass after the other; what a pass needs is kept for the next one.
class FastPass {
 public:
  explicit FastPass(const FastScene& shared)
      : shared_(shared),
        bins_(faces_, shared.in_air),
        exact_view_(shared.outlines, faces_, transfers_.counts),
        outline_view_(faces_, transfers_.counts) {}

  Transfers run(const Vec3& omega, const Cancellation& cancellation) {
    const Clock::time_point start = Clock::now();
    faces_.project(*shared_.scene, *shared_.tree, shared_.outlines, omega, cancellation,
                   shared_.shaft ? &*shared_.shaft : nullptr);
    const Clock::time_point ordered = Clock::now();
    bins_.fill(cancellation);
    const Clock::time_point binned = Clock::now();
    begin(omega);
    look_all<Way::up>(cancellation);
    if (!shared_.in_air) {
      look_all<Way::down>(cancellation);
    }
    // Outside the shaft things are missing that would hide others.
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
  bool nothing_is_covered_twice() const {
    // Corners lie a step or so off their lines: a thousand steps by the 2^60 of the scene.
    const double rounding = 0x1p10 * 0x1p60 * area_unit_;
    const auto holds = [rounding](const Coverage& side) {
      return side.covered <= side.projected * (1 + 1e-9) + rounding;
    };
    return std::all_of(transfers_.forward.begin(), transfers_.forward.end(), holds) &&
           std::all_of(transfers_.backward.begin(), transfers_.backward.end(), holds);
  }

  void begin(const Vec3& omega) {
    const auto patches = static_cast<std::size_t>(shared_.scene->patch_count());
    transfers_ = {};
    transfers_.direction = omega;
    transfers_.forward.resize(patches);
    transfers_.backward.resize(patches);
    transfers_.back_seen.resize(patches);
    found_.clear();
    seen_from_front_.assign(faces_.faces.size(), 0);
    area_unit_ = faces_.grid.step * faces_.grid.step;
    for (const ProjectedFragments::Face& face : faces_.faces) {
      auto& side = face.front ? transfers_.forward : transfers_.backward;
      at(side, face.patch).projected += area_unit_ * face.area;
    }
  }

  enum class Way { up, down };
  struct VisibleArea {
    std::int32_t face;
    double area;
  };
  /// A place in the list of a bin: what is there overlaps by its box, or is the list's end.
  struct Cursor {
    FastBins::Entry entry;
    std::int32_t face;
  };

  /// Bin by bin, so that what is looked at next is near.
  template <Way way>
  void look_all(const Cancellation& cancellation) {
    std::int32_t looks = 0;
    for (const FastBins::Bin& bin : bins_.bins()) {
      fetch(bin);
      for (FastBins::Entry e = bin.begin; e < bin.end; ++e) {
        const std::int32_t face = bins_.face(e);
        if (!has_to_look(way, face)) {
          continue;
        }
        if (++looks % 256 == 0) {
          cancellation.throw_if_canceled();
        }
        if (bins_.entry_count(face) > most_bins) {
          look<way>(face, &bin, e);
        } else if (bins_.entry_before(e) == FastBins::none) {
          look<way>(face, nullptr, e);
        }
      }
    }
  }

  /// What follows uses the faces of a bin in an order that the processor cannot foresee.
  void fetch(const FastBins::Bin& bin) const {
    for (FastBins::Entry e = bin.begin; e < bin.end; ++e) {
      const ProjectedFragments::Face& face = at(faces_.faces, bins_.face(e));
      __builtin_prefetch(faces_.corners.data() + face.begin);
      __builtin_prefetch(faces_.corners.data() + face.end - 1);
    }
  }

  bool has_to_look(Way way, std::int32_t k) const {
    const ProjectedFragments::Face& face = at(faces_.faces, k);
    if (way == Way::up) {
      return face.front;
    }
    return !face.front && face.area - at(seen_from_front_, k) > 0x1p-38 * face.area;
  }

  template <Way way>
  void look(std::int32_t face, const FastBins::Bin* bin, FastBins::Entry entry) {
    if (!look_with<way>(outline_view_, face, bin, entry)) {
      ++transfers_.counts.exact_queries;
      look_with<way>(exact_view_, face, bin, entry);
    }
    for (const VisibleArea& visible : visible_areas_) {
      accumulate<way>(face, visible);
    }
  }

  /// Fills visible_areas_. Returns false where what is seen is too much for the view.
  template <Way way, class View>
  bool look_with(View& view, std::int32_t face, const FastBins::Bin* bin, FastBins::Entry entry) {
    visible_areas_.clear();
    if (bin) {
      view.look_from(face, *bin);
    } else {
      view.look_from(face);
    }
    begin_search<way>(face, bin != nullptr, entry, view.window());
    for (std::int32_t other = next<way>(view.window()); other >= 0;
         other = next<way>(view.window())) {
      const double area = view.subtract(other);
      if (view.failed()) {
        return false;
      }
      if (area > 0) {
        visible_areas_.push_back({other, area});
      }
      if (view.done()) {
        break;
      }
    }
    return true;
  }

  template <Way way>
  void begin_search(std::int32_t face, bool in_one_bin, FastBins::Entry entry,
                    const FaceWindow& window) {
    cursors_.clear();
    if (in_one_bin) {
      cursors_.push_back({entry, 0});
    } else {
      for (auto e = bins_.last_entry(face); e != FastBins::none; e = bins_.entry_before(e)) {
        cursors_.push_back({e, 0});
      }
    }
    for (Cursor& cursor : cursors_) {
      move<way>(cursor, window);
    }
  }

  template <Way way>
  void move(Cursor& cursor, const FaceWindow& window) const {
    do {
      cursor.entry += way == Way::up ? -1 : 1;
    } while (!window.overlaps(bins_.box(cursor.entry)));
    cursor.face = bins_.face(cursor.entry);
  }

  /// The next face that may be seen, or -1.
  template <Way way>
  std::int32_t next(const FaceWindow& window) {
    if (cursors_.size() == 1) {
      const std::int32_t face = cursors_[0].face;
      if (face >= 0) {
        move<way>(cursors_[0], window);
      }
      return face;
    }
    std::int32_t nearest = -1;
    for (const Cursor& cursor : cursors_) {
      if (cursor.face < 0) {
        continue;
      }
      if (nearest < 0 || (way == Way::up ? cursor.face > nearest : cursor.face < nearest)) {
        nearest = cursor.face;
      }
    }
    if (nearest < 0) {
      return nearest;
    }
    for (Cursor& cursor : cursors_) {
      if (cursor.face == nearest) {
        move<way>(cursor, window);
      }
    }
    return nearest;
  }

  template <Way way>
  void accumulate(std::int32_t looking, const VisibleArea& visible) {
    const ProjectedFragments::Face& own = at(faces_.faces, looking);
    const ProjectedFragments::Face& other = at(faces_.faces, visible.face);
    const double area = area_unit_ * visible.area;
    const auto i = static_cast<std::size_t>(own.patch), j = static_cast<std::size_t>(other.patch);
    if (way == Way::up) {
      transfers_.forward[i].covered += area;
      if (other.front) {
        transfers_.back_seen[j] += area;
      } else {
        transfers_.backward[j].covered += area;
        at(seen_from_front_, visible.face) += visible.area;
        found_.push_back({own.patch, other.patch, area});
      }
    } else if (!other.front) {
      transfers_.backward[i].covered += area;
      transfers_.back_seen[j] += area;
    }
  }

  /// By receiver, then source, one entry a pair; parts summed in the order they were found.
  void sort_exchanges(const Cancellation& cancellation) {
    const std::size_t patches = transfers_.forward.size();
    row_ends_.assign(patches + 1, 0);
    for (const Transfer& t : found_) {
      ++row_ends_[static_cast<std::size_t>(t.receiver) + 1];
    }
    for (std::size_t i = 0; i < patches; ++i) {
      row_ends_[i + 1] += row_ends_[i];
    }
    sorted_.resize(found_.size());
    for (const Transfer& t : found_) {
      sorted_[at(row_ends_, t.receiver)++] = t;
    }
    std::vector<Transfer>& exchanges = transfers_.exchanges;
    exchanges.reserve(found_.size());
    std::size_t begin = 0;
    for (std::size_t i = 0; i < patches; ++i) {
      if (i % 4096 == 0) {
        cancellation.throw_if_canceled();
      }
      sort_by_source(sorted_.data() + begin, sorted_.data() + row_ends_[i]);
      const std::size_t row = exchanges.size();
      for (; begin < row_ends_[i]; ++begin) {
        const Transfer& t = sorted_[begin];
        if (exchanges.size() > row && exchanges.back().source == t.source) {
          exchanges.back().area += t.area;
        } else {
          exchanges.push_back(t);
        }
      }
    }
  }

  /// Equal ones stay in their order.
  static void sort_by_source(Transfer* first, Transfer* last) {
    constexpr std::ptrdiff_t few = 24;
    if (last - first > few) {
      std::stable_sort(first, last,
                       [](const Transfer& a, const Transfer& b) { return a.source < b.source; });
      return;
    }
    for (Transfer* next = first; next < last; ++next) {
      const Transfer moved = *next;
      Transfer* to = next;
      for (; to > first && to[-1].source > moved.source; --to) {
        *to = to[-1];
      }
      *to = moved;
    }
  }

  const FastScene& shared_;
  double area_unit_ = 1;                  ///< m² a step squared
  std::vector<double> seen_from_front_;   ///< a face: steps squared
  std::vector<Transfer> found_, sorted_;  ///< exchanges, visible by visible
  std::vector<std::uint32_t> row_ends_;
  std::vector<VisibleArea> visible_areas_;
  std::vector<Cursor> cursors_;
  Transfers transfers_;
  ProjectedFragments faces_;
  FastBins bins_;
  ExactView exact_view_;
  OutlineView outline_view_;
};

/// Passes that no thread is making; one is kept for each that has made one at the same time.
class IdlePasses {
 public:
  /// None where all are under way.
  std::unique_ptr<FastPass> take() {
    const std::lock_guard lock(mutex_);
    if (passes_.empty()) {
      return nullptr;
    }
    std::unique_ptr<FastPass> pass = std::move(passes_.back());
    passes_.pop_back();
    return pass;
  }
  void give_back(std::unique_ptr<FastPass> pass) {
    const std::lock_guard lock(mutex_);
    passes_.push_back(std::move(pass));
  }

 private:
  std::mutex mutex_;
  std::vector<std::unique_ptr<FastPass>> passes_;
};

/// Whether a pass tells that lit sides look at lit sides only. Where surfaces are closed, what
/// holds along all lines of one direction holds everywhere: the surfaces around a point, counted
/// by their lit sides and backs, are the same number on whatever line one comes to it
/// (decisions/0015-closed-surfaces.md).
bool is_in_air(const FastScene& shared) {
  // As good as any that no scene is aligned with.
  const Vec3 omega = normalized(Vec3{0.5772156649, 0.3141592653, 0.7390851332});
  if (!is_closed_surface(*shared.scene)) {
    return false;
  }
  const Cancellation never;
  const Transfers transfers = FastPass(shared).run(omega, never);
  for (PatchId i = 0; i < shared.scene->patch_count(); ++i) {
    // Rounding lets slivers of backs be seen beside the edges of what hides them.
    const double most = 1e-13 * shared.scene->patch(i).area;
    if (at(transfers.back_seen, i) > most) {
      return false;
    }
  }
  return true;
}

}  // namespace

bool fronts_see_no_backs(std::shared_ptr<const Scene> scene, std::shared_ptr<const BspTree> tree) {
  return is_in_air(FastScene(std::move(scene), std::move(tree)));
}

namespace {

TransferEngine engine_of(std::shared_ptr<const FastScene> shared) {
  auto idle = std::make_shared<IdlePasses>();
  return [shared = std::move(shared), idle = std::move(idle)](const Vec3& omega,
                                                              const Cancellation& cancellation) {
    std::unique_ptr<FastPass> pass = idle->take();
    if (!pass) {
      pass = std::make_unique<FastPass>(*shared);
    }
    Transfers transfers = pass->run(omega, cancellation);
    idle->give_back(std::move(pass));
    return transfers;
  };
}

}  // namespace

TransferEngine fast_engine(std::shared_ptr<const Scene> scene,
                           std::shared_ptr<const BspTree> tree) {
  auto shared = std::make_shared<FastScene>(std::move(scene), std::move(tree));
  shared->in_air = is_in_air(*shared);
  return engine_of(std::move(shared));
}

TransferEngine fast_patch_engine(std::shared_ptr<const Scene> scene,
                                 std::shared_ptr<const BspTree> tree, PatchId patch) {
  auto shared = std::make_shared<FastScene>(std::move(scene), std::move(tree));
  shared->in_air = is_in_air(*shared);  // of the whole scene; so of what the shaft holds
  shared->shaft.emplace(*shared->scene, *shared->tree, patch);
  return engine_of(std::move(shared));
}

}  // namespace transillum
