// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include <cairo-svg.h>
#include <cairo.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <map>
#include <memory>
#include <numbers>
#include <ostream>
#include <set>
#include <stdexcept>
#include <utility>

#include "io/clean_text.h"
#include "io/file_ending.h"
#include "transillum/errors.h"
#include "transillum/files.h"
#include "transillum/study_files.h"

namespace transillum {
namespace {

// Sizes in points of the page; large enough for a projector.
constexpr double page_width = 1600, page_height = 960;
constexpr double plot_left = 170, plot_right = 960, plot_top = 100, plot_bottom = 820;
constexpr double legend_left = 990, legend_right = 1575;
constexpr double title_size = 36, text_size = 30, label_size = 28;
constexpr double line_width = 4, bound_width = 9, marker_size = 11;

struct Color {
  double r, g, b;
};
constexpr Color ink{0.1, 0.1, 0.12}, grid{0.86, 0.87, 0.89}, bound_color{0.5, 0.5, 0.53};
/// Okabe and Ito's, which most who are colour-blind tell apart; the light ones darkened.
constexpr std::array<Color, 7> palette{{{0.00, 0.45, 0.70},
                                        {0.84, 0.37, 0.00},
                                        {0.00, 0.55, 0.42},
                                        {0.70, 0.33, 0.55},
                                        {0.10, 0.10, 0.12},
                                        {0.78, 0.55, 0.00},
                                        {0.20, 0.60, 0.82}}};

enum class Marker { circle, square, triangle, diamond, down, cross, plus };
constexpr int marker_count = 7;

/// How a series is drawn, so that it can be told from the others without colour.
struct Style {
  Color color{};
  Marker marker{};
  std::vector<double> dashes;  ///< on, off, …; none: solid
  bool filled = true;
};

const std::vector<double>& dashes_of(std::size_t variant) {
  static const std::vector<std::vector<double>> patterns{
      {}, {16, 9}, {4, 8}, {22, 8, 4, 8}, {30, 10}, {12, 6, 4, 6, 4, 6}};
  return patterns[variant % patterns.size()];
}

/// Marker and colour by sampling, dashes by what else sets series apart; by that alone where there
/// is but one sampling.
std::vector<Style> styles_of(const std::vector<StudySeries>& series) {
  std::vector<Sampling> samplings;
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
  for (const StudySeries& s : series) index_of(samplings, s.sampling);
  std::vector<Style> styles;
  for (const StudySeries& s : series) {
    const std::size_t variant = index_of(variants, variant_of(s));
    const std::size_t kind = samplings.size() > 1 ? index_of(samplings, s.sampling) : variant;
    styles.push_back({palette[kind % palette.size()], static_cast<Marker>(kind % marker_count),
                      dashes_of(variant), variant % 2 == 0});
  }
  return styles;
}

/// A logarithmic axis from page to page coordinate.
struct LogAxis {
  double low, high;          ///< values at the ends
  double low_end, high_end;  ///< where they are on the page

  double operator()(double value) const {
    return low_end + (high_end - low_end) * std::log(value / low) / std::log(high / low);
  }
};

/// A page under Cairo's pens.
class Page {
 public:
  explicit Page(cairo_surface_t* surface)
      : surface_(surface, cairo_surface_destroy), cairo_(cairo_create(surface), cairo_destroy) {
    set(Color{1, 1, 1});
    cairo_paint(cairo());
    cairo_set_line_join(cairo(), CAIRO_LINE_JOIN_ROUND);
    cairo_select_font_face(cairo(), "sans-serif", CAIRO_FONT_SLANT_NORMAL,
                           CAIRO_FONT_WEIGHT_NORMAL);
  }

  cairo_t* cairo() const { return cairo_.get(); }
  void set(const Color& c) const { cairo_set_source_rgb(cairo(), c.r, c.g, c.b); }

  void line(const std::vector<std::pair<double, double>>& points, const Color& color, double width,
            const std::vector<double>& dashes = {}) const {
    cairo_new_path(cairo());  // text leaves a point
    for (const auto& [x, y] : points) cairo_line_to(cairo(), x, y);
    set(color);
    cairo_set_line_width(cairo(), width);
    cairo_set_dash(cairo(), dashes.data(), static_cast<int>(dashes.size()), 0);
    cairo_stroke(cairo());
    cairo_set_dash(cairo(), nullptr, 0, 0);
  }

  /// `align` 0 begins, 0.5 is centred, 1 ends at x; y is the base line. Text wider than `most`
  /// shrinks.
  void text(const std::string& text, double x, double y, double size, double align,
            const Color& color = ink, double most = page_width) const {
    const double width = width_of(text, size);
    cairo_set_font_size(cairo(), width > most ? size * most / width : size);
    set(color);
    cairo_move_to(cairo(), x - align * std::min(width, most), y);
    cairo_show_text(cairo(), text.c_str());
  }

  double width_of(const std::string& text, double size) const {
    cairo_set_font_size(cairo(), size);
    cairo_text_extents_t extents;
    cairo_text_extents(cairo(), text.c_str(), &extents);
    return extents.x_advance;
  }

  void text_upwards(const std::string& words, double x, double y, double size) const {
    cairo_save(cairo());
    cairo_translate(cairo(), x, y);
    cairo_rotate(cairo(), -std::numbers::pi / 2);
    text(words, 0, 0, size, 0.5);
    cairo_restore(cairo());
  }

  void marker(const Style& style, double x, double y) const {
    trace(style.marker, x, y);
    set(style.filled ? style.color : Color{1, 1, 1});
    cairo_fill_preserve(cairo());
    set(style.color);
    cairo_set_line_width(cairo(), line_width);
    cairo_stroke(cairo());
  }

  /// @throws std::runtime_error where anything went wrong.
  void finish() const {
    cairo_surface_finish(surface_.get());
    for (const cairo_status_t status :
         {cairo_status(cairo()), cairo_surface_status(surface_.get())}) {
      check(status);
    }
  }
  static void check(cairo_status_t status) {
    if (status != CAIRO_STATUS_SUCCESS) {
      throw std::runtime_error(
          fmt::format("the plot cannot be drawn: {}", cairo_status_to_string(status)));
    }
  }
  cairo_surface_t* surface() const { return surface_.get(); }

 private:
  void trace(Marker marker, double x, double y) const {
    constexpr double s = marker_size, w = marker_size / 2.5;
    const auto outline = [&](std::initializer_list<std::pair<double, double>> corners) {
      for (const auto& [dx, dy] : corners) cairo_line_to(cairo(), x + dx, y + dy);
      cairo_close_path(cairo());
    };
    cairo_new_path(cairo());
    switch (marker) {
      case Marker::circle:
        cairo_arc(cairo(), x, y, s, 0, 2 * std::numbers::pi);
        break;
      case Marker::square:
        outline({{-s, -s}, {s, -s}, {s, s}, {-s, s}});
        break;
      case Marker::triangle:
        outline({{-1.2 * s, s}, {0, -1.2 * s}, {1.2 * s, s}});
        break;
      case Marker::diamond:
        outline({{-1.3 * s, 0}, {0, -1.3 * s}, {1.3 * s, 0}, {0, 1.3 * s}});
        break;
      case Marker::down:
        outline({{-1.2 * s, -s}, {0, 1.2 * s}, {1.2 * s, -s}});
        break;
      case Marker::cross:
        outline({{-s, -s + w},
                 {-s + w, -s},
                 {0, -w},
                 {s - w, -s},
                 {s, -s + w},
                 {w, 0},
                 {s, s - w},
                 {s - w, s},
                 {0, w},
                 {-s + w, s},
                 {-s, s - w},
                 {-w, 0}});
        break;
      case Marker::plus:
        outline({{-w, -s},
                 {w, -s},
                 {w, -w},
                 {s, -w},
                 {s, w},
                 {w, w},
                 {w, s},
                 {-w, s},
                 {-w, w},
                 {-s, w},
                 {-s, -w},
                 {-w, -w}});
        break;
    }
  }

  std::unique_ptr<cairo_surface_t, void (*)(cairo_surface_t*)> surface_;
  std::unique_ptr<cairo_t, void (*)(cairo_t*)> cairo_;
};

/// 0.001 -> "0.1 %".
std::string percent_text(double share) { return fmt::format("{:.12g} %", 100 * share); }

std::string with_minus(std::string number) {
  if (!number.empty() && number[0] == '-') number.replace(0, 1, "\u2212");
  return number;
}

class StudyPlot {
 public:
  StudyPlot(const std::string& scene, const std::vector<StudySeries>& series, const Study& study)
      : scene_(scene), names_(names_of(series)), styles_(styles_of(series)) {
    for (const StudyPoint& point : study.points) {
      if (!(point.rms_error > 0 && std::isfinite(point.rms_error))) continue;
      points_[point.series].push_back(point);
      bounds_[static_cast<double>(point.passes)] = point.bound;
    }
  }

  void draw(const Page& page) const {
    const std::string title = "Error of B: " + clean_text(scene_);
    page.text(title, plot_left, 58, title_size, 0, ink, page_width - plot_left - 30);
    if (points_.empty()) {
      page.text("no points", (plot_left + plot_right) / 2, (plot_top + plot_bottom) / 2, text_size,
                0.5);
      return;
    }
    const LogAxis x = pass_axis(), y = error_axis();
    draw_grid(page, x, y);
    cairo_save(page.cairo());
    cairo_rectangle(page.cairo(), plot_left, plot_top - 1, page_width, plot_bottom - plot_top + 2);
    cairo_clip(page.cairo());
    draw_bound(page, x, y);
    for (const auto& [series, points] : points_) draw_series(page, x, y, styles_[series], points);
    cairo_restore(page.cairo());
    draw_legend(page);
  }

 private:
  LogAxis pass_axis() const {
    const double first = bounds_.begin()->first, last = bounds_.rbegin()->first;
    // Room for markers at the ends; a single M stands in the middle.
    const double margin = std::max(1.12, std::pow(last / first, 0.03));
    return {first / margin, last * margin, plot_left, plot_right};
  }

  /// Whole decades round all errors, and what of the bound lies up to one decade above.
  LogAxis error_axis() const {
    double low = HUGE_VAL, high = 0;
    for (const auto& [series, points] : points_) {
      for (const StudyPoint& point : points) {
        low = std::min(low, point.rms_error);
        high = std::max(high, point.rms_error);
      }
    }
    double bound = 0;
    for (const auto& [passes, value] : bounds_) bound = std::max(bound, value);
    high = std::max(high, std::min(bound, 10 * high));
    const double bottom = std::floor(std::log10(low) - 0.05);
    const double top = std::max(std::ceil(std::log10(high) - 0.35), bottom + 1);
    const double headroom = std::max(top, std::log10(high) + 0.08);
    return {std::pow(10, bottom), std::pow(10, headroom), plot_bottom, plot_top};
  }

  void draw_grid(const Page& page, const LogAxis& x, const LogAxis& y) const {
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
    // From the right: the last number is the one that matters.
    double free = HUGE_VAL;
    for (auto it = bounds_.rbegin(); it != bounds_.rend(); ++it) {
      const double at = x(it->first);
      page.line({{at, plot_top}, {at, plot_bottom}}, grid, 1.2);
      page.line({{at, plot_bottom}, {at, plot_bottom + 8}}, ink, 2);
      const std::string label = fmt::format("{:.0f}", it->first);
      const double half = 9.5 * static_cast<double>(label.size());
      if (at + half > free) continue;
      page.text(label, at, plot_bottom + 42, label_size, 0.5);
      free = at - half - 12;
    }
    page.line({{plot_left, plot_top}, {plot_left, plot_bottom}, {plot_right, plot_bottom}}, ink,
              2.5);
    page.text("passes M", (plot_left + plot_right) / 2, plot_bottom + 100, text_size, 0.5);
    page.text_upwards("RMS error of B over RMS of B", 42, (plot_top + plot_bottom) / 2, text_size);
  }

  void draw_bound(const Page& page, const LogAxis& x, const LogAxis& y) const {
    std::vector<std::pair<double, double>> line;
    for (const auto& [passes, bound] : bounds_) {
      if (bound > 0) line.emplace_back(x(passes), y(bound));
    }
    if (line.size() > 1) page.line(line, bound_color, bound_width);
  }

  static void draw_series(const Page& page, const LogAxis& x, const LogAxis& y, const Style& style,
                          const std::vector<StudyPoint>& points) {
    std::vector<std::pair<double, double>> line;
    for (const StudyPoint& point : points) {
      line.emplace_back(x(static_cast<double>(point.passes)), y(point.rms_error));
    }
    page.line(line, style.color, line_width, style.dashes);
    for (const auto& [at, height] : line) page.marker(style, at, height);
  }

  /// The worst first, as the lines end in the plot.
  void draw_legend(const Page& page) const {
    std::vector<std::size_t> order;
    for (const auto& [series, points] : points_) order.push_back(series);
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
      return points_.at(a).back().rms_error > points_.at(b).back().rms_error;
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
    page.text("slope", legend_right, at, size, 1);
    const auto entry = [&](const std::string& name, const std::string& slope) {
      page.text(name, name_left, at + 0.35 * size, size, 0);
      page.text(with_minus(slope), legend_right, at + 0.35 * size, size, 1);
    };
    at += row;
    page.line({{legend_left, at}, {legend_left + sample, at}}, bound_color, bound_width);
    entry("bound (eq. 37)", {});
    for (const std::size_t series : order) {
      at += row;
      page.line({{legend_left, at}, {legend_left + sample, at}}, styles_[series].color, line_width,
                styles_[series].dashes);
      page.marker(styles_[series], legend_left + sample / 2, at);
      const auto law = fitted_power_law(points_.at(series));
      entry(names_[series], law ? fmt::format("{:.2f}", law->slope) : std::string());
    }
  }

  std::string scene_;
  std::vector<std::string> names_;
  std::vector<Style> styles_;
  std::map<std::size_t, std::vector<StudyPoint>> points_;  ///< with an error, a series
  std::map<double, double> bounds_;                        ///< by passes
};

cairo_status_t append(void* out, const unsigned char* data, unsigned length) {
  static_cast<std::ostream*>(out)->write(reinterpret_cast<const char*>(data), length);
  return CAIRO_STATUS_SUCCESS;  // the stream keeps its own failure
}

void draw_svg(std::ostream& out, const StudyPlot& plot) {
  const Page page(cairo_svg_surface_create_for_stream(append, &out, page_width, page_height));
  plot.draw(page);
  page.finish();
}

void draw_png(std::ostream& out, const StudyPlot& plot) {
  const Page page(cairo_image_surface_create(CAIRO_FORMAT_RGB24, static_cast<int>(page_width),
                                             static_cast<int>(page_height)));
  plot.draw(page);
  Page::check(cairo_status(page.cairo()));
  Page::check(cairo_surface_write_to_png_stream(page.surface(), append, &out));
}

using PlotDrawer = void (*)(std::ostream&, const StudyPlot&);

PlotDrawer drawer_for(const std::filesystem::path& path) {
  const std::string ending = lower_case_ending(path);
  if (ending == ".svg") return draw_svg;
  if (ending == ".png") return draw_png;
  throw InputError(fmt::format("{}: a plot ends in .svg or .png", path.string()));
}

}  // namespace

void check_plot_path(const std::filesystem::path& path) {
  drawer_for(path);
  check_writable(path);
}

void write_study_plot(const std::filesystem::path& path, const std::string& scene,
                      const std::vector<StudySeries>& series, const Study& study) {
  const PlotDrawer draw = drawer_for(path);
  const StudyPlot plot(scene, series, study);
  write_file_whole(path, [&](std::ostream& out) { draw(out, plot); });
}

}  // namespace transillum
