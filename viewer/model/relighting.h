// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QObject>
#include <memory>

#include "model/material_edits.h"
#include "model/relighter.h"
#include "model/snapshot.h"

namespace transillum::viewer {

/// Lays the light of changed materials over what the solver tells.
class Relighting : public QObject {
  Q_OBJECT

 public:
  explicit Relighting(QObject* parent = nullptr);

  MaterialEdits& edits() { return edits_; }
  /// A new scene: its materials, unchanged.
  void show_scene(const Scene& scene);
  /// What is to be shown of a snapshot of the solver: itself, or with the light and the materials
  /// of the edits, as soon as that light is found.
  std::shared_ptr<const SolverSnapshot> lit(std::shared_ptr<const SolverSnapshot> snapshot);
  /// Why materials cannot be changed now; empty where they can.
  QString obstacle() const;
  /// What the light of changed materials is found from, a sentence for the user; empty where it is
  /// the solve's form factors and nothing else.
  QString account() const;
  /// Whether a light that was asked for is still being found.
  bool busy() const { return relighter_.busy(); }

 signals:
  /// Other light: what lit() gives has changed.
  void changed();
  void form_factors_requested();
  void failed(const QString& message);

 private:
  void ask();

  MaterialEdits edits_;
  Relighter relighter_;
  std::shared_ptr<const SolverSnapshot> snapshot_;          ///< the solver's newest
  std::shared_ptr<const FormFactors> used_;                 ///< that were asked with last
  std::shared_ptr<const RelightResult> light_;              ///< null: the solver's own
  std::shared_ptr<const std::vector<Material>> materials_;  ///< of light_
};

}  // namespace transillum::viewer
