// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "transillum/at.h"
#include "visibility/queries/fragment_bins.h"
#include "visibility/queries/needle_lines.h"
#include "visibility/queries/projected_fragments.h"

namespace transillum {

/// The side to which a query is directed.
enum class Toward {
  source,   ///< along omega: from a front-facing fragment to those above it
  receiver  ///< against omega: from a back-facing fragment to those below it
};

/// Enumerates the candidates of one query, nearest first, by merging the lists of its bins.
class CandidateSearch {
 public:
  /// A position in the list of a bin: a fragment whose box overlaps the window, or a sentinel (-1).
  struct Cursor {
    FragmentBins::Entry entry;
    std::int32_t fragment;
  };

  CandidateSearch(const Scene& scene, const FragmentBins& bins, const ProjectedFragments& projected)
      : bins_(bins), projected_(projected), needle_lines_(scene, projected) {}

  /// To be called when the bins are filled.
  void fill() { needle_lines_.fill(); }

  /// Begins a search from `fragment`: in the bin of `entry` only, or in all its bins. `window`:
  /// here and in next(), the bounds within which candidates are sought.
  template <Toward toward>
  void begin(std::int32_t fragment, bool in_one_bin, FragmentBins::Entry entry,
             const FragmentWindow& window) {
    cursors_.clear();
    if (needle_lines_.exist()) {
      needle_lines_.begin(fragment);
    }
    if (in_one_bin) {
      cursors_.push_back({entry, 0});
    } else {
      for (auto e = bins_.last_entry(fragment); e != FragmentBins::none;
           e = bins_.entry_before(e)) {
        cursors_.push_back({e, 0});
      }
    }
    for (Cursor& cursor : cursors_) {
      advance<toward>(cursor, window);
    }
  }

  /// Where the search is, to be continued there later.
  const std::vector<Cursor>& cursors() const { return cursors_; }
  void resume(std::vector<Cursor> cursors) { cursors_ = std::move(cursors); }

  /// The next candidate, or -1.
  template <Toward toward>
  std::int32_t next(const FragmentWindow& window) {
    std::int32_t fragment = next_in_window<toward>(window);
    while (needle_lines_.exist() && fragment >= 0 && needle_lines_.are_apart(fragment)) {
      fragment = next_in_window<toward>(window);
    }
    return fragment;
  }

 private:
  template <Toward toward>
  std::int32_t next_in_window(const FragmentWindow& window) {
    if (cursors_.size() == 1) {
      const std::int32_t fragment = cursors_[0].fragment;
      if (fragment >= 0) {
        advance<toward>(cursors_[0], window);
      }
      return fragment;
    }
    std::int32_t nearest = -1;
    for (const Cursor& cursor : cursors_) {
      if (cursor.fragment < 0) {
        continue;
      }
      if (nearest < 0 ||
          (toward == Toward::source ? cursor.fragment > nearest : cursor.fragment < nearest)) {
        nearest = cursor.fragment;
      }
    }
    if (nearest < 0) {
      return nearest;
    }
    for (Cursor& cursor : cursors_) {
      if (cursor.fragment == nearest) {
        advance<toward>(cursor, window);
      }
    }
    return nearest;
  }

  template <Toward toward>
  void advance(Cursor& cursor, const FragmentWindow& window) const {
    if constexpr (toward == Toward::source) {
      do {
        --cursor.entry;
      } while (!window.overlaps(bins_.box(cursor.entry)));
      cursor.fragment = bins_.fragment(cursor.entry);
    } else {
      // The lists may hold no boxes of front-facing fragments.
      do {
        cursor.fragment = bins_.fragment(++cursor.entry);
      } while (cursor.fragment >= 0 && !window.overlaps(at(projected_.boxes, cursor.fragment)));
    }
  }

  const FragmentBins& bins_;
  const ProjectedFragments& projected_;
  NeedleLines needle_lines_;
  std::vector<Cursor> cursors_;
};

}  // namespace transillum
