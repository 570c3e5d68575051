// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
// Changes of materials by the name of a material, a group or a face. All names are resolved before
// anything is changed; then each change selects faces, and where these are only some of a
// material's faces, they get a copy of the material.
#include "transillum/material_changes.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <map>
#include <set>

#include "base/did_you_mean.h"
#include "base/text_file.h"
#include "scene/build/description_check.h"
#include "transillum/at.h"
#include "transillum/errors.h"

namespace transillum {
namespace {

constexpr std::size_t listed_names = 8;
constexpr std::size_t longest_suggestion = 60;

/// What a change applies to.
struct Target {
  enum class Kind { material, group, face } kind = Kind::face;
  std::vector<bool> members;                 ///< by material or group: whether it is meant
  std::size_t face_begin = 0, face_end = 0;  ///< the faces of one number
};

/// Finds what targets mean in a description.
class TargetFinder {
 public:
  explicit TargetFinder(const SceneDescription& description) : description_(description) {
    for (const Material& m : description.materials) {
      materials_.push_back(m.name);
    }
    used_.resize(materials_.size());
    for (const std::int32_t m : description.face_material) {
      at(used_, m) = true;
    }
  }

  Target find(const std::string& name) {
    if (auto found = find_spelled(name, false)) {
      return *found;
    }
    if (auto found = find_by_prefix(name)) {
      return *found;
    }
    if (auto found = find_spelled(name, true)) {
      return *found;
    }
    throw InputError(fmt::format("{}: no material, group or face:N is named {}{}",
                                 description_.name, in_quotes(name), known_names(name)));
  }
  /// Remarks for SceneDescription::notes.
  std::vector<std::string> notes;

 private:
  using Names = std::vector<std::string>;

  static std::optional<std::vector<bool>> members(const Names& names, const std::string& name,
                                                  bool ignore_case) {
    std::vector<bool> found(names.size());
    const std::string wanted = ignore_case ? lower_case(name) : name;
    for (std::size_t i = 0; i < names.size(); ++i) {
      found[i] = (ignore_case ? lower_case(names[i]) : names[i]) == wanted;
    }
    if (std::find(found.begin(), found.end(), true) == found.end()) {
      return {};
    }
    return found;
  }
  std::optional<Target> find_material(const std::string& name, bool ignore_case) {
    auto found = members(materials_, name, ignore_case);
    if (!found) {
      return {};
    }
    bool in_use = false;
    for (std::size_t m = 0; m < found->size(); ++m) {
      in_use = in_use || ((*found)[m] && used_[m]);
    }
    if (!in_use) {
      notes.push_back(fmt::format("{}: material {} is changed, but no face uses it",
                                  description_.name, in_quotes(name)));
    }
    return Target{Target::Kind::material, *std::move(found)};
  }
  std::optional<Target> find_group(const std::string& name, bool ignore_case) const {
    auto found = members(description_.groups, name, ignore_case);
    return found ? std::optional(Target{Target::Kind::group, *std::move(found)}) : std::nullopt;
  }
  std::optional<Target> find_spelled(const std::string& name, bool ignore_case) {
    std::optional<Target> material = find_material(name, ignore_case);
    std::optional<Target> group = find_group(name, ignore_case);
    if (material && group) {
      notes.push_back(fmt::format(
          "{}: {} is a material and a group; the material is changed (for the group: {})",
          description_.name, in_quotes(name), in_quotes("group:" + name)));
    }
    return material ? material : group;
  }
  std::optional<Target> find_by_prefix(const std::string& name) {
    const std::size_t colon = name.find(':');
    if (colon == std::string::npos) {
      return {};
    }
    const std::string kind = name.substr(0, colon), rest = name.substr(colon + 1);
    for (const bool ignore_case : {false, true}) {
      std::optional<Target> found;
      if (kind == "material") {
        found = find_material(rest, ignore_case);
      } else if (kind == "group") {
        found = find_group(rest, ignore_case);
      }
      if (found) {
        return found;
      }
    }
    return kind == "face" ? std::optional(find_face(rest)) : std::nullopt;
  }
  Target find_face(const std::string& digits) const {
    std::int32_t number = -1;
    const char* const last = digits.data() + digits.size();
    const auto [end, error] = std::from_chars(digits.data(), last, number);
    const std::int32_t largest = std::max(description_.number_of(description_.face_count() - 1),
                                          static_cast<std::int32_t>(joined_to().size()) - 1);
    if (error == std::errc::invalid_argument || end != last || digits.front() == '-') {
      throw InputError(fmt::format("{}: face {} is not a number; faces are numbered 0 to {}",
                                   description_.name, in_quotes(digits), largest));
    }
    const std::size_t first = first_face(number);
    if (error == std::errc() && first < first_face(std::int64_t{number} + 1)) {
      return Target{Target::Kind::face, {}, first, first_face(std::int64_t{number} + 1)};
    }
    if (error == std::errc() && static_cast<std::size_t>(number) < joined_to().size() &&
        at(joined_to(), number) >= 0) {
      const std::int32_t now = at(joined_to(), number);
      throw InputError(fmt::format(
          "{}: face {} was joined to face {}, as faces of one plane, material and group are; "
          "change face {}, or read the faces as they are in the file",
          description_.name, number, now, now));
    }
    throw InputError(fmt::format("{}: there is no face {}; faces are numbered 0 to {}",
                                 description_.name, digits, largest));
  }
  const std::vector<std::int32_t>& joined_to() const { return description_.joined_to; }
  /// The first face with this number or a larger one.
  std::size_t first_face(std::int64_t number) const {
    const std::vector<std::int32_t>& numbers = description_.face_number;
    return numbers.empty()
               ? static_cast<std::size_t>(std::clamp<std::int64_t>(
                     number, 0, static_cast<std::int64_t>(description_.face_count())))
               : static_cast<std::size_t>(std::lower_bound(numbers.begin(), numbers.end(), number) -
                                          numbers.begin());
  }
  /// The end of the message about an unknown name: a similar one, or the first few there are.
  std::string known_names(const std::string& name) const {
    Names all = materials_;
    all.insert(all.end(), description_.groups.begin(), description_.groups.end());
    std::string similar = did_you_mean(name, all);
    if (!similar.empty() || all.empty()) {
      return similar;
    }
    std::string list;
    for (std::size_t i = 0; i < std::min(all.size(), listed_names); ++i) {
      list += (i == 0 ? "; there are " : ", ") + in_quotes(all[i]);
    }
    return list + (all.size() > listed_names
                       ? fmt::format(" and {} more", all.size() - listed_names)
                       : std::string());
  }

  const SceneDescription& description_;
  Names materials_;
  std::vector<bool> used_;
};

/// Changes the materials of faces. Keeps how many faces each material has, so that a change for all
/// of them needs no copy.
class MaterialEditor {
 public:
  explicit MaterialEditor(SceneDescription& description)
      : description_(description),
        original_(description.face_material),
        uses_(description.materials.size()) {
    for (const std::int32_t m : original_) {
      ++at(uses_, m);
    }
    for (const Material& m : description.materials) {
      names_.insert(m.name);
    }
  }

  void apply(const MaterialChange& change, const Target& target) {
    if (target.kind == Target::Kind::material) {
      change_unused(change, target);
    }
    std::map<std::int32_t, std::vector<std::size_t>> selected;  // by material
    if (target.kind == Target::Kind::face) {
      for (std::size_t f = target.face_begin; f < target.face_end; ++f) {
        selected[description_.face_material[f]].push_back(f);
      }
    } else {
      for (std::size_t f = 0; f < description_.face_count(); ++f) {
        const std::int32_t member =
            target.kind == Target::Kind::material ? original_[f] : description_.group_of(f);
        if (member >= 0 && at(target.members, member)) {
          selected[description_.face_material[f]].push_back(f);
        }
      }
    }
    for (const auto& [material, faces] : selected) {
      change_faces(change, material, faces);
    }
  }

 private:
  static Material changed(Material material, const MaterialChange& change) {
    material.reflectance = change.reflectance.value_or(material.reflectance);
    material.exitance = change.exitance.value_or(material.exitance);
    material.lobe = change.lobe.value_or(material.lobe);
    return material;
  }
  /// Materials that no face uses have no faces to select.
  void change_unused(const MaterialChange& change, const Target& target) {
    for (std::size_t m = 0; m < target.members.size(); ++m) {
      if (target.members[m] && uses_[m] == 0) {
        description_.materials[m] = changed(description_.materials[m], change);
      }
    }
  }
  void change_faces(const MaterialChange& change, std::int32_t material,
                    const std::vector<std::size_t>& faces) {
    Material& old = at(description_.materials, material);
    Material made = changed(old, change);
    if (made.reflectance == old.reflectance && made.exitance == old.exitance &&
        made.lobe == old.lobe) {
      return;
    }
    if (faces.size() == at(uses_, material)) {
      old = std::move(made);
      return;
    }
    made.name = new_name(old.name, change.target);
    const auto number = static_cast<std::int32_t>(description_.materials.size());
    description_.materials.push_back(std::move(made));
    at(uses_, material) -= faces.size();
    uses_.push_back(faces.size());
    for (const std::size_t f : faces) {
      description_.face_material[f] = number;
    }
  }
  /// The name of a part of a material, unlike all others.
  std::string new_name(const std::string& material, std::string target) {
    for (char& c : target) {
      c = c == ':' || c == ' ' ? '-' : c;
    }
    const std::string name = fmt::format("{}-{}", material, target);
    std::string unique = name;
    for (int i = 2; !names_.insert(unique).second; ++i) {
      unique = fmt::format("{}-{}", name, i);
    }
    return unique;
  }

  SceneDescription& description_;
  const std::vector<std::int32_t> original_;  ///< material of each face before the first change
  std::vector<std::size_t> uses_;             ///< by material: number of faces
  std::set<std::string> names_;
};

void check_values(const SceneDescription& description, const MaterialChange& change) {
  const std::string place =
      fmt::format("{}: change of {}: ", description.name, in_quotes(change.target));
  if (change.reflectance) {
    check_reflectance(*change.reflectance, place);
  }
  if (change.exitance) {
    check_exitance(*change.exitance, place);
  }
  if (change.lobe) {
    check_lobe(*change.lobe, place);
  }
}

/// The parts of NAME=V,V,…: the name and the numbers; none where the text has another form.
std::pair<std::string, std::vector<double>> named_numbers(const std::string& text) {
  const std::size_t equals = text.rfind('=');
  if (equals == std::string::npos || equals == 0) {
    return {};
  }
  std::vector<double> values;
  for (std::size_t begin = equals + 1; begin <= text.size();) {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    const auto number = parse_number(std::string_view(text).substr(begin, end - begin));
    if (!number) {
      return {};
    }
    values.push_back(*number);
    begin = end + 1;
  }
  return {text.substr(0, equals), values};
}

/// The parts of NAME=V or NAME=V,V,V.
std::pair<std::string, Rgb> named_values(const std::string& text) {
  const auto [name, values] = named_numbers(text);
  if (values.size() != 1 && values.size() != 3) {
    throw InputError(in_quotes(text) + " is not NAME=VALUE or NAME=RED,GREEN,BLUE");
  }
  return {name, {values[0], values[values.size() / 2], values[values.size() - 1]}};
}

bool suggests_light(const std::string& name) {
  constexpr std::array words{"light", "lamp", "bulb", "licht", "leucht", "emi",
                             "glow",  "luz",  "luce", "neon",  "lumi"};
  const std::string lower = lower_case(name);
  return std::any_of(words.begin(), words.end(),
                     [&](const char* word) { return lower.find(word) != std::string::npos; });
}

bool fits_on_a_line(const std::string& name) {
  return !name.empty() && name.size() <= longest_suggestion &&
         std::none_of(name.begin(), name.end(), [](unsigned char c) {
           return c < 0x20 || c == 0x7f || c == '\'' || c == '"';
         });
}

}  // namespace

MaterialChange exitance_change(const std::string& text) {
  auto [target, exitance] = named_values(text);
  return {.target = std::move(target), .exitance = exitance};
}

MaterialChange reflectance_change(const std::string& text) {
  auto [target, reflectance] = named_values(text);
  return {.target = std::move(target), .reflectance = reflectance};
}

MaterialChange lobe_change(const std::string& text) {
  const auto [target, values] = named_numbers(text);
  if (values.size() != 2 && values.size() != 4) {
    throw InputError(in_quotes(text) +
                     " is not NAME=SHARE,EXPONENT or NAME=RED,GREEN,BLUE,EXPONENT");
  }
  const std::size_t last = values.size() - 1;
  Lobe lobe{.reflectance = {values[0], values[last / 2], values[last - 1]}};
  lobe.exponent = values[last];
  return {.target = target, .lobe = lobe};
}

void change_materials(SceneDescription& description, std::span<const MaterialChange> changes) {
  TargetFinder finder(description);
  std::vector<Target> targets;
  for (const MaterialChange& change : changes) {
    check_values(description, change);
    targets.push_back(finder.find(change.target));
  }
  MaterialEditor editor(description);
  for (std::size_t i = 0; i < changes.size(); ++i) {
    editor.apply(changes[i], targets[i]);
  }
  description.notes.insert(description.notes.end(), finder.notes.begin(), finder.notes.end());
}

std::string suggested_light(const SceneDescription& description) {
  std::vector<std::size_t> uses(description.materials.size());
  for (const std::int32_t m : description.face_material) {
    ++at(uses, m);
  }
  const std::string* best = nullptr;
  std::size_t fewest = description.face_count() + 1;
  for (std::size_t m = 0; m < uses.size(); ++m) {
    const std::string& name = description.materials[m].name;
    if (uses[m] == 0 || !fits_on_a_line(name)) {
      continue;
    }
    if (suggests_light(name)) {
      return name;
    }
    if (uses[m] < fewest) {
      best = &name;
      fewest = uses[m];
    }
  }
  for (const std::string& name : description.groups) {
    if (fits_on_a_line(name) && suggests_light(name)) {
      return name;
    }
  }
  return best ? *best : fmt::format("face:{}", description.number_of(0));
}

}  // namespace transillum
