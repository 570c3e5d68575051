// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// The choice of quantity, color map, range and exposure that all views share.
#pragma once

#include <QObject>
#include <QString>
#include <memory>
#include <vector>

#include "colors/color_scale.h"
#include "colors/quantity.h"
#include "model/measured_errors.h"
#include "model/requests/slow_quantities.h"
#include "model/snapshot.h"
#include "state/kept_runs.h"
#include "state/selection.h"
#include "support/newest_result.h"

namespace transillum::viewer {

/// How the range of the color map is set.
enum class RangeRule {
  automatic,  ///< fitted to each snapshot
  widening,   ///< only widened, so that pictures can be compared over time
  fixed       ///< set by the user
};

/// The quantity by which all views color the patches, its color scale, and the automatic range and
/// exposure.
///
/// Threads: the main thread only.
class ColorChoice : public QObject {
  Q_OBJECT

 public:
  explicit ColorChoice(const Selection& selection, QObject* parent = nullptr);

  const ColorScale& scale() const { return scale_; }
  Quantity quantity() const { return quantity_; }
  const Selection& selection() const { return selection_; }
  /// The user's choice; scale().mode differs for quantities that it does not apply to.
  ColorMode mode() const { return mode_; }
  /// The user's choice; signed quantities use ColorMap::diverging.
  ColorMap map() const { return map_; }
  RangeRule range_rule() const { return range_rule_; }
  bool exposure_is_automatic() const { return automatic_; }

  void set_quantity(Quantity quantity);
  /// Switches between B and the radiance toward the eye, if one of them is shown: the radiance for
  /// runs in which lobes take part, B for all others.
  void show_lobes(bool take_part);
  void set_mode(ColorMode mode);
  void set_map(ColorMap map);
  /// Sets the choice for all quantities that span decades if the shown one does; else for all
  /// others.
  void set_logarithmic(bool logarithmic);
  void set_range_rule(RangeRule rule);
  /// Sets a range with RangeRule::widening.
  void widen_from(double low, double high);
  /// Sets a fixed range. An invalid one (low >= high, or 0 if logarithmic) is repaired.
  void set_range(double low, double high);
  void set_gamma(double gamma);
  /// Sets the exposure in EV and ends the automatic one.
  void set_exposure(double exposure);
  void set_automatic_exposure(bool automatic);
  /// Shows B of constant functions as SolverSnapshot::fitted, where there is one and in true color.
  void set_fitted(bool fitted);

  /// The runs to compare with.
  KeptRuns& kept_runs() { return kept_runs_; }
  const KeptRuns& kept_runs() const { return kept_runs_; }
  /// Keeps the newest snapshot, which becomes A. @returns false where the kept runs are too large
  bool keep_run();
  /// The two runs whose difference is B - A: a kept run, and a kept run or the newest snapshot;
  /// null where there is none.
  std::shared_ptr<const SolverSnapshot> run_a() const;
  std::shared_ptr<const SolverSnapshot> run_b() const;
  /// Shows A instead of the newest snapshot, with the same scale.
  void show_kept_run(bool shown);
  bool shows_kept_run() const { return shows_kept_run_; }

  /// The newest measured errors, perhaps of an earlier solve; null if none were measured.
  const std::shared_ptr<const MeasuredErrors>& errors() const { return errors_; }
  void set_errors(std::shared_ptr<const MeasuredErrors> errors);

  /// Measures the cost of passes of the newest snapshot's solve, unless that was done.
  /// costs_changed() follows.
  void request_costs();

  /// Sets the point, m, of quantities that depend on the camera.
  void set_eye(const Vec3& eye);
  const Vec3& eye() const { return eye_; }

  /// Fits range and exposure to a new snapshot. Emits fitted(), not changed(): the caller shows the
  /// snapshot in the views afterward.
  void fit(std::shared_ptr<const SolverSnapshot> snapshot);
  /// The same, for the light of the scene while its faces are moved: range and kept runs stay.
  void fit_moved(std::shared_ptr<const SolverSnapshot> snapshot);
  /// While held, range and exposure are not fitted: the pictures of a film can be compared.
  void hold_range(bool held) { range_is_held_ = held; }

  /// One color per patch of the newest snapshot; grays if there are no values, and a neutral light
  /// where nothing emits, and in the first iteration of a solve with lobes.
  const std::vector<Color8>& patch_colors() const { return patch_colors_; }
  /// The shown quantity, one value per patch; or empty.
  const std::vector<Rgb>& values() const { return values_.values; }
  /// Whether the shown quantity is linear on patches; values() are then its means.
  bool linear() const { return !values_.values.empty() && !values_.linear_terms.empty(); }
  /// Whether it is so only to look at: the light of the solve is constant on patches.
  bool is_fitted() const { return values_.fitted; }
  /// The shown quantity at a point of patch i. Requires values().
  Rgb value_at(PatchId i, const Vec3& point) const;
  /// If values() is empty, the reason for the user; empty where nothing emits, which the window
  /// says.
  const QString& missing() const { return values_.missing; }
  /// PatchValues::note
  const QString& note() const { return values_.note; }
  std::shared_ptr<const SolverSnapshot> snapshot() const { return snapshot_; }
  /// Whether values() waits for a solve.
  bool busy() const {
    return response_.busy() || jumps_.busy() || eye_radiance_.busy() ||
           (costs_.busy() && traits_of(quantity_).by_costs);
  }

 signals:
  void changed();  ///< all pictures must be recolored
  void fitted();
  void form_factors_requested();
  void eye_changed();
  /// @param costs  null while they are measured, and where they were not
  /// @param missing  why there are none, for the user; empty before request_costs()
  void costs_changed(std::shared_ptr<const MeasuredCosts> costs, const QString& missing);

 private:
  /// Recolors if the shown quantity is of a kind.
  void change_if(bool QuantityTraits::*kind);
  bool& logarithmic_choice();
  PatchValues values_by_response(const SolverSnapshot& snapshot);
  PatchValues values_by_jumps(const std::shared_ptr<const SolverSnapshot>& snapshot);
  void tell_costs();
  PatchValues values_by_costs(const SolverSnapshot& snapshot);
  PatchValues values_by_measurement(const SolverSnapshot& snapshot) const;
  PatchValues values_by_eye(const std::shared_ptr<const SolverSnapshot>& snapshot);
  PatchValues values_of_shown(const std::shared_ptr<const SolverSnapshot>& snapshot,
                              const SolverSnapshot* other);
  PatchValues values_of_kept(const std::shared_ptr<const SolverSnapshot>& kept);
  void refit();
  void fit_range();
  void color();
  void reset_range();
  void change();

  const Selection& selection_;
  Quantity quantity_ = Quantity::radiosity;
  ColorMode mode_ = ColorMode::true_color;
  ColorScale scale_;
  ColorMap map_ = default_color_map;
  bool logarithmic_ = false;         ///< the user's choice for most quantities
  bool decades_logarithmic_ = true;  ///< the user's choice for quantities that span decades
  RangeRule range_rule_ = RangeRule::automatic;
  bool range_is_known_ = false;  ///< the range was fitted since reset_range()
  bool range_is_held_ = false;
  bool automatic_ = true;
  std::shared_ptr<const SolverSnapshot> snapshot_;
  KeptRuns kept_runs_;
  std::shared_ptr<const MeasuredErrors> errors_;
  bool shows_kept_run_ = false;
  bool fitted_ = false;
  bool lit_ = true;  ///< something emits
  PatchValues values_;
  std::vector<Color8> patch_colors_;
  Vec3 eye_;
  std::shared_ptr<const GlossyLight> light_of_range_;  ///< the light that the range of by_eye
                                                       ///< quantities was fitted to
  KeptResult<LightRequest, PatchResponse> response_;
  // While one is being computed, only the newest of later ones is kept.
  KeptResult<std::shared_ptr<const SolverSnapshot>, PatchJumps> jumps_;
  KeptResult<EyeRequest, RadianceToward> eye_radiance_;
  KeptResult<CostRequest, MeasuredCosts> costs_;
};

}  // namespace transillum::viewer
