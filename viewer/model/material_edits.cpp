// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Changes of E and rho by the user, with an undo stack; changes during one drag are merged. The
// library's change_materials() applies them, to a description with materials and groups only.
#include "model/material_edits.h"

#include <algorithm>
#include <utility>

#include "transillum/at.h"
#include "transillum/errors.h"

namespace transillum::viewer {

namespace {

constexpr const char* prefixes[] = {"material:", "group:", "face:"};

std::string prefixed(TargetKind kind, const std::string& name) { return at(prefixes, kind) + name; }

bool has_prefix(const std::string& target) {
  return std::any_of(std::begin(prefixes), std::end(prefixes),
                     [&](const char* prefix) { return target.rfind(prefix, 0) == 0; });
}

std::string name_of_target(const std::string& target) {
  return target.substr(target.find(':') + 1);
}

/// The materials and groups of the scene's faces that have patches, without points.
SceneDescription faces_of(const Scene& scene) {
  SceneDescription faces;
  faces.name = scene.name();
  faces.materials = scene.materials();
  faces.groups = scene.groups();
  faces.joined_to = scene.report().joined_to;
  for (const Patch& patch : scene.patches()) {
    if (faces.face_number.empty() || faces.face_number.back() != patch.face) {
      faces.face_number.push_back(patch.face);
      faces.face_begin.push_back(0);
      faces.face_material.push_back(patch.material);
      faces.face_group.push_back(patch.group);
    }
  }
  return faces;
}

bool same(const Material& a, const Material& b) {
  return a.exitance == b.exitance && a.reflectance == b.reflectance && a.lobe == b.lobe;
}

/// `changes` with one more, in order of precedence; one of the same target is extended.
std::vector<MaterialChange> with(std::vector<MaterialChange> changes, const MaterialChange& more) {
  const auto same_target =
      std::find_if(changes.begin(), changes.end(),
                   [&](const MaterialChange& one) { return one.target == more.target; });
  if (same_target != changes.end()) {
    same_target->exitance = more.exitance ? more.exitance : same_target->exitance;
    same_target->reflectance = more.reflectance ? more.reflectance : same_target->reflectance;
    same_target->lobe = more.lobe ? more.lobe : same_target->lobe;
    return changes;
  }
  const auto place = std::find_if(changes.begin(), changes.end(),
                                  [kind = MaterialEdits::kind_of(more.target)](const auto& one) {
                                    return MaterialEdits::kind_of(one.target) > kind;
                                  });
  changes.insert(place, more);
  return changes;
}

}  // namespace

class MaterialEdits::Change : public QUndoCommand {
 public:
  Change(MaterialEdits& edits, std::string target, std::vector<MaterialChange> after)
      : edits_(edits),
        target_(std::move(target)),
        drag_(edits.drag_),
        before_(edits.changes_),
        after_(std::move(after)) {}
  int id() const override { return 1; }
  bool mergeWith(const QUndoCommand* other) override {
    const auto* later = static_cast<const Change*>(other);
    if (later->target_ != target_ || later->drag_ != drag_) {
      return false;
    }
    after_ = later->after_;
    return true;
  }
  void undo() override { edits_.put(before_); }
  void redo() override { edits_.put(after_); }

 private:
  MaterialEdits& edits_;
  std::string target_;
  int drag_;
  std::vector<MaterialChange> before_, after_;
};

std::string MaterialEdits::target_of(const Scene& scene, TargetKind kind, PatchId i) {
  switch (kind) {
    case TargetKind::face:
      return prefixed(kind, std::to_string(scene.patch(i).face));
    case TargetKind::group: {
      const std::int32_t group = scene.patch(i).group;
      return group == no_group ? std::string() : prefixed(kind, at(scene.groups(), group));
    }
    case TargetKind::material:
      break;
  }
  return prefixed(TargetKind::material, scene.material(i).name);
}

TargetKind MaterialEdits::kind_of(const std::string& target) {
  return target.rfind("face:", 0) == 0    ? TargetKind::face
         : target.rfind("group:", 0) == 0 ? TargetKind::group
                                          : TargetKind::material;
}

void MaterialEdits::start_with(std::shared_ptr<const Scene> scene) {
  scene_ = std::move(scene);
  faces_ = faces_of(*scene_);
  undo_.clear();
  put({});
}

void MaterialEdits::continue_with(std::shared_ptr<const Scene> scene) {
  scene_ = std::move(scene);
  faces_ = faces_of(*scene_);
  put(std::move(changes_));
}

std::vector<PatchId> MaterialEdits::patches_of(const std::string& target) const {
  if (!scene_) {
    return {};
  }
  const std::string name = name_of_target(target);
  const TargetKind kind = kind_of(target);
  std::vector<bool> members(kind == TargetKind::group ? scene_->groups().size()
                                                      : scene_->materials().size());
  for (std::size_t k = 0; k < members.size(); ++k) {
    members[k] =
        (kind == TargetKind::group ? scene_->groups()[k] : scene_->materials()[k].name) == name;
  }
  const int face = QString::fromStdString(name).toInt();
  const auto belongs = [&](const Patch& patch) {
    switch (kind) {
      case TargetKind::face:
        return patch.face == face;
      case TargetKind::group:
        return patch.group != no_group && at(members, patch.group);
      case TargetKind::material:
        break;
    }
    return static_cast<bool>(at(members, patch.material));
  };
  std::vector<PatchId> patches;
  for (PatchId i = 0; i < scene_->patch_count(); ++i) {
    if (belongs(scene_->patch(i))) {
      patches.push_back(i);
    }
  }
  return patches;
}

Material MaterialEdits::values_of(const std::string& target) const {
  const std::vector<PatchId> patches = patches_of(target);
  return patches.empty() ? Material{} : materials_->of(patches.front());
}

MaterialEdits::Extent MaterialEdits::extent_of(const std::string& target) const {
  const std::vector<PatchId> patches = patches_of(target);
  return {static_cast<int>(patches.size()),
          std::all_of(patches.begin(), patches.end(), [&](PatchId i) {
            return same(materials_->of(i), materials_->of(patches.front()));
          })};
}

bool MaterialEdits::changes_exitance() const {
  for (PatchId i = 0; any_ && i < scene_->patch_count(); ++i) {
    if (!(materials_->of(i).exitance == scene_->exitance(i))) {
      return true;
    }
  }
  return false;
}

void MaterialEdits::set_exitance(const std::string& target, const Rgb& exitance) {
  push({target, {}, exitance}, tr("change of %1").arg(target_text(target)));
}

void MaterialEdits::set_reflectance(const std::string& target, const Rgb& reflectance) {
  push({target, reflectance, {}}, tr("change of %1").arg(target_text(target)));
}

void MaterialEdits::set_lobe(const std::string& target, const Lobe& lobe) {
  push({.target = target, .lobe = lobe}, tr("change of %1").arg(target_text(target)));
}

void MaterialEdits::push(const MaterialChange& change, const QString& text) {
  std::vector<MaterialChange> after = with(changes_, change);
  if (after == changes_) {
    return;
  }
  if (after.size() > changes_.size()) {
    SceneDescription tried = faces_;  // if a change does not fit, nothing is changed
    change_materials(tried, std::vector{change});
  }
  auto command = std::make_unique<Change>(*this, change.target, std::move(after));
  command->setText(text);
  undo_.push(command.release());
}

void MaterialEdits::restore() {
  if (changes_.empty()) {
    return;
  }
  begin_drag();
  auto command = std::make_unique<Change>(*this, std::string(), std::vector<MaterialChange>());
  command->setText(tr("restore the scene's materials"));
  undo_.push(command.release());
}

void MaterialEdits::begin_drag() {
  ++drag_;
  emit begun();
}

std::vector<MaterialChange> MaterialEdits::changes() const {
  return any_ ? changes_ : std::vector<MaterialChange>();
}

std::string MaterialEdits::with_kind(const std::string& target) const {
  if (has_prefix(target)) {
    return target;
  }
  const bool is_material =
      std::any_of(faces_.materials.begin(), faces_.materials.end(),
                  [&](const Material& material) { return material.name == target; });
  const bool is_group =
      std::find(faces_.groups.begin(), faces_.groups.end(), target) != faces_.groups.end();
  return prefixed(!is_material && is_group ? TargetKind::group : TargetKind::material, target);
}

std::vector<std::string> MaterialEdits::start_over(const std::vector<MaterialChange>& changes) {
  if (changes.empty() && changes_.empty()) {
    return {};
  }
  std::vector<std::string> misfits;
  std::vector<MaterialChange> fitting;
  for (MaterialChange change : changes) {
    change.target = with_kind(change.target);
    try {
      SceneDescription tried = faces_;
      change_materials(tried, std::vector{change});
      fitting = with(std::move(fitting), change);
    } catch (const InputError& error) {
      misfits.emplace_back(error.what());
    }
  }
  undo_.clear();
  put(std::move(fitting));
  return misfits;
}

void MaterialEdits::put(std::vector<MaterialChange> changes) {
  changes_ = std::move(changes);
  apply();
  emit changed();
}

void MaterialEdits::apply() {
  SceneDescription changed_faces = faces_;
  try {
    change_materials(changed_faces, changes_);
  } catch (const InputError&) {  // a face was removed
    for (const MaterialChange& change : changes_) {
      try {
        change_materials(changed_faces, std::vector{change});
      } catch (const InputError&) {
      }
    }
  }
  auto materials = std::make_shared<PatchMaterials>();
  materials->materials = std::move(changed_faces.materials);
  materials->of_patch.reserve(scene_->patches().size());
  any_ = has_light_ = false;
  std::size_t face = 0;
  for (const Patch& patch : scene_->patches()) {
    face += patch.face > faces_.face_number[face] ? 1U : 0U;
    const std::int32_t number = at(changed_faces.face_material, face);
    materials->of_patch.push_back(number);
    const Material& material = at(materials->materials, number);
    any_ = any_ || !same(material, at(faces_.materials, patch.material));
    has_light_ = has_light_ || max_abs(material.exitance) > 0;
  }
  materials_ = std::move(materials);
}

QString target_text(const std::string& target) {
  constexpr int longest = 28;
  QString name = QString::fromStdString(name_of_target(target));
  if (name.size() > longest) {
    name = name.left(longest - 1) + QStringLiteral("…");
  }
  switch (MaterialEdits::kind_of(target)) {
    case TargetKind::face:
      return MaterialEdits::tr("Face %1").arg(name);
    case TargetKind::group:
      return MaterialEdits::tr("Group \"%1\"").arg(name);
    case TargetKind::material:
      break;
  }
  return MaterialEdits::tr("Material \"%1\"").arg(name);
}

}  // namespace transillum::viewer
