// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Results by the ending of their file, the exposure of those that show colors, and series of
// results.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <ostream>
#include <utility>

#include "io/clean_text.h"
#include "io/file_ending.h"
#include "io/results/result_writers.h"
#include "transillum/at.h"
#include "transillum/errors.h"
#include "transillum/files.h"

namespace transillum {
namespace {

using ResultWriter = std::function<void(std::ostream&, const Solution&, const DisplayOptions&)>;

/// A writer that shows no colors.
ResultWriter without_colors(void (*write)(std::ostream&, const Solution&)) {
  return [write](std::ostream& out, const Solution& solution, const DisplayOptions&) {
    write(out, solution);
  };
}

ResultWriter writer_for(const std::filesystem::path& path) {
  const std::string ending = lower_case_ending(path);
  if (ending == ".csv") {
    return without_colors(write_result_csv);
  }
  if (ending == ".vtp") {
    return without_colors(write_result_vtp);
  }
  if (ending == ".ply") {
    return write_result_ply;
  }
  if (ending == ".obj") {
    return without_colors(write_result_obj);
  }
  if (ending == ".glb") {
    return write_result_glb;
  }
  if (ending == ".gltf") {
    return write_result_gltf;
  }
  throw InputError(fmt::format(
      "{}: the name of a result must end in .csv, .vtp, .ply, .obj, .glb or .gltf", path.string()));
}

/// What 98 % of the area does not exceed, of the largest channel of B.
/// @param emitting whether patches that emit count too
double bright(const Solution& solution, bool emitting) {
  constexpr double share = 0.98;
  std::vector<std::pair<double, double>> values;  // of B, and area
  double area = 0;
  for (PatchId i = 0; i < solution.scene->patch_count(); ++i) {
    if (emitting || max_abs(solution.scene->exitance(i)) == 0) {
      values.emplace_back(max_abs(at(solution.radiosity, i)), solution.scene->patch(i).area);
      area += values.back().second;
    }
  }
  std::sort(values.begin(), values.end());
  double below = 0;
  for (const auto& [value, of_patch] : values) {
    below += of_patch;
    if (below >= share * area) {
      return value;
    }
  }
  return 0;
}

}  // namespace

void DisplayOptions::validate() const {
  if (exposure && !(*exposure > 0 && std::isfinite(*exposure))) {
    throw InputError(fmt::format("exposure: {} is not a finite number greater than 0", *exposure));
  }
  if (up && !(std::abs(norm(*up) - 1) <= 1e-9)) {
    throw InputError(
        fmt::format("up: the vector {} {} {} is not a unit vector", up->x, up->y, up->z));
  }
}

double automatic_exposure(const Solution& solution) {
  const double without_sources = bright(solution, false);
  const double white = without_sources > 0 ? without_sources : bright(solution, true);
  return white > 0 ? 1 / white : 1;
}

double exposure_of(const Solution& solution, const DisplayOptions& display) {
  return display.exposure ? *display.exposure : automatic_exposure(solution);
}

void check_result_path(const std::filesystem::path& path) {
  writer_for(path);
  check_writable(path);
}

void check_statistics_path(const std::filesystem::path& path) {
  if (lower_case_ending(path) != ".json") {
    throw InputError(
        fmt::format("{}: the name of a statistics file must end in .json", path.string()));
  }
  check_writable(path);
}

void write_result(const std::filesystem::path& path, const Solution& solution,
                  const DisplayOptions& display) {
  display.validate();
  const ResultWriter write = writer_for(path);
  check_distinct({path.string()}, solution.scene->files());
  write_file_whole(path, [&](std::ostream& out) { write(out, solution, display); });
}

ResultSeries::ResultSeries(std::filesystem::path path) : path_(std::move(path)) {
  if (lower_case_ending(path_) != ".pvd") {
    throw InputError(fmt::format("{}: the name of a series must end in .pvd", path_.string()));
  }
  check_writable(path_);
}

void ResultSeries::add(const Solution& solution, double time) {
  const auto name = [&](std::size_t number) {
    return fmt::format("{}-{:04}.vtp", path_.stem().string(), number);
  };
  write_result(path_.parent_path() / name(times_.size() + 1), solution);
  times_.push_back(time);
  write_file_whole(path_, [&](std::ostream& out) {
    out << "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\">\n"
           "  <Collection>\n";
    for (std::size_t k = 0; k < times_.size(); ++k) {
      out << fmt::format("    <DataSet timestep=\"{}\" part=\"0\" file=\"{}\"/>\n", times_[k],
                         xml_text(name(k + 1)));
    }
    out << "  </Collection>\n</VTKFile>\n";
  });
}

}  // namespace transillum
