// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

class QTextDocument;

namespace transillum::viewer {

/// Sets space between the paragraphs of a document that was read from Markdown, and thin lines
/// around the cells of its tables.
void spread_paragraphs(QTextDocument& document);

}  // namespace transillum::viewer
