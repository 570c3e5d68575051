// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// The tally of a class: a JSON file beside the lesson, or in the user's data folder for built-in
// lessons.
#include "lessons/tally.h"

#include <QCryptographicHash>
#include <QDir>
#include <QFileInfo>
#include <QSaveFile>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "base/json_text.h"
#include "support/json_object.h"

namespace transillum::viewer {

using nlohmann::json;

namespace {

constexpr int most_pages = 1 << 20, most_answers = 1 << 30;

AnswerCounts counts_from(JsonObject& object) {
  AnswerCounts counts;
  const json* answers = object.find("answers");
  if (!answers) {
    object.fail_at("answers", "is missing");
  }
  JsonObject list(*answers, object.where("answers"));
  for (const auto& item : answers->items()) {
    list.read(item.key(), counts[item.key()], 0, most_answers);
  }
  return counts;
}

}  // namespace

void Tally::keep(const QString& file) {
  if (file == file_) {
    return;
  }
  file_.clear();
  if (QFileInfo::exists(file)) {
    read(file);
  }
  file_ = file;
}

void Tally::read(const QString& file) {
  const std::string name = file.toStdString();
  const json whole = parse_json(read_json_file(name), name);
  JsonObject object(whole, name);
  const json* list = object.find("tally");
  if (!list || !list->is_array()) {
    object.fail_at("tally", "must be a list [ … ]");
  }
  object.done();
  auto sums = counts_;  // the answers so far stay as they are where the file is damaged
  for (const json& value : *list) {
    JsonObject entry(value, object.where("tally"));
    int page = 0;
    std::string ask;
    entry.read("page", page, 1, most_pages);
    entry.read("ask", ask);
    for (const auto& [answer, count] : counts_from(entry)) {
      sums[{page - 1, ask}][answer] += count;
    }
    entry.done();
  }
  counts_ = std::move(sums);
}

AnswerCounts Tally::of(int page, const Question& question) const {
  const auto found = counts_.find({page, question.ask});
  return found == counts_.end() ? AnswerCounts() : found->second;
}

void Tally::set(int page, const Question& question, AnswerCounts counts) {
  counts_[{page, question.ask}] = std::move(counts);
  if (!file_.isEmpty()) {
    write();
  }
}

void Tally::write() const {
  json list = json::array();
  for (const auto& [key, counts] : counts_) {
    if (!counts.empty()) {
      list.push_back({{"page", key.first + 1}, {"ask", key.second}, {"answers", counts}});
    }
  }
  const QByteArray text = QByteArray::fromStdString(json{{"tally", list}}.dump(2) + '\n');
  QDir().mkpath(QFileInfo(file_).path());
  QSaveFile file(file_);
  if (!file.open(QIODevice::WriteOnly) || file.write(text) < 0 || !file.commit()) {
    throw std::runtime_error((file_ + ": " + file.errorString()).toStdString());
  }
}

QString tally_file(const Lesson& lesson, const QString& folder) {
  if (folder.isEmpty()) {
    return {};
  }
  const QFileInfo file(QString::fromStdString(lesson.file));
  const QString name = file.completeBaseName() + QStringLiteral(".tally.json");
  if (lesson.built_in) {
    return folder + '/' + name;
  }
  if (QFileInfo(file.absolutePath()).isWritable()) {
    return file.absolutePath() + '/' + name;
  }
  // Lessons of the same name in different folders have different tallies.
  const QByteArray hash =
      QCryptographicHash::hash(file.absoluteFilePath().toUtf8(), QCryptographicHash::Sha1);
  return folder + '/' + QString::fromLatin1(hash.toHex().left(8)) + '-' + name;
}

}  // namespace transillum::viewer
