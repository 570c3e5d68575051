// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "widgets/engine_text.h"

#include <QComboBox>
#include <QCoreApplication>

namespace transillum::viewer {

namespace {

QString tr(const char* words) { return QCoreApplication::translate("Engine", words); }

}  // namespace

QString engine_label(Engine engine) {
  switch (engine) {
    case Engine::fast:
      return tr("Fast");
    case Engine::local:
      return tr("Local map");
    case Engine::global:
      return tr("Global map");
    case Engine::exact:
      return tr("Exact numbers");
    case Engine::zbuffer:
      return tr("Z-buffer");
    case Engine::painter:
      return tr("Painter's algorithm");
    case Engine::rays:
      return tr("Parallel rays");
    case Engine::corrected:
      return tr("No cutting, corrected");
    case Engine::hemicube:
      return tr("Hemicube");
  }
  return {};
}

QString engine_sentence(Engine engine) {
  switch (engine) {
    case Engine::fast:
      return tr("Each receiver's polygon is eaten up by what lies above it, nearest first: exact");
    case Engine::local:
      return tr("The local visibility map of section 3.2, the one that can be watched: exact");
    case Engine::global:
      return tr(
          "The global visibility map of section 3.1, an arrangement in fractions: exact, slow");
    case Engine::exact:
      return tr("The local map in fractions, which never round: slow, for small scenes");
    case Engine::zbuffer:
      return tr("Each pixel of the plane has its list of patches, by height (section 2)");
    case Engine::painter:
      return tr("Patches are painted into one buffer of pixels, the farthest first (section 2)");
    case Engine::rays:
      return tr("Parallel rays through the scene; each stands for its share of the plane");
    case Engine::corrected:
      return tr(
          "What is partly hidden stays whole, and its light is corrected: approximate "
          "(section 8)");
    case Engine::hemicube:
      return tr(
          "What the middle of each patch sees through the pixels of half a cube round it; "
          "takes no directions");
  }
  return {};
}

bool takes_resolution(Engine engine) {
  return engine == Engine::zbuffer || engine == Engine::painter || engine == Engine::rays ||
         engine == Engine::hemicube;
}

void add_engines(QComboBox& box, bool with_hemicubes) {
  for (const std::string& name : engine_names()) {
    const Engine engine = engine_from_name(name);
    if (!with_hemicubes && !takes_directions(engine)) {
      continue;
    }
    box.addItem(engine_label(engine), static_cast<int>(engine));
    box.setItemData(box.count() - 1, engine_sentence(engine), Qt::ToolTipRole);
  }
}

Engine engine_of(const QComboBox& box) { return static_cast<Engine>(box.currentData().toInt()); }

void choose_engine(QComboBox& box, Engine engine) {
  box.setCurrentIndex(box.findData(static_cast<int>(engine)));
}

}  // namespace transillum::viewer
