// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QString>
#include <vector>

#include "state/callout.h"

class QTextDocument;

namespace transillum::viewer {

class Focus;
class Selection;

/// Sets the formulas in the text of a page: indices below the line, letters of quantities in
/// italics. Each symbol becomes a link `symbol:NAME`, which has the color of the text.
void typeset_symbols(QTextDocument& document);
/// The callouts that show what the symbol of a link stands for in the scene and the map, at the
/// position in focus; empty for another link.
std::vector<Callout> callouts_of_symbol(const QString& link, const Focus& focus,
                                        const Selection& selection);

}  // namespace transillum::viewer
