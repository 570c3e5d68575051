// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "model/requests/eye_radiance.h"

#include <utility>

namespace transillum::viewer {

EyeRadiance::EyeRadiance(QObject* parent)
    : QObject(parent),
      finder_(
          *this,
          [](const Request& request, const Cancellation&) {
            return RadianceToward{request.light, request.eye,
                                  request.light->radiance_toward(request.eye)};
          },
          [this](const Request&, std::shared_ptr<const RadianceToward> radiance,
                 const QString& error) {
            radiance_ = std::move(radiance);
            error_ = error;
            if (!(wanted_ == started_)) {
              started_ = wanted_;
              finder_.request(started_);
            }
            emit changed();
          }) {}

void EyeRadiance::request(std::shared_ptr<const GlossyLight> light, const Vec3& eye) {
  Request request{std::move(light), eye};
  if (request == wanted_) {
    return;
  }
  wanted_ = std::move(request);
  if (!finder_.busy()) {
    started_ = wanted_;
    finder_.request(started_);
  }
}

}  // namespace transillum::viewer
