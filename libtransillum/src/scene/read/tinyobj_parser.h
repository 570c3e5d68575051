// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <functional>
#include <istream>
#include <span>

namespace transillum {

/// Callbacks for what tinyobjloader finds in an OBJ text, in the order of its lines. They get no
/// positions: tinyobjloader does not round decimal numbers to the nearest double, so obj_reader.cpp
/// reads them itself.
struct ObjEvents {
  std::function<void()> vertex;
  std::function<void(std::span<const int>)> face;  ///< vertex indices as written
};
void parse_obj(std::istream& text, const ObjEvents& events);

}  // namespace transillum
