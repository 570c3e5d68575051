// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Lays out a LineChart (title, axes, plot, legend) and paints it: the plot by VTK's chart, all text
// and the legend directly. Lengths are in user units of the Cairo context.
#include "io/vtk/chart_painter.h"

#include <vtkBrush.h>
#include <vtkContext2D.h>
#include <vtkContextScene.h>
#include <vtkNew.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>

#include "io/clean_text.h"
#include "io/vtk/cairo_context_device.h"
#include "io/vtk/chart_plots.h"

namespace transillum {
namespace {

/// VTK's gap between labels and axis title.
constexpr double axis_title_gap = 10;
/// Lengths of the line samples in a legend row and a legend column.
constexpr double row_sample = 20, column_sample = 36;

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

/// One chart and the layout of its parts. y runs downward here, upward in VTK.
class ChartPainter {
 public:
  ChartPainter(cairo_t* cairo, const LineChart& chart, double width, double height)
      : chart_(with_clean_texts(chart)), style_(chart.style), width_(width), height_(height) {
    device_->draw_on(cairo, height);
    context_->Begin(device_);
    legend_ = chart_.legend;
    if (legend_.empty()) {
      legend_.resize(chart_.series.size());
      std::iota(legend_.begin(), legend_.end(), 0);
    }
    std::erase_if(legend_, [&](std::size_t k) { return chart_.series[k].name.empty(); });
  }
  ~ChartPainter() { context_->End(); }
  ChartPainter(const ChartPainter&) = delete;
  ChartPainter& operator=(const ChartPainter&) = delete;

  ChartArea paint();

 private:
  double line_of(double size) const { return 1.2 * size; }
  double width_of(const std::string& text, double size, bool bold = false);
  /// `text`, shortened with an ellipsis if it is wider than `room`.
  std::string elided(const std::string& text, double room, double size, bool bold = false);
  void draw(const std::string& text, double x, double middle, double align, double size,
            const ChartColor& color, bool bold = false);

  double measure_legend();
  void lay_out();
  void keep_labels_apart(ChartAxis& axis, double length, bool across);
  void draw_title();
  void draw_hint();
  void draw_legend_row(const std::vector<vtkPlot*>& plots);
  void draw_legend_column(const std::vector<vtkPlot*>& plots);
  void draw_sample(vtkPlot& plot, double x, double middle, double width);

  LineChart chart_;
  const ChartStyle& style_;
  double width_, height_;
  ChartArea plot_;
  std::vector<std::size_t> legend_;
  double legend_size_ = 0, legend_left_ = 0;
  vtkNew<CairoContextDevice> device_;
  vtkNew<vtkContext2D> context_;
  vtkNew<vtkTextProperty> text_;
};

double ChartPainter::width_of(const std::string& text, double size, bool bold) {
  set_text(*text_, style_, size, style_.ink, bold);
  context_->ApplyTextProp(text_);
  float bounds[4];
  device_->ComputeStringBounds(text, bounds);
  return bounds[2];
}

std::string ChartPainter::elided(const std::string& text, double room, double size, bool bold) {
  if (width_of(text, size, bold) <= room) {
    return text;
  }
  std::size_t fits = 0, end = text.size();  // bytes
  while (fits < end) {
    const std::size_t middle = (fits + end + 1) / 2;
    if (width_of(clean_text(text.substr(0, middle)) + "…", size, bold) <= room) {
      fits = middle;
    } else {
      end = middle - 1;
    }
  }
  while (fits > 0 && (static_cast<unsigned char>(text[fits]) & 0xC0) == 0x80) {
    --fits;
  }
  return fits == 0 ? std::string() : text.substr(0, fits) + "…";
}

void ChartPainter::draw(const std::string& text, double x, double middle, double align, double size,
                        const ChartColor& color, bool bold) {
  set_text(*text_, style_, size, color, bold);
  text_->SetVerticalJustificationToCentered();
  text_->SetJustification(align == 0   ? VTK_TEXT_LEFT
                          : align == 1 ? VTK_TEXT_RIGHT
                                       : VTK_TEXT_CENTERED);
  context_->ApplyTextProp(text_);
  float point[2] = {static_cast<float>(x), static_cast<float>(height_ - middle)};
  device_->DrawString(point, text);
}

/// Sets legend_size_ to the largest font size that fits; returns the width of the legend's column.
double ChartPainter::measure_legend() {
  legend_size_ = style_.label_size;
  if (chart_.legend_below_title || legend_.empty()) {
    return 0;
  }
  double names = 0, notes = width_of(chart_.note_title, legend_size_);
  for (const std::size_t k : legend_) {
    names = std::max(names, width_of(chart_.series[k].name, legend_size_));
    notes = std::max(notes, width_of(chart_.series[k].note, legend_size_));
  }
  const double fixed = column_sample + 7 + (notes > 0 ? 14 : 0);
  const double max_text_width = 0.38 * width_ - fixed;
  const double shrink = std::clamp(max_text_width / std::max(names + notes, 1.0), 0.4, 1.0);
  legend_size_ = shrink < 1 ? std::floor(shrink * legend_size_) : legend_size_;
  return fixed + std::min(max_text_width, shrink * (names + notes));
}

void ChartPainter::lay_out() {
  const double margin = style_.margin, line = line_of(style_.label_size);
  const double title = line_of(style_.text_size);
  double labels = 0;
  for (const ChartTick& tick : chart_.y.ticks) {
    labels = std::max(labels, width_of(tick.label, style_.label_size));
  }
  const double last_label =
      chart_.x.ticks.empty() ? 0 : width_of(chart_.x.ticks.back().label, style_.label_size);
  const double legend = measure_legend();
  plot_.left = margin + labels + (chart_.axis_titles ? axis_title_gap + title : 6);
  plot_.right =
      width_ - (legend > 0 ? legend + 2.2 * margin : std::max(2.5 * margin, last_label / 2 + 2));
  plot_.top = margin + line_of(style_.title_size) + margin;
  if (chart_.legend_below_title) {
    plot_.top += line;
  }
  plot_.bottom =
      height_ - (chart_.axis_titles ? line + axis_title_gap + title : line + 6) - 0.5 * margin;
  // Round to whole pixels, as VTK does for its axes.
  for (double* side : {&plot_.left, &plot_.top}) {
    *side = std::ceil(*side);
  }
  for (double* side : {&plot_.right, &plot_.bottom}) {
    *side = std::floor(*side);
  }
  legend_left_ = width_ - margin - legend;
  keep_labels_apart(chart_.x, plot_.right - plot_.left, true);
  keep_labels_apart(chart_.y, plot_.bottom - plot_.top, false);
}

/// Removes labels that would touch another, and grid lines too close to each other. Starts at the
/// last tick, whose label is the most important.
void ChartPainter::keep_labels_apart(ChartAxis& axis, double length, bool across) {
  const double low = axis_value(axis, axis.low), high = axis_value(axis, axis.high);
  double free = HUGE_VAL, last_line = HUGE_VAL;
  std::vector<ChartTick> kept;
  for (auto tick = axis.ticks.rbegin(); tick != axis.ticks.rend(); ++tick) {
    const double at = length * (axis_value(axis, tick->value) - low) / (high - low);
    if (!(at > -0.5 && at < length + 0.5)) {
      continue;
    }
    if (!tick->label.empty()) {
      const double half =
          across ? width_of(tick->label, style_.label_size) / 2 : line_of(style_.label_size) / 2;
      if (at + half > free) {
        tick->label.clear();
      } else {
        free = at - half - (across ? 0.6 * style_.label_size : 0);
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

void ChartPainter::draw_title() {
  const double size = style_.title_size, middle = style_.margin + line_of(size) / 2;
  const double left = chart_.legend_below_title ? 1.5 * style_.margin : plot_.left;
  double right = width_ - 1.5 * style_.margin;
  if (!chart_.axis_titles) {
    draw(chart_.x.title, right, middle, 1, style_.text_size, style_.dim);
    right -= width_of(chart_.x.title, style_.text_size) + style_.margin;
  }
  draw(elided(chart_.title, right - left, size, style_.bold_title), left, middle, 0, size,
       style_.ink, style_.bold_title);
}

/// Draws the hint in the middle of the plot, wrapped to its width.
void ChartPainter::draw_hint() {
  const double room = plot_.right - plot_.left - 8;
  std::vector<std::string> lines;
  std::size_t begin = 0;
  while (begin < chart_.hint.size()) {
    std::size_t end = chart_.hint.find(' ', begin);
    const std::string word = chart_.hint.substr(begin, end - begin);
    const std::string joined = lines.empty() ? word : lines.back() + " " + word;
    if (!lines.empty() && width_of(joined, style_.text_size) <= room) {
      lines.back() = joined;
    } else {
      lines.push_back(elided(word, room, style_.text_size));
    }
    begin = end == std::string::npos ? end : end + 1;
  }
  const double line = line_of(style_.text_size);
  double middle = (plot_.top + plot_.bottom - (static_cast<double>(lines.size()) - 1) * line) / 2;
  for (const std::string& text : lines) {
    draw(text, (plot_.left + plot_.right) / 2, middle, 0.5, style_.text_size, style_.dim);
    middle += line;
  }
}

void ChartPainter::draw_sample(vtkPlot& plot, double x, double middle, double width) {
  const vtkRectf place(static_cast<float>(x), static_cast<float>(height_ - middle),
                       static_cast<float>(width), 0);
  plot.PaintLegend(context_, place, 0);
}

void ChartPainter::draw_legend_row(const std::vector<vtkPlot*>& plots) {
  const double size = style_.label_size, middle = plot_.top - line_of(size) / 2 - 6;
  double x = plot_.left;
  for (const std::size_t k : legend_) {
    const std::string name = elided(chart_.series[k].name, plot_.right - x - row_sample - 5, size);
    if (name.empty()) {
      return;
    }
    draw_sample(*plots[k], x, middle, row_sample);
    draw(name, x + row_sample + 5, middle, 0, size, style_.ink);
    x += row_sample + 5 + width_of(name, size) + size;
  }
}

void ChartPainter::draw_legend_column(const std::vector<vtkPlot*>& plots) {
  const double right = width_ - style_.margin;
  const double row =
      std::min(1.85 * style_.label_size,
               (plot_.bottom - plot_.top) / (1.0 + static_cast<double>(legend_.size())));
  double middle = plot_.top + row / 2;
  if (!chart_.note_title.empty()) {
    draw(chart_.note_title, right, middle, 1, legend_size_, style_.dim);
    middle += row;
  }
  for (const std::size_t k : legend_) {
    const ChartSeries& series = chart_.series[k];
    const double name_left = legend_left_ + column_sample + 7;
    const double note = width_of(series.note, legend_size_);
    draw_sample(*plots[k], legend_left_, middle, column_sample);
    draw(elided(series.name, right - note - name_left, legend_size_), name_left, middle, 0,
         legend_size_, style_.ink);
    draw(series.note, right, middle, 1, legend_size_, style_.ink);
    middle += row;
  }
}

ChartArea ChartPainter::paint() {
  lay_out();
  draw_title();
  const double plot_width = plot_.right - plot_.left, plot_height = plot_.bottom - plot_.top;
  if (plot_width < 40 || plot_height < 20) {
    return plot_;
  }
  const vtkNew<vtkChartXY> chart;
  chart->SetLayoutStrategy(vtkChart::AXES_TO_RECT);
  chart->SetSize(vtkRectf(static_cast<float>(plot_.left),
                          static_cast<float>(height_ - plot_.bottom),
                          static_cast<float>(plot_width), static_cast<float>(plot_height)));
  chart->SetShowLegend(false);
  chart->SetRenderEmpty(true);
  chart->GetBackgroundBrush()->SetOpacity(0);
  if (chart_.axis_titles) {
    chart_.y.title = elided(chart_.y.title, plot_height + 2 * style_.text_size, style_.text_size);
  }
  add_axes(*chart, chart_);
  const std::vector<vtkPlot*> plots = add_plots(*chart, chart_, plot_width);
  const vtkNew<vtkContextScene> scene;
  scene->SetGeometry(static_cast<int>(width_), static_cast<int>(height_));
  scene->AddItem(chart);
  scene->Paint(context_);
  draw_hint();
  if (chart_.legend_below_title) {
    draw_legend_row(plots);
  } else {
    draw_legend_column(plots);
  }
  return plot_;
}

}  // namespace

ChartArea paint_chart(cairo_t* cairo, const LineChart& chart, double width, double height) {
  return ChartPainter(cairo, chart, width, height).paint();
}

}  // namespace transillum
