// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "window/files/kept_faces.h"

#include "transillum/errors.h"
#include "transillum/files.h"

namespace transillum::viewer {

using nlohmann::json;

void write_kept_faces(const std::filesystem::path& obj, const SceneDescription& faces) {
  SceneDescription written = faces;
  written.face_two_sided.clear();  // such a face would be written, and read, as two
  written.files.clear();
  write_obj(obj, written);
}

json kept_lists(const SceneDescription& faces) {
  return {{"name", faces.name},
          {"files", faces.files},
          {"numbers", faces.face_number},
          {"joined-to", faces.joined_to},
          {"two-sided", faces.face_two_sided},
          {"rounding", faces.coordinate_rounding},
          {"patches", faces.faces_are_patches}};
}

SceneDescription read_kept_faces(const std::filesystem::path& obj, const json& lists,
                                 const std::string& where) {
  SceneDescription faces = describe_scene(obj.string());
  try {
    lists.at("name").get_to(faces.name);
    lists.at("files").get_to(faces.files);
    lists.at("numbers").get_to(faces.face_number);
    lists.at("joined-to").get_to(faces.joined_to);
    lists.at("two-sided").get_to(faces.face_two_sided);
    lists.at("rounding").get_to(faces.coordinate_rounding);
    lists.at("patches").get_to(faces.faces_are_patches);
  } catch (const json::exception&) {
    throw InputError(where + ": damaged");
  }
  const std::size_t count = faces.face_count();
  for (const std::size_t size : {faces.face_number.size(), faces.face_two_sided.size()}) {
    if (size != 0 && size != count) {
      throw InputError(where + ": not of the faces in " + obj.string());
    }
  }
  faces.face_line.assign(count, 0);  // lines of the user's file are not known
  return faces;
}

}  // namespace transillum::viewer
