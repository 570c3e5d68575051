// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QObject>
#include <QString>
#include <QUndoStack>
#include <memory>
#include <string>
#include <vector>

#include "model/patch_materials.h"
#include "transillum/material_changes.h"
#include "transillum/scene.h"

namespace transillum::viewer {

/// The kinds of target that a change of E, rho or a lobe applies to.
enum class TargetKind { material, group, face };

/// The user's changes of E, rho and lobes of materials, groups and faces, which can be undone. If
/// several changes apply to a face, the change of the face takes precedence over the change of its
/// group, and both over the change of its material.
///
/// A target is written as for change_materials(), with its kind: `material:NAME`, `group:NAME`,
/// `face:N`.
///
/// Threads: the main thread only.
class MaterialEdits : public QObject {
  Q_OBJECT

 public:
  /// @param undo gets each change; outlives this object
  explicit MaterialEdits(QUndoStack& undo, QObject* parent = nullptr)
      : QObject(parent), undo_(undo) {}

  /// The target of a kind that patch i belongs to; empty for a group if the patch has none.
  static std::string target_of(const Scene& scene, TargetKind kind, PatchId i);
  static TargetKind kind_of(const std::string& target);
  /// A target of change_materials() with its kind: `lamp` becomes `material:lamp`, or `group:lamp`
  /// if only a group has that name.
  std::string with_kind(const std::string& target) const;

  /// Discards all changes, for another scene.
  void start_with(std::shared_ptr<const Scene> scene);
  /// Keeps the changes and what can be undone, for the same scene with edited faces. Changes of
  /// faces that it does not have are ignored.
  void continue_with(std::shared_ptr<const Scene> scene);
  /// Whether any face differs from the scene.
  bool any() const { return any_; }
  /// Why a result cannot be studied or measured: materials have changed since its solve. Empty if
  /// they have not.
  QString why_unsolved() const {
    return any_ ? tr("Materials have changed since the solve: press Solve first") : QString();
  }
  /// E and rho of all patches, with the changes; null before the first scene.
  const std::shared_ptr<const PatchMaterials>& materials() const { return materials_; }
  /// Whether any patch emits.
  bool has_light() const { return has_light_; }
  /// Whether the exitance of any patch differs from the scene's.
  bool changes_exitance() const;
  /// E and rho of the target's first patch; a black surface if the target has no patch.
  Material values_of(const std::string& target) const;
  /// Number of patches of a target, and whether they all have the same E and rho.
  struct Extent {
    int patches = 0;
    bool uniform = true;
  };
  Extent extent_of(const std::string& target) const;

  /// Sets E (W/m²) or rho of a target. Changes since begin_drag() are undone together.
  /// @throws InputError where the scene has no such target
  void set_exitance(const std::string& target, const Rgb& exitance);
  void set_reflectance(const std::string& target, const Rgb& reflectance);
  /// Sets the lobe of a target, which only glossy runs use.
  void set_lobe(const std::string& target, const Lobe& lobe);
  void begin_drag();
  /// Discards all changes, as one undoable change.
  void restore();
  /// The changes, materials first and faces last; empty if no face differs from the scene.
  std::vector<MaterialChange> changes() const;
  /// Replaces all changes and clears the undo stack.
  /// @returns a sentence about each change that does not fit the scene, which is ignored
  std::vector<std::string> start_over(const std::vector<MaterialChange>& changes);

  /// The changes between begin_macro() and end_macro() are undone together.
  void begin_macro(const QString& text) { undo_.beginMacro(text); }
  void end_macro() { undo_.endMacro(); }

 signals:
  void begun();  ///< begin_drag()
  void changed();

 private:
  class Change;
  void push(const MaterialChange& change, const QString& text);
  void put(std::vector<MaterialChange> changes);
  void apply();
  /// The patches of a target, in order.
  std::vector<PatchId> patches_of(const std::string& target) const;

  std::shared_ptr<const Scene> scene_;
  SceneDescription faces_;  ///< materials and groups of the scene's faces; no points
  std::vector<MaterialChange> changes_;
  std::shared_ptr<const PatchMaterials> materials_;
  bool any_ = false, has_light_ = false;
  int drag_ = 0;
  QUndoStack& undo_;
};

/// A target for the user: `Face 12`, `Material "white"`. Long names are shortened.
QString target_text(const std::string& target);

}  // namespace transillum::viewer
