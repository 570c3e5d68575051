// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "model/snapshot.h"
#include "transillum/hemicube_image.h"

namespace transillum::viewer {

/// What a hemicube on a patch sees, and how right it is. Immutable.
struct HemicubeComparison {
  struct Request {
    std::shared_ptr<const LoadedScene> loaded;
    PatchId eye = no_patch;
    int resolution = 64;      ///< even
    bool differences = true;  ///< compare with exact_form_factors()

    friend bool operator==(const Request&, const Request&) = default;
  };
  Request request;
  HemicubeImage image;
  std::vector<double> exact;  ///< F_ij of the eye's patch, a patch; empty: not known

  /// How much more of patch j is seen than there is, over the larger of both, -1 to 1.
  double surplus(PatchId j) const;
  /// Of all that is seen, the share that is another patch in truth.
  double wrong_share() const;
  /// Patches that no pixel shows though F_ij > 0.
  int missed() const;
};

/// The image alone, in a blink where there are few patches. Any thread.
/// @throws InputError, Canceled
std::shared_ptr<const HemicubeComparison> see_by_hemicube(
    const HemicubeComparison::Request& request, const Cancellation& cancellation);
/// The same with exact form factors beside, which may take seconds.
/// @throws Canceled
std::shared_ptr<const HemicubeComparison> with_exact(const HemicubeComparison& sight,
                                                     const Cancellation& cancellation,
                                                     const std::function<void(double)>& progress);

}  // namespace transillum::viewer
