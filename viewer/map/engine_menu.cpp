// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// The menu that chooses the engine, resolution and error marks of a map (MapEngineChoice).
#include "map/engine_menu.h"

#include <QActionGroup>
#include <QMenu>

#include "widgets/build.h"
#include "widgets/engine_text.h"

namespace transillum::viewer {

namespace {

QString label_of(const MapEngineChoice& choice) {
  if (!choice.engine) {
    return EngineMenu::tr("Exact");
  }
  const QString name = engine_label(*choice.engine);
  return choice.order == PaintersOrder::newell ? EngineMenu::tr("%1, Newell's order").arg(name)
                                               : name;
}

}  // namespace

EngineMenu::EngineMenu(QWidget* parent) : QToolButton(parent) {
  setObjectName("map_engine");
  setToolTip(tr("Choose the engine whose V is drawn"));
  setPopupMode(QToolButton::InstantPopup);
  auto* menu = new QMenu(this);
  menu->setToolTipsVisible(true);
  add_engines(*menu);
  add_resolutions(*menu);
  menu->addSeparator();
  differences_ = menu->addAction(tr("Mark errors"));
  differences_->setObjectName("map_difference");
  differences_->setCheckable(true);
  differences_->setChecked(choice_.differences);
  connect(differences_, &QAction::toggled, this, [this](bool on) {
    MapEngineChoice next = choice_;
    next.differences = on;
    change(next);
  });
  setMenu(menu);
  change(choice_);
}

void EngineMenu::add_engines(QMenu& menu) {
  menu.addSection(tr("Engine"));
  auto* engines = new QActionGroup(this);
  const auto add_engine = [&](std::optional<Engine> engine, const std::string& name,
                              PaintersOrder order = PaintersOrder::bsp) {
    MapEngineChoice shown;
    shown.engine = engine;
    shown.order = order;
    QAction* action = engines->addAction(label_of(shown));
    action->setObjectName(QString::fromStdString(name));
    action->setToolTip(engine ? engine_sentence(*engine) : tr("The exact visibility map V"));
    action->setCheckable(true);
    action->setChecked(!engine);
    connect(action, &QAction::triggered, this, [this, engine, order] {
      MapEngineChoice next = choice_;
      next.engine = engine;
      next.order = order;
      change(next);
    });
  };
  add_engine(std::nullopt, "map_exact");
  for (const EngineTraits& traits : transillum::engines()) {
    using Picture = EngineTraits::Picture;
    if (traits.picture != Picture::polygons && traits.picture != Picture::none) {
      add_engine(traits.value, std::string("map_") + traits.name);
    }
    if (traits.takes_order) {
      add_engine(traits.value, "map_newell", PaintersOrder::newell);
    }
  }
  menu.addActions(engines->actions());
}

void EngineMenu::add_resolutions(QMenu& menu) {
  menu.addSection(tr("Pixels along the longer side"));
  resolutions_ = new QActionGroup(this);
  for (const int resolution : {16, 32, 64, 128, 256, 512}) {
    QAction* action = resolutions_->addAction(QString::number(resolution));
    action->setCheckable(true);
    action->setChecked(resolution == choice_.resolution);
    connect(action, &QAction::triggered, this, [this, resolution] {
      MapEngineChoice next = choice_;
      next.resolution = resolution;
      change(next);
    });
  }
  menu.addActions(resolutions_->actions());
}

void EngineMenu::change(const MapEngineChoice& choice) {
  choice_ = choice;
  const bool pixels = choice_.engine && traits_of(*choice_.engine).takes_resolution;
  for (QAction* action : resolutions_->actions()) {
    enable_if(*action, pixels, tr("The picture has no pixels"));
  }
  enable_if(*differences_, choice_.engine.has_value(), tr("The exact map has no errors"));
  QString label = label_of(choice_);
  if (choice_.engine && traits_of(*choice_.engine).takes_order) {  // short: there is little room
    label = choice_.order == PaintersOrder::newell ? tr("Painter (Newell)") : tr("Painter (BSP)");
  }
  setText(pixels ? tr("%1, %2 px ").arg(label).arg(choice_.resolution) : label + QLatin1Char(' '));
  emit changed();
}

}  // namespace transillum::viewer
