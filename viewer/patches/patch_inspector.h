// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QWidget>
#include <memory>
#include <string>

#include "colors/color_choice.h"
#include "model/snapshot.h"
#include "state/focus.h"
#include "state/selection.h"

class QLabel;

namespace transillum::viewer {

class BalanceView;
class Fold;
class ValueGrid;

/// The geometry, material and current results of the selected patch.
class PatchInspector : public QWidget {
  Q_OBJECT

 public:
  PatchInspector(Focus& focus, Selection& selection, const ColorChoice& colors,
                 QWidget* parent = nullptr);

  void show_snapshot(std::shared_ptr<const SolverSnapshot> snapshot);

 signals:
  /// Passes BalanceView::panel_wanted() on.
  void panel_wanted(const std::string& panel);
  /// Passes BalanceView::table_wanted() on.
  void table_wanted(bool partners);
  /// Passes BalanceView::directions_wanted() on.
  void directions_wanted(const std::vector<PatchId>& sources);

 private:
  /// Adds a row with the symbol, unit and tip of the quantity.
  QLabel* add_quantity(Quantity quantity, const char* name);
  void make_sums();
  void make_coefficients();
  void show_coefficients(PatchId patch);
  void show_patch();
  void show_sums();
  void show_balance();

  Selection& selection_;
  const ColorChoice& colors_;
  std::shared_ptr<const SolverSnapshot> snapshot_;
  QLabel* hint_;
  BalanceView* balance_;
  Fold* why_;  ///< with balance_
  ValueGrid *sums_, *values_;
  ValueGrid* coefficients_;  ///< coefficients of B, where B is linear on patches
  QLabel *mean_b_, *first_b_, *second_b_, *first_direction_, *second_direction_, *lowest_,
      *highest_;
  QLabel *count_, *total_area_, *emitted_, *leaving_, *received_, *mean_;  ///< shown for several
                                                                           ///< patches
  QLabel *id_, *face_, *material_, *group_, *area_, *center_, *normal_, *exitance_, *reflectance_,
      *radiosity_, *error_, *irradiance_, *form_factor_sum_, *sky_fraction_, *swatch_;
};

}  // namespace transillum::viewer
