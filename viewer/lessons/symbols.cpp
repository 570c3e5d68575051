// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Symbols of formulas in lessons. Files write them in Unicode: *B*ᵢ, *A*(i, j, ω_d), ρ.
#include "lessons/symbols.h"

#include <QRegularExpression>
#include <QTextBlock>
#include <QTextCursor>
#include <QTextDocument>
#include <map>

#include "state/focus.h"
#include "state/selection.h"

namespace transillum::viewer {

namespace {

const QString prefix = QStringLiteral("symbol:");

// A letter, and its index if it has one.
const QRegularExpression& symbol_pattern() {
  static const QRegularExpression pattern(
      QStringLiteral("(?<![\\w(])(A\\(i, j, ω(?:_d)?\\)|F[ᵢⱼ]+|[ABE][ᵢⱼ]|ρ[ᵢⱼ]?|ω_d|ω)(?!\\w)"));
  return pattern;
}

// Letters that are symbols only where they are in italics.
const QRegularExpression& letter_pattern() {
  static const QRegularExpression pattern(QStringLiteral("(?<![\\w])([ijABEFV])(?![\\wᵢⱼ])"));
  return pattern;
}

QTextCursor selected(const QTextBlock& block, int begin, int length) {
  QTextCursor cursor(block);
  cursor.setPosition(block.position() + begin);
  cursor.setPosition(block.position() + begin + length, QTextCursor::KeepAnchor);
  return cursor;
}

QString name_of(const QString& symbol) { return symbol.left(1); }

void link_matches(const QTextBlock& block, const QRegularExpression& pattern, bool in_italics) {
  auto matches = pattern.globalMatch(block.text());
  while (matches.hasNext()) {
    const auto match = matches.next();
    QTextCursor cursor = selected(block, match.capturedStart(1), match.capturedLength(1));
    QTextCursor first = selected(block, match.capturedStart(1), 1);
    if ((in_italics && !first.charFormat().fontItalic()) || cursor.charFormat().isAnchor()) {
      continue;
    }
    QTextCharFormat format;
    format.setAnchor(true);
    format.setAnchorHref(prefix + name_of(match.captured(1)));
    format.setToolTip(
        QTextDocument::tr("Point at the symbol: the scene, the map and the pseudo-code "
                          "show what it stands for"));
    cursor.mergeCharFormat(format);
  }
}

// "ᵢ" and "_d" become indices below the line.
void lower_indices(const QTextBlock& block) {
  static const QRegularExpression index(QStringLiteral("[ᵢⱼ]|_d"));
  for (auto match = index.match(block.text()); match.hasMatch();
       match = index.match(block.text(), match.capturedStart() + 1)) {
    QTextCursor cursor = selected(block, match.capturedStart(), match.capturedLength());
    QTextCharFormat format = cursor.charFormat();
    format.setVerticalAlignment(QTextCharFormat::AlignSubScript);
    format.setFontItalic(true);
    const QString text = match.captured();
    cursor.insertText(text == QStringLiteral("ᵢ")   ? QStringLiteral("i")
                      : text == QStringLiteral("ⱼ") ? QStringLiteral("j")
                                                    : text.mid(1),
                      format);
  }
}

// The step shown; of a whole direction, the last that inserts a fragment of patch i, if it is
// given.
std::int32_t step_of(const Focus& focus, PatchId i) {
  if (focus.at_step() || i == no_patch) {
    return focus.position().step;
  }
  const MapHistory& history = focus.map()->history;
  std::int32_t step = history.step_count() - 1;
  while (step >= 0 && history.step(step).patch != i) {
    --step;
  }
  return step;
}

// The patch that the step's fragment sees over the largest area.
PatchId most_seen(const MapHistory& history, std::int32_t step) {
  std::map<PatchId, double> areas;
  PatchId most = no_patch;
  for (const std::int32_t r : history.inside_at(step)) {
    const PatchId patch = history.row(r).patch;
    areas[patch] += history.record().area(history.row(r));
    most = most == no_patch || areas[patch] > areas[most] ? patch : most;
  }
  return most;
}

}  // namespace

void typeset_symbols(QTextDocument& document) {
  for (QTextBlock block = document.begin(); block.isValid(); block = block.next()) {
    link_matches(block, symbol_pattern(), false);
    link_matches(block, letter_pattern(), true);
    lower_indices(block);
  }
}

std::vector<Callout> callouts_of_symbol(const QString& link, const Focus& focus,
                                        const Selection& selection) {
  using Anchor = Callout::Anchor;
  if (!link.startsWith(prefix)) {
    return {};
  }
  const QString name = link.mid(prefix.size());
  PatchId i = selection.patch();
  const std::int32_t step = focus.map() ? step_of(focus, i) : -1;
  if (i == no_patch && step >= 0) {
    i = focus.map()->history.step(step).patch;
  }
  const PatchId j = step >= 0 ? most_seen(focus.map()->history, step) : no_patch;
  std::vector<Callout> callouts;
  const auto add = [&](const QString& text, Anchor anchor, PatchId patch) {
    if (anchor != Anchor::patch || patch != no_patch) {
      callouts.push_back({text.toStdString(), anchor, patch, {}});
    }
  };
  if (name == QStringLiteral("ω")) {
    add(name, Anchor::direction, no_patch);
  } else if (name == QStringLiteral("V")) {
    add(name, Anchor::map, no_patch);
  } else if (name == QStringLiteral("j")) {
    add(name, Anchor::patch, j);
  } else if (name == QStringLiteral("A") || name == QStringLiteral("F")) {
    if (name == QStringLiteral("A")) {
      add(name, Anchor::inside, no_patch);
    }
    add(QStringLiteral("i"), Anchor::patch, i);
    add(QStringLiteral("j"), Anchor::patch, j);
  } else {
    add(name == QStringLiteral("i") ? name : name + QStringLiteral(" of i"), Anchor::patch, i);
  }
  return callouts;
}

}  // namespace transillum::viewer
