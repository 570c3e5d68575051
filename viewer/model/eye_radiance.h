// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QObject>
#include <QString>
#include <memory>
#include <vector>

#include "support/newest_result.h"
#include "transillum/glossy.h"

namespace transillum::viewer {

/// Radiance of all patches toward a point.
struct RadianceToward {
  std::shared_ptr<const GlossyLight> light;
  Vec3 eye;                 ///< m
  std::vector<Rgb> values;  ///< W/(m² sr), one per patch
};

/// Evaluates the last reflection for the eye's direction, on its own thread: while one eye is being
/// computed, only the newest of later ones is kept.
///
/// Threads: functions and signals belong to the thread that created it.
class EyeRadiance : public QObject {
  Q_OBJECT

 public:
  explicit EyeRadiance(QObject* parent = nullptr);

  /// Nothing happens if it is the request of the last call.
  void request(std::shared_ptr<const GlossyLight> light, const Vec3& eye);
  /// The newest radiance, which may belong to an older request; null if none has been computed or
  /// the last request failed.
  std::shared_ptr<const RadianceToward> radiance() const { return radiance_; }
  /// Why the last request failed; else empty.
  const QString& error() const { return error_; }
  bool busy() const { return finder_.busy(); }

 signals:
  /// radiance() or error() has changed.
  void changed();

 private:
  struct Request {
    std::shared_ptr<const GlossyLight> light;
    Vec3 eye;
    friend bool operator==(const Request& a, const Request& b) {
      return a.light == b.light && a.eye == b.eye;
    }
  };

  Request wanted_, started_;
  std::shared_ptr<const RadianceToward> radiance_;
  QString error_;
  NewestResult<Request, RadianceToward> finder_;
};

}  // namespace transillum::viewer
