// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QObject>
#include <memory>
#include <vector>

#include "model/material_edits.h"
#include "model/snapshot.h"
#include "support/newest_result.h"
#include "transillum/relight.h"

namespace transillum::viewer {

/// Replaces the light in snapshots by that of edited materials, computed from stored form factors.
///
/// Threads: the main thread only.
class Relighting : public QObject {
  Q_OBJECT

 public:
  /// @param undo gets the changes of materials; outlives this object
  explicit Relighting(QUndoStack& undo, QObject* parent = nullptr);

  MaterialEdits& edits() { return edits_; }
  /// Starts with the unedited materials of a new scene.
  void show_scene(std::shared_ptr<const Scene> scene);
  /// The snapshot to show for one of the solver: the same, or with the edited materials and their
  /// light once it is computed.
  std::shared_ptr<const SolverSnapshot> lit(std::shared_ptr<const SolverSnapshot> snapshot);
  /// The reason why materials cannot be edited now; empty if they can.
  QString reason_unavailable() const;
  /// A sentence for the user on how the light of edited materials is computed; empty if it is only
  /// from the form factors of the solve run.
  QString method_note() const;
  /// Whether lobes take part in the run.
  bool by_lobes() const { return snapshot_ && snapshot_->glossy; }
  /// Whether requested light has not been delivered yet.
  bool busy() const {
    return relighter_.busy() || (snapshot_ && snapshot_->glossy && snapshot_->materials != asked_);
  }

 signals:
  /// The result of lit() has changed.
  void changed();
  void form_factors_requested();
  /// Of a run in which lobes take part: its solver is to find the light of these materials.
  /// @param materials  null: those of the scene
  void solver_light_requested(std::shared_ptr<const transillum::viewer::PatchMaterials> materials);
  void failed(const QString& message);

 private:
  struct Request {
    std::shared_ptr<const Scene> scene;
    std::shared_ptr<const FormFactors> form_factors;
    std::shared_ptr<const DirectLight> shot;  ///< may be null
    std::shared_ptr<const PatchMaterials> materials;
    std::vector<Rgb> start;  ///< initial B, W/m², one per patch
    std::vector<Rgb> sky;    ///< what the patches receive from the sky, W/m²; empty: no sky
    double tolerance = 1e-6;
  };
  static RelightResult relit(const Request& request, const Cancellation& cancellation);
  void request_light();
  void ask_solver();

  MaterialEdits edits_;
  std::shared_ptr<const SolverSnapshot> snapshot_;   ///< newest of the solver
  std::shared_ptr<const FormFactors> used_;          ///< of the newest request
  std::shared_ptr<const RelightResult> light_;       ///< null: the solver's light
  std::shared_ptr<const PatchMaterials> materials_;  ///< of light_
  std::shared_ptr<const PatchMaterials> asked_;      ///< of solver_light_requested(), the newest
  NewestResult<Request, RelightResult> relighter_;
};

}  // namespace transillum::viewer
