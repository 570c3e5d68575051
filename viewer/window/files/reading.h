// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// How a file is read: asked of the user, and remembered for the file.
#pragma once

#include <QDialog>
#include <QString>
#include <QStringList>
#include <optional>
#include <utility>
#include <vector>

#include "model/run_options.h"

class QCheckBox;
class QComboBox;
class QDoubleSpinBox;
class QSettings;

namespace transillum::viewer {

/// Asks how the file of a scene is read: the unit of its lengths, orientation and joining of faces.
class ReadingDialog : public QDialog {
  Q_OBJECT

 public:
  /// @param input  shown at first; values that the dialog does not ask for stay as they are
  ReadingDialog(const QString& file, const SceneInput& input, QWidget* parent = nullptr);

  SceneInput input() const;

 private:
  void fill_units();
  void show_scale();

  SceneInput base_;
  QComboBox *unit_, *orient_, *join_;
  QDoubleSpinBox* scale_;
  QCheckBox* photometric_;
};

/// How scene files were read when they were last shown: units, orientation, joining of faces. Files
/// read as usual are not listed.
class ReadingMemory {
 public:
  /// Beyond this number, the file shown longest ago is forgotten.
  static constexpr int most_files = 200;

  /// The part of an input that is remembered: all but its changes of materials and its number of
  /// patches.
  static SceneInput reading_of(const SceneInput& input);
  /// A part of a sentence on the differences from the usual reading, such as "lengths in
  /// centimeters, faces turned"; empty if there are none.
  static QString text_of(const SceneInput& input);

  /// How the file was read; not set if it was read as usual, or never.
  /// @param path  absolute, as by QFileInfo::absoluteFilePath()
  std::optional<SceneInput> find(const QString& path) const;
  /// Notes how a file has been read; the file becomes the newest.
  void remember(const QString& path, const SceneInput& input);
  int size() const { return static_cast<int>(files_.size()); }

  void save(QSettings& settings) const;
  /// Entries that cannot be read are ignored.
  void load(const QSettings& settings);

 private:
  std::vector<std::pair<QString, SceneInput>> files_;  ///< the newest first
};

}  // namespace transillum::viewer
