// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include "transillum/cancellation.h"

namespace transillum::testing {

/// A cancellation that has taken place.
inline Cancellation canceled() {
  Cancellation cancellation;
  cancellation.cancel();
  return cancellation;
}

}  // namespace transillum::testing
