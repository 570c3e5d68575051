// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QObject>
#include <QString>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "model/requests/relighting.h"
#include "model/run_options.h"
#include "model/snapshot.h"
#include "model/solver/solve_runner.h"

class QWidget;

namespace transillum::viewer {

/// The open scene: how it was read, and the newest snapshot of its solve, with the light of changed
/// materials. Everything that shows a snapshot receives it from here.
///
/// Threads: belongs to the window's thread.
class OpenScene : public QObject {
  Q_OBJECT

 public:
  /// The references must outlive this object.
  OpenScene(SolveRunner& runner, Relighting& relighting);

  /// Loads and solves a scene; the open scene stays until the new one is loaded.
  /// @param spec a file, or a built-in with its parameters
  /// @param first_look  whether the faces of a scene of few are divided, with linear functions,
  /// unless the options say otherwise
  void open(const std::string& spec, const RunOptions& options, Goal goal = {Goal::Kind::finished},
            bool first_look = false);
  /// Shows an earlier solve of the open scene again, as a result file is shown.
  /// @param loaded  with the light
  void show_earlier(const std::shared_ptr<const LoadedScene>& loaded, const SolveOptions& options,
                    const SceneInput& input);

  /// How the faces of the open scene came about.
  struct Faces {
    std::string spec;  ///< scene whose solve these faces are; no file while they are not saved
    SceneInput input;  ///< how the scene was read
    /// Edited faces that no file has; null for the scene as `spec` names it.
    std::shared_ptr<const SceneDescription> edited = nullptr;
  };
  Faces faces() const { return {spec_, input_, edited_}; }
  /// Solves the open scene with other faces, in the same way as before.
  /// @param loaded  with the patches of these faces
  /// @param before  snapshot of the solve before
  /// @param runs    whether to solve to the end, even if `before` is not finished
  void solve_faces(const std::shared_ptr<const LoadedScene>& loaded, const Faces& faces,
                   const SolverSnapshot& before, bool runs);
  /// The next open() of `spec` has these faces, which no file has, instead of the faces that it
  /// names; until a scene is loaded or fails to load, is_open(spec) is false.
  void give_faces(const std::string& spec, std::shared_ptr<const SceneDescription> faces) {
    given_ = {spec, std::move(faces)};
  }
  /// While held, snapshots of the solver are kept and not shown.
  void hold(bool held);
  /// Whether faces were edited, and no file has them with the present materials: spec() then names
  /// nothing that can be read.
  bool has_unsaved_faces() const;
  /// Whether faces were edited and saved with the changed materials, in the file spec().
  bool has_saved_faces() const { return edited_ && !has_unsaved_faces(); }
  /// Whether solve_faces() was called and patches_changed() has not been emitted yet.
  bool awaits_faces() const { return awaits_faces_; }
  /// Edited faces were written to a file, with these changes of materials.
  void set_saved(const std::string& file, const std::vector<MaterialChange>& changes);
  /// The next open() of a saved scene reads its file.
  void read_saved() {
    if (has_saved_faces()) {
      edited_ = nullptr;
    }
  }

  /// The scene that open() was called with last.
  const std::string& requested_spec() const { return requested_spec_; }
  /// The open scene; empty before the first scene is loaded.
  const std::string& spec() const { return spec_; }
  /// How the faces became patches; a result file has options of its own.
  const SceneOptions& options() const { return options_; }
  /// How the file was read.
  const SceneInput& input() const { return input_; }
  std::shared_ptr<const LoadedScene> loaded() const { return loaded_; }
  /// The snapshot shown; null until the first one of a scene arrives.
  std::shared_ptr<const SolverSnapshot> snapshot() const { return shown_; }

  /// Whether a scene has been requested and has neither been loaded nor failed to load.
  bool is_opening() const { return opening_; }
  /// Whether `spec` is open and was read with the same options; options of the solve may differ.
  bool is_open(const std::string& spec, const RunOptions& options) const;
  /// Whether the solve has processed no direction yet.
  bool at_start() const;
  /// Whether the scene has so few patches that their outlines are shown by default, or they are
  /// divided in rounds.
  bool outlined_by_default() const;
  /// Sends the snapshot out again, to views whose colors have changed.
  void show_again();

 signals:
  /// A scene has been requested; it may still fail to load.
  void opening();
  /// Emitted for views: a new scene replaces the old one.
  void scene_loaded(std::shared_ptr<const transillum::viewer::LoadedScene> loaded);
  /// Emitted after all views have received scene_loaded().
  void scene_shown();
  /// Emitted for views: the open scene has other patches, of a round of refinement or of a new run.
  void patches_changed(std::shared_ptr<const transillum::viewer::LoadedScene> loaded);
  /// Emitted for views: there is a new snapshot of the open scene.
  void snapshot_ready(std::shared_ptr<const transillum::viewer::SolverSnapshot> snapshot);
  /// Emitted after all views have received snapshot_ready().
  void snapshot_shown();

 private:
  void take_scene(std::shared_ptr<const LoadedScene> loaded);
  void take_patches(std::shared_ptr<const LoadedScene> loaded);
  void take_snapshot(std::shared_ptr<const SolverSnapshot> snapshot);

  SolveRunner& runner_;
  Relighting& relighting_;
  std::string requested_spec_, spec_;
  std::shared_ptr<const SceneDescription> requested_edited_, edited_;      ///< Faces::edited
  std::pair<std::string, std::shared_ptr<const SceneDescription>> given_;  ///< give_faces()
  SceneInput requested_input_, input_;
  SceneOptions options_;
  bool opening_ = false;
  int holds_ = 0;
  bool awaits_faces_ = false;
  std::optional<std::vector<MaterialChange>> saved_changes_;  ///< not set: edited_ is not saved
  std::shared_ptr<const LoadedScene> loaded_;
  std::shared_ptr<const SolverSnapshot> newest_;  ///< the snapshot that the solver posted
  std::shared_ptr<const SolverSnapshot> shown_;   ///< with the light of changed materials
};

class OpenScene;

/// Asks before a solve that took long, or edited faces that no file has, are discarded.
class WorkGuard {
 public:
  enum class Lost { solve, scene };

  /// @param scene must outlive this object
  explicit WorkGuard(const OpenScene& scene) : scene_(scene) {}

  /// Whether the solve of the open scene, or the scene with it, may be discarded: the solve took
  /// less than a minute and no edit of faces is lost, or the user agrees.
  /// @param what  text of the button, such as "Quit"
  bool may_lose(QWidget* parent, const QString& what, Lost lost = Lost::solve) const;
  /// For tests: the time from which a solve took long.
  void set_long_seconds(double seconds) { long_seconds_ = seconds; }

 private:
  const OpenScene& scene_;
  double long_seconds_ = 60;
};

}  // namespace transillum::viewer
