// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include <cairo-svg.h>
#include <fmt/format.h>

#include <filesystem>
#include <ostream>

#include "choice.h"
#include "io/file_ending.h"
#include "io/study_plot.h"
#include "transillum/errors.h"
#include "transillum/files.h"
#include "transillum/study_files.h"

namespace transillum {
namespace {

cairo_status_t append(void* out, const unsigned char* data, unsigned length) {
  static_cast<std::ostream*>(out)->write(reinterpret_cast<const char*>(data), length);
  return CAIRO_STATUS_SUCCESS;  // the stream keeps its own failure
}

void draw_svg(std::ostream& out, const StudyPlot& plot) {
  const PlotPage page(
      cairo_svg_surface_create_for_stream(append, &out, PlotPage::width, PlotPage::height));
  plot.draw(page);
  page.finish();
}

void draw_png(std::ostream& out, const StudyPlot& plot) {
  const PlotPage page(cairo_image_surface_create(
      CAIRO_FORMAT_RGB24, static_cast<int>(PlotPage::width), static_cast<int>(PlotPage::height)));
  plot.draw(page);
  page.flush();
  PlotPage::check(cairo_surface_write_to_png_stream(page.surface(), append, &out));
}

using PlotDrawer = void (*)(std::ostream&, const StudyPlot&);

PlotDrawer drawer_for(const std::filesystem::path& path) {
  const std::string ending = lower_case_ending(path);
  if (ending == ".svg") return draw_svg;
  if (ending == ".png") return draw_png;
  throw InputError(fmt::format("{}: a plot ends in .svg or .png", path.string()));
}

}  // namespace

const std::vector<std::string>& study_axis_names() {
  static const std::vector<std::string> names{"passes", "seconds"};
  return names;
}

StudyAxis study_axis_from_name(const std::string& name) {
  return choice_from_name<StudyAxis>(study_axis_names(), "axis", name);
}

void check_plot_path(const std::filesystem::path& path) {
  drawer_for(path);
  check_writable(path);
}

void write_study_plot(const std::filesystem::path& path, const std::string& scene,
                      const std::vector<StudySeries>& series, const Study& study,
                      ErrorMeasure error, StudyAxis against) {
  const PlotDrawer draw = drawer_for(path);
  const StudyPlot plot(scene, series, study, error, against);
  write_file_whole(path, [&](std::ostream& out) { draw(out, plot); });
}

PlotPicture draw_study_plot(const std::string& scene, const std::vector<StudySeries>& series,
                            const Study& study, ErrorMeasure error, int width, int height) {
  const PlotPage page(cairo_image_surface_create(CAIRO_FORMAT_RGB24, width, height), width, height);
  StudyPlot(scene, series, study, error).draw(page);
  page.flush();
  PlotPicture picture{width, height, {}};
  const unsigned char* row = cairo_image_surface_get_data(page.surface());
  for (int y = 0; y < height; ++y, row += cairo_image_surface_get_stride(page.surface())) {
    const auto* pixels = reinterpret_cast<const std::uint32_t*>(row);
    picture.pixels.insert(picture.pixels.end(), pixels, pixels + width);
  }
  return picture;
}

}  // namespace transillum
