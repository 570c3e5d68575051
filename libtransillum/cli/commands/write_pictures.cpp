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
  constexpr double bytes_of_pixel = sizeof(Rgb) + 3 * sizeof(float);
  return bytes_of_pixel * options.width * options.height;
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
           double exposure, const std::string& title) {
  const PictureLook look{.exposure = exposure, .tone = request.tone};
  const FalseColors colors{.highest = 1 / exposure, .lux = request.lux};
  if (is_figure_file(file)) {
    PictureFigure figure{.title = title, .look = look, .pixels_per_inch = request.pixels_per_inch};
    if (request.false_colors) {
      figure.false_colors = colors;
    }
    write_figure(file, picture, figure);
  } else if (request.false_colors && is_screen_picture(file)) {
    write_false_colors(file, picture, colors);
  } else {
    write_picture(file, picture, look);
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
  const auto free = static_cast<double>(free_memory());
  if (memory_of(options) > free) {
    throw InputError(fmt::format(
        "--size: a picture of {} x {} pixels takes {:.3g} GB of memory, but {:.3g} GB are free",
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
  const std::string title = solution->scene->name();
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
    writers.emplace_back([&] { write(request, file, picture, exposure, title); });
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
