// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "cli/progress_display.h"
#include "io/drawing/picture_figure.h"
#include "transillum/files.h"
#include "transillum/picture.h"

namespace transillum::cli {

/// A picture, and the files that have it.
struct PictureRequest {
  std::vector<std::string> files;  ///< empty: no picture is made
  Camera camera;
  PictureOptions options = {};
  std::optional<double> exposure = std::nullopt;  ///< if unset, automatic_exposure()
  ToneCurve tone = ToneCurve::linear;
  std::string size_text = {};                      ///< the size given, for messages; may be empty
  double pixels_per_inch = PictureFigure::screen;  ///< resolution of .png, .svg and .pdf files
  /// Title of .png, .svg and .pdf files; unset: the scene's name, but none in .png files
  std::optional<std::string> title = std::nullopt;
  bool false_colors = false;  ///< .png, .svg and .pdf files have them
  bool lux = false;           ///< illuminance instead of B
  bool quiet = false;         ///< no line on standard error
};

/// Checks camera, size and memory before a solve.
/// @throws InputError
void check_picture_request(const PictureRequest& request,
                           const std::shared_ptr<const Scene>& scene);
/// Makes the picture, shows the progress, writes the files and prints a line about them.
/// @throws NothingToSave where it is canceled: then no file is written
void write_pictures(const PictureRequest& request, std::shared_ptr<const Solution> solution,
                    ProgressDisplay& display, const Cancellation& cancellation);

}  // namespace transillum::cli
