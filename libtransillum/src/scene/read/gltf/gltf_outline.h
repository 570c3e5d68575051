// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace transillum {

inline constexpr const char* meshopt_extension = "EXT_meshopt_compression";
inline constexpr const char* draco_extension = "KHR_draco_mesh_compression";

/// Reads which extensions a file requires, and checks the numbers of places of data, which the
/// parser takes as 0 where they are negative or no whole numbers.
/// @param text that check_json() has passed
/// @param name of the file, at the beginning of messages
/// @throws InputError
std::vector<std::string> required_extensions(std::string_view text, const std::string& name);

/// Whether a file has compressed data, which the parser refuses.
bool is_compressed_gltf(std::string_view text);

/// The text of a compressed file as the parser takes it: a byte of data for each buffer without
/// any, and no indices where they are in the compressed data.
std::string parsable_gltf(std::string_view text);

}  // namespace transillum
