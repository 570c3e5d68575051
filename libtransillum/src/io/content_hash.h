// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <boost/uuid/detail/md5.hpp>
#include <cstddef>
#include <string>
#include <type_traits>

#include "transillum/scene.h"

namespace transillum {

/// MD5: detects accidental changes, not deliberate ones.
class ContentHash {
 public:
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
  /// The hash as 32 hexadecimal digits; may be called once.
  std::string digits();

 private:
  void append(const void* data, std::size_t size);

  boost::uuids::detail::md5 md5_;
};

}  // namespace transillum
