// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QString>

namespace transillum::viewer {

/// A message for the exception being handled, of whatever type; to be called inside a catch block.
/// Never empty.
QString current_failure_text();

}  // namespace transillum::viewer
