// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Lessons as HTML files for a browser: no server, no other file, no network. A MapRecord is a table
// of polygons with the steps of their lives, so stepping in the browser shows or hides polygons.
#include "lessons/lesson_html.h"

#include <QRectF>
#include <QRegularExpression>
#include <QTextDocument>
#include <algorithm>
#include <array>
#include <limits>
#include <span>

#include "lessons/result_text.h"
#include "lessons/symbols.h"
#include "state/callout.h"
#include "state/section.h"
#include "support/number_text.h"
#include "transillum/at.h"

namespace transillum::viewer {

namespace {

constexpr std::size_t most_rows = 20'000;
constexpr double map_width = 560, omega_room = 24;  // user units of the SVG

const char* const style_sheet = R"(
:root { color-scheme: light dark; }
body { font: 17px/1.5 system-ui, sans-serif; max-width: 76rem; margin: 0 auto; padding: 1rem; }
p, ul, .question { max-width: 44rem; }
.views { display: flex; flex-wrap: wrap; gap: 1rem; align-items: flex-start; margin: .5rem 0; }
.views > * { flex: 1 1 24rem; min-width: 0; }
figure { margin: 0; }
section { border-top: 1px solid #8888; margin-top: 2rem; padding-top: .5rem; }
img, svg.map { width: 100%; height: auto; display: block; }
svg.map { background: #1d2127; }
svg.map polygon { stroke: #1d2127; stroke-width: .6; }
svg.map polygon.back { fill: url(#hatch); }
svg.map .callout path { stroke: #fff; stroke-width: 2; }
svg.map .callout circle { fill: #fff; }
svg.map .callout text { font: bold 14px system-ui, sans-serif; fill: #fff; stroke: #000; stroke-width: 4px; paint-order: stroke; }
svg.map polygon.strip { opacity: .3; }
svg.map line { stroke-width: 4; }
svg.map .phase { filter: drop-shadow(0 0 1px #000); }
svg.map .phase polygon { fill: none; stroke: #fff; stroke-width: 1.2; }
svg.map .phase polygon.outside { fill: #4fb3e8; fill-opacity: .85; }
svg.map .phase polygon.inside { fill: #e67e22; fill-opacity: .5; }
svg.map .phase polygon.exchanged { fill-opacity: 1; }
svg.map .phase polygon.step { stroke: #ffe04d; stroke-width: 3; }
svg.map text.label { font: 12px system-ui, sans-serif; fill: #fff; stroke: #000; stroke-width: 3px; paint-order: stroke; text-anchor: middle; pointer-events: none; }
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
  const polygons = box.querySelectorAll('svg [data-made]'), first = input.value;
  const show = () => {
    const step = Number(input.value) - 1;
    for (const p of polygons) {
      const made = Number(p.dataset.made), consumed = Number(p.dataset.consumed);
      p.style.display = made <= step && step < consumed ? '' : 'none';
      p.classList.toggle('now', made === step && p.dataset.whole === '1');
    }
    for (const mark of box.querySelectorAll('.phase')) {
      mark.style.display = input.value === first ? '' : 'none';
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

QString page_tr(const char* text) { return QObject::tr(text); }

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
  QString text = web_text(page.text);
  for (const PageControl& control : page.controls) {
    const int value =
        control.kind == PageControl::Kind::option ? value_in(control, page.state.options) : -1;
    const QString shown =
        value < 0 ? QStringLiteral("…") : QString::fromStdString(at(control.labels, value));
    text.replace('{' + QString::fromStdString(control.name) + '}', shown);
  }
  return text;
}

QString answer_text(const Question& question, const Solved& solved) {
  QStringList right;
  if (question.kind == Question::Kind::curve) {
    for (std::size_t k = 0; k < solved.values.size(); ++k) {
      right << QStringLiteral("%1: %2").arg(QString::fromStdString(question.choices.at(k).text),
                                            value_text(question, solved.values[k]));
    }
    return right.join(QStringLiteral("; "));
  }
  for (const int k : solved.right) {
    if (question.kind == Question::Kind::patch) {
      right << page_tr("patch %1 (%2)").arg(k).arg(value_text(question, at(solved.values, k)));
    } else {
      const Question::Choice& choice = at(question.choices, k);
      right << (choice.text.empty() ? value_text(question, at(solved.values, k))
                                    : QString::fromStdString(choice.text));
    }
  }
  if (right.isEmpty() || question.rule == Question::Rule::nearest) {
    right << page_tr("computed: %1").arg(value_text(question, solved.value));
  }
  return right.join(QStringLiteral("; "));
}

QString question_html(const ShownPage& shown) {
  const Question& question = *shown.page.question;
  QString html = QStringLiteral("<div class=\"question\">") + html_of(web_text(question.ask));
  if (question.kind == Question::Kind::choice) {
    html += QStringLiteral("<ul>");
    for (const Question::Choice& choice : question.choices) {
      const QString text = choice.text.empty() ? value_text(question, choice.value->number)
                                               : QString::fromStdString(choice.text);
      html += QStringLiteral("<li>%1</li>").arg(text.toHtmlEscaped());
    }
    html += QStringLiteral("</ul>");
  }
  if (shown.solved) {
    html +=
        QStringLiteral("<details><summary>%1</summary><p><b>%2</b></p>%3</details>")
            .arg(page_tr("Reveal the answer"), answer_text(question, *shown.solved).toHtmlEscaped(),
                 html_of(web_text(question.then)));
  }
  return html + QStringLiteral("</div>\n");
}

QString map_html(const ShownPage& shown) {
  const MapHistory& history = shown.map->history;
  const bool all = history.record().rows.size() <= most_rows;
  const std::vector<std::string>& panels = shown.page.state.panels;
  const auto needs = [&](const char* panel) {
    return std::find(panels.begin(), panels.end(), panel) != panels.end();
  };
  if (shown.whole && !needs("section")) {
    QString sides;
    for (const bool receivers : {false, true}) {
      sides += QStringLiteral("<div>%1<p>%2</p></div>\n")
                   .arg(QString::fromUtf8(side_svg(*shown.map, receivers, shown.patch_colors)),
                        receivers ? page_tr("receives, along −ω") : page_tr("emits, along ω"));
    }
    return sides;
  }
  QString svg;
  for (const auto draw : {section_svg, map_svg}) {
    if (draw == section_svg ? needs("section") : !needs("section") || needs("map")) {
      svg += QString::fromUtf8(
          draw(*shown.map, shown.step, shown.patch_colors, all, shown.page.callouts));
    }
  }
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
      .arg(shown.step.last() + 1)
      .arg(page_tr("Step"));
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

QByteArray color_svg(const Color8& color) {
  return '#' + QByteArray(reinterpret_cast<const char*>(color.data()), 3).toHex();
}

/// @param whole  whether it is marked at the step that made it
/// @param strip  whether it is a strip of a section
QByteArray polygon_svg(const MapRecord::Row& row, std::span<const QPointF> corners, bool whole,
                       const std::vector<Color8>& patch_colors, bool shown, bool strip = false) {
  QByteArray svg = "<polygon data-made=\"" + QByteArray::number(row.made) + "\" data-consumed=\"" +
                   QByteArray::number(row.consumed) + "\" data-whole=\"" + (whole ? "1" : "0") +
                   "\" points=\"";
  for (const QPointF& p : corners) {
    svg += number(p.x()) + ',' + number(p.y()) + ' ';
  }
  svg += '"';
  const QByteArray kind = (strip ? "strip " : "") + QByteArray(row.front_facing ? "back" : "");
  if (!kind.isEmpty()) {
    svg += " class=\"" + kind.trimmed() + '"';
  }
  if (!row.front_facing) {
    svg += " fill=\"" + color_svg(at(patch_colors, row.patch)) + '"';
  }
  svg += shown ? ">" : " style=\"display:none\">";
  return svg + "<title>" + QObject::tr("patch %1").arg(row.patch).toUtf8() + "</title></polygon>";
}

QByteArray svg_begin(double width, double height) {
  return "<svg class=\"map\" viewBox=\"-8 -8 " + number(width + 16) + ' ' + number(height + 16) +
         "\" width=\"" + number(width + 16) +
         "\"><defs><pattern id=\"hatch\" width=\"6\" height=\"6\" "
         "patternUnits=\"userSpaceOnUse\"><rect width=\"6\" height=\"6\" "
         "fill=\"#3a4250\"/><path d=\"M0 6L6 0\" stroke=\"#6b7686\"/></pattern></defs>";
}

/// The part of the plane that a map fills, m, and its user units per meter.
struct SvgFrame {
  Vec2 low{std::numeric_limits<double>::max(), std::numeric_limits<double>::max()};
  Vec2 high{-low.x, -low.y};
  double scale = 1;
};

SvgFrame frame_of(const MapRecord& record) {
  SvgFrame frame;
  for (const Vec2& p : record.corners) {
    frame.low = {std::min(frame.low.x, p.x), std::min(frame.low.y, p.y)};
    frame.high = {std::max(frame.high.x, p.x), std::max(frame.high.y, p.y)};
  }
  frame.scale =
      map_width / std::max({frame.high.x - frame.low.x, frame.high.y - frame.low.y, 1e-300});
  return frame;
}

// Along omega: u to the left, v up.
std::vector<QPointF> corners_of(const SvgFrame& frame, const MapRecord& record,
                                const MapRecord::Row& row) {
  std::vector<QPointF> corners;
  for (const Vec2& p : record.outline(row)) {
    corners.emplace_back(frame.scale * (frame.high.x - p.x), frame.scale * (frame.high.y - p.y));
  }
  return corners;
}

/// Where omega leaves the plane: below the map, at the right.
QPointF omega_place(const SvgFrame& frame) {
  return {frame.scale * (frame.high.x - frame.low.x) - 24,
          frame.scale * (frame.high.y - frame.low.y) + 14};
}

/// An arrow seen from its end.
QByteArray omega_svg(const QPointF& place) {
  constexpr double radius = 6, half = 4.2;
  const QByteArray x = number(place.x()), y = number(place.y());
  return "<g stroke=\"#fff\" fill=\"none\"><circle cx=\"" + x + "\" cy=\"" + y + "\" r=\"" +
         number(radius) + "\"/><path d=\"M" + number(place.x() - half) + ' ' +
         number(place.y() - half) + 'L' + number(place.x() + half) + ' ' +
         number(place.y() + half) + 'M' + number(place.x() - half) + ' ' +
         number(place.y() + half) + 'L' + number(place.x() + half) + ' ' +
         number(place.y() - half) + "\"/></g><text x=\"" + number(place.x() + 10) + "\" y=\"" +
         number(place.y() + 5) + "\" fill=\"#fff\">ω</text>";
}

/// The number of a polygon's patch, if it has room.
QByteArray label_svg(const MapRecord::Row& row, const std::vector<QPointF>& corners, bool shown) {
  constexpr double least_area = 500;
  QPointF middle;
  double twice_area = 0;
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const QPointF &a = corners[k], &b = corners[(k + 1) % corners.size()];
    middle += a / static_cast<double>(corners.size());
    twice_area += a.x() * b.y() - b.x() * a.y();
  }
  if (std::abs(twice_area) / 2 < least_area) {
    return {};
  }
  return "<text class=\"label\" data-made=\"" + QByteArray::number(row.made) +
         "\" data-consumed=\"" + QByteArray::number(row.consumed) + "\" x=\"" + number(middle.x()) +
         "\" y=\"" + number(middle.y() + 4) + (shown ? "\">" : "\" style=\"display:none\">") +
         QByteArray::number(row.patch) + "</text>";
}

/// The marks of a phase over V before a step: the polygon of the step, and what it cuts, or its
/// parts.
QByteArray phase_svg(const RecordedMap& map, const SvgFrame& frame, const ShownStep& shown) {
  if (shown.phase == Phase::after || shown.step < 0 || shown.step >= map.history.step_count()) {
    return {};
  }
  QByteArray svg = "<g class=\"phase\">";
  const auto add = [&](std::int32_t r, const QByteArray& kind) {
    svg += "<polygon class=\"" + kind + "\" points=\"";
    for (const QPointF& p : corners_of(frame, map.record(), map.row(r))) {
      svg += number(p.x()) + ',' + number(p.y()) + ' ';
    }
    svg += "\"/>";
  };
  if (shown.phase == Phase::before) {
    for (const std::int32_t r : map.history.cut_at(shown.step)) {
      add(r, "cut");
    }
  } else {
    for (const std::int32_t r : map.history.outside_at(shown.step)) {
      add(r, "outside");
    }
    for (const std::int32_t r : map.history.inside_at(shown.step)) {
      add(r, map.history.exchanges(r) ? "inside exchanged" : "inside");
    }
  }
  if (const std::int32_t row = map.history.step(shown.step).row; row != MapRecord::no_row) {
    add(row, "step");
  }
  return svg + "</g>";
}

}  // namespace

QByteArray map_svg(const RecordedMap& map, const ShownStep& shown_step,
                   const std::vector<Color8>& patch_colors, bool all,
                   const std::vector<Callout>& callouts) {
  const std::int32_t step = shown_step.step, last = shown_step.last();
  const MapRecord& record = map.record();
  const SvgFrame frame = frame_of(record);
  const double scale = frame.scale, width = scale * (frame.high.x - frame.low.x);
  QByteArray svg = svg_begin(width, scale * (frame.high.y - frame.low.y) + omega_room), labels;
  for (const MapRecord::Row& row : record.rows) {
    const bool shown = row.made <= last && last < row.consumed;
    if (!shown && !all) {
      continue;
    }
    const std::vector<QPointF> corners = corners_of(frame, record, row);
    svg += polygon_svg(row, corners, row.parent == MapRecord::no_row, patch_colors, shown);
    if (shown_step.labels) {
      labels += label_svg(row, corners, shown);
    }
  }
  svg += phase_svg(map, frame, shown_step) + labels;
  std::vector<QRectF> taken;
  const std::vector<std::int32_t> rows = record.map_after(step);
  for (const Callout& callout : callouts) {
    std::optional<QPointF> at;
    if (const auto place = place_in_map(callout, map, rows, step)) {
      at = QPointF(scale * (frame.high.x - place->x), scale * (frame.high.y - place->y));
    } else if (callout.anchor == Callout::Anchor::direction) {
      at = omega_place(frame);
    }
    if (at) {
      svg += callout_svg(QString::fromStdString(callout.text), at->x(), at->y(), width, taken);
    }
  }
  return svg + omega_svg(omega_place(frame)) + "</svg>";
}

// The BSP order is the order from the top: seen along omega, later fragments cover earlier ones.
QByteArray side_svg(const RecordedMap& map, bool receivers,
                    const std::vector<Color8>& patch_colors) {
  const MapRecord& record = map.record();
  const SvgFrame frame = frame_of(record);
  QByteArray svg = svg_begin(frame.scale * (frame.high.x - frame.low.x),
                             frame.scale * (frame.high.y - frame.low.y) + omega_room);
  const std::int32_t count = map.history.step_count();
  for (std::int32_t n = 0; n < count; ++n) {
    // The farthest first.
    const MapHistory::Step& step = map.history.step(receivers ? count - 1 - n : n);
    if (step.row == MapRecord::no_row || step.front_facing != receivers) {
      continue;
    }
    const MapRecord::Row& row = map.row(step.row);
    MapRecord::Row front = row;
    front.front_facing = false;  // its front is seen
    svg += polygon_svg(front, corners_of(frame, record, row), true, patch_colors, true);
  }
  return svg + omega_svg(omega_place(frame)) + "</svg>";
}

QByteArray section_svg(const RecordedMap& map, const ShownStep& shown_step,
                       const std::vector<Color8>& patch_colors, bool all,
                       const std::vector<Callout>& callouts) {
  const std::int32_t step = shown_step.step, last = shown_step.last();
  const Section section = section_of(map);
  const auto [left, right, bottom, top] = section.box();
  constexpr double bar = 10;
  const double scale = map_width / std::max({right - left, top - bottom, 1e-300});
  const auto place = [&, left = left, top = top](const Vec2& p) {
    return QPointF(scale * (p.x - left), scale * (top - p.y));
  };
  QByteArray svg = svg_begin(scale * (right - left), scale * (top - bottom) + bar);
  for (const bool strips : {true, false}) {
    for (const Section::Interval& interval : section.intervals) {
      const MapRecord::Row& row = map.row(interval.row);
      const bool shown = row.made <= last && last < row.consumed;
      const auto strip = strip_of(section, map, interval, no_patch);
      if (!strip || (!shown && !all)) {
        continue;
      }
      std::array<QPointF, 4> corners;
      std::transform(strip->begin(), strip->end(), corners.begin(), place);
      if (!strips) {  // a bar below the line
        const QPointF down(-bar * section.omega.x, bar * section.omega.y);
        corners = {corners[0], corners[3], corners[3] + down, corners[0] + down};
      }
      const bool whole = !strips && row.parent == MapRecord::no_row;
      svg += polygon_svg(row, corners, whole, patch_colors, shown, strips);
    }
  }
  for (const Section::Segment& segment : section.segments) {
    const QPointF a = place(segment.a), b = place(segment.b);
    svg += "<line x1=\"" + number(a.x()) + "\" y1=\"" + number(a.y()) + "\" x2=\"" + number(b.x()) +
           "\" y2=\"" + number(b.y()) + "\" stroke=\"" +
           color_svg(at(patch_colors, segment.patch)) + "\"><title>" +
           QObject::tr("patch %1").arg(segment.patch).toUtf8() + "</title></line>";
  }
  std::vector<QRectF> taken;
  for (const Callout& callout : callouts) {
    if (const auto point = place_in_section(callout, section, map, step)) {
      const QPointF at = place(*point);
      svg += callout_svg(QString::fromStdString(callout.text), at.x(), at.y(),
                         scale * (right - left), taken);
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
    const QString text = text_of(shown.page);
    if (text.trimmed().isEmpty() && !shown.page.text.empty()) {
      continue;  // the page speaks of the window only
    }
    html += QStringLiteral("<section><h2>%1</h2>\n")
                .arg(QString::fromStdString(shown.page.title).toHtmlEscaped());
    html += html_of(text) + QStringLiteral("<div class=\"views\">\n");
    if (!shown.picture.isEmpty()) {
      html += QStringLiteral("<img alt=\"%1\" src=\"data:image/png;base64,%2\">\n")
                  .arg(page_tr("The scene"), QString::fromLatin1(shown.picture.toBase64()));
    }
    if (shown.map) {
      html += map_html(shown);
    }
    for (const PanelPicture& panel : shown.panels) {
      html += QStringLiteral(
                  "<figure><img alt=\"%1\" src=\"data:image/png;base64,%2\">"
                  "<figcaption>%1</figcaption></figure>\n")
                  .arg(panel.title.toHtmlEscaped(), QString::fromLatin1(panel.picture.toBase64()));
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
