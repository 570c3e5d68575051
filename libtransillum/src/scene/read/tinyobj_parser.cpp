// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "scene/read/tinyobj_parser.h"

#include <map>

// Compiled in, in double, under a name of its own: a distribution's shared library of the same
// name is built for float.
#define TINYOBJLOADER_USE_DOUBLE
#define TINYOBJLOADER_IMPLEMENTATION
#define tinyobj transillum_tinyobj
#include <tiny_obj_loader.h>

namespace transillum {
namespace {

/// One face's indices, kept between calls to save the allocation.
struct Receiver {
  const ObjEvents& events;
  std::vector<int> indices;
};

Receiver& receiver(void* user) { return *static_cast<Receiver*>(user); }

}  // namespace

void parse_obj(std::istream& text, const ObjEvents& events) {
  Receiver receiving{events, {}};
  tinyobj::callback_t callback;
  callback.vertex_cb = [](void* user, double, double, double, double) {
    receiver(user).events.vertex();
  };
  callback.index_cb = [](void* user, tinyobj::index_t* corners, int count) {
    Receiver& r = receiver(user);
    r.indices.clear();
    for (int i = 0; i < count; ++i) {
      r.indices.push_back(corners[i].vertex_index);
    }
    r.events.face(r.indices);
  };
  callback.usemtl_cb = [](void* user, const char* name, int) {
    receiver(user).events.material(name);
  };
  std::string warnings, errors;
  tinyobj::LoadObjWithCallback(text, callback, &receiving, nullptr, &warnings, &errors);
}

std::vector<std::string> parse_mtl(std::istream& text) {
  std::map<std::string, int> numbers;
  std::vector<tinyobj::material_t> materials;
  std::string warnings, errors;
  tinyobj::LoadMtl(&numbers, &materials, &text, &warnings, &errors);
  std::vector<std::string> names;
  for (const tinyobj::material_t& m : materials) {
    names.push_back(m.name);
  }
  return names;
}

}  // namespace transillum
