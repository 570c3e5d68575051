// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// A text browser with widgets in its lines. In the document, a character stands for each widget, as
// large as the widget; the widget is a child of the viewport and follows that character.
#include "lessons/page_text.h"

#include <QAbstractTextDocumentLayout>
#include <QScrollBar>
#include <QTextBlock>
#include <QTextLayout>

namespace transillum::viewer {

namespace {

constexpr int inset_type = QTextFormat::UserObject + 1;
constexpr int inset_index = QTextFormat::UserProperty + 1;

}  // namespace

PageText::PageText(QWidget* parent) : QTextBrowser(parent) {}

void PageText::show_page(const QString& markdown, const std::vector<Inset>& insets) {
  for (const Placed& one : placed_) {
    delete one.widget;
  }
  placed_.clear();
  setMarkdown(markdown);
  document()->documentLayout()->registerHandler(inset_type, this);
  for (const Inset& inset : insets) {
    inset.widget->setParent(viewport());
    QTextCursor found = document()->find(inset.mark);
    if (found.isNull()) {
      inset.widget->hide();
      continue;
    }
    const int position = found.selectionStart();
    QTextCharFormat format;
    format.setObjectType(inset_type);
    format.setProperty(inset_index, static_cast<int>(placed_.size()));
    format.setVerticalAlignment(QTextCharFormat::AlignMiddle);
    placed_.push_back({QTextCursor(document()), inset.widget});
    found.insertText(QString(QChar::ObjectReplacementCharacter), format);
    placed_.back().cursor.setPosition(position);
    inset.widget->show();
  }
  place_insets();
}

void PageText::place_insets() {
  for (const Placed& one : placed_) {
    const int position = one.cursor.position();
    const QTextBlock block = document()->findBlock(position);
    const QRectF box = document()->documentLayout()->blockBoundingRect(block);
    const QTextLine line = block.layout()->lineForTextPosition(position - block.position());
    if (!line.isValid()) {
      continue;
    }
    const QSize size = one.widget->sizeHint();
    const double y = line.y() + (line.height() - size.height()) / 2;
    const QPointF corner = box.topLeft() + QPointF(line.cursorToX(position - block.position()), y) -
                           QPointF(horizontalScrollBar()->value(), verticalScrollBar()->value());
    one.widget->setGeometry(QRect(corner.toPoint(), size));
  }
}

QSizeF PageText::intrinsicSize(QTextDocument*, int, const QTextFormat& format) {
  const auto index = static_cast<std::size_t>(format.intProperty(inset_index));
  return index < placed_.size() ? QSizeF(placed_[index].widget->sizeHint()) : QSizeF();
}

void PageText::resizeEvent(QResizeEvent* event) {
  QTextBrowser::resizeEvent(event);
  place_insets();
}

void PageText::scrollContentsBy(int dx, int dy) {
  QTextBrowser::scrollContentsBy(dx, dy);
  place_insets();
}

}  // namespace transillum::viewer
