// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Files of pictures: radiance as it is (.exr, .pfm), or colors that a screen can show (.png).
#pragma once

#include <filesystem>

#include "transillum/choice.h"
#include "transillum/export.h"
#include "transillum/picture.h"
#include "transillum/vec3.h"

namespace TRANSILLUM_API transillum {

/// How exposed light becomes a color.
enum class ToneCurve {
  linear,  ///< proportional; what is brighter than white keeps its hue
  aces,    ///< film curve of ACES, as fitted by K. Narkowicz (2016)
  filmic,  ///< film curve of J. Hable (2010), white at 11.2 after an exposure of 2
};
/// @returns the texts of tone curves.
template <>
const Choices& choices_of<ToneCurve>();

/// Colors of a picture on a screen.
struct PictureLook {
  /// Linear color per radiosity, m²/W, > 0: pi times the radiance, which is B of a diffuse surface,
  /// times it is 1 where a linear picture becomes white.
  double exposure = 1;
  ToneCurve tone = ToneCurve::linear;  ///< from exposed light to linear color

  /// @throws InputError naming the value and its range.
  void validate() const;
};
/// The linear color in which a radiance is shown, each channel from 0 to 1.
Rgb shown_color(const Rgb& radiance, const PictureLook& look);

/// A scale of false colors for B = pi times the radiance, by its luminance (Rec. 709).
struct FalseColors {
  double highest = 1;  ///< B at the upper end of the scale, W/m², > 0; the lower end is 0
  bool lux = false;    ///< the scale says lux, lm/m², at 683 lm/W, instead of W/m²

  /// @throws InputError naming the value and its range.
  void validate() const;
};

/// Whether `path` ends in .png, .exr or .pfm.
bool is_picture_file(const std::filesystem::path& path);
/// Whether `path` ends in .png: such a file has the colors of a PictureLook or FalseColors.
bool is_screen_picture(const std::filesystem::path& path);
/// Checks, before a long computation, that `path` is writable and ends in .png, .exr or .pfm.
/// @throws InputError
void check_picture_path(const std::filesystem::path& path);
/// Writes a picture in the format given by the extension of `path`, completely or not at all.
///
/// - .png: 8 bits a channel, sRGB.
/// - .exr: OpenEXR, channels R, G, B of 32-bit floating-point numbers: radiance, W/(m² sr).
/// - .pfm: the same numbers as a portable float map, little-endian, rows from the bottom.
/// @param path the file.
/// @param picture the picture.
/// @param look of .png files.
/// @throws InputError as check_picture_path(), for a look out of range, or a picture without its
/// pixels; std::runtime_error if the file cannot be written.
void write_picture(const std::filesystem::path& path, const Picture& picture,
                   const PictureLook& look = {});
/// Writes a .png file of the picture in false colors, with a labeled scale on its right, which
/// makes it wider.
/// @throws InputError, std::runtime_error as write_picture()
void write_false_colors(const std::filesystem::path& path, const Picture& picture,
                        const FalseColors& colors);

}  // namespace TRANSILLUM_API transillum
