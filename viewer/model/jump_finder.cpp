// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "model/jump_finder.h"

#include <utility>

#include "model/snapshot_solution.h"
#include "transillum/refinement.h"

namespace transillum::viewer {

JumpFinder::JumpFinder(QObject* parent)
    : QObject(parent),
      finder_(
          *this,
          [](const Request& snapshot, const Cancellation& cancellation) {
            // Uses the current materials, which the user may have changed.
            std::vector<Rgb> reflectance;
            for (PatchId i = 0; i < snapshot->loaded->scene->patch_count(); ++i) {
              const Material& material = material_of(*snapshot, i);
              reflectance.push_back(snapshot->glossy
                                        ? material.reflectance + used_lobe(material).reflectance
                                        : material.reflectance);
            }
            return PatchJumps{snapshot->loaded->scene,
                              radiosity_jumps(solution_of(*snapshot), reflectance, cancellation)};
          },
          [this](const Request&, std::shared_ptr<const PatchJumps> jumps, const QString& error) {
            jumps_ = std::move(jumps);
            error_ = error;
            if (wanted_ != started_) {
              started_ = wanted_;
              finder_.request(started_);
            }
            emit changed();
          }) {}

void JumpFinder::request(std::shared_ptr<const SolverSnapshot> snapshot) {
  if (snapshot == wanted_) {
    return;
  }
  wanted_ = std::move(snapshot);
  if (!finder_.busy()) {
    started_ = wanted_;
    finder_.request(started_);
  }
}

void JumpFinder::clear() {
  finder_.clear();
  wanted_ = started_ = nullptr;
  jumps_ = nullptr;
  error_.clear();
}

}  // namespace transillum::viewer
