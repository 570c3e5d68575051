// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Materials edited by the user, with an undo stack; changes during one drag are merged.
#include "model/material_edits.h"

#include <algorithm>
#include <utility>

#include "transillum/at.h"

namespace transillum::viewer {

namespace {

bool same(const Material& a, const Material& b) {
  return a.exitance == b.exitance && a.reflectance == b.reflectance;
}

}  // namespace

class MaterialEdits::Change : public QUndoCommand {
 public:
  Change(MaterialEdits& edits, int material, Material after)
      : edits_(edits),
        material_(material),
        drag_(edits.drag_),
        before_(at(edits.now_, material)),
        after_(std::move(after)) {
    setText(MaterialEdits::tr("change %1").arg(QString::fromStdString(before_.name)));
  }
  int id() const override { return 1; }
  bool mergeWith(const QUndoCommand* other) override {
    const auto* later = static_cast<const Change*>(other);
    if (later->material_ != material_ || later->drag_ != drag_) {
      return false;
    }
    after_ = later->after_;
    return true;
  }
  void undo() override { edits_.put(material_, before_.exitance, before_.reflectance); }
  void redo() override { edits_.put(material_, after_.exitance, after_.reflectance); }

 private:
  MaterialEdits& edits_;
  int material_;
  int drag_;
  Material before_, after_;
};

void MaterialEdits::start_with(std::vector<Material> materials) {
  originals_ = now_ = std::move(materials);
  undo_.clear();
  emit changed();
}

bool MaterialEdits::any() const {
  for (std::size_t m = 0; m < now_.size(); ++m) {
    if (!same(now_[m], originals_[m])) {
      return true;
    }
  }
  return false;
}

void MaterialEdits::set(int material, const Rgb& exitance, const Rgb& reflectance) {
  Material after = at(now_, material);
  after.exitance = exitance;
  after.reflectance = reflectance;
  if (!same(after, at(now_, material))) {
    undo_.push(new Change(*this, material, std::move(after)));
  }
}

void MaterialEdits::restore() {
  if (!any()) {
    return;
  }
  begin_drag();
  undo_.beginMacro(tr("restore the scene's materials"));
  for (std::size_t m = 0; m < now_.size(); ++m) {
    set(static_cast<int>(m), originals_[m].exitance, originals_[m].reflectance);
  }
  undo_.endMacro();
}

std::vector<MaterialChange> MaterialEdits::changes() const {
  std::vector<MaterialChange> changes;
  for (std::size_t m = 0; m < now_.size(); ++m) {
    if (!same(now_[m], originals_[m])) {
      changes.push_back({now_[m].name, now_[m].exitance, now_[m].reflectance});
    }
  }
  return changes;
}

std::vector<std::string> MaterialEdits::start_over(const std::vector<MaterialChange>& changes) {
  if (changes.empty() && !any()) {
    return {};
  }
  std::vector<std::string> unknown;
  now_ = originals_;
  for (const MaterialChange& change : changes) {
    const auto changed_material = std::find_if(
        now_.begin(), now_.end(), [&](const Material& one) { return one.name == change.name; });
    if (changed_material == now_.end()) {
      unknown.push_back(change.name);
      continue;
    }
    changed_material->exitance = change.exitance;
    changed_material->reflectance = change.reflectance;
  }
  undo_.clear();
  emit changed();
  return unknown;
}

void MaterialEdits::put(int material, const Rgb& exitance, const Rgb& reflectance) {
  Material& changed_material = at(now_, material);
  changed_material.exitance = exitance;
  changed_material.reflectance = reflectance;
  emit changed();
}

}  // namespace transillum::viewer
