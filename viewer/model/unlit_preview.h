// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QImage>
#include <QObject>
#include <QSize>
#include <memory>
#include <vector>

#include "model/snapshot.h"
#include "support/request_worker.h"

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
  double white_share(double exposure) const;
};

/// Computes an UnlitView by rays, on its own thread; the newest request replaces the others. Back
/// sides are transparent, as in the exported triangles.
///
/// Threads: the public functions and the signals belong to the thread that created it.
class UnlitPreview : public QObject {
  Q_OBJECT

 public:
  struct Request {
    std::shared_ptr<const SolverSnapshot> snapshot;
    Vec3 eye, target, up;    ///< the camera, m
    double view_angle = 30;  ///< vertical, degrees
    QSize size;              ///< size of the picture, pixels
  };
  explicit UnlitPreview(QObject* parent = nullptr);

  void request(Request request);

 signals:
  void ready(std::shared_ptr<const transillum::viewer::UnlitView> view);
  void failed(const QString& message);

 private:
  RequestWorker<Request> worker_;
};

}  // namespace transillum::viewer
