// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "pixel_menu.h"

#include <QActionGroup>
#include <QMenu>

namespace transillum::viewer {

namespace {

QString name_of_engine(const std::optional<Engine>& engine) {
  if (!engine) return PixelMenu::tr("Exact");
  return *engine == Engine::zbuffer ? PixelMenu::tr("Z-buffer") : PixelMenu::tr("Painter");
}

}  // namespace

PixelMenu::PixelMenu(QWidget* parent) : QToolButton(parent) {
  setObjectName("map_engine");
  setToolTip(tr("Draw V exactly, or as a discrete engine's pixels show it"));
  setPopupMode(QToolButton::InstantPopup);
  auto* menu = new QMenu(this);
  menu->addSection(tr("Engine"));
  auto* engines = new QActionGroup(this);
  const auto add_engine = [&](std::optional<Engine> engine, const char* name, const QString& text) {
    QAction* action = engines->addAction(text);
    action->setObjectName(QString::fromLatin1(name));
    action->setCheckable(true);
    action->setChecked(engine == choice_.engine);
    connect(action, &QAction::triggered, this, [this, engine] {
      PixelChoice next = choice_;
      next.engine = engine;
      change(next);
    });
  };
  add_engine(std::nullopt, "map_exact", tr("Exact"));
  add_engine(Engine::zbuffer, "map_zbuffer", tr("Z-buffer: a list of patches a pixel"));
  add_engine(Engine::painter, "map_painter", tr("Painter: one item buffer, painted over"));
  menu->addActions(engines->actions());
  menu->addSection(tr("Pixels along the longer side"));
  resolutions_ = new QActionGroup(this);
  for (const int resolution : {16, 32, 64, 128, 256, 512}) {
    QAction* action = resolutions_->addAction(QString::number(resolution));
    action->setCheckable(true);
    action->setChecked(resolution == choice_.resolution);
    connect(action, &QAction::triggered, this, [this, resolution] {
      PixelChoice next = choice_;
      next.resolution = resolution;
      change(next);
    });
  }
  menu->addActions(resolutions_->actions());
  menu->addSeparator();
  differences_ = menu->addAction(tr("Mark what differs from the exact map"));
  differences_->setObjectName("map_difference");
  differences_->setCheckable(true);
  differences_->setChecked(choice_.differences);
  connect(differences_, &QAction::toggled, this, [this](bool on) {
    PixelChoice next = choice_;
    next.differences = on;
    change(next);
  });
  setMenu(menu);
  change(choice_);
}

void PixelMenu::change(const PixelChoice& choice) {
  choice_ = choice;
  resolutions_->setEnabled(choice_.engine.has_value());
  differences_->setEnabled(choice_.engine.has_value());
  setText(choice_.engine ? tr("%1 %2 ").arg(name_of_engine(choice_.engine)).arg(choice_.resolution)
                         : name_of_engine(choice_.engine) + QLatin1Char(' '));
  emit changed();
}

}  // namespace transillum::viewer
