// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "transillum/scene.h"

namespace transillum::viewer {

/// Writes faces as OBJ with MTL, each once. The file lacks what kept_lists() has.
/// @throws std::runtime_error if a file cannot be written
void write_kept_faces(const std::filesystem::path& obj, const SceneDescription& faces);

/// Name, files, numbers and sides of faces, and the rounding of their coordinates.
nlohmann::json kept_lists(const SceneDescription& faces);

/// Reads the faces of write_kept_faces() and kept_lists().
/// @param where  begins the message of an error in the lists
/// @throws InputError if the file cannot be read, or the lists do not belong to it
SceneDescription read_kept_faces(const std::filesystem::path& obj, const nlohmann::json& lists,
                                 const std::string& where);

}  // namespace transillum::viewer
