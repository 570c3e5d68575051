// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Which options exclude each other, and the range of each.
#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "options/option_table.h"
#include "transillum/errors.h"

namespace transillum {
namespace {

bool has_no_directions(const RunOptions& r) { return !takes_directions(r.solve.engine); }
bool is_one_way(const RunOptions& r) { return !r.solve.two_way; }
bool is_linear(const RunOptions& r) { return r.solve.basis == Basis::linear; }
bool is_glossy(const RunOptions& r) { return r.solve.glossy; }
bool is_symmetric(const RunOptions& r) { return r.solve.normalize == Normalization::symmetric; }
bool is_by_rows(const RunOptions& r) { return r.solve.normalize == Normalization::rows; }
bool is_semi_iterative(const RunOptions& r) { return traits_of(r.solve.scheme).renews_directions; }
bool is_conjugate(const RunOptions& r) { return traits_of(r.solve.scheme).is_symmetric; }
bool is_not_fixed(const RunOptions& r) { return r.solve.scheme != Scheme::fixed; }
bool chooses_directions(const RunOptions& r) { return is_not_fixed(r) && !is_conjugate(r); }
bool has_goal(const RunOptions& r) { return r.solve.goal.is_set(); }
bool has_iterations(const RunOptions& r) { return r.solve.iterations > 0; }
/// A first shot where it pays excludes nothing: where it cannot be, there is none.
bool has_shot(const RunOptions& r) { return r.solve.first_shot.value_or(-1) >= 0; }
bool has_rounds(const RunOptions& r) { return r.refine.is_set(); }
bool has_no_limit_of_patches(const RunOptions& r) { return r.refine.patches == 0; }
bool has_time_limit(const RunOptions& r) { return r.solve.goal.seconds > 0; }
bool is_total(const RunOptions& r) { return r.total; }
bool has_other_error(const RunOptions& r) {
  return has_goal(r) && r.solve.goal.of != AccuracyOf::surfaces;
}
bool has_no_moments(const RunOptions& r) { return !traits_of(r.solve.engine).has_linear_basis; }
/// Engines without directions are asked elsewhere.
bool is_approximate(const RunOptions& r) {
  const EngineTraits& traits = traits_of(r.solve.engine);
  return traits.takes_directions && traits.error == EngineTraits::Error::own;
}

/// Two settings that exclude each other, and what the first has to say about that.
struct Conflict {
  const char* option;
  bool (*one)(const RunOptions&);
  bool (*other)(const RunOptions&);
  const char* reason;  ///< {engine} and {scheme} are their names
};

constexpr Conflict conflicts[] = {
    {"normalize", is_symmetric, is_one_way, "symmetric requires two-way passes"},
    {"normalize", is_symmetric, is_semi_iterative,
     "symmetric is not available with the semi-iterative scheme"},
    {"scheme", is_conjugate, is_one_way, "conjugate-gradients requires two-way passes"},
    {"scheme", is_conjugate, is_by_rows,
     "conjugate-gradients requires a symmetric matrix, so it cannot normalize by rows"},
    {"basis", is_linear, has_no_moments,
     "linear requires the moments of exchanges, which engine {engine} does not have; choose fast, "
     "local, exact or pairs"},
    {"basis", is_linear, is_semi_iterative,
     "linear is not available with the semi-iterative scheme, whose error bounds require form "
     "factors of at least 0"},
    {"glossy", is_glossy, has_no_directions,
     "lobes are not available with engine hemicube or pairs, which have no directions"},
    {"glossy", is_glossy, is_one_way,
     "lobes are not available with one-way passes: a lobe reflects from a set of directions into "
     "the same set"},
    {"glossy", is_glossy, is_linear, "lobes are not available with a linear basis"},
    {"glossy", is_glossy, is_symmetric,
     "lobes are not available with symmetric normalization, which knows only sums over all "
     "directions"},
    {"glossy", is_glossy, is_not_fixed,
     "lobes are not available with another scheme than fixed: every iteration needs the same "
     "directions"},
    {"accuracy", has_goal, chooses_directions,
     "the scheme {scheme} chooses its directions itself; choose fixed or conjugate-gradients"},
    {"accuracy", has_goal, has_iterations,
     "a given number of iterations leaves an error of its own"},
    {"accuracy", has_goal, is_approximate,
     "engine {engine} has errors that do not come from the directions"},
    {"glossy", is_glossy, has_rounds, "lobes are not available with rounds of refinement"},
    {"total", is_total, has_rounds, "patches are divided by the total error; no rounds come first"},
    {"total", is_total, has_time_limit, "a total error has no time limit"},
    {"total", is_total, has_other_error, "a total error is an error of surfaces"},
    {"refine-by", has_rounds, has_no_limit_of_patches,
     "requires patches, the most patches to make"},
    {"refine-by", has_rounds, has_time_limit, "rounds of refinement have no time limit"},
    {"refine-by", has_rounds, has_no_directions,
     "rounds of refinement are not available with engine {engine}, which has no directions"},
};

constexpr std::pair<const char*, const char*> all_alternatives[] = {
    {"max-patch-area", "patches"}, {"units", "scale"}, {"sun", "sun-direction"},
    {"sun", "sun-irradiance"},     {"sun", "site"},    {"site", "sun-direction"},
};

std::string text_of(const Conflict& conflict, const SolveOptions& solve) {
  return fmt::format(fmt::runtime(conflict.reason), fmt::arg("engine", name_of(solve.engine)),
                     fmt::arg("scheme", name_of(solve.scheme)));
}

/// @throws InputError for an option out of its range.
void check_ranges(const RunOptions& run) {
  RunOptions scratch;
  for (const Option& o : options()) {
    try {
      if (!o.print(run).empty()) {
        o.parse(scratch, o.print(run));
      }
    } catch (const InputError& error) {
      throw InputError(fmt::format("{}: {}", o.name, error.what()));
    }
  }
}

/// @throws InputError for two options that exclude each other.
void check_conflicts(const RunOptions& run) {
  for (const Conflict& conflict : conflicts) {
    if (conflict.one(run) && conflict.other(run)) {
      throw InputError(fmt::format("{}: {}", conflict.option, text_of(conflict, run.solve)));
    }
  }
}

}  // namespace

void SolveOptions::validate() const {
  check_ranges({.solve = *this});
  if (averaged_iterations < 0) {
    throw InputError(fmt::format("iterations in the mean: {} is less than 0", averaged_iterations));
  }
  if (traits_of(scheme).renews_directions && iterations > 0 && burn_in.value_or(0) >= iterations) {
    throw InputError(
        fmt::format("burn-in: {} of {} iterations leave none for the mean", *burn_in, iterations));
  }
  if (replicas > directions) {
    throw InputError(
        fmt::format("replicas: {} exceeds the number of directions, {}", replicas, directions));
  }
  check_conflicts({.solve = *this});
  sky.validate();
  goal.validate();
}

std::string SolveOptions::why_dark(bool emits) const {
  return emits || sky.is_set() || sky.sun.below_horizon
             ? ""
             : "nothing emits light, so B would be 0 everywhere";
}

std::optional<double> SolveOptions::used_first_shot() const {
  if (!first_shot || *first_shot >= 0) {
    return first_shot;
  }
  RunOptions run{.solve = *this};
  run.solve.first_shot = 0;
  // Light by direction is whole where no shot is asked for.
  const bool excluded =
      glossy || !takes_directions(engine) ||
      std::any_of(std::begin(conflicts), std::end(conflicts), [&](const auto& c) {
        return (c.one == has_shot || c.other == has_shot) && c.one(run) && c.other(run);
      });
  return excluded ? std::nullopt : first_shot;
}

std::span<const std::pair<const char*, const char*>> alternatives() { return all_alternatives; }

void RunOptions::validate() const {
  solve.validate();
  check_ranges(*this);
  check_conflicts(*this);
  input.read.validate();
  if (refine.is_set()) {
    refine.options().validate();
  }
}

std::string first_conflict(const RunOptions& options) {
  for (const Conflict& conflict : conflicts) {
    if (conflict.one(options) && conflict.other(options)) {
      return text_of(conflict, options.solve);
    }
  }
  return {};
}

std::string conflict_of(const std::string& name, const RunOptions& options) {
  for (const Conflict& conflict : conflicts) {
    if (conflict.option == name && conflict.one(options) && conflict.other(options)) {
      return text_of(conflict, options.solve);
    }
  }
  return {};
}

}  // namespace transillum
