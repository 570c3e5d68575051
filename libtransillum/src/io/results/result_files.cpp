// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Results by the ending of their file, and series of results.
#include <fmt/format.h>

#include <ostream>
#include <utility>

#include "base/text_file.h"
#include "io/results/result_writers.h"
#include "io/text.h"
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
  if (ending == ".glb") {
    return write_result_glb;
  }
  if (ending == ".gltf") {
    return write_result_gltf;
  }
  throw InputError(fmt::format(
      "{}: the name of a result must end in .csv, .vtp, .ply, .glb or .gltf, the name of a picture "
      "in .png, .exr or .pfm",
      path.string()));
}

}  // namespace

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

namespace {

std::filesystem::path member_of_series(const std::filesystem::path& series, std::size_t number) {
  return series.parent_path() / fmt::format("{}-{:04}.vtp", series.stem().string(), number);
}

}  // namespace

ResultSeries::ResultSeries(std::filesystem::path path) : path_(std::move(path)) {
  if (lower_case_ending(path_) != ".pvd") {
    throw InputError(fmt::format("{}: the name of a series must end in .pvd", path_.string()));
  }
  check_writable(path_);
  check_writable(member_of_series(path_, 1'000'000));  // longer than any name that is used
}

void ResultSeries::check_apart_from(const std::vector<std::string>& files) const {
  const std::string beginning = path_.stem().string() + '-', ending = ".vtp";
  for (const std::string& file : files) {
    std::error_code ignored;
    const std::string name = std::filesystem::weakly_canonical(file, ignored).filename().string();
    if (name.size() < beginning.size() + ending.size() || !name.starts_with(beginning) ||
        !name.ends_with(ending)) {
      continue;
    }
    const std::string number =
        name.substr(beginning.size(), name.size() - beginning.size() - ending.size());
    if (number.size() < 4 || number.find_first_not_of("0123456789") != std::string::npos) {
      continue;
    }
    try {
      check_distinct({file, (path_.parent_path() / name).string()}, {});
    } catch (const InputError&) {
      throw InputError(fmt::format("{}: the series {} writes this file too", file, path_.string()));
    }
  }
}

void ResultSeries::add(const Solution& solution, double time) {
  write_result(member_of_series(path_, times_.size() + 1), solution);
  times_.push_back(time);
  write_file_whole(path_, [&](std::ostream& out) {
    out << "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\">\n"
           "  <Collection>\n";
    for (std::size_t k = 0; k < times_.size(); ++k) {
      out << fmt::format("    <DataSet timestep=\"{}\" part=\"0\" file=\"{}\"/>\n", times_[k],
                         xml_text(member_of_series(path_, k + 1).filename().string()));
    }
    out << "  </Collection>\n</VTKFile>\n";
  });
}

}  // namespace transillum
