// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <cstdint>
#include <filesystem>
#include <iosfwd>
#include <string>
#include <vector>

#include "transillum/study.h"

namespace transillum {

// Files of studies; written as all others are (files.h).

/// sampling,directions,passes,rms_error,max_error,bound,seconds,engine,resolution; the first column
/// has the names of the series. Points without errors are left out.
void write_study_csv(std::ostream& out, const std::vector<StudySeries>& series, const Study& study);
void write_study_csv(const std::filesystem::path& path, const std::vector<StudySeries>& series,
                     const Study& study);

/// What errors are plotted against.
enum class StudyAxis { passes, seconds };
const std::vector<std::string>& study_axis_names();
/// @throws InputError naming the choices.
StudyAxis study_axis_from_name(const std::string& name);

/// check_writable, and @throws InputError unless `path` ends in .svg or .png.
void check_plot_path(const std::filesystem::path& path);
/// The errors, both axes logarithmic; against the passes with the bound of eq. 37 and fitted slopes
/// in the legend; series differ in marker and dashes as well as in colour. Points without errors,
/// or with none, are left out.
/// @param scene what the title calls it
void write_study_plot(const std::filesystem::path& path, const std::string& scene,
                      const std::vector<StudySeries>& series, const Study& study,
                      ErrorMeasure error = ErrorMeasure::rms,
                      StudyAxis against = StudyAxis::passes);

/// The same in memory: rows from the top of 0x..rrggbb, the plot as large as fits.
struct PlotPicture {
  int width = 0, height = 0;
  std::vector<std::uint32_t> pixels;
};
/// @throws std::runtime_error
PlotPicture draw_study_plot(const std::string& scene, const std::vector<StudySeries>& series,
                            const Study& study, ErrorMeasure error, int width, int height);

}  // namespace transillum
