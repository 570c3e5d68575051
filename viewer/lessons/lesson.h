// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <string>
#include <vector>

#include "lessons/view_state.h"

namespace transillum::viewer {

/// Ordered pages of text, each with what the window is to show beside it.
struct Lesson {
  struct Page {
    std::string title;
    std::string text;  ///< Markdown
    ViewState state;   ///< complete: what the pages before told is in it
  };
  std::string title;
  std::vector<Page> pages;  ///< at least one
};

/// A lesson of its file's text; the format is told in viewer/MANUAL.md.
/// @param name what messages call the file. @param folder where the scenes lie that it names.
/// @throws InputError naming file, page and what is wrong.
Lesson lesson_from_text(const std::string& text, const std::string& name,
                        const std::string& folder = {});
/// @throws InputError, also where the file cannot be read.
Lesson read_lesson(const std::string& path);
/// @throws InputError where a page names a panel that is not among those of the window.
void check_panels(const Lesson& lesson, const std::string& name,
                  const std::vector<std::string>& panels);
/// Those that the viewer brings along, in their order.
const std::vector<Lesson>& built_in_lessons();

}  // namespace transillum::viewer
