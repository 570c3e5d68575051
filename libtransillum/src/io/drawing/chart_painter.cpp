// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Lays out a LineChart (title, legend, axes, plot) and paints it, from the background to the
// labels. Lengths are in user units of the Cairo context, y downward.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include "io/drawing/chart_canvas.h"
#include "io/text.h"

namespace transillum {
namespace {

/// Distances: from an axis to its labels, from these to the title, from a sample to its name.
constexpr double label_gap = 6, title_gap = 10, name_gap = 6;
constexpr double tick_length = 4;
/// Lengths of the line samples in a legend row and a legend column.
constexpr double row_sample = 20, column_sample = 36;
constexpr double not_shown = std::numeric_limits<double>::quiet_NaN();

double line_of(double size) { return 1.2 * size; }
double width_of(const ChartArea& area) { return area.right - area.left; }
double height_of(const ChartArea& area) { return area.bottom - area.top; }

/// The fraction of an axis that is below `value`; NaN for values that cannot be shown.
double fraction_of(const ChartAxis& axis, double value) {
  const auto at = [&](double v) { return axis.logarithmic ? std::log10(v) : v; };
  const double fraction = (at(value) - at(axis.low)) / (at(axis.high) - at(axis.low));
  return std::isfinite(fraction) ? fraction : not_shown;
}

LineChart with_clean_texts(LineChart chart) {
  for (std::string* text :
       {&chart.title, &chart.hint, &chart.note_title, &chart.x.title, &chart.y.title}) {
    *text = clean_text(*text);
  }
  for (ChartAxis* axis : {&chart.x, &chart.y}) {
    for (ChartTick& tick : axis->ticks) {
      tick.label = clean_text(tick.label);
    }
  }
  for (ChartSeries& series : chart.series) {
    series.name = clean_text(series.name);
    series.note = clean_text(series.note);
  }
  return chart;
}

/// Keeps the lowest and highest of the points in each column of width 1, which looks the same and
/// draws faster.
std::vector<ChartPoint> thinned(const std::vector<ChartPoint>& points) {
  std::vector<ChartPoint> kept;
  for (std::size_t begin = 0, end = 0; begin < points.size(); begin = end) {
    const double column = std::floor(points[begin].x);
    std::size_t low = begin, high = begin;
    for (end = begin + 1; end < points.size() && std::floor(points[end].x) == column; ++end) {
      const double y = points[end].y;
      low = y < points[low].y || std::isnan(points[low].y) ? end : low;
      high = y > points[high].y || std::isnan(points[high].y) ? end : high;
    }
    kept.push_back(points[std::min(low, high)]);
    if (low != high) {
      kept.push_back(points[std::max(low, high)]);
    }
  }
  return kept;
}

/// One chart and the layout of its parts.
class ChartPainter {
 public:
  ChartPainter(cairo_t* cairo, const LineChart& chart, double width, double height,
               ChartDevice* device)
      : chart_(with_clean_texts(chart)),
        style_(chart.style),
        width_(width),
        height_(height),
        canvas_(cairo, style_.font, device),
        has_paper_(device == nullptr),
        title_{style_.title_size, style_.ink, style_.bold_title},
        axis_title_{style_.text_size, style_.dim},
        label_{style_.label_size, style_.ink},
        legend_text_(label_),
        legend_(chart.legend) {
    if (legend_.empty()) {
      legend_.resize(chart_.series.size());
      std::iota(legend_.begin(), legend_.end(), 0);
    }
    std::erase_if(legend_, [&](std::size_t k) { return chart_.series[k].name.empty(); });
  }

  ChartArea paint();

 private:
  double measure_legend();
  void lay_out();
  void lay_out_rows();
  void keep_labels_apart(ChartAxis& axis, double length, bool across);
  double x_of(double value) const;
  double y_of(double value) const;
  void draw_title();
  void draw_grid(bool fine);
  void draw_axes();
  void draw_labels();
  void draw_series(const ChartSeries& series);
  void draw_hint();
  void draw_sample(const ChartSeries& series, const ChartPoint& begin, double length);
  void draw_legend_rows();
  void draw_legend_column();

  LineChart chart_;
  const ChartStyle& style_;
  double width_, height_;
  ChartCanvas canvas_;
  bool has_paper_;
  ChartText title_, axis_title_, label_, legend_text_;
  ChartArea plot_;
  std::vector<std::size_t> legend_;      ///< named series
  std::vector<ChartPoint> legend_rows_;  ///< where each begins, y from the first row
  double legend_left_ = 0;               ///< left edge, where the legend is a column
};

/// Sets the font size of the legend to the largest that fits; returns the width of its column.
double ChartPainter::measure_legend() {
  if (chart_.legend_below_title || legend_.empty()) {
    return 0;
  }
  double names = 0, notes = canvas_.width_of(chart_.note_title, legend_text_);
  for (const std::size_t k : legend_) {
    names = std::max(names, canvas_.width_of(chart_.series[k].name, legend_text_));
    notes = std::max(notes, canvas_.width_of(chart_.series[k].note, legend_text_));
  }
  const double fixed = column_sample + name_gap + (notes > 0 ? 14 : 0);
  const double most = 0.38 * width_ - fixed;
  const double shrink = std::clamp(most / std::max(names + notes, 1.0), 0.4, 1.0);
  if (shrink < 1) {
    legend_text_.size = std::floor(shrink * legend_text_.size);
  }
  return fixed + std::min(most, shrink * (names + notes));
}

/// Places the legend below the title, in as many rows as a fifth of the height has room for.
void ChartPainter::lay_out_rows() {
  const double row = line_of(label_.size), left = 1.5 * style_.margin, right = width_ - left;
  ChartPoint at{left, 0};
  for (const std::size_t k : legend_) {
    const double length =
        row_sample + name_gap + canvas_.width_of(chart_.series[k].name, legend_text_);
    if (at.x > left && at.x + length > right && at.y + 2 * row <= 0.2 * height_) {
      at = {left, at.y + row};
    }
    legend_rows_.push_back(at);
    at.x += length + label_.size;
  }
}

void ChartPainter::lay_out() {
  const double margin = style_.margin, line = line_of(label_.size);
  const double title = line_of(axis_title_.size);
  double labels = 0;
  for (const ChartTick& tick : chart_.y.ticks) {
    labels = std::max(labels, canvas_.width_of(tick.label, label_));
  }
  const double last_label =
      chart_.x.ticks.empty() ? 0 : canvas_.width_of(chart_.x.ticks.back().label, label_);
  const double legend = measure_legend();
  legend_left_ = width_ - margin - legend;
  const double beside_labels = chart_.axis_titles ? title_gap + title : label_gap;
  // Whole pixels, so that all lines of the axes are sharp.
  plot_.left = std::ceil(margin + labels + beside_labels);
  plot_.right = std::floor(legend > 0 ? legend_left_ - 1.2 * margin
                                      : width_ - std::max(2.5 * margin, last_label / 2 + 2));
  plot_.top = margin + line_of(title_.size) + margin;
  if (chart_.legend_below_title) {
    lay_out_rows();
    plot_.top += line + (legend_rows_.empty() ? 0 : legend_rows_.back().y);
  }
  plot_.top = std::ceil(plot_.top);
  plot_.bottom = std::floor(height_ - line - beside_labels - 0.5 * margin);
  keep_labels_apart(chart_.x, width_of(plot_), true);
  keep_labels_apart(chart_.y, height_of(plot_), false);
}

/// Removes ticks outside the axis, labels that would touch another, and grid lines too close to
/// each other. Starts at the last tick, whose label is the most important.
void ChartPainter::keep_labels_apart(ChartAxis& axis, double length, bool across) {
  double free = HUGE_VAL, last_line = HUGE_VAL;
  std::vector<ChartTick> kept;
  for (auto tick = axis.ticks.rbegin(); tick != axis.ticks.rend(); ++tick) {
    const double at = length * fraction_of(axis, tick->value);
    if (!(at > -0.5 && at < length + 0.5)) {
      continue;
    }
    if (!tick->label.empty()) {
      const double half =
          (across ? canvas_.width_of(tick->label, label_) : line_of(label_.size)) / 2;
      if (at + half > free) {
        tick->label.clear();
      } else {
        free = at - half - (across ? 0.6 * label_.size : 0);
      }
    }
    if (tick->label.empty() && last_line - at < 3) {
      continue;
    }
    last_line = at;
    kept.push_back(*tick);
  }
  axis.ticks = std::move(kept);
}

// The limits keep all coordinates in the range of Cairo's.
double ChartPainter::x_of(double value) const {
  return std::clamp(plot_.left + fraction_of(chart_.x, value) * width_of(plot_), -1e6, 1e6);
}

double ChartPainter::y_of(double value) const {
  return std::clamp(plot_.bottom - fraction_of(chart_.y, value) * height_of(plot_), -1e6, 1e6);
}

void ChartPainter::draw_title() {
  const double middle = style_.margin + line_of(title_.size) / 2;
  const double left = chart_.legend_below_title ? 1.5 * style_.margin : plot_.left;
  double right = width_ - 1.5 * style_.margin;
  if (!chart_.axis_titles) {
    canvas_.draw(chart_.x.title, {right, middle}, 1, axis_title_);
    right -= canvas_.width_of(chart_.x.title, axis_title_) + style_.margin;
  }
  canvas_.draw(canvas_.elided(chart_.title, right - left, title_), {left, middle}, 0, title_);
}

void ChartPainter::draw_grid(bool fine) {
  const ChartPen pen{style_.grid, (fine ? 0.4 : 1) * style_.line_width};
  const auto draw = [&](const ChartAxis& axis, const auto& line_at) {
    for (const ChartTick& tick : axis.ticks) {
      if (axis.grid && tick.minor == fine) {
        canvas_.draw(line_at(tick.value), pen);
      }
    }
  };
  draw(chart_.x, [&](double x) {
    return std::array<ChartPoint, 2>{{{x_of(x), plot_.top}, {x_of(x), plot_.bottom}}};
  });
  draw(chart_.y, [&](double y) {
    return std::array<ChartPoint, 2>{{{plot_.left, y_of(y)}, {plot_.right, y_of(y)}}};
  });
}

void ChartPainter::draw_axes() {
  const ChartPen pen{style_.framed ? style_.dim : style_.ink, style_.line_width};
  const auto& [left, top, right, bottom] = plot_;
  const auto draw = [&](const ChartPoint& a, const ChartPoint& b) {
    canvas_.draw(std::array{a, b}, pen);
  };
  const double corner = style_.line_width / 2;
  draw({left, bottom}, {right, bottom});
  draw({left, top - corner}, {left, bottom + corner});
  if (style_.framed) {
    draw({left, top}, {right, top});
    draw({right, top - corner}, {right, bottom + corner});
  }
  for (const ChartTick& tick : chart_.x.ticks) {
    if (!tick.minor) {
      draw({x_of(tick.value), bottom}, {x_of(tick.value), bottom + tick_length});
    }
  }
}

void ChartPainter::draw_labels() {
  const double below = plot_.bottom + label_gap + line_of(label_.size) / 2;
  for (const ChartTick& tick : chart_.x.ticks) {
    canvas_.draw(tick.label, {x_of(tick.value), below}, 0.5, label_);
  }
  for (const ChartTick& tick : chart_.y.ticks) {
    canvas_.draw(tick.label, {plot_.left - label_gap, y_of(tick.value)}, 1, label_);
  }
  if (!chart_.axis_titles) {
    return;
  }
  const double half = line_of(axis_title_.size) / 2;
  canvas_.draw(
      chart_.x.title,
      {(plot_.left + plot_.right) / 2, plot_.bottom + line_of(label_.size) + title_gap + half}, 0.5,
      axis_title_);
  // Beside the plot; a long title extends downward, where nothing else is.
  const double room = height_ - style_.margin - plot_.top;
  const std::string title = canvas_.elided(chart_.y.title, room, axis_title_);
  const double length = canvas_.width_of(title, axis_title_);
  canvas_.draw(title, {style_.margin + half, plot_.top + std::max(height_of(plot_), length) / 2},
               0.5, axis_title_, true);
}

/// Draws the line between gaps, and markers whose centers are in the plot.
void ChartPainter::draw_series(const ChartSeries& series) {
  std::vector<ChartPoint> points;
  points.reserve(series.points.size());
  for (const ChartPoint& point : series.points) {
    points.push_back({x_of(point.x), y_of(point.y)});
  }
  if (static_cast<double>(points.size()) > 2 * width_of(plot_)) {
    points = thinned(points);
  }
  const ChartArea area{plot_.left - 1, plot_.top - 1, plot_.right + 1, plot_.bottom + 1};
  const auto is_gap = [](const ChartPoint& p) { return std::isnan(p.x) || std::isnan(p.y); };
  canvas_.clip(area);
  for (auto begin = points.begin(); begin != points.end();) {
    const auto end = std::find_if(begin, points.end(), is_gap);
    canvas_.draw(std::span(begin, end), {series.color, series.width, series.dashes});
    begin = std::find_if_not(end, points.end(), is_gap);
  }
  canvas_.clip_nothing();
  for (const ChartPoint& p : points) {
    if (p.x > area.left && p.x < area.right && p.y > area.top && p.y < area.bottom) {
      canvas_.draw_marker(p, series, style_.paper);
    }
  }
}

/// Draws the hint in the middle of the plot, wrapped to its width.
void ChartPainter::draw_hint() {
  const double room = width_of(plot_) - 8;
  std::vector<std::string> lines;
  std::size_t begin = 0;
  while (begin < chart_.hint.size()) {
    std::size_t end = chart_.hint.find(' ', begin);
    const std::string word = chart_.hint.substr(begin, end - begin);
    const std::string joined = lines.empty() ? word : lines.back() + " " + word;
    if (!lines.empty() && canvas_.width_of(joined, axis_title_) <= room) {
      lines.back() = joined;
    } else {
      lines.push_back(canvas_.elided(word, room, axis_title_));
    }
    begin = end == std::string::npos ? end : end + 1;
  }
  const double line = line_of(axis_title_.size), middle = (plot_.left + plot_.right) / 2;
  double y = (plot_.top + plot_.bottom - (static_cast<double>(lines.size()) - 1) * line) / 2;
  for (const std::string& text : lines) {
    const double half = canvas_.width_of(text, axis_title_) / 2 + 4;
    canvas_.fill({middle - half, y - line / 2, middle + half, y + line / 2}, style_.paper);
    canvas_.draw(text, {middle, y}, 0.5, axis_title_);
    y += line;
  }
}

void ChartPainter::draw_sample(const ChartSeries& series, const ChartPoint& begin, double length) {
  canvas_.draw(std::array{begin, ChartPoint{begin.x + length, begin.y}},
               {series.color, series.width, series.dashes});
  canvas_.draw_marker({begin.x + length / 2, begin.y}, series, style_.paper);
}

void ChartPainter::draw_legend_rows() {
  const double first = 1.25 * style_.margin + line_of(title_.size) + line_of(label_.size) / 2;
  const double right = width_ - 1.5 * style_.margin;
  for (std::size_t n = 0; n < legend_.size(); ++n) {
    const ChartSeries& series = chart_.series[legend_[n]];
    const ChartPoint at{legend_rows_[n].x, first + legend_rows_[n].y};
    const double name_left = at.x + row_sample + name_gap;
    const std::string name = canvas_.elided(series.name, right - name_left, legend_text_);
    if (name.empty()) {
      return;
    }
    draw_sample(series, at, row_sample);
    canvas_.draw(name, {name_left, at.y}, 0, legend_text_);
  }
}

void ChartPainter::draw_legend_column() {
  const double right = width_ - style_.margin;
  const double row =
      std::min(1.85 * label_.size, height_of(plot_) / (1.0 + static_cast<double>(legend_.size())));
  double middle = plot_.top + row / 2;
  if (!chart_.note_title.empty()) {
    canvas_.draw(chart_.note_title, {right, middle}, 1,
                 {legend_text_.size, style_.dim, legend_text_.bold});
    middle += row;
  }
  for (const std::size_t k : legend_) {
    const ChartSeries& series = chart_.series[k];
    const double name_left = legend_left_ + column_sample + name_gap;
    const double room = right - canvas_.width_of(series.note, legend_text_) - name_left;
    draw_sample(series, {legend_left_, middle}, column_sample);
    canvas_.draw(canvas_.elided(series.name, room, legend_text_), {name_left, middle}, 0,
                 legend_text_);
    canvas_.draw(series.note, {right, middle}, 1, legend_text_);
    middle += row;
  }
}

ChartArea ChartPainter::paint() {
  lay_out();
  if (has_paper_) {
    canvas_.fill({0, 0, width_, height_}, style_.paper);
  }
  draw_title();
  if (width_of(plot_) < 40 || height_of(plot_) < 20) {
    return plot_;
  }
  draw_grid(true);
  draw_grid(false);
  draw_axes();
  for (const ChartSeries& series : chart_.series) {
    draw_series(series);
  }
  draw_hint();
  draw_labels();
  if (chart_.legend_below_title) {
    draw_legend_rows();
  } else {
    draw_legend_column();
  }
  return plot_;
}

}  // namespace

ChartArea paint_chart(cairo_t* cairo, const LineChart& chart, double width, double height,
                      ChartDevice* device) {
  return ChartPainter(cairo, chart, width, height, device).paint();
}

}  // namespace transillum
