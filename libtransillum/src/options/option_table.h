// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// The table of options: what each is called, what it means, how it is written, when it has an
// effect, and which exclude each other. Command lines, session files, keywords of Python, settings
// in statistics, help and manual pages are loops over it.
#pragma once

#include <cstdint>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "options/option.h"
#include "transillum/run_options.h"

namespace transillum {

/// All options of a run.
const std::vector<Option>& options();
/// The option called `name`.
/// @throws std::out_of_range where there is none
const Option& option(const std::string& name);
/// Sets the option `key` from JSON text; former names of options are known too.
/// @returns whether there is such an option
/// @throws InputError as Option::from_json()
bool set_from_json(RunOptions& options, const std::string& key, const std::string& json);

/// Why an option changes nothing in any of these runs, as "used only with engine painter"; empty
/// if it has an effect. For front ends, to refuse options that would silently do nothing.
std::string why_unused(const std::string& name, const std::vector<RunOptions>& runs);
/// The reason why an option cannot be combined with another one in `options`, such as "lobes are
/// not available with a linear basis"; empty if all can be combined with it.
std::string conflict_of(const std::string& name, const RunOptions& options);
/// The names of two options that set the same, of which only one may be given.
std::span<const std::pair<const char*, const char*>> alternatives();
/// The reason why two of them exclude each other; empty if all can be combined.
std::string first_conflict(const RunOptions& options);
/// The defaults that depend on other options: the choices of the paper; an accuracy of 1 % where
/// neither directions nor an accuracy are given, and nothing excludes it, in solves without lobes;
/// the iterations in the mean.
/// @param given names of the options that were given. With "accuracy" there is no default accuracy.
void set_dependent_defaults(RunOptions& options, const std::set<std::string>& given);
/// The preset of the window for scenes of few large faces, where set_dependent_defaults() keeps the
/// faces: about `patches` patches, with linear functions unless another option excludes them.
/// @param patches usual_patches() of the scene; 0 where its faces are no larger than usual.
/// @returns whether the preset is set: not where options say how faces become patches
bool set_window_defaults(RunOptions& options, std::int64_t patches);
/// The name and the value, as text, of each option that must be given to get `options` from the
/// defaults, by parse() and then set_dependent_defaults(). Options without effect are omitted.
std::vector<std::pair<std::string, std::string>> differences_from_default(
    const RunOptions& options);

/// The limit of kept form factors where SolveOptions::memory is 0, bytes: a quarter of the
/// machine's memory.
std::uint64_t default_memory_limit();

}  // namespace transillum
