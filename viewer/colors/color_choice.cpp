// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Keeps the choice of quantity, scale and range, and computes the colors of the patches from the
// newest snapshot of the solver.
#include "colors/color_choice.h"

#include <algorithm>
#include <numbers>
#include <utility>

#include "colors/neutral_light.h"
#include "model/snapshot_values.h"
#include "support/number_text.h"

namespace transillum::viewer {

namespace {

// Whether a quantity is 0 everywhere if nothing emits.
bool needs_light(Quantity quantity) {
  return quantity == Quantity::radiosity || quantity == Quantity::exitance ||
         quantity == Quantity::irradiance || quantity == Quantity::eye_radiance ||
         quantity == Quantity::error || quantity == Quantity::measured_error ||
         quantity == Quantity::last_change || quantity == Quantity::jump;
}

/// Whether a quantity has no values yet because lobes reflect at the end of an iteration, and no
/// light is known from before, or by a first shot.
bool waits_for_lobes(Quantity quantity, const SolverSnapshot& snapshot) {
  const bool reflected = quantity == Quantity::radiosity || quantity == Quantity::irradiance ||
                         quantity == Quantity::eye_radiance;
  return reflected && snapshot.glossy && snapshot.progress.iteration == 0 && !snapshot.of_draft &&
         !snapshot.of_file &&
         std::all_of(snapshot.irradiance.begin(), snapshot.irradiance.end(),
                     [](const Rgb& h) { return max_abs(h) == 0; });
}

/// Candidates and exact queries of the selected patch, and their reason.
QString cost_text(const PatchCost& cost, int passes) {
  const auto per_pass = [&](std::int64_t count) {
    return number_text(static_cast<double>(count) / passes);
  };
  const auto reason = static_cast<std::size_t>(cost.main_reason());
  return ColorChoice::tr("Selected patch, per pass: %1 candidates, %2 exact queries; %3")
      .arg(per_pass(cost.candidates), per_pass(cost.exact_queries()),
           QString::fromStdString(choices_of<QueryFailure>().sentences[reason]));
}

/// B/pi: the mean of the radiance, weighted by the cosine.
std::vector<Rgb> mean_radiance(const SolverSnapshot& snapshot) {
  std::vector<Rgb> values = snapshot.radiosity;
  for (Rgb& value : values) {
    value = std::numbers::inv_pi * value;
  }
  return values;
}

}  // namespace

ColorChoice::ColorChoice(const Selection& selection, QObject* parent)
    : QObject(parent),
      selection_(selection),
      response_(
          *this, &solve_response, [this] { change_if(&QuantityTraits::by_response); },
          CurrentJob::cancel),
      jumps_(
          *this, &find_jumps, [this] { change_if(&QuantityTraits::by_jumps); }, CurrentJob::finish),
      eye_radiance_(
          *this, &radiance_toward, [this] { change_if(&QuantityTraits::by_eye); },
          CurrentJob::finish),
      costs_(
          *this, &measure_costs,
          [this] {
            tell_costs();
            change_if(&QuantityTraits::by_costs);
          },
          CurrentJob::cancel) {
  connect(&selection_, &Selection::changed, this, [this] {
    change_if(&QuantityTraits::of_selection);
    change_if(&QuantityTraits::by_costs);
  });
  connect(&kept_runs_, &KeptRuns::compared_changed, this, [this] {
    shows_kept_run_ = shows_kept_run_ && run_a();
    change();
  });
}

void ColorChoice::change_if(bool QuantityTraits::*kind) {
  if (traits_of(quantity_).*kind) {
    change();
  }
}

void ColorChoice::set_quantity(Quantity quantity) {
  if (quantity == quantity_) {
    return;
  }
  quantity_ = quantity;
  reset_range();
  change();
  if (traits_of(quantity).of_selection) {
    emit form_factors_requested();
  }
}

void ColorChoice::show_lobes(bool take_part) {
  if (quantity_ == (take_part ? Quantity::radiosity : Quantity::eye_radiance)) {
    set_quantity(take_part ? Quantity::eye_radiance : Quantity::radiosity);
  }
}

void ColorChoice::set_mode(ColorMode mode) {
  if (mode == mode_) {
    return;
  }
  mode_ = mode;
  reset_range();
  change();
}

void ColorChoice::set_map(ColorMap map) {
  if (std::exchange(map_, map) != map) {
    change();
  }
}

bool& ColorChoice::logarithmic_choice() {
  return traits_of(quantity_).spans_decades ? decades_logarithmic_ : logarithmic_;
}

void ColorChoice::set_logarithmic(bool logarithmic) {
  if (logarithmic == logarithmic_choice()) {
    return;
  }
  logarithmic_choice() = logarithmic;
  if (range_rule_ != RangeRule::fixed) {
    reset_range();
  }
  change();
}

void ColorChoice::set_range_rule(RangeRule rule) {
  if (std::exchange(range_rule_, rule) != rule) {
    change();
  }
}

void ColorChoice::widen_from(double low, double high) {
  range_rule_ = RangeRule::widening;
  range_is_known_ = true;
  scale_.low = low;
  scale_.high = high;
  change();
}

void ColorChoice::set_range(double low, double high) {
  range_rule_ = RangeRule::fixed;
  scale_.low = low;
  scale_.high = high;
  change();
}

void ColorChoice::set_gamma(double gamma) {
  if (std::exchange(scale_.gamma, gamma) != gamma) {
    change();
  }
}

void ColorChoice::set_exposure(double exposure) {
  if (!automatic_ && exposure == scale_.exposure) {
    return;
  }
  automatic_ = false;
  scale_.exposure = exposure;
  change();
}

void ColorChoice::set_automatic_exposure(bool automatic) {
  if (std::exchange(automatic_, automatic) != automatic) {
    change();
  }
}

void ColorChoice::set_fitted(bool fitted) {
  if (std::exchange(fitted_, fitted) != fitted && snapshot_ && snapshot_->fitted) {
    change();
  }
}

Rgb ColorChoice::value_at(PatchId i, const Vec3& point) const {
  const Rgb& mean = at(values_.values, i);
  return linear()
             ? viewer::value_at(mean, at(values_.linear_terms, i), at(*values_.bases, i), point)
             : mean;
}

void ColorChoice::set_errors(std::shared_ptr<const MeasuredErrors> errors) {
  errors_ = std::move(errors);
  change_if(&QuantityTraits::by_measurement);
}

void ColorChoice::set_eye(const Vec3& eye) {
  if (eye == eye_) {
    return;
  }
  eye_ = eye;
  emit eye_changed();
  if (traits_of(quantity_).by_eye && snapshot_) {
    const auto kept = run_a();
    const auto& shown = shows_kept_run_ && kept ? kept : snapshot_;
    if (shown->glossy) {
      eye_radiance_.request({shown->glossy, eye_});  // change() follows
    }
  }
}

bool ColorChoice::keep_run() { return !snapshot_ || kept_runs_.keep(*snapshot_); }

std::shared_ptr<const SolverSnapshot> ColorChoice::run_a() const {
  return kept_runs_.run(kept_runs_.first());
}

std::shared_ptr<const SolverSnapshot> ColorChoice::run_b() const {
  const auto kept = kept_runs_.run(kept_runs_.second());
  return kept ? kept : snapshot_;
}

void ColorChoice::show_kept_run(bool shown) {
  shown = shown && run_a();
  if (shown == shows_kept_run_) {
    return;
  }
  shows_kept_run_ = shown;
  change();
}

void ColorChoice::fit(std::shared_ptr<const SolverSnapshot> snapshot) {
  const bool new_scene = !snapshot_ || snapshot_->loaded != snapshot->loaded;
  snapshot_ = std::move(snapshot);
  if (snapshot_->measured_errors) {
    errors_ = snapshot_->measured_errors;
  }
  if (new_scene) {
    kept_runs_.set_scene(snapshot_->loaded->scene);
    shows_kept_run_ = shows_kept_run_ && run_a();
  }
  if (new_scene && range_rule_ != RangeRule::fixed) {
    reset_range();
  }
  if (costs_.clear_unless(cost_request(*snapshot_))) {
    tell_costs();
  }
  refit();
  emit fitted();
}

void ColorChoice::fit_moved(std::shared_ptr<const SolverSnapshot> snapshot) {
  snapshot_ = std::move(snapshot);
  refit();
  emit fitted();
}

void ColorChoice::change() {
  refit();
  emit changed();
}

void ColorChoice::reset_range() {
  range_is_known_ = false;
  // A range entered for another quantity does not apply.
  if (range_rule_ == RangeRule::fixed) {
    range_rule_ = RangeRule::automatic;
  }
}

void ColorChoice::refit() {
  const QuantityTraits& traits = traits_of(quantity_);
  scale_.mode = !traits.has_channels                                 ? ColorMode::red
                : !traits.is_light && mode_ == ColorMode::true_color ? ColorMode::luminance
                                                                     : mode_;
  scale_.map = traits.is_signed ? ColorMap::diverging : map_;
  scale_.logarithmic = logarithmic_choice() && !traits.is_signed;
  scale_.marks_zero = scale_.logarithmic || traits.spans_decades;
  if (!traits.by_jumps) {
    jumps_.clear();
  }
  if (!snapshot_) {
    return;
  }
  const auto kept = run_a();
  const bool show_kept = shows_kept_run_ && kept && quantity_ != Quantity::difference;
  lit_ = has_light(*snapshot_);
  const bool waits = lit_ && !show_kept && waits_for_lobes(quantity_, *snapshot_);
  lit_ = lit_ && !waits;
  if (!lit_ && needs_light(quantity_)) {
    values_ = {};
    if (waits) {
      values_.missing =
          tr("Neutral light: lobes reflect only after the last direction of an iteration.");
    }
    color();
    return;
  }
  if (show_kept) {
    values_ = values_of_kept(kept);
  } else {
    const auto& shown = quantity_ == Quantity::difference ? run_b() : snapshot_;
    values_ = values_of_shown(shown, kept.get());
    if (fitted_ && quantity_ == Quantity::radiosity && mode_ == ColorMode::true_color &&
        values_.linear_terms.empty() && shown->fitted) {
      values_.linear_terms = shown->fitted->terms;
      values_.bases = shown->fitted->bases;
      values_.fitted = true;
    }
    fit_range();
  }
  color();
}

PatchValues ColorChoice::values_of_shown(const std::shared_ptr<const SolverSnapshot>& snapshot,
                                         const SolverSnapshot* other) {
  const QuantityTraits& traits = traits_of(quantity_);
  return traits.by_response      ? values_by_response(*snapshot)
         : traits.by_jumps       ? values_by_jumps(snapshot)
         : traits.by_costs       ? values_by_costs(*snapshot)
         : traits.by_measurement ? values_by_measurement(*snapshot)
         : traits.by_eye && snapshot->glossy
             ? values_by_eye(snapshot)
             : values_of(quantity_, *snapshot, selection_.patch(), other);
}

/// The radiance toward the eye. While it is being computed, the last radiance of an older light of
/// the scene is shown.
PatchValues ColorChoice::values_by_eye(const std::shared_ptr<const SolverSnapshot>& snapshot) {
  eye_radiance_.request({snapshot->glossy, eye_});
  const auto found = eye_radiance_.result();
  PatchValues result;
  if (found && &found->light->scene() == snapshot->loaded->scene.get()) {
    result.values = found->values;
    return result;
  }
  result = values_of(quantity_, *snapshot, no_patch, nullptr);
  if (!eye_radiance_.error().isEmpty()) {
    result.missing = eye_radiance_.error();
  }
  return result;
}

PatchValues ColorChoice::values_by_jumps(const std::shared_ptr<const SolverSnapshot>& snapshot) {
  jumps_.request(snapshot);
  const auto jumps = jumps_.result();
  if (!jumps || jumps->scene != snapshot->loaded->scene) {
    PatchValues result = values_of(quantity_, *snapshot, no_patch, nullptr);
    if (!jumps_.error().isEmpty()) {
      result.missing = jumps_.error();
    }
    return result;
  }
  PatchValues result;
  for (const double jump : jumps->values) {
    result.values.push_back({jump, jump, jump});
  }
  return result;
}

void ColorChoice::tell_costs() {
  const bool busy = costs_.busy();
  emit costs_changed(busy ? nullptr : costs_.result(), busy ? tr("measuring…") : costs_.error());
}

void ColorChoice::request_costs() {
  if (!snapshot_) {
    return;
  }
  const bool was_busy = costs_.busy();
  costs_.request(cost_request(*snapshot_));
  if (costs_.busy() != was_busy) {
    tell_costs();
  }
}

PatchValues ColorChoice::values_by_costs(const SolverSnapshot& snapshot) {
  request_costs();
  const auto measured = costs_.result();
  PatchValues result;
  if (!measured || costs_.busy() || measured->loaded != snapshot.loaded) {
    result = values_of(quantity_, snapshot, no_patch, nullptr);
    if (!costs_.error().isEmpty()) {
      result.missing = costs_.error();
    }
    return result;
  }
  const PatchCosts& costs = measured->costs;
  for (const PatchCost& cost : costs.patches) {
    const double sum = quantity_ == Quantity::query_time
                           ? 1e6 * cost.seconds
                           : static_cast<double>(cost.exact_queries());
    const double value = sum / costs.passes;
    result.values.push_back({value, value, value});
  }
  if (has_index(costs.patches, selection_.patch())) {
    result.note = cost_text(at(costs.patches, selection_.patch()), costs.passes);
  }
  return result;
}

PatchValues ColorChoice::values_by_measurement(const SolverSnapshot& snapshot) const {
  PatchValues result;
  if (!errors_ || !errors_->are_of(snapshot)) {
    return values_of(quantity_, snapshot, no_patch, nullptr);
  }
  for (const double error : errors_->report.relative_errors) {
    const double percent = 100 * error;
    result.values.push_back({percent, percent, percent});
  }
  return result;
}

PatchValues ColorChoice::values_of_kept(const std::shared_ptr<const SolverSnapshot>& kept) {
  if (traits_of(quantity_).of_selection) {
    return {{}, tr("Kept runs have no form factors.")};
  }
  if (traits_of(quantity_).by_jumps) {
    return values_by_jumps(kept);
  }
  if (traits_of(quantity_).by_eye && kept->glossy) {
    return values_by_eye(kept);
  }
  if (traits_of(quantity_).by_costs) {
    return {{}, tr("Kept runs have no cost of passes.")};
  }
  // The number of fragments comes from the tree of the open scene.
  const SolverSnapshot& shown = quantity_ == Quantity::fragments ? *snapshot_ : *kept;
  return values_of(quantity_, shown, selection_.patch(), nullptr);
}

PatchValues ColorChoice::values_by_response(const SolverSnapshot& snapshot) {
  const PatchId patch = selection_.patch();
  if (const auto request = light_request(snapshot, patch)) {
    response_.request(*request);
  }
  PatchValues result = values_of(quantity_, snapshot, patch, nullptr, response_.result().get());
  if (!response_.error().isEmpty()) {
    result.missing = response_.error();
  }
  return result;
}

void ColorChoice::fit_range() {
  if (values_.values.empty()) {
    return;
  }
  const QuantityTraits& traits = traits_of(quantity_);
  const Scene& scene = *snapshot_->loaded->scene;
  if (scale_.mode == ColorMode::true_color) {
    if (!automatic_ || range_is_held_) {
      return;
    }
    // Reflectances are between 0 and 1: white is 1.
    if (quantity_ == Quantity::reflectance) {
      scale_.exposure = 0;
    } else if (traits.by_eye) {
      // Fits the range to the mean over all directions, which stays the same while the camera
      // moves.
      scale_.fit_exposure(scene, mean_radiance(*snapshot_));
    } else {
      scale_.fit_exposure(scene, values_.values);
    }
    return;
  }
  const double low = scale_.low, high = scale_.high;
  // While only the camera moves, the range is not fitted again, so that colors stay comparable.
  const auto light = traits.by_eye ? eye_radiance_.result() : nullptr;
  const bool same_light = light && light->light == light_of_range_ && range_is_known_;
  light_of_range_ = light ? light->light : nullptr;
  if (range_rule_ != RangeRule::fixed && !range_is_held_) {
    if (quantity_ == Quantity::radiosity) {
      scale_.fit_range(scene, values_.values);
    } else {
      scale_.fit_range(values_.values, traits.is_signed);
    }
    if ((range_rule_ == RangeRule::widening || same_light) && range_is_known_) {
      scale_.low = std::min(low, scale_.low);
      scale_.high = std::max(high, scale_.high);
    }
    range_is_known_ = true;
  }
  scale_.repair_range();
  scale_.find_out_of_range(values_.values);
  if (!linear()) {
    return;
  }
  // The range follows the means of the patches: one corner that overshoots does not set it.
  std::vector<Rgb> corners;
  for (const double sign : {1.0, -1.0}) {
    const auto size = [this, sign](const Rgb& rgb) { return sign * scale_.value(rgb); };
    const std::vector<Rgb> ends = largest_corners(values_, scene, size);
    corners.insert(corners.end(), ends.begin(), ends.end());
  }
  scale_.find_out_of_range(corners);
}

void ColorChoice::color() {
  if (values_.values.empty() && !lit_) {
    shade_neutral(*snapshot_, patch_colors_);
  } else if (values_.values.empty()) {
    shade_gray(*snapshot_, patch_colors_);
  } else {
    scale_.color(values_.values, patch_colors_);
  }
}

}  // namespace transillum::viewer
