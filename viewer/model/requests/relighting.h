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

/// The options of relight() that a snapshot with form factors determines; they refer to its lists.
RelightOptions relight_options(const SolverSnapshot& solved);

/// Replaces the light in snapshots by the light of edited materials, computed from stored form
/// factors.
///
/// Threads: the main thread only.
class Relighting : public QObject {
  Q_OBJECT

 public:
  /// @param undo gets the changes of materials; outlives this object
  explicit Relighting(QUndoStack& undo, QObject* parent = nullptr);

  MaterialEdits& edits() { return edits_; }
  /// Starts with the unedited materials of a new scene.
  /// @param edited  it is the same scene with edited faces: MaterialEdits::continue_with()
  void show_scene(std::shared_ptr<const Scene> scene, bool edited = false);
  /// The snapshot to show in place of one of the solver: the same, or one with the edited materials
  /// and their light once it is computed.
  std::shared_ptr<const SolverSnapshot> lit(std::shared_ptr<const SolverSnapshot> snapshot);
  /// The reason why materials cannot be edited now; empty if they can.
  QString reason_unavailable() const;
  /// A sentence for the user on how the light of edited materials is computed; empty if only the
  /// form factors of the solve run are used.
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
  /// A light was made in a scene without light, which is not solved: a solve is to make its form
  /// factors.
  void solve_requested();
  /// The solver is to find the light of these materials, in a run in which lobes take part.
  /// @param materials  null for the materials of the scene
  void solver_light_requested(std::shared_ptr<const transillum::viewer::PatchMaterials> materials);
  void failed(const QString& message);

 private:
  struct Request {
    std::shared_ptr<const SolverSnapshot> snapshot;  ///< with form factors
    std::shared_ptr<const PatchMaterials> materials;
    std::shared_ptr<const RelightResult> start;  ///< null to start with the snapshot's light
  };
  bool awaits_light() const;
  static RelightResult relit(const Request& request, const Cancellation& cancellation);
  void request_light();
  void ask_solver();

  MaterialEdits edits_;
  std::shared_ptr<const SolverSnapshot> snapshot_;   ///< newest of the solver
  std::shared_ptr<const FormFactors> used_;          ///< form factors of the newest request
  std::shared_ptr<const RelightResult> light_;       ///< null for the solver's light
  std::shared_ptr<const PatchMaterials> materials_;  ///< materials of light_
  std::shared_ptr<const PatchMaterials>
      asked_;  ///< materials of the newest solver_light_requested()
  NewestResult<Request, RelightResult> relighter_;
};

}  // namespace transillum::viewer
