// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QAbstractTableModel>
#include <QStringList>
#include <iosfwd>
#include <string>
#include <vector>

#include "transillum/scene.h"

namespace transillum::viewer {

/// What a table tells of each of its patches.
struct PatchColumn {
  enum class Kind {
    integer,
    number,
    channels,  ///< sorted and shown by luminance
    word       ///< the number of one of `words`
  };
  QString title;
  QString tip;
  std::string csv_name;  ///< channels add _r, _g, _b
  Kind kind = Kind::number;
  std::vector<Rgb> values;  ///< one a row, in red alone but for channels
  QStringList words = {};
};

/// Patches as a table, sorted and searched without moving its values: quick for many thousands.
class PatchTable : public QAbstractTableModel {
  Q_OBJECT

 public:
  using QAbstractTableModel::QAbstractTableModel;

  /// `patches` have a row of `columns` each. Order and search stay.
  void set_contents(std::vector<PatchId> patches, std::vector<PatchColumn> columns);
  /// Shows what has this in a word, or whose patch number begins with it; empty shows all.
  void set_search(const QString& text);

  /// The patch of a shown row.
  PatchId patch(int row) const;
  /// Where a patch is shown, or -1.
  int row_of(PatchId patch) const;
  /// Patches, shown or not.
  int size() const { return static_cast<int>(patches_.size()); }
  /// A header line and the shown rows in their order; numbers read back bit for bit.
  void write_csv(std::ostream& out) const;

  int rowCount(const QModelIndex& parent = {}) const override;
  int columnCount(const QModelIndex& parent = {}) const override;
  QVariant data(const QModelIndex& index, int role) const override;
  QVariant headerData(int section, Qt::Orientation orientation, int role) const override;
  void sort(int column, Qt::SortOrder order) override;

 private:
  bool matches(int entry) const;
  void arrange();

  std::vector<PatchId> patches_;
  std::vector<PatchColumn> columns_;
  QString search_;
  int sorted_by_ = -1;
  Qt::SortOrder order_ = Qt::AscendingOrder;
  std::vector<int> shown_;  ///< a row: its place in patches_
};

}  // namespace transillum::viewer
