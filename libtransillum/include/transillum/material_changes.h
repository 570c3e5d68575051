// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

// Changes of materials by name, before a Scene is made of a description: a light for a scene that
// has none, another reflectance for a group of faces. Files, command lines and windows name what
// to change in the same way.

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "transillum/export.h"
#include "transillum/scene.h"

namespace TRANSILLUM_API transillum {

/// New values for the material of some faces.
struct MaterialChange {
  /// Which faces: the name of a material, the name of a group of faces, or `face:N`, the face with
  /// the number N in results (SceneDescription::number_of()). A name that is both means the
  /// material; `material:NAME` and `group:NAME` say which. Names are found without regard to case
  /// where none is spelled exactly so.
  std::string target;
  std::optional<Rgb> reflectance = std::nullopt;  ///< rho, 0 <= rho < 1 per channel; kept if unset
  std::optional<Rgb> exitance = std::nullopt;     ///< E, W/m², >= 0; kept if unset
  std::optional<Lobe> lobe = std::nullopt;        ///< its glossy part; kept if unset

  /// Exact comparison.
  friend bool operator==(const MaterialChange&, const MaterialChange&) = default;
};

/// A change of E from the text `NAME=E` or `NAME=R,G,B`: one number is for all channels. NAME ends
/// at the last `=`.
/// @throws InputError where the text has another form; values are checked by change_materials()
MaterialChange exitance_change(const std::string& text);
/// A change of rho from a text of the same form.
/// @throws InputError
MaterialChange reflectance_change(const std::string& text);
/// A change of the lobe to Phong's, from the text `NAME=K,N` or `NAME=R,G,B,N`: the fraction K of
/// the light that it reflects, for all channels or for each, and the exponent N.
/// @throws InputError
MaterialChange lobe_change(const std::string& text);

/// Applies changes in their order: of two for the same face and value, the later one holds. All
/// targets refer to the description as it is before the first change, so a change of a material
/// also reaches its faces to which an earlier change gave another exitance.
///
/// Where a change is for a part of a material's faces, these get a new material, named after the
/// material and the target. Materials in use keep their numbers; new ones are appended. A target
/// that is both a material and a group, or a material that no face uses, is noted in
/// SceneDescription::notes. Faces, groups and points are not changed.
///
/// Time: linear in the faces, for each change of a group or a material.
/// @throws InputError naming the target and, if a name of the scene is similar, that name; the
/// value and the valid range; for a face that was joined to another, that one. Then nothing is
/// changed.
void change_materials(SceneDescription& description, std::span<const MaterialChange> changes);

/// A target for a change that gives the scene its first light, for messages: a material in use or
/// a group whose name suggests a lamp ("light", "Lampe", "bulb" …), else the material in use with
/// the fewest faces; the first face where no material in use has a name that fits on a line.
std::string suggested_light(const SceneDescription& description);

}  // namespace TRANSILLUM_API transillum
