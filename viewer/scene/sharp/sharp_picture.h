// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// The picture that the scene view shows while it rests: light at the point that each sample of a
// pixel sees, instead of one value per patch.
#pragma once

#include <QImage>
#include <QSize>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <vector>

#include "colors/color_scale.h"
#include "model/snapshot.h"
#include "state/camera_views.h"
#include "transillum/cancellation.h"
#include "transillum/picture.h"

namespace transillum::viewer {

/// The half of space that a clipping plane shows.
struct ShownHalf {
  Vec3 origin;  ///< a point of the plane, m
  Vec3 normal;  ///< toward the half

  friend bool operator==(const ShownHalf&, const ShownHalf&) = default;
};

/// The subject of a sharp picture, and how it is shown.
struct SharpSubject {
  std::shared_ptr<const LoadedScene> loaded;  ///< for its picker
  std::shared_ptr<const SolverSnapshot> snapshot;
  bool by_eye = false;  ///< radiance toward the eye, W/(m² sr); otherwise radiosity, W/m²
  ColorScale scale;     ///< in true color
  ViewPoint view;
  QSize size;                     ///< pixels
  std::vector<bool> hidden = {};  ///< one per patch; empty if none is
  std::optional<ShownHalf> half = std::nullopt;

  friend bool operator==(const SharpSubject& a, const SharpSubject& b) {
    return a.loaded == b.loaded && a.snapshot == b.snapshot && a.by_eye == b.by_eye &&
           a.scale.exposure == b.scale.exposure && a.scale.gamma == b.scale.gamma &&
           a.view == b.view && a.size == b.size && a.hidden == b.hidden && a.half == b.half;
  }
};

/// How far a sharp picture is.
struct SharpProgress {
  double fraction = 0;  ///< part of the work that is done
  bool finished = false;
};

/// The light of a snapshot at points of its surfaces.
struct SnapshotLight {
  std::shared_ptr<const SolverSnapshot> snapshot;
  std::shared_ptr<const Scene> scene;  ///< with the snapshot's materials
  SurfaceLight light;
};

/// Makes sharp pictures, one at a time. Keeps the light of the newest snapshot for the next.
class SharpRenderer {
 public:
  static constexpr int samples = 4;  ///< per pixel of a finished picture

  /// Called about every 100 ms, and with the finished picture: RGBA, without alpha where nothing is
  /// known yet.
  using Deliver = std::function<void(const QImage&, const SharpProgress&)>;
  /// Few pixels first, unless `begins_fine` is set; between those that see the same plane, colors
  /// are interpolated. Then all pixels, then more samples of each.
  /// @throws Canceled, InputError
  void render(const SharpSubject& subject, bool begins_fine, const Cancellation& cancellation,
              const Deliver& deliver);
  /// The light of a snapshot. Any thread may call it.
  /// @throws Canceled, InputError
  std::shared_ptr<const SnapshotLight> light_of(
      const std::shared_ptr<const SolverSnapshot>& snapshot, const Cancellation& cancellation);
  /// Releases the light. Any thread may call it.
  void release();

 private:
  std::mutex mutex_;  ///< guards light_
  std::shared_ptr<const SnapshotLight> light_;
};

}  // namespace transillum::viewer
