// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "patches/warning_list.h"

#include <QRegularExpression>
#include <utility>
#include <vector>

namespace transillum::viewer {

namespace {

constexpr int patches_role = Qt::UserRole;

// Messages about a face begin with "name:line: face N: ", N as Patch::face.
std::vector<PatchId> patches_named(const QString& warning, const Scene& scene) {
  static const QRegularExpression place(QStringLiteral("(?:^|: )face (\\d+): "));
  const QRegularExpressionMatch match = place.match(warning);
  std::vector<PatchId> patches;
  for (PatchId i = 0; match.hasMatch() && i < scene.patch_count(); ++i) {
    if (scene.patch(i).face == match.captured(1).toInt()) {
      patches.push_back(i);
    }
  }
  return patches;
}

}  // namespace

WarningList::WarningList(Selection& selection, QWidget* parent)
    : QListWidget(parent), selection_(selection) {
  setObjectName("warning_list");
  setWordWrap(true);
  setAlternatingRowColors(true);
  setFrameShape(QFrame::NoFrame);
  connect(this, &QListWidget::itemClicked, this,
          [this](const QListWidgetItem* item) { choose(*item); });
  connect(this, &QListWidget::itemActivated, this,
          [this](const QListWidgetItem* item) { choose(*item); });
}

void WarningList::show_scene(std::shared_ptr<const Scene> scene) {
  scene_ = std::move(scene);
  clear();
  for (const std::string& warning : scene_->report().warnings) {
    auto* item = new QListWidgetItem(QString::fromStdString(warning), this);
    const std::vector<PatchId> patches = patches_named(item->text(), *scene_);
    QVariantList list;
    for (const PatchId patch : patches) {
      list << patch;
    }
    item->setData(patches_role, list);
    item->setToolTip(patches.empty() ? tr("This warning is about no face of the scene")
                                     : tr("Click to go to the face"));
  }
  if (count() == 0) {
    auto* none = new QListWidgetItem(tr("No warnings about this scene"), this);
    none->setFlags(Qt::NoItemFlags);
  }
}

void WarningList::choose(const QListWidgetItem& item) {
  std::vector<PatchId> patches;
  for (const QVariant& patch : item.data(patches_role).toList()) {
    patches.push_back(patch.toInt());
  }
  if (patches.empty()) {
    return;
  }
  selection_.select_all(std::move(patches));
  emit face_chosen();
}

}  // namespace transillum::viewer
