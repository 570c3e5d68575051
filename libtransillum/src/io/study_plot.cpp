// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "io/study_plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "io/clean_text.h"

namespace transillum {
namespace {

constexpr double plot_left = 170, plot_right = 960, plot_top = 100, plot_bottom = 820;
constexpr double legend_left = 990, legend_right = 1575;
constexpr double title_size = 36, text_size = 30, label_size = 28, bound_width = 9;

constexpr PlotColor grid{0.86, 0.87, 0.89}, bound_color{0.5, 0.5, 0.53};
/// Okabe and Ito's, which most who are colour-blind tell apart; the light ones darkened.
constexpr std::array<PlotColor, 7> palette{{{0.00, 0.45, 0.70},
                                            {0.84, 0.37, 0.00},
                                            {0.00, 0.55, 0.42},
                                            {0.70, 0.33, 0.55},
                                            {0.10, 0.10, 0.12},
                                            {0.78, 0.55, 0.00},
                                            {0.20, 0.60, 0.82}}};

const std::vector<double>& dashes_of(std::size_t variant) {
  static const std::vector<std::vector<double>> patterns{
      {}, {16, 9}, {4, 8}, {22, 8, 4, 8}, {30, 10}, {12, 6, 4, 6, 4, 6}};
  return patterns[variant % patterns.size()];
}

/// Marker and colour by sampling, or by engine where there is but one sampling; dashes by what else
/// sets series apart, and colours too where there is nothing else.
std::vector<PlotStyle> styles_of(const std::vector<StudySeries>& series) {
  std::vector<Sampling> samplings;
  std::vector<Engine> engines;
  std::vector<StudySeries> variants;
  const auto index_of = [](auto& list, const auto& value) {
    const auto found = std::find(list.begin(), list.end(), value);
    const auto index = static_cast<std::size_t>(found - list.begin());
    if (found == list.end()) list.push_back(value);
    return index;
  };
  const auto variant_of = [](StudySeries s) {
    s.sampling = {};
    return s;
  };
  // Both ways, the default, gets the solid line, whichever comes first.
  for (const bool two_way : {true, false}) {
    for (const StudySeries& s : series) {
      if (s.two_way == two_way) index_of(variants, variant_of(s));
    }
  }
  for (const StudySeries& s : series) {
    index_of(samplings, s.sampling);
    index_of(engines, s.engine);
  }
  std::vector<PlotStyle> styles;
  for (const StudySeries& s : series) {
    const std::size_t variant = index_of(variants, variant_of(s));
    const std::size_t kind = samplings.size() > 1 ? index_of(samplings, s.sampling)
                             : engines.size() > 1 ? index_of(engines, s.engine)
                                                  : variant;
    styles.push_back({palette[kind % palette.size()], static_cast<Marker>(kind % marker_count),
                      dashes_of(variant), variant % 2 == 0});
  }
  return styles;
}

/// 0.001 -> "0.1 %".
std::string percent_text(double share) { return fmt::format("{:.12g} %", 100 * share); }

std::string with_minus(std::string number) {
  if (!number.empty() && number[0] == '-') number.replace(0, 1, "\u2212");
  return number;
}

}  // namespace

/// A logarithmic axis, from values to coordinates of the page.
struct StudyPlot::LogAxis {
  double low, high;          ///< values at the ends
  double low_end, high_end;  ///< where they are on the page

  double operator()(double value) const {
    return low_end + (high_end - low_end) * std::log(value / low) / std::log(high / low);
  }
};

StudyPlot::StudyPlot(const std::string& scene, const std::vector<StudySeries>& series,
                     const Study& study, ErrorMeasure measure, StudyAxis against)
    : scene_(scene),
      measure_(measure),
      against_(against),
      names_(names_of(series)),
      styles_(styles_of(series)) {
  for (const StudyPoint& point : study.points) {
    const double error = point.error(measure_);
    if (!(error > 0 && std::isfinite(error))) continue;
    if (against_ == StudyAxis::passes) {
      if (!takes_directions(series[point.series].engine)) continue;
      bounds_[static_cast<double>(point.passes)] = point.bound;
    }
    points_[point.series].push_back(point);
  }
}

void StudyPlot::draw(const PlotPage& page) const {
  const std::string title = "Error of B: " + clean_text(scene_);
  page.text(title, plot_left, 58, title_size, 0, PlotPage::width - plot_left - 30);
  if (points_.empty()) {
    page.text("no points", (plot_left + plot_right) / 2, (plot_top + plot_bottom) / 2, text_size,
              0.5);
    return;
  }
  const LogAxis x = abscissa_axis(), y = error_axis();
  draw_grid(page, x, y);
  page.clip(plot_left, plot_top - 1, PlotPage::width, plot_bottom - plot_top + 2);
  draw_bound(page, x, y);
  for (const auto& [series, points] : points_) draw_series(page, x, y, series, points);
  page.unclip();
  draw_legend(page);
}

double StudyPlot::abscissa(const StudyPoint& point) const {
  return against_ == StudyAxis::passes ? static_cast<double>(point.passes)
                                       : std::max(point.seconds, 1e-6);
}

StudyPlot::LogAxis StudyPlot::abscissa_axis() const {
  double first = HUGE_VAL, last = 0;
  for (const auto& [series, points] : points_) {
    for (const StudyPoint& point : points) {
      first = std::min(first, abscissa(point));
      last = std::max(last, abscissa(point));
    }
  }
  // Room for markers at the ends; a single M stands in the middle.
  const double margin = std::max(1.12, std::pow(last / first, 0.03));
  return {first / margin, last * margin, plot_left, plot_right};
}

/// Whole decades round all errors, and of the bound its end and what lies up to one decade above.
StudyPlot::LogAxis StudyPlot::error_axis() const {
  double low = HUGE_VAL, high = 0;
  for (const auto& [series, points] : points_) {
    for (const StudyPoint& point : points) {
      low = std::min(low, point.error(measure_));
      high = std::max(high, point.error(measure_));
    }
  }
  if (!bounds_.empty()) {
    double least_bound = HUGE_VAL, bound = 0;
    for (const auto& [passes, value] : bounds_) {
      least_bound = std::min(least_bound, value);
      bound = std::max(bound, value);
    }
    high = std::max(high, std::min(bound, std::max(10 * high, 2 * least_bound)));
  }
  const double bottom = std::floor(std::log10(low) - 0.05);
  const double top = std::max(std::ceil(std::log10(high) - 0.35), bottom + 1);
  const double headroom = std::max(top, std::log10(high) + 0.08);
  return {std::pow(10, bottom), std::pow(10, headroom), plot_bottom, plot_top};
}

void StudyPlot::draw_grid(const PlotPage& page, const LogAxis& x, const LogAxis& y) const {
  const double decades = std::log10(y.high / y.low);
  for (double power = std::floor(std::log10(y.low)); power <= std::log10(y.high); ++power) {
    const double at = std::pow(10, power);
    for (int k = 1; k < 10; ++k) {
      if (k * at > y.high * 1.0001 || (k > 1 && decades > 6)) break;
      const double height = y(k * at);
      page.line({{plot_left, height}, {plot_right, height}}, grid, k == 1 ? 2.5 : 0.8);
      if (k == 1 || (decades <= 1.5 && (k == 2 || k == 5))) {
        page.text(percent_text(k * at), plot_left - 16, height + 10, label_size, 1);
      }
    }
  }
  if (against_ == StudyAxis::passes) {
    draw_passes(page, x);
  } else {
    draw_seconds(page, x);
  }
  page.line({{plot_left, plot_top}, {plot_left, plot_bottom}, {plot_right, plot_bottom}},
            PlotPage::ink, 2.5);
  page.text(against_ == StudyAxis::passes ? "passes M" : "processor time, s",
            (plot_left + plot_right) / 2, plot_bottom + 100, text_size, 0.5);
  page.text_upwards(measure_ == ErrorMeasure::rms ? "RMS error of B over RMS of B"
                                                  : "largest error of B over largest B",
                    42, (plot_top + plot_bottom) / 2, text_size);
}

void StudyPlot::draw_passes(const PlotPage& page, const LogAxis& x) const {
  // From the right: the last number is the one that matters.
  double free = HUGE_VAL;
  for (auto it = bounds_.rbegin(); it != bounds_.rend(); ++it) {
    const double at = x(it->first);
    page.line({{at, plot_top}, {at, plot_bottom}}, grid, 1.2);
    page.line({{at, plot_bottom}, {at, plot_bottom + 8}}, PlotPage::ink, 2);
    const std::string label = fmt::format("{:.0f}", it->first);
    const double half = 9.5 * static_cast<double>(label.size());
    if (at + half > free) continue;
    page.text(label, at, plot_bottom + 42, label_size, 0.5);
    free = at - half - 12;
  }
}

void StudyPlot::draw_seconds(const PlotPage& page, const LogAxis& x) const {
  const bool narrow = std::log10(x.high / x.low) <= 2.5;
  for (double power = std::floor(std::log10(x.low)); power <= std::log10(x.high); ++power) {
    for (int k = 1; k < 10; ++k) {
      const double value = k * std::pow(10, power), at = x(value);
      if (value < x.low || value > x.high) continue;
      page.line({{at, plot_top}, {at, plot_bottom}}, grid, k == 1 ? 2.5 : 0.8);
      if (k > 1 && !(narrow && (k == 2 || k == 5))) continue;
      page.line({{at, plot_bottom}, {at, plot_bottom + 8}}, PlotPage::ink, 2);
      page.text(fmt::format("{:.6g}", value), at, plot_bottom + 42, label_size, 0.5);
    }
  }
}

void StudyPlot::draw_bound(const PlotPage& page, const LogAxis& x, const LogAxis& y) const {
  std::vector<std::pair<double, double>> line;
  for (const auto& [passes, bound] : bounds_) {
    if (bound > 0) line.emplace_back(x(passes), y(bound));
  }
  if (line.size() > 1) page.line(line, bound_color, bound_width);
}

void StudyPlot::draw_series(const PlotPage& page, const LogAxis& x, const LogAxis& y,
                            std::size_t series, const std::vector<StudyPoint>& points) const {
  const PlotStyle& style = styles_[series];
  std::vector<std::pair<double, double>> line;
  for (const StudyPoint& point : points) {
    line.emplace_back(x(abscissa(point)), y(point.error(measure_)));
  }
  page.line(line, style.color, PlotPage::line_width, style.dashes);
  for (const auto& [at, height] : line) page.marker(style, at, height);
}

/// The worst first, as the lines end in the plot.
void StudyPlot::draw_legend(const PlotPage& page) const {
  std::vector<std::size_t> order;
  for (const auto& [series, points] : points_) order.push_back(series);
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return points_.at(a).back().error(measure_) > points_.at(b).back().error(measure_);
  });
  constexpr double sample = 72, name_left = legend_left + sample + 14, slope_width = 96;
  constexpr double name_width = legend_right - slope_width - name_left;
  const double row =
      std::min(52.0, (plot_bottom - plot_top) / (2.0 + static_cast<double>(order.size())));
  double size = std::min(label_size, 0.62 * row);
  for (const std::string& name : names_) {
    size = std::min(size, size * name_width / page.width_of(name, size));
  }
  double at = plot_top + 8;
  const bool by_passes = against_ == StudyAxis::passes;
  if (by_passes) page.text("slope", legend_right, at, size, 1);
  const auto entry = [&](const std::string& name, const std::string& slope) {
    page.text(name, name_left, at + 0.35 * size, size, 0);
    page.text(with_minus(slope), legend_right, at + 0.35 * size, size, 1);
  };
  if (by_passes) {
    at += row;
    page.line({{legend_left, at}, {legend_left + sample, at}}, bound_color, bound_width);
    entry("bound (eq. 37)", {});
  }
  for (const std::size_t series : order) {
    at += row;
    page.line({{legend_left, at}, {legend_left + sample, at}}, styles_[series].color,
              PlotPage::line_width, styles_[series].dashes);
    page.marker(styles_[series], legend_left + sample / 2, at);
    const auto law = fitted_power_law(points_.at(series), measure_);
    entry(names_[series], law && by_passes ? fmt::format("{:.2f}", law->slope) : std::string());
  }
}

}  // namespace transillum
