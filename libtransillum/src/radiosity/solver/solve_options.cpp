// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include <fmt/format.h>

#include <cmath>

#include "base/choice.h"
#include "transillum/at.h"
#include "transillum/errors.h"
#include "transillum/radiosity.h"

namespace transillum {
namespace {

/// @throws InputError for what a linear basis cannot be combined with.
void check_linear_basis(const SolveOptions& options) {
  if (!has_moments(options.engine) && options.engine != Engine::pairs) {
    throw InputError(
        fmt::format("basis: linear requires the moments of exchanges, which engine {} does not "
                    "have; choose fast, local, exact or pairs",
                    name_of(options.engine)));
  }
  if (options.normalize == Normalization::symmetric) {
    throw InputError(
        "basis: linear is not available with symmetric normalization, whose one factor per patch "
        "cannot correct its moments");
  }
  if (options.scheme == Scheme::semi_iterative) {
    throw InputError(
        "basis: linear is not available with the semi-iterative scheme, whose error bounds "
        "require form factors of at least 0");
  }
  if (options.first_shot) {
    throw InputError(
        "basis: linear is not available with a first shot, which has no moments of its exchanges");
  }
}

/// @throws InputError for what lobes cannot be combined with.
void check_glossy(const SolveOptions& options) {
  const char* problem = nullptr;
  if (!takes_directions(options.engine)) {
    problem = "engine hemicube or pairs, which have no directions";
  } else if (!options.two_way) {
    problem = "one-way passes: a lobe reflects from a set of directions into the same set";
  } else if (options.basis != Basis::constant) {
    problem = "a linear basis";
  } else if (options.normalize == Normalization::symmetric) {
    problem = "symmetric normalization, which knows only sums over all directions";
  } else if (options.scheme != Scheme::fixed) {
    problem = "another scheme than fixed: every iteration needs the same directions";
  } else if (options.goal.set()) {
    problem = "an accuracy or a time limit, which require replicas";
  } else if (options.first_shot) {
    problem = "a first shot, which does not say from where its light comes";
  } else if (options.replicas > 1) {
    problem = "replicas: a patch keeps its radiance for one set of directions";
  }
  if (problem != nullptr) {
    throw InputError(fmt::format("glossy: lobes are not available with {}", problem));
  }
}

/// @throws InputError where the spread of replicas of one set of directions would not show the
/// error of B.
void check_error_is_seen(const SolveOptions& options) {
  if (options.scheme != Scheme::fixed && options.scheme != Scheme::conjugate_gradients) {
    throw InputError(
        fmt::format("accuracy: the scheme {} chooses its directions itself; choose fixed or "
                    "conjugate-gradients",
                    name_of(options.scheme)));
  }
  if (options.iterations > 0) {
    throw InputError("accuracy: a given number of iterations leaves an error of its own");
  }
  const Engine engine = options.engine;
  if (engine == Engine::zbuffer || engine == Engine::painter || engine == Engine::corrected) {
    throw InputError(fmt::format(
        "accuracy: the error of engine {} is not only that of the directions", name_of(engine)));
  }
}

}  // namespace

const std::vector<std::string>& normalization_names() {
  static const std::vector<std::string> names{"none", "rows", "symmetric"};
  return names;
}

Normalization normalization_from_name(const std::string& name) {
  return choice_from_name<Normalization>(normalization_names(), "normalization", name);
}

const std::string& name_of(Normalization normalization) {
  return at(normalization_names(), normalization);
}

const std::vector<std::string>& basis_names() {
  static const std::vector<std::string> names{"constant", "linear"};
  return names;
}

Basis basis_from_name(const std::string& name) {
  return choice_from_name<Basis>(basis_names(), "basis", name);
}

const std::string& name_of(Basis basis) { return at(basis_names(), basis); }

const std::vector<std::string>& scheme_names() {
  static const std::vector<std::string> names{"fixed", "growing", "semi-iterative",
                                              "conjugate-gradients"};
  return names;
}

Scheme scheme_from_name(const std::string& name) {
  return choice_from_name<Scheme>(scheme_names(), "scheme", name);
}

const std::string& name_of(Scheme scheme) { return at(scheme_names(), scheme); }

void SolveOptions::validate() const {
  if (directions < 1 || directions > (1 << 24)) {
    throw InputError(
        fmt::format("directions: {} is not in the range 1 to {}", directions, 1 << 24));
  }
  if (iterations < 0) {
    throw InputError(fmt::format("iterations: {} is less than 0", iterations));
  }
  if (!(tolerance > 0) || !(tolerance < 1)) {
    throw InputError(fmt::format("tolerance: {} is not between 0 and 1", tolerance));
  }
  if (averaged_iterations < 0) {
    throw InputError(fmt::format("iterations in the mean: {} is less than 0", averaged_iterations));
  }
  if (burn_in && (*burn_in < 0 || *burn_in > 1'000'000)) {
    throw InputError(fmt::format("burn-in: {} is not in the range 0 to 1000000", *burn_in));
  }
  if (scheme == Scheme::semi_iterative && iterations > 0 && burn_in.value_or(0) >= iterations) {
    throw InputError(
        fmt::format("burn-in: {} of {} iterations leave none for the mean", *burn_in, iterations));
  }
  if (replicas < 1 || replicas > 64) {
    throw InputError(fmt::format("replicas: {} is not in the range 1 to 64", replicas));
  }
  if (replicas > directions) {
    throw InputError(
        fmt::format("replicas: {} exceeds the number of directions, {}", replicas, directions));
  }
  if (normalize == Normalization::symmetric) {
    if (!two_way) {
      throw InputError("normalize: symmetric requires two-way passes");
    }
    if (scheme == Scheme::semi_iterative) {
      throw InputError("normalize: symmetric is not available with the semi-iterative scheme");
    }
  }
  if (scheme == Scheme::conjugate_gradients) {
    if (!two_way) {
      throw InputError("scheme: conjugate-gradients requires two-way passes");
    }
    if (normalize == Normalization::rows) {
      throw InputError(
          "scheme: conjugate-gradients requires a symmetric matrix, so it cannot normalize by "
          "rows");
    }
  }
  if (first_shot && *first_shot != first_shot_where_it_pays &&
      !(*first_shot >= 0 && std::isfinite(*first_shot))) {
    throw InputError(
        fmt::format("first shot: {} is not a finite number of at least 0", *first_shot));
  }
  if (threads < 0 || threads > 4096) {
    throw InputError(fmt::format("threads: {} is not in the range 0 to 4096", threads));
  }
  if (basis == Basis::linear) {
    check_linear_basis(*this);
  }
  if (glossy) {
    check_glossy(*this);
  }
  sky.validate();
  goal.validate();
  if (goal.set()) {
    check_error_is_seen(*this);
  }
}

}  // namespace transillum
