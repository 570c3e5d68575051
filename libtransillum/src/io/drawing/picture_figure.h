// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <utility>

#include "transillum/files.h"
#include "transillum/picture.h"

namespace transillum {

/// A picture as a figure: below its title, with the scale of its false colors at its right.
struct PictureFigure {
  static constexpr double screen = 96;  ///< pixels per inch of a screen with scale 1, as in CSS

  std::string title = {};                                  ///< any bytes; empty without a title
  PictureLook look = {};                                   ///< colors, but for false colors
  std::optional<FalseColors> false_colors = std::nullopt;  ///< false colors instead of `look`
  double pixels_per_inch = screen;                         ///< resolution of the picture, > 0
};

/// Width and height of a .png file, pixels.
/// @param width, height  of the picture, pixels
std::pair<int, int> figure_pixels(int width, int height, const PictureFigure& figure);
/// Whether `path` ends in .svg or .pdf.
bool is_figure_file(const std::filesystem::path& path);
/// Checks, before a long computation, that `path` is writable and ends as a picture's or a figure's
/// name.
/// @throws InputError
void check_figure_path(const std::filesystem::path& path);
/// Writes a figure in the format given by the extension of `path`, completely or not at all: the
/// picture as an image, the scale as vectors, texts as text; in .png files everything is in pixels.
/// A picture with coverage has no paper behind it.
/// @throws InputError for another ending, a value out of range, or a picture without its pixels;
/// std::runtime_error if the file cannot be written
void write_figure(const std::filesystem::path& path, const Picture& picture,
                  const PictureFigure& figure);

}  // namespace transillum
