// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Lessons as HTML files for a browser: no server, no other file, no network. A MapRecord is a table
// of polygons with the steps of their lives, so stepping in the browser shows or hides polygons.
#include "lessons/lesson_html.h"

#include <QRectF>
#include <QRegularExpression>
#include <QTextDocument>
#include <algorithm>
#include <limits>

#include "lessons/symbols.h"
#include "state/callout.h"
#include "support/number_text.h"
#include "transillum/at.h"

namespace transillum::viewer {

namespace {

constexpr std::size_t most_rows = 20'000;
constexpr double map_width = 560;  // user units of the SVG

const char* const style_sheet = R"(
:root { color-scheme: light dark; }
body { font: 17px/1.5 system-ui, sans-serif; max-width: 76rem; margin: 0 auto; padding: 1rem; }
p, ul, .question { max-width: 44rem; }
.views { display: flex; flex-wrap: wrap; gap: 1rem; align-items: flex-start; margin: .5rem 0; }
.views > * { flex: 1 1 24rem; min-width: 0; }
section { border-top: 1px solid #8888; margin-top: 2rem; padding-top: .5rem; }
img, svg.map { width: 100%; height: auto; display: block; }
svg.map { background: #1d2127; }
svg.map polygon { stroke: #1d2127; stroke-width: .6; }
svg.map polygon.back { fill: url(#hatch); }
svg.map .callout path { stroke: #fff; stroke-width: 2; }
svg.map .callout circle { fill: #fff; }
svg.map .callout text { font: bold 14px system-ui, sans-serif; fill: #fff; stroke: #000; stroke-width: 4px; paint-order: stroke; }
svg.map polygon.now { stroke: #ffe04d; stroke-width: 3; }
.steps { display: flex; gap: .6rem; align-items: center; flex-wrap: wrap; }
.steps input { flex: 1; }
.question { border: 1px solid #8888; border-radius: 6px; padding: .3rem 1rem; margin: 1rem 0; }
table { border-collapse: collapse; } td, th { border: 1px solid #8888; padding: .2rem .6rem; }
)";

// Shows the polygons with made <= step < consumed.
const char* const script = R"(
for (const box of document.querySelectorAll('.stepper')) {
  const input = box.querySelector('input'), text = box.querySelector('output');
  const polygons = box.querySelectorAll('svg polygon');
  const show = () => {
    const step = Number(input.value) - 1;
    for (const p of polygons) {
      const made = Number(p.dataset.made), consumed = Number(p.dataset.consumed);
      p.style.display = made <= step && step < consumed ? '' : 'none';
      p.classList.toggle('now', made === step && p.dataset.whole === '1');
    }
    text.textContent = input.value + ' / ' + input.max;
  };
  const move = by => { input.value = Number(input.value) + by; show(); };
  input.addEventListener('input', show);
  box.querySelector('.back').addEventListener('click', () => move(-1));
  box.querySelector('.on').addEventListener('click', () => move(1));
  show();
}
)";

QString tr(const char* text) { return QObject::tr(text); }

// The body of Qt's HTML, without fonts and colors, and without the links of symbols.
QString html_of(const QString& markdown) {
  QTextDocument document;
  document.setMarkdown(markdown);
  typeset_symbols(document);
  QString html = document.toHtml();
  static const QRegularExpression body(QStringLiteral("<body[^>]*>(.*)</body>"),
                                       QRegularExpression::DotMatchesEverythingOption);
  static const QRegularExpression link(
      QStringLiteral("<a (?:title=\"[^\"]*\" )?href=\"symbol:[^>]*>(.*?)</a>"));
  static const QRegularExpression look(
      QStringLiteral("(font-family|font-size|color|background-color|-qt-[a-z-]+|margin[a-z-]*|"
                     "text-indent):[^;\"]*;?"));
  static const QRegularExpression code(
      QStringLiteral("<span style=\"[^\"]*font-family:[^;\"]*mono[^\"]*\">([^<]*)</span>"),
      QRegularExpression::CaseInsensitiveOption);
  html = body.match(html).captured(1);
  html.replace(code, QStringLiteral("<code>\\1</code>"));
  while (html.contains(link)) {
    html.replace(link, QStringLiteral("\\1"));
  }
  html.remove(look);
  html.remove(QRegularExpression(QStringLiteral(" style=\"\\s*\"")));
  return html;
}

// Controls become the values that the page begins with.
QString text_of(const Lesson::Page& page) {
  QString text = QString::fromStdString(page.text);
  for (const PageControl& control : page.controls) {
    const int value =
        control.kind == PageControl::Kind::option ? value_in(control, page.state.options) : -1;
    const QString shown =
        value < 0 ? QStringLiteral("…") : QString::fromStdString(at(control.labels, value));
    text.replace('{' + QString::fromStdString(control.name) + '}', shown);
  }
  return text;
}

QString value_text(const Question& question, double value) {
  const QString unit = QString::fromStdString(question.unit);
  return (number_text(question.percent ? 100 * value : value) + ' ' + unit).trimmed();
}

QString answer_text(const Question& question, const Solved& solved) {
  QStringList right;
  for (const int k : solved.right) {
    if (question.kind == Question::Kind::patch) {
      right << tr("patch %1 (%2)").arg(k).arg(value_text(question, at(solved.values, k)));
    } else {
      const Question::Choice& choice = at(question.choices, k);
      right << (choice.text.empty() ? value_text(question, at(solved.values, k))
                                    : QString::fromStdString(choice.text));
    }
  }
  if (right.isEmpty() || question.rule == Question::Rule::nearest) {
    right << tr("computed: %1").arg(value_text(question, solved.value));
  }
  return right.join(QStringLiteral("; "));
}

QString question_html(const ShownPage& shown) {
  const Question& question = *shown.page.question;
  QString html =
      QStringLiteral("<div class=\"question\">") + html_of(QString::fromStdString(question.ask));
  if (!question.choices.empty()) {
    html += QStringLiteral("<ul>");
    for (const Question::Choice& choice : question.choices) {
      const QString text = choice.text.empty() ? value_text(question, choice.value->number)
                                               : QString::fromStdString(choice.text);
      html += QStringLiteral("<li>%1</li>").arg(text.toHtmlEscaped());
    }
    html += QStringLiteral("</ul>");
  }
  if (shown.solved) {
    html += QStringLiteral("<details><summary>%1</summary><p><b>%2</b></p>%3</details>")
                .arg(tr("Reveal the answer"), answer_text(question, *shown.solved).toHtmlEscaped(),
                     html_of(QString::fromStdString(question.then)));
  }
  return html + QStringLiteral("</div>\n");
}

QString map_html(const ShownPage& shown) {
  const MapHistory& history = shown.map->history;
  const bool all = history.record().rows.size() <= most_rows;
  const QString svg = QString::fromUtf8(
      map_svg(*shown.map, shown.step, shown.patch_colors, all, shown.page.callouts));
  if (!all) {
    return QStringLiteral("<div>%1</div>\n").arg(svg);
  }
  return QStringLiteral(
             "<div class=\"stepper\">%1<div class=\"steps\"><button class=\"back\" "
             "type=\"button\">‹</button><input type=\"range\" min=\"0\" max=\"%2\" value=\"%3\" "
             "aria-label=\"%5\"><button class=\"on\" type=\"button\">›</button>%5 "
             "<output>%3 / %2</output></div></div>\n")
      .arg(svg)
      .arg(history.step_count())
      .arg(shown.step + 1)
      .arg(tr("Step"));
}

QByteArray number(double value) { return QByteArray::number(value, 'f', 2); }

// Writes a text beside the point, on the side with more room, and below the texts that it would
// hide.
QByteArray callout_svg(const QString& text, double x, double y, double width,
                       std::vector<QRectF>& taken) {
  constexpr double shift = 14, line = 18, letter = 8.5;
  const bool to_left = x > width / 2;
  const double end = to_left ? x - shift : x + shift, room = letter * text.size();
  QRectF place(to_left ? end - room : end, std::max(y - shift, line) - line, room, line);
  while (std::any_of(taken.begin(), taken.end(),
                     [&](const QRectF& other) { return other.intersects(place); })) {
    place.translate(0, line);
  }
  taken.push_back(place);
  const double base = place.bottom() - 0.25 * line;
  return "<g class=\"callout\"><path d=\"M" + number(x) + ' ' + number(y) + 'L' + number(end) +
         ' ' + number(base) + "\"/><circle cx=\"" + number(x) + "\" cy=\"" + number(y) +
         "\" r=\"3\"/><text x=\"" + number(end) + "\" y=\"" + number(base) +
         (to_left ? "\" text-anchor=\"end\">" : "\">") + text.toHtmlEscaped().toUtf8() +
         "</text></g>";
}

}  // namespace

QByteArray map_svg(const RecordedMap& map, std::int32_t step,
                   const std::vector<Color8>& patch_colors, bool all,
                   const std::vector<Callout>& callouts) {
  const MapRecord& record = map.record();
  Vec2 low{std::numeric_limits<double>::max(), std::numeric_limits<double>::max()};
  Vec2 high{-low.x, -low.y};
  for (const Vec2& p : record.corners) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y)};
  }
  const double scale = map_width / std::max({high.x - low.x, high.y - low.y, 1e-300});
  QByteArray svg = "<svg class=\"map\" viewBox=\"-8 -8 " + number(scale * (high.x - low.x) + 16) +
                   ' ' + number(scale * (high.y - low.y) + 16) + "\" width=\"" +
                   number(scale * (high.x - low.x) + 16) +
                   "\"><defs><pattern id=\"hatch\" width=\"6\" height=\"6\" "
                   "patternUnits=\"userSpaceOnUse\"><rect width=\"6\" height=\"6\" "
                   "fill=\"#3a4250\"/><path d=\"M0 6L6 0\" stroke=\"#6b7686\"/></pattern></defs>";
  for (const MapRecord::Row& row : record.rows) {
    const bool shown = row.made <= step && step < row.consumed;
    if (!shown && !all) {
      continue;
    }
    svg += "<polygon data-made=\"" + QByteArray::number(row.made) + "\" data-consumed=\"" +
           QByteArray::number(row.consumed) + "\" data-whole=\"" +
           (row.parent == MapRecord::no_row ? "1" : "0") + "\" points=\"";
    for (const Vec2& p : record.outline(row)) {  // along omega: u to the left, v up
      svg += number(scale * (high.x - p.x)) + ',' + number(scale * (high.y - p.y)) + ' ';
    }
    svg += '"';
    if (row.front_facing) {
      svg += " class=\"back\"";
    } else {
      const Color8 color = at(patch_colors, row.patch);
      svg += " fill=\"#" + QByteArray(reinterpret_cast<const char*>(color.data()), 3).toHex() + '"';
    }
    svg += shown ? ">" : " style=\"display:none\">";
    svg += "<title>" + QObject::tr("patch %1").arg(row.patch).toUtf8() + "</title></polygon>";
  }
  std::vector<QRectF> taken;
  const std::vector<std::int32_t> rows = record.map_after(step);
  for (const Callout& callout : callouts) {
    const double width = scale * (high.x - low.x);
    std::optional<Vec2> place = place_in_map(callout, map, rows, step);
    if (callout.anchor == Callout::Anchor::direction) {
      place = Vec2{(low.x + high.x) / 2, high.y};
    }
    if (place) {
      svg += callout_svg(QString::fromStdString(callout.text), scale * (high.x - place->x),
                         scale * (high.y - place->y), width, taken);
    }
  }
  return svg + "</svg>";
}

QByteArray lesson_html(const QString& title, const std::vector<ShownPage>& pages) {
  QString html = QStringLiteral(
                     "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">"
                     "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">"
                     "<title>%1</title><style>%2</style></head><body>\n<h1>%1</h1>\n")
                     .arg(title.toHtmlEscaped(), QString::fromLatin1(style_sheet));
  for (const ShownPage& shown : pages) {
    html += QStringLiteral("<section><h2>%1</h2>\n")
                .arg(QString::fromStdString(shown.page.title).toHtmlEscaped());
    html += html_of(text_of(shown.page)) + QStringLiteral("<div class=\"views\">\n");
    if (!shown.picture.isEmpty()) {
      html += QStringLiteral("<img alt=\"%1\" src=\"data:image/png;base64,%2\">\n")
                  .arg(tr("The scene"), QString::fromLatin1(shown.picture.toBase64()));
    }
    if (shown.map) {
      html += map_html(shown);
    }
    html += QStringLiteral("</div>\n");
    if (shown.page.question) {
      html += question_html(shown);
    }
    html += QStringLiteral("</section>\n");
  }
  html += QStringLiteral("<script>%1</script></body></html>\n").arg(QString::fromLatin1(script));
  return html.toUtf8();
}

}  // namespace transillum::viewer
