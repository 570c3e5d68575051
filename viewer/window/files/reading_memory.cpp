// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "window/files/reading_memory.h"

#include <QSettings>
#include <algorithm>
#include <nlohmann/json.hpp>

#include "support/json_object.h"
#include "support/number_text.h"
#include "transillum/errors.h"

namespace transillum::viewer {

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
