// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "cli/commands/write_pictures.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <functional>
#include <numbers>
#include <utility>
#include <vector>

#include "base/memory_limit.h"
#include "base/seconds_since.h"
#include "cli/interruption.h"
#include "cli/messages.h"
#include "cli/output_files.h"
#include "geometry/luminance.h"
#include "transillum/errors.h"
#include "transillum/files.h"

namespace transillum::cli {
namespace {

/// Memory of a picture while it is written, bytes.
double memory_of(const PictureOptions& options) {
  // Radiance, coverage, the floats of a file, and colors, image and page of a figure.
  constexpr double bytes_of_pixel = sizeof(Rgb) + 4 * sizeof(float) + 3 * 4;
  return bytes_of_pixel * options.width * options.height;
}

/// @param scene_name  the title of .svg and .pdf files without another
PictureFigure figure_of(const PictureRequest& request, const std::string& file, double exposure,
                        const std::string& scene_name) {
  PictureFigure figure{.title = request.title.value_or(is_figure_file(file) ? scene_name : ""),
                       .look = {.exposure = exposure, .tone = request.tone},
                       .pixels_per_inch = request.pixels_per_inch};
  if (request.false_colors) {
    figure.false_colors = {.highest = 1 / exposure, .lux = request.lux};
  }
  return figure;
}

/// Checks that a .png file has room for the title and the scale.
void check_page(const PictureRequest& request, const std::string& file) {
  // The exposure may not be known yet; the labels of this one are wide.
  constexpr double wide = 1 / 1.2e6;
  const auto [width, height] =
      figure_pixels(request.options.width, request.options.height,
                    figure_of(request, file, request.exposure.value_or(wide), {}));
  if (std::max(width, height) > PictureOptions::largest_size) {
    throw InputError(fmt::format(
        "--size: \"{}\" is too large for {}: with its title and its scale it has {} x {} pixels, "
        "at most {} along each side",
        request.size_text, file, width, height, PictureOptions::largest_size));
  }
}

/// The luminance of H that the picture does not exceed in 98 % of the pixels that show a surface.
double bright_irradiance(const Picture& picture) {
  std::vector<double> values;
  for (const Rgb& radiance : picture.radiance) {
    if (const double value = std::numbers::pi * luminance(radiance); value > 0) {
      values.push_back(value);
    }
  }
  const auto place = values.begin() + static_cast<std::ptrdiff_t>(49 * values.size() / 50);
  std::nth_element(values.begin(), place, values.end());
  return values.empty() ? 1 : *place;
}

void write(const PictureRequest& request, const std::string& file, const Picture& picture,
           double exposure, const std::string& scene_name) {
  if (is_figure_file(file) || is_screen_picture(file)) {
    write_figure(file, picture, figure_of(request, file, exposure, scene_name));
  } else {
    write_picture(file, picture);
  }
}

}  // namespace

void check_picture_request(const PictureRequest& request,
                           const std::shared_ptr<const Scene>& scene) {
  if (request.files.empty()) {
    return;
  }
  const PictureOptions& options = request.options;
  options.validate();
  CameraRays(*scene, request.camera, options.width, options.height);
  check_eye(scene, request.camera);
  for (const std::string& file : request.files) {
    if (is_screen_picture(file)) {
      check_page(request, file);
    }
  }
  const auto free = static_cast<double>(free_memory());
  if (memory_of(options) > free) {
    throw InputError(fmt::format(
        "{}a picture of {} x {} pixels takes {:.3g} GB of memory, but {:.3g} GB are free",
        request.size_text.empty() ? "" : fmt::format("--size: \"{}\": ", request.size_text),
        options.width, options.height, 1e-9 * memory_of(options), 1e-9 * free));
  }
}

void write_pictures(const PictureRequest& request, std::shared_ptr<const Solution> solution,
                    ProgressDisplay& display, const Cancellation& cancellation) {
  if (request.files.empty()) {
    return;
  }
  const auto start = std::chrono::steady_clock::now();
  PictureOptions options = request.options;
  options.irradiance = request.lux;
  const double of_result = automatic_exposure(*solution);
  const std::string scene_name = solution->scene->name();
  Picture picture;
  display.begin("making the picture");
  try {
    picture = make_picture(std::move(solution), request.camera, options, cancellation,
                           [&](double fraction) {
                             display.show_rate("making the picture", fraction,
                                               1.0 * options.width * options.height, "pixels");
                           });
  } catch (const Canceled&) {
    throw NothingToSave("the picture is not finished: it is not written");
  }
  const double exposure =
      request.exposure.value_or(request.lux ? 1 / bright_irradiance(picture) : of_result);
  display.begin("writing the picture");
  std::vector<std::function<void()>> writers;
  for (const std::string& file : request.files) {
    writers.emplace_back([&] { write(request, file, picture, exposure, scene_name); });
  }
  write_all(writers);
  display.clear();
  if (!request.quiet) {
    print_message(fmt::format("{}: {} x {} pixels, {} sample{} each, in {:.3g} s; exposure {:.4g}",
                              fmt::join(request.files, ", "), options.width, options.height,
                              options.samples, options.samples == 1 ? "" : "s",
                              seconds_since(start), exposure));
    if (picture.gathered_lamps > 0) {
      print_message(fmt::format("the light of {} weak or dim emitting faces was gathered by rays",
                                picture.gathered_lamps));
    }
  }
}

}  // namespace transillum::cli
