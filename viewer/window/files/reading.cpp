// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "window/files/reading.h"

#include <QCheckBox>
#include <QComboBox>
#include <QDialogButtonBox>
#include <QDoubleSpinBox>
#include <QFileInfo>
#include <QFormLayout>
#include <QLabel>
#include <QPushButton>
#include <QSettings>
#include <QVBoxLayout>
#include <algorithm>
#include <nlohmann/json.hpp>

#include "support/json_object.h"
#include "support/number_text.h"
#include "transillum/errors.h"
#include "transillum/scene.h"
#include "widgets/build.h"

namespace transillum::viewer {

namespace {

struct Unit {
  const char *name, *text;
};
// The display names of length_unit_names(), in their order.
constexpr Unit units[] = {{"m", QT_TRANSLATE_NOOP("ReadingDialog", "meters")},
                          {"cm", QT_TRANSLATE_NOOP("ReadingDialog", "centimeters")},
                          {"mm", QT_TRANSLATE_NOOP("ReadingDialog", "millimeters")},
                          {"in", QT_TRANSLATE_NOOP("ReadingDialog", "inches")},
                          {"ft", QT_TRANSLATE_NOOP("ReadingDialog", "feet")}};

}  // namespace

ReadingDialog::ReadingDialog(const QString& file, const SceneInput& input, QWidget* parent)
    : QDialog(parent), base_(input) {
  setObjectName("reading_dialog");
  setWindowTitle(tr("Units and orientation"));
  unit_ = named("reading_unit", new QComboBox);
  scale_ = named("reading_scale", new QDoubleSpinBox);
  scale_->setDecimals(9);
  scale_->setRange(1e-9, 1e9);
  scale_->setSuffix(tr(" m per unit"));
  orient_ = named("reading_orient", new QComboBox);
  orient_->addItems({tr("Faces as in the file"), tr("Turn faces that show their back")});
  join_ = named("reading_join", new QComboBox,
                tr("Joins faces of one plane, material and group that share edges: fewer and "
                   "larger patches"));
  join_->addItems({tr("Usual: joined in glTF and STL"), tr("Join faces of one plane"),
                   tr("Do not join faces")});
  photometric_ =
      named("reading_photometric", new QCheckBox(tr("Emissive colors are luminances, cd/m²")));
  const QString ending = QFileInfo(file).suffix().toLower();
  photometric_->setToolTip(
      tr("Only for glTF: divide by 683 lm/W instead of reading the values as radiances"));
  enable_if(*photometric_, ending == "gltf" || ending == "glb", tr("This file is not glTF"));
  fill_units();

  auto* form = new QFormLayout;
  form->addRow(tr("Lengths in"), unit_);
  form->addRow(QString(), scale_);
  form->addRow(tr("Orientation"), orient_);
  form->addRow(tr("Joining"), join_);
  form->addRow(QString(), photometric_);
  auto* title = new QLabel(tr("How %1 is read").arg(QFileInfo(file).fileName()));
  auto* note = new QLabel(tr("The choice is remembered for this file."));
  note->setForegroundRole(QPalette::PlaceholderText);
  auto* buttons = new QDialogButtonBox(QDialogButtonBox::Cancel);
  buttons->addButton(tr("Read again"), QDialogButtonBox::AcceptRole)->setDefault(true);
  auto* layout = new QVBoxLayout(this);
  layout->setSpacing(12);
  layout->addWidget(title);
  layout->addLayout(form);
  layout->addWidget(note);
  layout->addWidget(buttons);
  connect(buttons, &QDialogButtonBox::accepted, this, &QDialog::accept);
  connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::reject);
  connect(unit_, qOverload<int>(&QComboBox::currentIndexChanged), this, &ReadingDialog::show_scale);
  orient_->setCurrentIndex(input.orient ? 1 : 0);
  join_->setCurrentIndex(!input.read.join ? 0 : *input.read.join ? 1 : 2);
  photometric_->setChecked(input.read.photometric);
}

void ReadingDialog::fill_units() {
  const double scale = base_.read.scale;
  int chosen = -1;
  for (const Unit& unit : units) {
    const double meters = length_unit_from_name(unit.name);
    unit_->addItem(tr(unit.text), meters);
    if (meters == scale) {
      chosen = unit_->count() - 1;
    }
  }
  unit_->addItem(tr("other units"));
  scale_->setValue(scale);
  unit_->setCurrentIndex(chosen >= 0 ? chosen : unit_->count() - 1);
  show_scale();
}

void ReadingDialog::show_scale() {
  const QVariant meters = unit_->currentData();
  enable_if(*scale_, !meters.isValid(), tr("The unit says it"));
  if (meters.isValid()) {
    scale_->setValue(meters.toDouble());
  }
}

SceneInput ReadingDialog::input() const {
  SceneInput input = base_;
  const QVariant meters = unit_->currentData();
  input.read.scale = meters.isValid() ? meters.toDouble() : scale_->value();
  input.orient = orient_->currentIndex() == 1;
  input.read.join =
      join_->currentIndex() == 0 ? std::nullopt : std::optional(join_->currentIndex() == 1);
  input.read.photometric = photometric_->isChecked();
  return input;
}

namespace {

constexpr const char* files_key = "files/reading";

QString length_text(double scale) {
  const std::pair<const char*, QString> known_units[] = {{"mm", QObject::tr("millimeters")},
                                                         {"cm", QObject::tr("centimeters")},
                                                         {"in", QObject::tr("inches")},
                                                         {"ft", QObject::tr("feet")}};
  for (const auto& [name, text] : known_units) {
    if (scale == length_unit_from_name(name)) {
      return QObject::tr("lengths in %1").arg(text);
    }
  }
  return QObject::tr("1 unit = %1 m").arg(number_text(scale));
}

}  // namespace

SceneInput ReadingMemory::reading_of(const SceneInput& input) {
  SceneInput reading = input;
  reading.changes.clear();
  reading.patches = 0;
  reading.divided.clear();
  return reading;
}

QString ReadingMemory::text_of(const SceneInput& input) {
  const ReadOptions usual;
  const ReadOptions& read = input.read;
  QStringList parts;
  if (read.scale != usual.scale) {
    parts << length_text(read.scale);
  }
  if (input.orient) {
    parts << QObject::tr("faces turned");
  }
  if (read.join) {
    parts << (*read.join ? QObject::tr("faces joined") : QObject::tr("faces not joined"));
  }
  if (read.photometric) {
    parts << QObject::tr("emissive colors as luminances");
  }
  if (read.default_reflectance != usual.default_reflectance) {
    parts << QObject::tr("default ρ %1").arg(number_text(read.default_reflectance));
  }
  if (read.max_reflectance) {
    parts << QObject::tr("ρ at most %1").arg(number_text(*read.max_reflectance));
  }
  return parts.join(QStringLiteral(", "));
}

std::optional<SceneInput> ReadingMemory::find(const QString& path) const {
  const auto found = std::find_if(files_.begin(), files_.end(),
                                  [&](const auto& file) { return file.first == path; });
  return found == files_.end() ? std::nullopt : std::optional(found->second);
}

void ReadingMemory::remember(const QString& path, const SceneInput& input) {
  std::erase_if(files_, [&](const auto& file) { return file.first == path; });
  const SceneInput reading = reading_of(input);
  if (reading == SceneInput{}) {
    return;
  }
  files_.insert(files_.begin(), {path, reading});
  files_.resize(std::min(files_.size(), std::size_t{most_files}));
}

void ReadingMemory::save(QSettings& settings) const {
  QStringList entries;
  for (const auto& [path, input] : files_) {
    const nlohmann::json options = to_json(RunOptions{{}, {}, input});
    const nlohmann::json entry = {{"file", path.toStdString()}, {"read", options.at("read")}};
    entries << QString::fromStdString(entry.dump());
  }
  settings.setValue(files_key, entries);
}

void ReadingMemory::load(const QSettings& settings) {
  files_.clear();
  for (const QString& text : settings.value(files_key).toStringList().mid(0, most_files)) {
    try {
      const nlohmann::json entry = parse_json(text.toStdString(), files_key);
      JsonObject object(entry, files_key);
      std::string path;
      object.read("file", path);
      const nlohmann::json* read = object.find("read");
      if (read != nullptr && !path.empty()) {
        const RunOptions options = run_options_from_json({{"read", *read}}, files_key);
        files_.emplace_back(QString::fromStdString(path), reading_of(options.input));
      }
    } catch (const InputError&) {
      // A file that is read as usual is better than none.
    }
  }
}

}  // namespace transillum::viewer
