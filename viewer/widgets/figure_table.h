// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QStringList>

class QTableView;

namespace transillum::viewer {

/// The looks that all tables of figures share; rows and columns grow with the type.
///
/// @param widest  the longest text to expect of each column; an empty one's width is left as it is.
///                Columns beyond these have room for a figure.
void set_up_figure_table(QTableView& table, QStringList widest);

}  // namespace transillum::viewer
