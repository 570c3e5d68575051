// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "scene/read/tinyobj_parser.h"

// Compiled in, with doubles, in a separate namespace: a distribution's shared library of the same
// name is built for float.
#define TINYOBJLOADER_USE_DOUBLE
#define TINYOBJLOADER_IMPLEMENTATION
#define tinyobj transillum_tinyobj
#include <tiny_obj_loader.h>

namespace transillum {
namespace {

struct CallbackState {
  const ObjEvents& events;
  std::vector<int> indices;  ///< indices of one face, kept to save allocations
};

CallbackState& state_of(void* user) { return *static_cast<CallbackState*>(user); }

}  // namespace

void parse_obj(std::istream& text, const ObjEvents& events) {
  CallbackState callback_state{events, {}};
  tinyobj::callback_t callback;
  callback.vertex_cb = [](void* user, double, double, double, double) {
    state_of(user).events.vertex();
  };
  callback.index_cb = [](void* user, tinyobj::index_t* corners, int count) {
    CallbackState& state = state_of(user);
    state.indices.clear();
    for (int i = 0; i < count; ++i) {
      state.indices.push_back(corners[i].vertex_index);
    }
    state.events.face(state.indices);
  };
  std::string warnings, errors;
  tinyobj::LoadObjWithCallback(text, callback, &callback_state, nullptr, &warnings, &errors);
}

}  // namespace transillum
