// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "window/menus/appearance_actions.h"

#include <QApplication>
#include <QMenu>
#include <QSettings>

#include "widgets/build.h"
#include "widgets/theme.h"

namespace transillum::viewer {

AppearanceActions::AppearanceActions(QObject* parent) : QObject(parent) {
  const auto add = [this](const char* name, const QString& text, const QString& tip,
                          const char* key) {
    auto* action = make_action(this, name, text, tip, QKeySequence(QString::fromLatin1(key)));
    action->setCheckable(true);
    connect(action, &QAction::toggled, this, &AppearanceActions::apply);
    return action;
  };
  projector_ = add("projector", tr("Projector mode"),
                   tr("The page of the lesson, one view and a thin timeline on the whole screen, "
                      "with larger type, thicker lines and more contrast"),
                   "P");
  dark_ = add("dark", tr("Dark"), tr("Light type on dark panels"), "Ctrl+D");
}

void AppearanceActions::add_to(QMenu& menu) const { menu.addActions({projector_, dark_}); }

bool AppearanceActions::projects() const { return projector_->isChecked(); }

void AppearanceActions::set_projects(bool projects) { projector_->setChecked(projects); }

void AppearanceActions::apply() {
  theme::apply(*qApp, {dark_->isChecked(), projector_->isChecked()});
  emit changed();
}

void AppearanceActions::save(QSettings& settings) const {
  settings.setValue("window/dark", dark_->isChecked());
  settings.setValue("window/projector", projector_->isChecked());
}

void AppearanceActions::load(const QSettings& settings) {
  dark_->setChecked(settings.value("window/dark", false).toBool());
  projector_->setChecked(settings.value("window/projector", false).toBool());
}

}  // namespace transillum::viewer
