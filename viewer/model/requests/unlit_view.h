// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QImage>
#include <QSize>
#include <memory>
#include <vector>

#include "model/snapshot.h"
#include "transillum/cancellation.h"

namespace transillum::viewer {

/// The picture that a program shows that opens an exported result: the patch in each pixel, and the
/// exposure.
struct UnlitView {
  std::shared_ptr<const SolverSnapshot> snapshot;
  QSize size;
  std::vector<PatchId> patches;   ///< per pixel, rows from the top; no_patch in the background
  double automatic_exposure = 1;  ///< exposure for the snapshot's radiosity
  std::vector<Vec3> points = {};  ///< per pixel, on its patch; empty unless B is linear on patches

  /// The picture without lighting: a pixel is `exposure` times B, clipped to 1, as sRGB.
  QImage picture(double exposure, QRgb background) const;
  /// The fraction of the area of patches that do not emit whose mean is clipped to white in a
  /// channel.
  double white_fraction(double exposure) const;
};

/// From where a snapshot is seen.
struct UnlitRequest {
  std::shared_ptr<const SolverSnapshot> snapshot;
  Vec3 eye, target, up;    ///< the camera, m
  double view_angle = 30;  ///< vertical, degrees
  QSize size;              ///< size of the picture, pixels
};
/// Computes an UnlitView by rays. Back sides are transparent, as in the exported triangles.
/// @throws Canceled
UnlitView unlit_view(const UnlitRequest& request, const Cancellation& cancellation);

}  // namespace transillum::viewer
