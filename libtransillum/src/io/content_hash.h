// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <string_view>
#include <type_traits>

#include "transillum/scene.h"

namespace transillum {

/// Detects accidental changes, not deliberate ones.
class ContentHash {
 public:
  enum class Method {
    xxh3,  ///< XXH3 with 128 bits
    md5,   ///< in files that were written before XXH3 was used
  };

  explicit ContentHash(Method method = Method::xxh3);
  ~ContentHash();

  /// The method of a hash as digits() returns it.
  static Method method_of(std::string_view digits);

  template <typename Value>
  void add(const Value& value) {
    static_assert(std::has_unique_object_representations_v<Value> ||
                  std::is_floating_point_v<Value>);
    append(&value, sizeof value);
  }
  void add(const Vec3& v) {
    for (const double x : {v.x, v.y, v.z}) {
      add(x);
    }
  }
  void add(const Rgb& v) {
    for (const double x : {v.r, v.g, v.b}) {
      add(x);
    }
  }
  void add(const std::string& text) {
    add(text.size());
    append(text.data(), text.size());
  }
  /// Adds points and outlines.
  void add_shape(const Scene& scene) {
    add(scene.points().size());
    for (const Vec3& point : scene.points()) {
      add(point);
    }
    add(scene.patch_count());
    for (PatchId i = 0; i < scene.patch_count(); ++i) {
      add(scene.outline(i).size());
      for (const PointId corner : scene.outline(i)) {
        add(corner);
      }
    }
  }
  /// Adds the corners of every patch. Unlike add_shape(), the result does not depend on the order
  /// in which points are stored, nor on the sign of 0.
  void add_polygons(const Scene& scene) {
    for (PatchId i = 0; i < scene.patch_count(); ++i) {
      add(scene.outline(i).size());
      for (const PointId corner : scene.outline(i)) {
        add(scene.points()[static_cast<std::size_t>(corner)] + Vec3{0, 0, 0});
      }
    }
  }
  /// Adds exitance and reflectance of every patch.
  void add_light(const Scene& scene) {
    for (PatchId i = 0; i < scene.patch_count(); ++i) {
      add(scene.exitance(i));
      add(scene.reflectance(i));
    }
  }
  /// The hash: `xxh3-` and 32 hexadecimal digits; of md5 the digits alone. May be called once.
  std::string digits();

 private:
  struct State;
  void append(const void* data, std::size_t size);

  std::unique_ptr<State> state_;
};

}  // namespace transillum
