// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QAbstractTableModel>
#include <QFont>
#include <QString>
#include <QVariant>

namespace transillum::viewer {

/// The head of a column.
struct ColumnHeader {
  QString name;
  QString tip = {};

  /// The data for a role.
  QVariant data(int role) const {
    return role == Qt::DisplayRole                     ? QVariant(name)
           : role == Qt::ToolTipRole && !tip.isEmpty() ? QVariant(tip)
                                                       : QVariant();
  }
};

/// The data for Qt::FontRole.
inline QVariant font_cell(bool bold) {
  QFont font;
  font.setBold(bold);
  return font;
}

/// A table whose rows have no parts, with a header for each column.
class FlatTable : public QAbstractTableModel {
 public:
  using QAbstractTableModel::QAbstractTableModel;

  int rowCount(const QModelIndex& parent = {}) const final { return parent.isValid() ? 0 : rows(); }
  int columnCount(const QModelIndex& parent = {}) const final {
    return parent.isValid() ? 0 : columns();
  }
  QVariant headerData(int section, Qt::Orientation orientation, int role) const final {
    return orientation == Qt::Horizontal && section < columns() ? header(section).data(role)
                                                                : QVariant();
  }

 private:
  virtual int rows() const = 0;
  virtual int columns() const = 0;
  virtual ColumnHeader header(int column) const = 0;
};

}  // namespace transillum::viewer
