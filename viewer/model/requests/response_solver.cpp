// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "model/requests/response_solver.h"

#include <utility>

namespace transillum::viewer {

namespace {

PatchResponse solve(const LightRequest& request, const Cancellation& cancellation) {
  return {request.loaded, request.receiver,
          solve_adjoint(
              request.scene(), *request.form_factors, request.receiver, request.material_list(),
              {.tolerance = request.tolerance, .patch_materials = request.patch_materials()},
              cancellation)};
}

}  // namespace

ResponseSolver::ResponseSolver(QObject* parent)
    : QObject(parent),
      solver_(*this, &solve,
              [this](const LightRequest&, std::shared_ptr<const PatchResponse> response,
                     const QString& error) {
                response_ = std::move(response);
                error_ = error;
                emit changed();
              }) {}

void ResponseSolver::request(const LightRequest& request) {
  if (request == requested_) {
    return;
  }
  requested_ = request;
  solver_.request(request);
}

}  // namespace transillum::viewer
