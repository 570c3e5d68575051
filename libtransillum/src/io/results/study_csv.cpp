// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include <fmt/ostream.h>

#include <ostream>

#include "io/results/study_csv.h"
#include "transillum/files.h"

namespace transillum {

void write_study_csv(std::ostream& out, const std::vector<StudySeries>& series,
                     const Study& study) {
  const std::vector<std::string> names = names_of(series);
  out << "sampling,directions,passes,rms_error,max_error,bound,seconds,engine,resolution\n";
  for (const StudyPoint& point : study.points) {
    if (!point.failure.empty()) {
      continue;
    }
    const StudySeries& of = series[point.series];
    fmt::print(out, "{},{},{},{},{},{},{},{},{}\n", names[point.series], point.directions,
               point.passes, point.rms_error, point.max_error, point.bound, point.seconds,
               name_of(of.engine), of.resolution);
  }
}

void write_study_csv(const std::filesystem::path& path, const std::vector<StudySeries>& series,
                     const Study& study) {
  write_file_whole(path, [&](std::ostream& out) { write_study_csv(out, series, study); });
}

}  // namespace transillum
