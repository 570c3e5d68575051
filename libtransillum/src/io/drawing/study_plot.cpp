// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// The chart of a study: error of B against passes or processor time, one line per series, with the
// bound of eq. 37.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>

#include "base/choice.h"
#include "io/drawing/study_chart.h"

namespace transillum {
namespace {

constexpr ChartColor bound_color{128, 128, 135};
constexpr ChartColor black{26, 26, 31};  ///< replaced by the ink color of the chart's style
/// Okabe and Ito's palette, distinguishable with most kinds of color blindness; light colors are
/// darkened.
constexpr std::array<ChartColor, 7> palette{{{0, 115, 179},
                                             {214, 94, 0},
                                             {0, 140, 107},
                                             {179, 84, 140},
                                             black,
                                             {199, 140, 0},
                                             {51, 153, 209}}};
constexpr std::array markers{ChartMarker::circle,  ChartMarker::square, ChartMarker::triangle,
                             ChartMarker::diamond, ChartMarker::down,   ChartMarker::cross,
                             ChartMarker::plus};
constexpr int dashes_count = 6;

/// Style of each series: marker and color by sampling, or by engine if there is only one sampling;
/// dashes by the other settings (the variant), and colors too if only they differ.
std::vector<ChartSeries> styles_of(const std::vector<StudySeries>& series) {
  std::vector<Sampling> samplings;
  std::vector<Engine> engines;
  std::vector<StudySeries> variants;
  const auto index_of = [](auto& list, const auto& value) {
    const auto found = std::find(list.begin(), list.end(), value);
    const auto index = static_cast<std::size_t>(found - list.begin());
    if (found == list.end()) {
      list.push_back(value);
    }
    return index;
  };
  const auto variant_of = [](StudySeries s) {
    s.sampling = {};
    return s;
  };
  // Two-way variants, the default, come first and so get the solid line.
  for (const bool two_way : {true, false}) {
    for (const StudySeries& s : series) {
      if (s.two_way == two_way) {
        index_of(variants, variant_of(s));
      }
    }
  }
  for (const StudySeries& s : series) {
    index_of(samplings, s.sampling);
    index_of(engines, s.engine);
  }
  std::vector<ChartSeries> styles;
  for (const StudySeries& s : series) {
    const std::size_t variant = index_of(variants, variant_of(s));
    const std::size_t kind = samplings.size() > 1 ? index_of(samplings, s.sampling)
                             : engines.size() > 1 ? index_of(engines, s.engine)
                                                  : variant;
    ChartSeries style;
    style.color = palette[kind % palette.size()];
    style.marker = markers[kind % markers.size()];
    style.dashes = static_cast<ChartDashes>(variant % dashes_count);
    style.hollow = variant % 2 == 1;
    styles.push_back(style);
  }
  return styles;
}

/// 0.001 -> "0.1 %".
std::string percent_text(double fraction) { return fmt::format("{:.12g} %", 100 * fraction); }

std::string slope_text(double slope) {
  std::string number = fmt::format("{:.2f}", slope);
  if (number[0] == '-') {
    number.replace(0, 1, "\u2212");
  }
  return number;
}

/// Ticks at decades, with labels; if `fine`, also at 2 to 9 times a decade, with labels at 2 and 5
/// if `detailed`.
std::vector<ChartTick> decade_ticks(double low, double high, bool detailed, bool fine,
                                    const std::function<std::string(double)>& text) {
  std::vector<ChartTick> ticks;
  const int first = static_cast<int>(std::floor(std::log10(low)));
  const int last = static_cast<int>(std::floor(std::log10(high) + 1e-9));
  for (int power = first; power <= last; ++power) {
    for (int k = 1; k < (fine ? 10 : 2); ++k) {
      const double value = k * std::pow(10, power);
      const bool labeled = k == 1 || (detailed && (k == 2 || k == 5));
      ticks.push_back({value, labeled ? text(value) : std::string(), !labeled});
    }
  }
  return ticks;
}

/// The chart of a study: see study_chart().
class StudyPlot {
 public:
  StudyPlot(const std::vector<StudySeries>& series, const Study& study, ErrorMeasure measure,
            StudyAxis against);

  LineChart chart(const std::string& scene, const ChartStyle& style) const;

 private:
  double abscissa(const StudyPoint& point) const;
  ChartAxis abscissa_axis() const;
  ChartAxis error_axis() const;
  void add_passes(ChartAxis& axis) const;
  ChartSeries bound() const;
  ChartSeries line_of(std::size_t series, const std::vector<StudyPoint>& points) const;
  std::vector<std::size_t> worst_first() const;

  ErrorMeasure measure_;
  StudyAxis against_;
  std::vector<std::string> names_;
  std::vector<ChartSeries> styles_;                        ///< without names and points
  std::map<std::size_t, std::vector<StudyPoint>> points_;  ///< by series: points with an error > 0
  std::map<double, double> bounds_;                        ///< by passes, if these are the abscissa
};

StudyPlot::StudyPlot(const std::vector<StudySeries>& series, const Study& study,
                     ErrorMeasure measure, StudyAxis against)
    : measure_(measure), against_(against), names_(names_of(series)), styles_(styles_of(series)) {
  for (const StudyPoint& point : study.points) {
    const double error = point.error(measure_);
    if (!(error > 0 && std::isfinite(error))) {
      continue;
    }
    if (against_ == StudyAxis::passes) {
      if (!takes_directions(series[point.series].engine)) {
        continue;
      }
      bounds_[static_cast<double>(point.passes)] = point.bound;
    }
    points_[point.series].push_back(point);
  }
}

LineChart StudyPlot::chart(const std::string& scene, const ChartStyle& style) const {
  LineChart chart;
  chart.title = "Error of B: " + scene;
  chart.style = style;
  if (points_.empty()) {
    chart.hint = "no points";
  } else {
    chart.x = abscissa_axis();
    chart.y = error_axis();
  }
  const bool by_passes = against_ == StudyAxis::passes;
  chart.x.title = by_passes ? "passes M" : "processor time, s";
  chart.y.title = measure_ == ErrorMeasure::rms ? "RMS error over RMS of reflected light"
                                                : "largest error over largest reflected light";
  if (points_.empty()) {
    return chart;
  }
  if (by_passes) {
    chart.note_title = "slope";
    chart.series.push_back(bound());
    chart.legend.push_back(0);
  }
  std::map<std::size_t, std::size_t> place;  // place of each series in chart.series
  for (const auto& [series, points] : points_) {
    place[series] = chart.series.size();
    chart.series.push_back(line_of(series, points));
    if (chart.series.back().color == black) {
      chart.series.back().color = style.ink;
    }
  }
  for (const std::size_t series : worst_first()) {
    chart.legend.push_back(place[series]);
  }
  return chart;
}

double StudyPlot::abscissa(const StudyPoint& point) const {
  return against_ == StudyAxis::passes ? static_cast<double>(point.passes)
                                       : std::max(point.seconds, 1e-6);
}

ChartAxis StudyPlot::abscissa_axis() const {
  double first = HUGE_VAL, last = 0;
  for (const auto& [series, points] : points_) {
    for (const StudyPoint& point : points) {
      first = std::min(first, abscissa(point));
      last = std::max(last, abscissa(point));
    }
  }
  // Margins leave room for markers at the ends and center a single M.
  const double margin = std::max(1.12, std::pow(last / first, 0.03));
  ChartAxis axis;
  axis.logarithmic = true;
  axis.low = first / margin;
  axis.high = last * margin;
  if (against_ == StudyAxis::passes) {
    for (const auto& [passes, bound] : bounds_) {
      axis.ticks.push_back({passes, fmt::format("{:.0f}", passes)});
    }
  } else {
    axis.ticks = decade_ticks(axis.low, axis.high, std::log10(axis.high / axis.low) <= 2.5, true,
                              [](double seconds) { return fmt::format("{:.6g}", seconds); });
  }
  return axis;
}

/// Whole decades that contain all errors, extended toward the bound by at most one decade, or to
/// show its smallest value.
ChartAxis StudyPlot::error_axis() const {
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
  ChartAxis axis;
  axis.logarithmic = true;
  axis.low = std::pow(10, bottom);
  axis.high = std::pow(10, headroom);
  const double decades = headroom - bottom;
  axis.ticks = decade_ticks(axis.low, axis.high, decades <= 1.5, decades <= 6, percent_text);
  return axis;
}

ChartSeries StudyPlot::bound() const {
  ChartSeries line;
  line.name = "bound (eq. 37)";
  line.color = bound_color;
  line.width = 4.5;
  for (const auto& [passes, bound] : bounds_) {
    line.points.push_back({passes, bound});
  }
  return line;
}

ChartSeries StudyPlot::line_of(std::size_t series, const std::vector<StudyPoint>& points) const {
  ChartSeries line = styles_[series];
  line.name = names_[series];
  for (const StudyPoint& point : points) {
    line.points.push_back({abscissa(point), point.error(measure_)});
  }
  const auto law = fitted_power_law(points, measure_);
  if (law && against_ == StudyAxis::passes) {
    line.note = slope_text(law->slope);
  }
  return line;
}

/// Indexes of series by their error at the last point, largest first: the order in which the lines
/// end at the right of the plot.
std::vector<std::size_t> StudyPlot::worst_first() const {
  std::vector<std::size_t> order;
  for (const auto& [series, points] : points_) {
    order.push_back(series);
  }
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return points_.at(a).back().error(measure_) > points_.at(b).back().error(measure_);
  });
  return order;
}

}  // namespace

namespace {

constexpr std::array axes{
    Choice{StudyAxis::passes, "passes"},
    Choice{StudyAxis::seconds, "seconds"},
};

}  // namespace

template <>
const Choices& choices_of<StudyAxis>() {
  return texts_of<axes>("axis");
}

LineChart study_chart(const std::string& scene, const std::vector<StudySeries>& series,
                      const Study& study, ErrorMeasure error, StudyAxis against,
                      const ChartStyle& style) {
  return StudyPlot(series, study, error, against).chart(scene, style);
}

}  // namespace transillum
