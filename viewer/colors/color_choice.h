// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QObject>
#include <QString>
#include <memory>
#include <vector>

#include "colors/color_scale.h"
#include "colors/quantity.h"
#include "model/snapshot.h"
#include "state/selection.h"

namespace transillum::viewer {

/// Where the ends of the color map come from.
enum class RangeRule {
  automatic,  ///< from every snapshot anew
  widening,   ///< so that all snapshots fit since it was chosen: pictures can be compared over time
  fixed       ///< the user's
};

/// The quantity that all views color the patches by, its scale, and what of it follows the light
/// by itself.
class ColorChoice : public QObject {
  Q_OBJECT

 public:
  explicit ColorChoice(const Selection& selection, QObject* parent = nullptr);

  const ColorScale& scale() const { return scale_; }
  Quantity quantity() const { return quantity_; }
  const Selection& selection() const { return selection_; }
  /// The user's, which not every quantity can be shown by.
  ColorMode mode() const { return mode_; }
  /// The user's, for what grows from nothing.
  ColorMap map() const { return map_; }
  RangeRule range_rule() const { return range_rule_; }
  bool exposure_is_automatic() const { return automatic_; }

  void set_quantity(Quantity quantity);
  void set_mode(ColorMode mode);
  void set_map(ColorMap map);
  void set_logarithmic(bool logarithmic);
  void set_range_rule(RangeRule rule);
  /// A range that widens from here on.
  void widen_from(double low, double high);
  /// Fixes the range. What cannot be (low >= high, or 0 where logarithmic) is mended.
  void set_range(double low, double high);
  void set_gamma(double gamma);
  /// Ends the automatic exposure.
  void set_exposure(double exposure);
  void set_automatic_exposure(bool automatic);

  /// Keeps the newest snapshot, for later ones to be compared with.
  void keep_run();
  /// The run that is compared with, or null.
  std::shared_ptr<const SolverSnapshot> kept_run() const { return kept_run_; }
  /// Shows the kept run in place of the newest, with the same scale.
  void show_kept_run(bool shown);
  bool shows_kept_run() const { return shows_kept_run_; }

  /// Fits range and exposure to a new snapshot; tells nobody but by fitted(), for the views are
  /// about to show that snapshot anyway.
  void fit(std::shared_ptr<const SolverSnapshot> snapshot);

  /// One color a patch of the newest snapshot; grays where there is nothing to show.
  const std::vector<Color8>& patch_colors() const { return patch_colors_; }
  /// The shown quantity of all patches, or empty.
  const std::vector<Rgb>& values() const { return values_.values; }
  /// What the user can do where there are none.
  const QString& missing() const { return values_.missing; }
  std::shared_ptr<const SolverSnapshot> snapshot() const { return snapshot_; }

 signals:
  void changed();  ///< every picture must be colored anew
  void fitted();
  void form_factors_requested();
  void kept_run_changed();

 private:
  void refit();
  void fit_range();
  void color();
  void reset_range();
  void change();

  const Selection& selection_;
  Quantity quantity_ = Quantity::radiosity;
  ColorMode mode_ = ColorMode::true_color;
  ColorScale scale_;
  ColorMap map_ = ColorMap::viridis;
  RangeRule range_rule_ = RangeRule::automatic;
  bool range_is_known_ = false;  ///< something was fitted since the range was forgotten
  bool automatic_ = true;
  std::shared_ptr<const SolverSnapshot> snapshot_, kept_run_;
  bool shows_kept_run_ = false;
  PatchValues values_;
  std::vector<Color8> patch_colors_;
};

}  // namespace transillum::viewer
