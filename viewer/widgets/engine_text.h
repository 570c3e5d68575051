// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QString>

#include "transillum/engine.h"

class QComboBox;

namespace transillum::viewer {

// Texts about engines for the user interface.

/// Name in a list of choices.
QString engine_label(Engine engine);
/// One sentence on its method; the tool tip.
QString engine_sentence(Engine engine);

/// Fills an empty box with the engines, each with its sentence as tool tip; data: the engine as
/// int.
/// @param with_rows also the engines that use no directions
void add_engines(QComboBox& box, bool with_rows);
/// The engine selected in such a box.
Engine engine_of(const QComboBox& box);
void choose_engine(QComboBox& box, Engine engine);

}  // namespace transillum::viewer
