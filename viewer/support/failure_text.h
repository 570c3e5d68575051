// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QString>
#include <exception>

#include "transillum/errors.h"

namespace transillum::viewer {

/// The setting of the panel that may help, in parentheses; empty for Remedy::none.
QString remedy_hint(Remedy remedy);
/// A message for `error`, with the hint of a SolveError. Never empty.
QString failure_text(const std::exception& error);
/// A message for the exception being handled, of whatever type; to be called inside a catch block.
/// Never empty.
QString current_failure_text();

}  // namespace transillum::viewer
