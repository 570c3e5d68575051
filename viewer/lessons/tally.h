// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QString>
#include <map>
#include <string>
#include <utility>

#include "lessons/lesson.h"

namespace transillum::viewer {

/// How often each answer to a question was given.
using AnswerCounts = std::map<std::string, int>;

/// The answers of a class to the questions of one lesson, kept in a file.
class Tally {
 public:
  /// Keeps the answers in a file from now on, which is made by the next answer, and adds those that
  /// the file has; in memory only if `file` is empty, as at first.
  /// @throws InputError where it cannot be read; then the answers are kept in memory
  void keep(const QString& file);

  /// The answers to a question. Empty if it has not been answered, or if the page had another
  /// question when it was answered.
  /// @param page from 0
  AnswerCounts of(int page, const Question& question) const;
  /// @throws std::runtime_error where the file cannot be written
  void set(int page, const Question& question, AnswerCounts counts);

  /// The file; empty if the answers are kept in memory only.
  const QString& file() const { return file_; }

 private:
  void read(const QString& file);
  void write() const;

  QString file_;
  std::map<std::pair<int, std::string>, AnswerCounts> counts_;  ///< by page and Question::ask
};

/// Where the tally of a lesson is kept: beside a lesson file if its folder is writable, else in
/// `folder`. @returns empty if `folder` is
QString tally_file(const Lesson& lesson, const QString& folder);

}  // namespace transillum::viewer
