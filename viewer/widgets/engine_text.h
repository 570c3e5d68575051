// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QString>

#include "transillum/engine.h"

class QComboBox;

namespace transillum::viewer {

// Engines in words for people.

/// As in a list to choose from.
QString engine_label(Engine engine);
/// One sentence: what it does.
QString engine_sentence(Engine engine);
/// Whether EngineOptions::resolution counts.
bool takes_resolution(Engine engine);

/// Fills an empty box with engines, each with its sentence as tool tip; data: the engine as int.
/// @param with_hemicubes also the one that takes no directions.
void add_engines(QComboBox& box, bool with_hemicubes);
/// What such a box is at.
Engine engine_of(const QComboBox& box);
void choose_engine(QComboBox& box, Engine engine);

}  // namespace transillum::viewer
