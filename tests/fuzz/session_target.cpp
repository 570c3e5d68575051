// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
// Fuzz target: session and lesson files of the viewer. An input is the text of a file; it is read
// both as a session and as a lesson.
#include "lessons/session_file.h"

#include <cmath>
#include <cstdint>
#include <string>
#include <string_view>

#include "fuzz/require.h"
#include "lessons/lesson.h"
#include "transillum/errors.h"

namespace transillum::fuzz {
namespace {

using viewer::Session;

constexpr std::size_t longest_message = 2000;

/// Calls `read`, whose only exception may be an InputError with one line that names the file.
template <class Read>
void check_errors(const Read& read) {
  try {
    read();
  } catch (const InputError& error) {
    const std::string_view text = error.what();
    require(text.starts_with("f.json"), "an error begins with the file");
    require(text.find('\n') == std::string_view::npos, "an error is one line");
    require(text.size() <= longest_message, "an error is short");
  }
}

void check(const viewer::ViewState& state) {
  require(!state.range || (std::isfinite(state.range->first) && std::isfinite(state.range->second)),
          "a range is finite");
  require(state.gamma >= 1 && state.gamma <= 3, "gamma is in its range");
  require(!state.focus || (state.focus->iteration >= 0 && state.focus->direction >= 0),
          "iterations and directions count from 0");
  require(state.selection >= no_patch, "a patch or none");
  state.options.solve.validate();
}

/// A session that is read can be written and read again, and is then written as the same text.
void check_session(const std::string& text) {
  const Session session = viewer::session_from_text(text, "f.json", "");
  check(session.state);
  const std::string written = viewer::to_text(session, "");
  const Session again = viewer::session_from_text(written, "f.json", "");
  require(viewer::to_text(again, "") == written, "a session reads back");
}

}  // namespace
}  // namespace transillum::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace transillum;
  const std::string text(reinterpret_cast<const char*>(data), size);
  fuzz::check_errors([&] { (void)viewer::kind_of_json(text, "f.json"); });
  fuzz::check_errors([&] { fuzz::check_session(text); });
  fuzz::check_errors([&] {
    for (const auto& page : viewer::lesson_from_text(text, "f.json").pages) {
      fuzz::check(page.state);
    }
  });
  return 0;
}
