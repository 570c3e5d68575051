// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QStringList>
#include <iosfwd>
#include <string>
#include <vector>

#include "support/number_text.h"
#include "transillum/scene.h"
#include "widgets/flat_table.h"

class QLabel;
class QTabWidget;
class QTableView;

namespace transillum::viewer {

/// A column of a patch table: one value per patch.
struct PatchColumn {
  enum class Kind {
    integer,
    number,
    percent,   ///< with two decimals in all columns
    channels,  ///< sorted and shown by luminance
    text       ///< index into `texts`
  };
  QString title;
  QString tip;
  std::string csv_name;  ///< channels add _r, _g, _b
  Kind kind = Kind::number;
  std::vector<Rgb> values;  ///< one per patch; only red is used, except for channels
  QStringList texts = {};
  ColumnFormat format = {};  ///< format of numbers and channels; set by PatchTable
};

/// A table of patches. Sorting and searching permute row indices only, so that tens of thousands of
/// rows stay fast.
class PatchTable : public FlatTable {
  Q_OBJECT

 public:
  using FlatTable::FlatTable;

  /// Replaces the contents; order and search stay.
  /// @param columns each with one value per entry of `patches`
  void set_contents(std::vector<PatchId> patches, std::vector<PatchColumn> columns);
  /// Shows only patches with `text` in a text column, or whose number begins with it; all patches
  /// if `text` is empty.
  void set_search(const QString& text);

  /// The patch in a shown row.
  PatchId patch(int row) const;
  /// The row that shows a patch, or -1.
  int row_of(PatchId patch) const;
  /// Number of patches, shown or not.
  int size() const { return static_cast<int>(patches_.size()); }
  /// Writes a header line and the shown rows in their order; numbers read back bit for bit.
  void write_csv(std::ostream& out) const;

  QVariant data(const QModelIndex& index, int role) const override;
  void sort(int column, Qt::SortOrder order) override;

 private:
  int rows() const override { return static_cast<int>(shown_.size()); }
  int columns() const override { return static_cast<int>(columns_.size()); }
  ColumnHeader header(int column) const override;
  void set_formats();
  bool matches(int entry) const;
  void arrange();

  std::vector<PatchId> patches_;
  std::vector<PatchColumn> columns_;
  QString search_;
  int sorted_by_ = -1;
  Qt::SortOrder order_ = Qt::AscendingOrder;
  std::vector<int> shown_;  ///< per shown row: its index in patches_
};

/// A tab with a table that sorts by any column, and a caption above it.
struct TablePage {
  PatchTable* table;
  QTableView* view;
  QLabel* caption;
};
/// @param name  of the view
/// @param widest  as of set_up_value_table()
TablePage add_table_page(QTabWidget& tabs, const QString& title, const QString& name,
                         const QStringList& widest);

}  // namespace transillum::viewer
