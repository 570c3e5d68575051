// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "model/requests/hemicube_comparison.h"

#include <algorithm>
#include <cmath>

#include "transillum/at.h"
#include "transillum/pair_form_factors.h"

namespace transillum::viewer {

double HemicubeComparison::surplus(PatchId j) const {
  const double by_hemicube = at(image.form_factors, j), exactly = at(exact, j);
  const double larger = std::max(by_hemicube, exactly);
  return larger > 0 ? (by_hemicube - exactly) / larger : 0;
}

double HemicubeComparison::wrong_share() const {
  double wrong = 0, all = 0;
  for (std::size_t k = 0; k < exact.size(); ++k) {
    wrong += std::abs(image.form_factors[k] - exact[k]);
    all += image.form_factors[k] + exact[k];
  }
  return all > 0 ? wrong / all : 0;
}

int HemicubeComparison::missed() const {
  int count = 0;
  for (std::size_t k = 0; k < exact.size(); ++k) {
    if (exact[k] > 0 && image.form_factors[k] == 0) {
      ++count;
    }
  }
  return count;
}

std::shared_ptr<const HemicubeComparison> render_hemicube(
    const HemicubeComparison::Request& request, const Cancellation& cancellation) {
  HemicubeOptions options;
  options.resolution = request.resolution;
  return std::make_shared<const HemicubeComparison>(
      HemicubeComparison{request,
                         hemicube_image(request.loaded->scene, request.loaded->tree, request.eye,
                                        options, cancellation),
                         {}});
}

std::shared_ptr<const HemicubeComparison> with_exact(const HemicubeComparison& image_only,
                                                     const Cancellation& cancellation,
                                                     const std::function<void(double)>& progress) {
  auto result = std::make_shared<HemicubeComparison>(image_only);
  result->exact = exact_form_factors(*image_only.request.loaded->scene, image_only.request.eye,
                                     cancellation, progress);
  return result;
}

}  // namespace transillum::viewer
