// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

#include "transillum/transfers.h"
#include "visibility/fast/fast_bins.h"
#include "visibility/fast/outline_cut.h"
#include "visibility/fast/projected_fragments.h"

namespace transillum {

/// What one face, or a part of it, sees: its region is cut by the faces it is shown, the nearest
/// first (decisions/0023-outlines.md). All that is kept of what is left is its outline, in
/// doubles relative to the face. Where rounding makes that inconsistent it says so, and an
/// ExactView has to look.
class OutlineView {
 public:
  OutlineView(const ProjectedFragments& faces, PassCounts& counts)
      : faces_(faces), counts_(counts) {}

  /// Looks from all of a face.
  void look_from(std::int32_t face);
  /// Looks from the part of a face that lies in a bin, if any.
  void look_from(std::int32_t face, const FastBins::Bin& bin);

  /// Takes what `face` covers out of what is left, and returns its area, steps squared.
  double subtract(std::int32_t face);
  /// What is left lies in here.
  const FaceWindow& window() const { return window_; }

  /// Whether nothing is left but for rounding.
  bool done() const {
    return left_->count == 0 || left_area_ <= std::min(0x1p-40 * area_, 64 * reach_);
  }
  /// Whether what looks or what was shown is too much for this view; nothing counts then.
  bool failed() const { return failed_; }

 private:
  void outline_whole();
  void outline_in_bin();
  void begin(double area, double reach);
  bool add_edges(double& twice_area);
  void find_window();

  std::array<Outline, 2> outlines_;
  Cutter cutter_;
  OutlineCut cut_;

  const ProjectedFragments& faces_;
  PassCounts& counts_;

  const ProjectedFragments::Face* own_ = nullptr;  ///< what looks
  const FastBins::Bin* bin_ = nullptr;             ///< and where, if not all of it
  bool outlined_ = false;                          ///< only once something is shown
  GridPoint origin_;
  double reach_ = 0;  ///< largest |x| + |y| of what looks
  double area_ = 0, left_area_ = 0;
  bool failed_ = false;
  FaceWindow window_;
  Extent extent_;    ///< of what is left
  Extent far_ends_;  ///< the origin's, to be added
  Outline* left_ = &outlines_[0];
  Outline* rest_ = &outlines_[1];  ///< what subtract() makes of it
};

}  // namespace transillum
