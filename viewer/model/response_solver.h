// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QObject>
#include <QString>
#include <memory>

#include "model/light_request.h"
#include "support/newest_result.h"
#include "transillum/adjoint.h"

namespace transillum::viewer {

/// The effect that light emitted by each patch has on one patch.
struct PatchResponse {
  std::shared_ptr<const LoadedScene> loaded;
  PatchId receiver = no_patch;
  Adjoint adjoint;
};

/// Solves the adjoint for a patch, from the form factors of a snapshot, on its own thread.
///
/// Threads: functions and signals belong to the thread that created it.
class ResponseSolver : public QObject {
  Q_OBJECT

 public:
  explicit ResponseSolver(QObject* parent = nullptr);

  /// Solves `request` unless it equals the request of the last call. The older response remains
  /// until then.
  void request(const LightRequest& request);
  /// The newest response; null if none has been solved or the last request failed.
  std::shared_ptr<const PatchResponse> response() const { return response_; }
  /// Why the last request failed; else empty.
  const QString& error() const { return error_; }
  bool busy() const { return solver_.busy(); }

 signals:
  /// response() or error() has changed.
  void changed();

 private:
  LightRequest requested_;
  std::shared_ptr<const PatchResponse> response_;
  QString error_;
  NewestResult<LightRequest, PatchResponse> solver_;
};

}  // namespace transillum::viewer
