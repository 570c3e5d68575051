// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "color_choice.h"

#include <utility>

namespace transillum::viewer {

void ColorChoice::set_mode(ColorMode mode) {
  if (mode == scale_.mode) return;
  scale_.mode = mode;
  refit();
  emit changed();
}

void ColorChoice::set_map(ColorMap map) {
  if (map == scale_.map) return;
  scale_.map = map;
  emit changed();
}

void ColorChoice::set_logarithmic(bool logarithmic) {
  if (logarithmic == scale_.logarithmic) return;
  scale_.logarithmic = logarithmic;
  refit();
  emit changed();
}

void ColorChoice::set_gamma(double gamma) {
  if (gamma == scale_.gamma) return;
  scale_.gamma = gamma;
  emit changed();
}

void ColorChoice::set_exposure(double exposure) {
  if (!automatic_ && exposure == scale_.exposure) return;
  automatic_ = false;
  scale_.exposure = exposure;
  emit changed();
}

void ColorChoice::set_automatic_exposure(bool automatic) {
  if (automatic == automatic_) return;
  automatic_ = automatic;
  refit();
  emit changed();
}

void ColorChoice::fit(std::shared_ptr<const SolverSnapshot> snapshot) {
  snapshot_ = std::move(snapshot);
  refit();
  emit fitted();
}

void ColorChoice::refit() {
  if (!snapshot_) return;
  if (scale_.mode != ColorMode::true_color)
    scale_.fit_range(*snapshot_->loaded->scene, snapshot_->radiosity);
  else if (automatic_)
    scale_.fit_exposure(*snapshot_->loaded->scene, snapshot_->radiosity);
}

}  // namespace transillum::viewer
