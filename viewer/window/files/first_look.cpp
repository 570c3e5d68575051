// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "window/files/first_look.h"

namespace transillum::viewer {

std::int64_t soft_patches(const std::string& spec) {
  const std::string name = spec.substr(0, spec.find(':'));
  // This number takes some seconds for 1,024 directions on one core.
  return name == "cornell-box" || name == "rooms" ? 1500 : 0;
}

}  // namespace transillum::viewer
