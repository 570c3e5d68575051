// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lessons/page_control.h"
#include "lessons/question.h"
#include "lessons/view_state.h"
#include "model/solver/error_runs.h"
#include "state/callout.h"

namespace transillum::viewer {

/// A sequence of pages, each with text and the state of the window to show beside it.
struct Lesson {
  struct Page {
    std::string title;
    std::string text;  ///< Markdown
    ViewState state;   ///< complete: includes what earlier pages set
    std::optional<Question> question;
    std::vector<PageControl> controls;  ///< in the text
    std::string large;                  ///< the panel, or `scene`, that gets most of the window
    std::vector<Callout> callouts;
    ErrorRuns errors;  ///< for the panel of errors; without runs, it is as before the lesson
  };
  std::string title;
  std::string file;  ///< the file that it was read from; a built-in lesson has a name without a
                     ///< folder
  bool built_in = false;
  int minutes = 0;          ///< that a class takes; 0 if the file does not say
  std::string needs;        ///< text: what to know or have before; may be empty
  bool first_hour = false;  ///< belongs to the first hour of a newcomer
  std::vector<Page> pages;  ///< at least one
};

/// Parses the text of a lesson file; viewer/LESSON_FORMAT.md describes the format.
/// @param name the file's name in error messages
/// @param folder where relative scene files are searched first
/// @throws InputError naming file, page, key and problem
Lesson lesson_from_text(const std::string& text, const std::string& name,
                        const std::string& folder = {});
/// Reads a lesson file. @throws InputError as above, or if the file cannot be read
Lesson read_lesson(const std::string& path);
/// Checks that every panel named by a page is one of `panels`. @throws InputError if not
void check_panels(const Lesson& lesson, const std::string& name,
                  const std::vector<std::string>& panels);
/// The place of a lesson in the first hour, whose lessons are taken in their order.
struct FirstHour {
  int place = 0;    ///< from 1; 0 if the lesson is none of them
  int lessons = 0;  ///< their number
  int minutes = 0;  ///< that they take together
};
FirstHour first_hour_of(const std::vector<Lesson>& lessons, int lesson);
/// The lessons compiled into the viewer, in their order.
const std::vector<Lesson>& built_in_lessons();

}  // namespace transillum::viewer
