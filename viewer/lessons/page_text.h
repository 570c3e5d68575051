// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QTextBrowser>
#include <QTextObjectInterface>
#include <vector>

namespace transillum::viewer {

/// Text of a page with widgets inside its lines.
class PageText : public QTextBrowser, public QTextObjectInterface {
  Q_OBJECT
  Q_INTERFACES(QTextObjectInterface)

 public:
  explicit PageText(QWidget* parent = nullptr);

  /// A widget that replaces `mark` in the text.
  struct Inset {
    QString mark;
    QWidget* widget = nullptr;
  };
  /// Replaces text and widgets. Deletes the old widgets and owns the new ones.
  void show_page(const QString& markdown, const std::vector<Inset>& insets);
  /// Moves the widgets to their places; call after a change of fonts or formats.
  void place_insets();

  QSizeF intrinsicSize(QTextDocument* document, int position, const QTextFormat& format) override;
  void drawObject(QPainter*, const QRectF&, QTextDocument*, int, const QTextFormat&) override {}

 protected:
  void resizeEvent(QResizeEvent* event) override;
  void scrollContentsBy(int dx, int dy) override;

 private:
  /// A widget and its place in the document.
  struct Placed {
    QTextCursor cursor;  ///< the position before its character
    QWidget* widget = nullptr;
  };
  std::vector<Placed> placed_;
};

}  // namespace transillum::viewer
