// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QStringList>

class QTableView;

namespace transillum::viewer {

/// Sets the common appearance of tables of numbers; rows and columns scale with the font.
///
/// @param widest  longest expected text per column. The width does not change where the text is
///                empty; further columns are as wide as a number.
void set_up_value_table(QTableView& table, QStringList widest);

}  // namespace transillum::viewer
