// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QPixmap>
#include <QScrollArea>
#include <QString>
#include <QVector>

class QAction;
class QBoxLayout;
class QGridLayout;
class QLabel;

namespace transillum::viewer {

/// A button that looks like a card: a picture, a title and one line of text.
class StartCard;

/// The first page of the window: what to do, the built-in scenes, the lessons and the user's files.
class StartPage : public QScrollArea {
  Q_OBJECT

 public:
  struct LessonEntry {
    QString title;
    int minutes = 0;  ///< 0 if it is not known
    QPixmap picture;
    int place = 0;    ///< in the first hour, from 1; 0 if it is no part of that
    double read = 0;  ///< fraction of its pages, 0 to 1
  };
  struct RecentFile {
    QString path;
    QPixmap picture;
  };

  explicit StartPage(QWidget* parent = nullptr);

  /// Shows a card for each action, with its text and tool tip; a click triggers the action.
  void set_choices(const QList<QAction*>& choices);
  /// @param hint  beside the heading of the lessons
  void set_lessons(const QVector<LessonEntry>& lessons, const QString& hint);
  void set_recent(const QVector<RecentFile>& files);
  /// Names the scene that is being loaded; empty if none is.
  void set_loading(const QString& name);

 signals:
  void open_clicked();
  /// @param lesson  position in the list of set_lessons()
  void lesson_clicked(int lesson);
  void built_in_clicked(const QString& name);
  void recent_clicked(const QString& path);

 protected:
  void resizeEvent(QResizeEvent* event) override;
  void changeEvent(QEvent* event) override;

 private:
  /// Cards of equal size in rows, as many in a row as have room.
  struct Grid {
    QGridLayout* layout;
    int most_columns;
    QVector<StartCard*> cards;
  };
  QWidget* make_files();
  QLabel* add_heading(QBoxLayout& column, const QString& text);
  static void clear(Grid& grid);
  /// Sizes headings and cards by font and width.
  void arrange();
  void place(Grid& grid, int room) const;

  QVector<QLabel*> headings_;
  QLabel* loading_;
  QLabel* lessons_hint_;
  QWidget* files_;
  QGridLayout* page_;  ///< scenes and lessons beside the files
  Grid choices_{}, scenes_{}, lessons_{}, recent_{};
};

}  // namespace transillum::viewer
