// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "patches/selection_actions.h"

#include <QMenu>
#include <utility>

#include "widgets/build.h"

namespace transillum::viewer {

SelectionActions::SelectionActions(Selection& selection, HiddenPatches& hidden, QObject* parent)
    : QObject(parent), selection_(selection), hidden_(hidden) {
  material_ = make_action(this, "select_material", tr("Select the material"),
                          tr("Select all patches of the selected patch's material"),
                          QKeySequence("Ctrl+M"));
  group_ =
      make_action(this, "select_group", tr("Select the group"),
                  tr("Select all patches of the selected patch's group"), QKeySequence("Ctrl+G"));
  face_ = make_action(this, "select_face", tr("Select the face"),
                      tr("Select all patches that the selected patch's face was divided into"),
                      QKeySequence("Ctrl+Shift+F"));
  hide_ = make_action(this, "hide_selection", tr("Hide the selection"),
                      tr("Do not draw the selected patches in the scene"), QKeySequence("H"));
  isolate_ = make_action(this, "isolate_selection", tr("Isolate the selection"),
                         tr("Draw only the selected patches in the scene"), QKeySequence("I"));
  show_all_ = make_action(this, "show_all", tr("Show all patches"),
                          tr("Show the hidden patches again"), QKeySequence("Shift+H"));
  connect(material_, &QAction::triggered, this, [this] {
    const auto material = scene_->patch(selection_.patch()).material;
    select_where([material](const Patch& patch) { return patch.material == material; });
  });
  connect(group_, &QAction::triggered, this, [this] {
    const auto group = scene_->patch(selection_.patch()).group;
    select_where([group](const Patch& patch) { return patch.group == group; });
  });
  connect(face_, &QAction::triggered, this, [this] {
    const auto face = scene_->patch(selection_.patch()).face;
    select_where([face](const Patch& patch) { return patch.face == face; });
  });
  connect(hide_, &QAction::triggered, this, [this] { hidden_.hide(selection_.patches()); });
  connect(isolate_, &QAction::triggered, this, [this] { hidden_.isolate(selection_.patches()); });
  connect(show_all_, &QAction::triggered, this, [this] { hidden_.show_all(); });
  connect(&selection_, &Selection::patches_changed, this, &SelectionActions::show_state);
  connect(&hidden_, &HiddenPatches::changed, this, &SelectionActions::show_state);
  show_state();
}

void SelectionActions::add_to(QMenu& menu) const {
  menu.setToolTipsVisible(true);
  menu.addSeparator();
  menu.addActions({material_, group_, face_});
  menu.addSeparator();
  menu.addActions({hide_, isolate_, show_all_});
}

void SelectionActions::show_scene(std::shared_ptr<const Scene> scene) {
  scene_ = std::move(scene);
  hidden_.reset(scene_->patch_count());
  show_state();
}

template <class Belongs>
void SelectionActions::select_where(const Belongs& belongs) {
  std::vector<PatchId> patches;
  for (PatchId i = 0; i < scene_->patch_count(); ++i) {
    if (belongs(scene_->patch(i))) {
      patches.push_back(i);
    }
  }
  selection_.select_all(std::move(patches));
}

void SelectionActions::show_state() {
  const PatchId patch = selection_.patch();
  const bool any = scene_ && patch >= 0 && patch < scene_->patch_count();
  for (QAction* action : {material_, face_, hide_, isolate_}) {
    enable_if(*action, any, tr("No patch is selected"));
  }
  enable_if(*group_, any && scene_->patch(patch).group != no_group,
            any ? tr("The selected patch is in no group") : tr("No patch is selected"));
  enable_if(*show_all_, hidden_.any(), tr("No patch is hidden"));
}

}  // namespace transillum::viewer
