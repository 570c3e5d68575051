// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QObject>
#include <QString>

namespace transillum::viewer {

/// A change of the open scene that a film shows in equal steps, each in the light that follows such
/// a change. The scene and its solve are as before once the film ends.
///
/// Threads: the main thread only.
class FilmedChange : public QObject {
  Q_OBJECT

 public:
  using QObject::QObject;

  /// Whether there is a change that can be filmed now.
  virtual bool can_film() const = 0;
  /// Begins a film. Requires can_film().
  /// @param count  its pictures, at least 2
  virtual void begin_film(int count) = 0;
  /// Shows a picture of the film; busy() until it is shown, and lit() is emitted then.
  /// @param index  from 0
  virtual void show_picture(int index) = 0;
  /// The text in a picture of the film; empty for none.
  virtual QString caption(int index) const = 0;
  /// Shows the scene as it was before the film; does nothing while there is no film.
  virtual void end_film() = 0;
  /// Whether something is computed that is not shown yet.
  virtual bool busy() const = 0;

 signals:
  void lit();  ///< the light of a step of the change is shown
  /// The film cannot continue, as where the user makes the change by hand.
  void film_lost(const QString& why);
};

}  // namespace transillum::viewer
