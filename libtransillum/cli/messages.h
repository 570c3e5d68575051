// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <exception>
#include <string>
#include <string_view>

#include "transillum/errors.h"
#include "transillum/scene.h"

namespace transillum::cli {

/// Writes `text` to stderr. All progress, warnings, summaries and errors go through this function:
/// if stderr is closed, full or a pipe without a reader, the text is lost and nothing else. Of
/// several processes only the first prints.
void print_diagnostics(std::string_view text) noexcept;
/// Prints `text` on stderr as one line; control characters become blanks.
void print_message(std::string_view text) noexcept;
/// The option that may help, as " (try …)"; empty for Remedy::none.
std::string remedy_hint(Remedy remedy);
/// The text of an error, with the hint of a SolveError.
std::string error_text(const std::exception& error);
/// A warning about a scene, with the option that may help.
std::string warning_text(const std::string& warning);
/// Prints what was repaired in the scene, one warning per line.
void print_warnings(const Scene& scene);

}  // namespace transillum::cli
