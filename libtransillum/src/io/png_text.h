// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <string>
#include <vector>

namespace transillum {

/// The bytes of a PNG file.
/// @param colors sRGB, three bytes a pixel, or four with alpha, row by row from the top.
/// @throws std::runtime_error if libpng fails.
std::string png_of(int width, int height, const std::vector<unsigned char>& colors);

/// A chunk of a PNG file: its length, type, body and checksum.
/// @param type  four letters
std::string png_chunk(const std::string& type, const std::string& body);
/// The chunk that says how large a pixel is, pHYs.
/// @param pixels_per_inch  0 gives an empty text: the size is not known
std::string png_size_chunk(double pixels_per_inch);
/// A PNG file with further chunks before its pixels.
std::string png_with_chunks(const std::string& png, const std::string& chunks);

}  // namespace transillum
