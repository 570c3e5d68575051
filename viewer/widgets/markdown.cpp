// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "widgets/markdown.h"

#include <QFontInfo>
#include <QTextBlock>
#include <QTextCursor>
#include <QTextDocument>
#include <QTextList>
#include <QTextTable>

#include "widgets/theme.h"

namespace transillum::viewer {

// Qt lays out Markdown paragraphs without space between them.
void spread_paragraphs(QTextDocument& document) {
  const double room = 0.6 * QFontInfo(document.defaultFont()).pixelSize();
  for (QTextBlock block = document.begin(); block.isValid(); block = block.next()) {
    QTextCursor cursor(block);
    if (QTextTable* table = cursor.currentTable()) {
      QTextTableFormat rules = table->format();
      rules.setBorderCollapse(true);
      rules.setBorder(1);
      rules.setBorderStyle(QTextFrameFormat::BorderStyle_Solid);
      rules.setBorderBrush(theme::rule);
      rules.setCellPadding(room / 3);
      rules.setBottomMargin(room);
      table->setFormat(rules);
      continue;
    }
    QTextBlockFormat format = block.blockFormat();
    format.setBottomMargin(block.textList() ? room / 2 : room);
    cursor.setBlockFormat(format);
  }
}

}  // namespace transillum::viewer
