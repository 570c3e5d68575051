// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// What a patch receives along each direction, and the table of it.
#pragma once

#include <span>
#include <vector>

#include "colors/color_scale.h"
#include "model/requests/per_direction_visibility.h"
#include "support/number_text.h"
#include "transillum/at.h"
#include "widgets/flat_table.h"

namespace transillum::viewer {

/// The light that a patch receives along one direction: one term of the outer sum of eq. 11.
struct ReceivedLight {
  int pass = 0;                  ///< from 0
  bool opposite = false;         ///< along -omega of the pass
  double cosine = 0;             ///< between the patch's normal and the direction
  double area = 0;               ///< area of front sides that the patch sees, m² on the plane
  Rgb irradiance;                ///< contribution to H of the patch, W/m²
  PatchId brightest = no_patch;  ///< the source of the largest contribution (luminance), if any

  friend bool operator==(const ReceivedLight&, const ReceivedLight&) = default;
};

/// The request for what a patch sees along the first `count` directions of an iteration.
PerDirectionVisibility::Request visibility_request(const SolverSnapshot& snapshot, int iteration,
                                                   int count, PatchId patch);

/// One entry per direction of `visible_areas`, in their order; in a two-way run omega and then
/// -omega of each pass.
/// @param radiosity B(n), W/m², one per patch
/// @param passes M: a contribution is 4/(A_i M) times the sum of visible area times B, with 2M
///        instead of M in a two-way run
std::vector<ReceivedLight> received_light(
    const PerDirectionVisibility::Request& request,
    std::span<const PerDirectionVisibility::VisibleAreas> visible_areas,
    const std::vector<Rgb>& radiosity, int passes);

/// The directions on the front side of a patch and what it receives along each; sorts by any
/// column.
class ReceivedTable : public FlatTable {
  Q_OBJECT

 public:
  using FlatTable::FlatTable;
  enum Column {
    of_direction,
    of_area,
    of_visible_fraction,
    of_irradiance,
    of_share,
    of_brightest,
    column_count
  };

  /// Shows the entries of `lights` that lie on the front side of the patch (positive cosine).
  /// @param patch_area m²
  void show_lights(const std::vector<ReceivedLight>& lights, double patch_area);
  /// Emphasizes the rows of this pass; -1 emphasizes no row.
  void set_current_pass(int pass);
  const ReceivedLight& light(int row) const { return at(lights_, row); }
  /// Sum over all rows, W/m².
  const Rgb& irradiance() const { return irradiance_; }

  QVariant data(const QModelIndex& index, int role) const override;
  void sort(int column, Qt::SortOrder order) override;

 private:
  int rows() const override { return static_cast<int>(lights_.size()); }
  int columns() const override { return column_count; }
  ColumnHeader header(int column) const override;
  double value(const ReceivedLight& light, int column) const;
  QString text(const ReceivedLight& light, int column) const;
  void set_formats(const std::vector<ReceivedLight>& lights);
  void sort_lights(std::vector<ReceivedLight>& lights) const;

  std::vector<ReceivedLight> lights_;
  double patch_area_ = 1;
  Rgb irradiance_;
  ColumnFormat area_format_, irradiance_format_;
  int current_pass_ = -1;
  int sorted_by_ = of_irradiance;
  Qt::SortOrder sort_order_ = Qt::DescendingOrder;
};

}  // namespace transillum::viewer
