// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QDialog>
#include <QString>
#include <functional>
#include <vector>

class QLineEdit;
class QTreeWidget;
class QTreeWidgetItem;

namespace transillum::viewer {

/// A thing that the palette can do.
struct PaletteEntry {
  QString text;
  QString place;  ///< the menu, or the kind of thing
  QString keys;
  bool enabled = true;
  std::function<void()> run;
  QString why = {};  ///< why it is not enabled; may be empty
};

/// How well a text fits a query: the sum over the words of the query, which all have to be in the
/// text. 0 is best: each begins a word. An abbreviation fits least.
/// @returns a negative number where the text does not fit
int palette_misfit(const QString& query, const QString& text);

/// A list of everything that the window can do, narrowed by typing. Enter does the marked entry.
class CommandPalette : public QDialog {
  Q_OBJECT

 public:
  /// @returns entries that depend on the query alone, such as a patch by its number
  using OfQuery = std::function<std::vector<PaletteEntry>(const QString& query)>;

  CommandPalette(std::vector<PaletteEntry> entries, OfQuery of_query, QWidget* parent);

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;
  void paintEvent(QPaintEvent* event) override;

 private:
  void fill();
  void run(const QTreeWidgetItem* item);

  std::vector<PaletteEntry> entries_, shown_;
  OfQuery of_query_;
  QLineEdit* query_;
  QTreeWidget* list_;
  int highest_ = 0;  ///< most height, pixels
};

}  // namespace transillum::viewer
