// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QString>

class QWidget;

namespace transillum::viewer {

/// Asks where to write. Begins in the folder of the last answer with the name `proposed`, whose
/// ending a name without one gets; who names a file that exists is asked once more.
/// Empty: the user has given it up.
QString ask_where_to_write(QWidget* parent, const QString& title, const QString& filter,
                           const QString& proposed);

}  // namespace transillum::viewer
