// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "widgets/engine_text.h"

#include <QComboBox>
#include <QCoreApplication>

namespace transillum::viewer {

namespace {

QString tr(const char* text) { return QCoreApplication::translate("Engine", text); }

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
    case Engine::pairs:
      return tr("Pairs of patches");
  }
  return {};
}

QString engine_sentence(Engine engine) {
  switch (engine) {
    case Engine::fast:
      return tr("Exact: subtracts the candidates from each receiver's region, nearest first");
    case Engine::local:
      return tr("Exact: the local visibility map of section 3.2, which can be stepped through");
    case Engine::global:
      return tr(
          "Exact, slow: the global visibility map of section 3.1, an arrangement in rational "
          "numbers");
    case Engine::exact:
      return tr(
          "Exact, slow: the local map in rational numbers, without rounding; for small scenes");
    case Engine::zbuffer:
      return tr("Each pixel of the plane has a list of patches, sorted by height (section 2)");
    case Engine::painter:
      return tr("Patches are painted into one pixel buffer, the farthest first (section 2)");
    case Engine::rays:
      return tr("Parallel rays through the scene; each represents an equal area of the plane");
    case Engine::corrected:
      return tr(
          "Approximate: partly hidden polygons are not cut, and their light is corrected "
          "(section 8)");
    case Engine::hemicube:
      return tr(
          "Form factors from the center of each patch through the pixels of half a cube; uses "
          "no directions");
    case Engine::pairs:
      return tr(
          "Form factors pair by pair: exact where nothing is between, otherwise past the shadows "
          "of blockers; uses no directions");
  }
  return {};
}

bool takes_resolution(Engine engine) {
  return engine == Engine::zbuffer || engine == Engine::painter || engine == Engine::rays ||
         engine == Engine::hemicube;
}

void add_engines(QComboBox& box, bool with_rows) {
  for (const std::string& name : engine_names()) {
    const Engine engine = engine_from_name(name);
    if (!with_rows && !takes_directions(engine)) {
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
