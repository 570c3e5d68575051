// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <functional>
#include <string_view>

namespace CLI {
class App;
}

namespace transillum::cli {

/// Prepares streams and signals of the process; to be called first.
void prepare_process();

/// Returned by run_program() where another process has failed, and this one has nothing to say.
inline constexpr int failed_elsewhere = -1;

/// Runs the command in the arguments; never throws.
/// @param report prints the message of an error
/// @returns the exit status, or failed_elsewhere
int run_program(int argc, char** argv, void (*report)(std::string_view) noexcept);

/// Passes the definitions of all commands and options on, for manual pages and completions.
void with_definitions(const std::function<void(const CLI::App&)>& use);

}  // namespace transillum::cli
