// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include "transillum/cancellation.h"

namespace transillum::cli {

/// From now on the first SIGINT or SIGTERM sets what this returns, and the second ends the
/// program at once. Call it once, before threads start.
const Cancellation& cancel_on_signals();

}  // namespace transillum::cli
