// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "model/snapshot.h"
#include "radiosity/form_factors/hemicube_image.h"

namespace transillum::viewer {

/// The image of a hemicube on a patch, and its form factors compared with exact ones. Immutable.
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
  std::vector<double> exact;  ///< F_ij with i = request.eye, one per patch j; empty if not computed

  /// (F_hemicube - F_exact) / max(F_hemicube, F_exact) of patch j, -1 to 1. Requires `exact`.
  double surplus(PatchId j) const;
  /// Sum of |F_hemicube - F_exact| over the sum of both, 0 to 1. Requires `exact`.
  double wrong_share() const;
  /// Number of patches with exact F_ij > 0 that are in no pixel.
  int missed() const;
};

/// The image without exact form factors. Any thread.
/// @throws InputError, Canceled
std::shared_ptr<const HemicubeComparison> render_hemicube(
    const HemicubeComparison::Request& request, const Cancellation& cancellation);
/// `image_only` and exact form factors, which may take seconds. Any thread.
/// @param progress called with the finished fraction, 0 to 1
/// @throws Canceled
std::shared_ptr<const HemicubeComparison> with_exact(const HemicubeComparison& image_only,
                                                     const Cancellation& cancellation,
                                                     const std::function<void(double)>& progress);

}  // namespace transillum::viewer
