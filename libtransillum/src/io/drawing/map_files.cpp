// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "transillum/map_files.h"

#include <fmt/format.h>

#include <functional>
#include <ostream>

#include "base/text_file.h"
#include "io/maps/map_writers.h"
#include "transillum/errors.h"
#include "transillum/files.h"

namespace transillum {
namespace {

using MapWriter = std::function<void(std::ostream&, const Scene&, const VisibilityMap&)>;

MapWriter writer_for(const std::filesystem::path& path, const MapPictureOptions& options) {
  using namespace std::placeholders;
  const std::string ending = lower_case_ending(path);
  if (ending == ".svg") {
    return std::bind(write_map_svg, _1, _2, _3, options);
  }
  if (ending == ".png") {
    return std::bind(write_map_png, _1, _2, _3, options);
  }
  if (ending == ".pdf") {
    return std::bind(write_map_pdf, _1, _2, _3, options);
  }
  if (ending == ".vtp") {
    return write_map_vtp;
  }
  if (ending == ".json") {
    return write_map_json;
  }
  throw InputError(fmt::format("{}: the name of a map must end in .svg, .pdf, .png, .vtp or .json",
                               path.string()));
}

}  // namespace

void check_map_path(const std::filesystem::path& path) {
  writer_for(path, {});
  check_writable(path);
}

bool is_map_picture(const std::filesystem::path& path) {
  const std::string ending = lower_case_ending(path);
  return ending == ".svg" || ending == ".pdf" || ending == ".png";
}

void write_map(const std::filesystem::path& path, const Scene& scene, const VisibilityMap& map,
               const MapPictureOptions& options) {
  options.validate();
  const MapWriter write = writer_for(path, options);
  check_distinct({path.string()}, scene.files());
  write_file_whole(path, [&](std::ostream& out) { write(out, scene, map); });
}

}  // namespace transillum
