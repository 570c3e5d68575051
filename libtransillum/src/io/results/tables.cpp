// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include <fmt/ostream.h>

#include <ostream>

#include "io/results/study_csv.h"
#include "transillum/files.h"

namespace transillum {
namespace {

/// A remainder below this fraction of the projected area is rounding (ALGORITHM.md, oracle 1).
constexpr double rounding_fraction = 1e-12;

}  // namespace

void write_transfers_csv(std::ostream& out, const Transfers& transfers) {
  out << "receiver,source,area\n";
  auto next = transfers.exchanges.begin();
  for (std::size_t i = 0; i < transfers.forward.size(); ++i) {
    const auto receiver = static_cast<PatchId>(i);
    const auto first = next;
    double received = 0;
    for (; next != transfers.exchanges.end() && next->receiver == receiver; ++next) {
      received += next->area;
    }
    const double projected = transfers.forward[i].projected;
    const double rest = projected - received;
    if (rest > rounding_fraction * projected) {
      fmt::print(out, "{},-1,{}\n", receiver, rest);
    }
    for (auto t = first; t != next; ++t) {
      fmt::print(out, "{},{},{}\n", t->receiver, t->source, t->area);
    }
  }
}

void write_form_factors_csv(std::ostream& out, const FormFactors& form_factors) {
  const bool linear = !form_factors.moments.empty();
  out << (linear ? "i,j,F,F01,F02,F10,F11,F12,F20,F21,F22\n" : "i,j,F\n");
  for (std::size_t i = 0; i + 1 < form_factors.row_begin.size(); ++i) {
    for (std::size_t k = form_factors.row_begin[i]; k < form_factors.row_begin[i + 1]; ++k) {
      fmt::print(out, "{},{},{}", i, form_factors.source[k], form_factors.value[k]);
      for (std::size_t m = 1; linear && m < form_factors.moments[k].value.size(); ++m) {
        fmt::print(out, ",{}", form_factors.moments[k].value[m]);
      }
      out << '\n';
    }
  }
}

void write_directions_csv(std::ostream& out, const std::vector<DirectionSample>& directions) {
  out << "u,v,x,y,z\n";
  for (const DirectionSample& sample : directions) {
    const Vec3& d = sample.direction;
    fmt::print(out, "{},{},{},{},{}\n", sample.u, sample.v, d.x, d.y, d.z);
  }
}

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

}  // namespace transillum
