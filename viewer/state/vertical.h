// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QObject>
#include <optional>

#include "transillum/scene.h"

namespace transillum::viewer {

/// The vertical of a file's scene, which few formats tell.
struct LikelyVertical {
  Vec3 up;
  bool is_clear = false;  ///< whether level surfaces, or lamps that face down, tell it
};

/// +z where clearly more of the surface is level under it than under +y, else +y, as in glTF and
/// most OBJ files.
LikelyVertical likely_vertical(const Scene& scene);

/// The vertical of the open scene: of the camera, of the sky and of exported files.
class Vertical : public QObject {
  Q_OBJECT

 public:
  using QObject::QObject;

  const Vec3& up() const { return up_; }
  /// Whether up() is neither known nor chosen, and either unusual or not clear.
  bool is_guess() const { return is_guess_; }
  /// Whether the scene's surfaces tell up(), where it is a guess.
  bool is_clear() const { return is_clear_; }
  /// The vertical that is the likeliest after up(): +y or +z.
  Vec3 other() const;
  /// Begins with another scene.
  /// @param known  its vertical, where that is known
  void show_scene(const Scene& scene, const std::optional<Vec3>& known);
  /// Sets the vertical that the user wants. @param up  unit vector
  void choose(const Vec3& up);

 signals:
  /// up() or is_guess() has changed.
  void changed();

 private:
  Vec3 up_{0, 1, 0};
  bool is_guess_ = false;
  bool is_clear_ = true;
};

}  // namespace transillum::viewer
