// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QAbstractTableModel>
#include <vector>

#include "directions/received_light.h"
#include "support/column_format.h"
#include "transillum/at.h"

namespace transillum::viewer {

/// The directions on the front side of a patch and what it receives along each; sorts by any
/// column.
class ReceivedTable : public QAbstractTableModel {
  Q_OBJECT

 public:
  using QAbstractTableModel::QAbstractTableModel;
  enum Column {
    of_direction,
    of_area,
    of_visible_share,
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

  int rowCount(const QModelIndex& parent = {}) const override;
  int columnCount(const QModelIndex& parent = {}) const override;
  QVariant data(const QModelIndex& index, int role) const override;
  QVariant headerData(int section, Qt::Orientation orientation, int role) const override;
  void sort(int column, Qt::SortOrder order) override;

 private:
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
