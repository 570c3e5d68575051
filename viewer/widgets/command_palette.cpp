// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// The command palette: a field for words and the list of entries that fit them. The window gives
// the entries; this file knows none of them.
#include "widgets/command_palette.h"

#include <QCoreApplication>
#include <QHeaderView>
#include <QKeyEvent>
#include <QLineEdit>
#include <QPainter>
#include <QRegularExpression>
#include <QTimer>
#include <QTreeWidget>
#include <algorithm>
#include <utility>

#include "widgets/build.h"
#include "widgets/theme.h"

namespace transillum::viewer {

namespace {

constexpr int most_shown = 100;
constexpr int widest = 720, highest = 460;
enum PaletteColumn { what_column, place_column, keys_column, palette_columns };

// Penalties of a word of the query.
constexpr int within_word = 2, scattered = 8;

/// Whether a word of the text begins with the first letter and has the others after it.
bool abbreviates(const QString& letters, const QString& text) {
  static const QRegularExpression separators(QStringLiteral("[^\\w]+"));
  for (const QString& word : text.split(separators, Qt::SkipEmptyParts)) {
    int from = 0;
    for (const QChar letter : letters) {
      const int at = word.indexOf(letter, from, Qt::CaseInsensitive);
      from = at < 0 || (from == 0 && at > 0) ? -1 : at + 1;
      if (from < 0) {
        break;
      }
    }
    if (from > 0) {
      return true;
    }
  }
  return false;
}

int misfit_of_word(const QString& word, const QString& text) {
  for (int at = 0; (at = text.indexOf(word, at, Qt::CaseInsensitive)) >= 0; ++at) {
    if (at == 0 || !text[at - 1].isLetterOrNumber()) {
      return 0;
    }
  }
  if (text.contains(word, Qt::CaseInsensitive)) {
    return within_word;
  }
  return abbreviates(word, text) ? scattered : -1;
}

}  // namespace

int palette_misfit(const QString& query, const QString& text) {
  int sum = 0;
  for (const QString& word : query.split(QLatin1Char(' '), Qt::SkipEmptyParts)) {
    const int misfit = misfit_of_word(word, text);
    if (misfit < 0) {
      return -1;
    }
    sum += misfit;
  }
  return sum;
}

CommandPalette::CommandPalette(std::vector<PaletteEntry> entries, OfQuery of_query, QWidget* parent)
    : QDialog(parent, Qt::Popup),
      entries_(std::move(entries)),
      of_query_(std::move(of_query)),
      query_(named("palette_query", new QLineEdit)),
      list_(named("palette_list", new QTreeWidget)) {
  setObjectName("command_palette");
  setAttribute(Qt::WA_DeleteOnClose);
  query_->setPlaceholderText(
      tr("An action, button, panel, quantity, scene, lesson, material, or the number of a patch"));
  query_->setClearButtonEnabled(true);
  query_->installEventFilter(this);
  list_->setColumnCount(palette_columns);
  list_->setHeaderHidden(true);
  list_->setRootIsDecorated(false);
  list_->setUniformRowHeights(true);
  list_->setFocusPolicy(Qt::NoFocus);
  list_->setFrameShape(QFrame::NoFrame);
  list_->setStyleSheet(QStringLiteral("QTreeView::item { padding: 4px 2px; }"));
  query_->setStyleSheet(QStringLiteral("QLineEdit { padding: 5px; }"));
  list_->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  list_->header()->setStretchLastSection(false);
  list_->header()->setSectionResizeMode(what_column, QHeaderView::Stretch);
  list_->header()->setSectionResizeMode(place_column, QHeaderView::ResizeToContents);
  list_->header()->setSectionResizeMode(keys_column, QHeaderView::ResizeToContents);
  auto* layout = make_column(this, {8, 8, 8, 8}, 6);
  layout->addWidget(query_);
  layout->addWidget(list_, 1);
  const QSize room = parent->size();
  highest_ = std::min(theme::scaled(highest), room.height() - 80);
  resize(std::min(theme::scaled(widest), room.width() - 40), highest_);
  move(parent->mapToGlobal({(room.width() - width()) / 2, std::min(60, room.height() / 10)}));
  connect(query_, &QLineEdit::textChanged, this, &CommandPalette::fill);
  connect(list_, &QTreeWidget::itemClicked, this, &CommandPalette::run);
  fill();
  query_->setFocus();
}

void CommandPalette::fill() {
  const QString query = query_->text().trimmed();
  std::vector<std::pair<int, PaletteEntry>> fitting;
  for (PaletteEntry& entry : of_query_(query)) {
    fitting.emplace_back(-1, std::move(entry));
  }
  for (const PaletteEntry& entry : entries_) {
    const int misfit = palette_misfit(query, entry.text + QLatin1Char(' ') + entry.place);
    if (misfit >= 0) {
      // Possible entries come before the others, and among them those that begin with the query.
      const bool begins = entry.text.startsWith(query, Qt::CaseInsensitive);
      const int rest = !begins ? 2 : entry.text.size() == query.size() ? 0 : 1;
      fitting.emplace_back(6 * misfit + (entry.enabled ? 0 : 3) + rest, entry);
    }
  }
  std::stable_sort(fitting.begin(), fitting.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  fitting.resize(std::min<std::size_t>(fitting.size(), most_shown));
  list_->clear();
  shown_.clear();
  for (auto& [misfit, entry] : fitting) {
    auto* item = new QTreeWidgetItem(list_, {entry.text, entry.place, entry.keys});
    item->setForeground(place_column, theme::ink_dim);
    item->setForeground(keys_column, theme::ink_dim);
    if (!entry.enabled) {
      item->setForeground(what_column, theme::ink_dim);
      item->setToolTip(what_column, entry.why.isEmpty() ? tr("Not possible now") : entry.why);
    }
    shown_.push_back(std::move(entry));
  }
  if (shown_.empty()) {
    auto* nothing = new QTreeWidgetItem(list_, {tr("Nothing has these words")});
    nothing->setForeground(what_column, theme::ink_dim);
    PaletteEntry impossible;
    impossible.enabled = false;
    shown_.push_back(std::move(impossible));
  }
  list_->setCurrentItem(list_->topLevelItem(0));
  const int rows = static_cast<int>(shown_.size()) * list_->sizeHintForRow(0);
  layout()->activate();  // so that the list has its height before the first show
  resize(width(), std::min(highest_, height() - list_->height() + rows));
}

void CommandPalette::run(const QTreeWidgetItem* item) {
  const int row = item ? list_->indexOfTopLevelItem(const_cast<QTreeWidgetItem*>(item)) : -1;
  if (row < 0 || !shown_[static_cast<std::size_t>(row)].enabled) {
    return;
  }
  // The call is made later: it may open a dialog, and this one must have been closed.
  QTimer::singleShot(0, parentWidget(), shown_[static_cast<std::size_t>(row)].run);
  close();
}

// A popup has no frame that would tell it from the panels behind it.
void CommandPalette::paintEvent(QPaintEvent* event) {
  QDialog::paintEvent(event);
  QPainter(this).fillRect(rect(), theme::accent);
  QPainter(this).fillRect(rect().adjusted(1, 1, -1, -1), palette().window());
}

bool CommandPalette::eventFilter(QObject* watched, QEvent* event) {
  if (event->type() != QEvent::KeyPress) {
    return QDialog::eventFilter(watched, event);
  }
  const auto* key = static_cast<QKeyEvent*>(event);
  switch (key->key()) {
    case Qt::Key_Up:
    case Qt::Key_Down:
    case Qt::Key_PageUp:
    case Qt::Key_PageDown: {
      QKeyEvent copy(*key);
      QCoreApplication::sendEvent(list_, &copy);
      return true;
    }
    case Qt::Key_Return:
    case Qt::Key_Enter:
      run(list_->currentItem());
      return true;
    default:
      return false;
  }
}

}  // namespace transillum::viewer
