// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "widgets/engine_text.h"

#include <QComboBox>
#include <QCoreApplication>

namespace transillum::viewer {

namespace {

QString tr(const char* text) { return QCoreApplication::translate("Engine", text); }

}  // namespace

QString engine_label(Engine engine) { return tr(traits_of(engine).label); }

QString engine_sentence(Engine engine) { return tr(traits_of(engine).sentence); }

void add_engines(QComboBox& box, bool with_rows) {
  for (const EngineTraits& traits : engines()) {
    if (with_rows || traits.takes_directions) {
      box.addItem(tr(traits.label), static_cast<int>(traits.value));
      box.setItemData(box.count() - 1, tr(traits.sentence), Qt::ToolTipRole);
    }
  }
}

Engine engine_of(const QComboBox& box) { return static_cast<Engine>(box.currentData().toInt()); }

void choose_engine(QComboBox& box, Engine engine) {
  box.setCurrentIndex(box.findData(static_cast<int>(engine)));
}

}  // namespace transillum::viewer
