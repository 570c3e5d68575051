// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "io/plot_page.h"
#include "transillum/study.h"
#include "transillum/study_files.h"

namespace transillum {

/// Errors, both axes logarithmic, and a legend: against passes, with the bound of eq. 37 and
/// slopes, and without hemicubes, which take none; or against seconds.
class StudyPlot {
 public:
  StudyPlot(const std::string& scene, const std::vector<StudySeries>& series, const Study& study,
            ErrorMeasure measure, StudyAxis against = StudyAxis::passes);

  void draw(const PlotPage& page) const;

 private:
  struct LogAxis;
  double abscissa(const StudyPoint& point) const;
  LogAxis abscissa_axis() const;
  LogAxis error_axis() const;
  void draw_grid(const PlotPage& page, const LogAxis& x, const LogAxis& y) const;
  void draw_passes(const PlotPage& page, const LogAxis& x) const;
  void draw_seconds(const PlotPage& page, const LogAxis& x) const;
  void draw_bound(const PlotPage& page, const LogAxis& x, const LogAxis& y) const;
  void draw_series(const PlotPage& page, const LogAxis& x, const LogAxis& y, std::size_t series,
                   const std::vector<StudyPoint>& points) const;
  void draw_legend(const PlotPage& page) const;

  std::string scene_;
  ErrorMeasure measure_;
  StudyAxis against_;
  std::vector<std::string> names_;
  std::vector<PlotStyle> styles_;
  std::map<std::size_t, std::vector<StudyPoint>> points_;  ///< with an error, a series
  std::map<double, double> bounds_;                        ///< by passes, where these are the axis
};

}  // namespace transillum
