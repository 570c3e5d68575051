// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "patches/selection_actions.h"

#include <QAction>
#include <QMenu>
#include <utility>

namespace transillum::viewer {

SelectionActions::SelectionActions(Selection& selection, HiddenPatches& hidden, QObject* parent)
    : QObject(parent), selection_(selection), hidden_(hidden) {
  material_ = add("select_material", tr("Select the material"),
                  tr("Select all patches of the selected patch's material"), "Ctrl+M");
  group_ = add("select_group", tr("Select the group"),
               tr("Select all patches of the selected patch's group"), "Ctrl+G");
  face_ =
      add("select_face", tr("Select the face"),
          tr("Select all patches that the selected patch's face was divided into"), "Ctrl+Shift+F");
  hide_ = add("hide_selection", tr("Hide the selection"),
              tr("Do not draw the selected patches in the scene"), "H");
  isolate_ = add("isolate_selection", tr("Isolate the selection"),
                 tr("Draw only the selected patches in the scene"), "I");
  show_all_ =
      add("show_all", tr("Show all patches"), tr("Show the hidden patches again"), "Shift+H");
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

QAction* SelectionActions::add(const char* name, const QString& text, const QString& tip,
                               const char* key) {
  auto* action = new QAction(text, this);
  action->setObjectName(QString::fromLatin1(name));
  action->setToolTip(tip);
  action->setShortcut(QKeySequence(QString::fromLatin1(key)));
  return action;
}

void SelectionActions::add_to(QMenu& menu) const {
  menu.setToolTipsVisible(true);
  menu.addSeparator();
  for (QAction* action : {material_, group_, face_}) {
    menu.addAction(action);
  }
  menu.addSeparator();
  for (QAction* action : {hide_, isolate_, show_all_}) {
    menu.addAction(action);
  }
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
    action->setEnabled(any);
  }
  group_->setEnabled(any && scene_->patch(patch).group != no_group);
  show_all_->setEnabled(hidden_.any());
}

}  // namespace transillum::viewer
