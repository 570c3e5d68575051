// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// A solve shared by several members: its results have the bits of a solve alone. The members are
// threads here; tests/mpi has processes.

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <mutex>
#include <sstream>

#include "support/thread_group.h"
#include "transillum/errors.h"
#include "transillum/radiosity_solver.h"
#include "transillum/solution.h"
#include "transillum/solve_options.h"
#include "transillum/solve_session.h"

namespace transillum::process_group_test {
namespace {

using testing::run_in_group;
using Until = RadiositySolver::Until;

std::shared_ptr<const Scene> box() {
  static const auto scene = load_scene("cornell-box");
  return scene;
}

/// The values of a solution that do not depend on time.
struct Outcome {
  std::vector<double> values;
  FormFactors factors;
  SolveStatistics statistics;
};

void append(std::vector<double>& values, const std::vector<Rgb>& list) {
  for (const Rgb& value : list) {
    values.insert(values.end(), {value.r, value.g, value.b});
  }
}

Outcome outcome_of(const Solution& solution) {
  Outcome outcome;
  append(outcome.values, solution.radiosity);
  append(outcome.values, solution.irradiance);
  append(outcome.values, solution.error.standard_error);
  append(outcome.values, solution.sky_irradiance);
  for (const LinearTerm& part : solution.linear_terms) {
    append(outcome.values, {part.first, part.second});
  }
  for (const auto* list : {&solution.form_factor_sums, &solution.sky_fractions}) {
    outcome.values.insert(outcome.values.end(), list->begin(), list->end());
  }
  const SolveStatistics& s = solution.statistics;
  outcome.values.insert(
      outcome.values.end(),
      {solution.error.rms_limit, s.light_directions, s.escaped, s.energy_defect, s.energy_balance,
       s.closure_defect_max, s.closure_defect_grazing, static_cast<double>(s.passes_made),
       static_cast<double>(s.transfers), static_cast<double>(s.counts.pairs),
       static_cast<double>(s.iterations), static_cast<double>(s.burn_in),
       static_cast<double>(solution.complete && s.kept_form_factors ? s.form_factors : 0)});
  for (const IterationRecord& record : s.iteration_records) {
    outcome.values.insert(outcome.values.end(),
                          {record.change, record.contraction, record.remainder});
  }
  outcome.statistics = s;
  return outcome;
}

Outcome solved(const SolveOptions& options, const std::shared_ptr<PatchSums>& group = nullptr) {
  if (options.goal.is_set()) {
    return outcome_of(solve(box(), options, {}, {}, group));
  }
  RadiositySolver solver(box(), options, {.sums = group});
  std::vector<double> changes;
  while (solver.advance(Until::iteration, [&](const RadiositySolver& watched) {
    const auto& now = watched.estimate_changes();
    changes = now.empty() ? changes : now;
    return true;
  })) {
  }
  Outcome outcome = outcome_of(solver.solution());
  if (!group) {  // in a group, the last round has not been seen
    EXPECT_FALSE(changes.empty());
  }
  outcome.values.insert(outcome.values.end(), solver.quadrature_errors().begin(),
                        solver.quadrature_errors().end());
  const auto backs = solver.back_seen_fractions();
  outcome.values.insert(outcome.values.end(), backs.begin(), backs.end());
  if (outcome.statistics.kept_form_factors && options.scheme != Scheme::semi_iterative) {
    outcome.factors = solver.form_factors();
  }
  return outcome;
}

/// Compares with the bits of `expected`; form factors are on member 0 only.
void expect_same(const Outcome& outcome, const Outcome& expected, int rank) {
  ASSERT_EQ(outcome.values.size(), expected.values.size());
  for (std::size_t k = 0; k < expected.values.size(); ++k) {
    ASSERT_EQ(std::bit_cast<std::uint64_t>(outcome.values[k]),
              std::bit_cast<std::uint64_t>(expected.values[k]))
        << "value " << k << ": " << outcome.values[k] << " instead of " << expected.values[k];
  }
  if (rank == 0) {
    EXPECT_EQ(outcome.factors.row_begin, expected.factors.row_begin);
    EXPECT_EQ(outcome.factors.source, expected.factors.source);
    EXPECT_EQ(outcome.factors.value, expected.factors.value);
  }
}

void expect_bits_of_one(const SolveOptions& options) {
  const Outcome expected = solved(options);
  for (const int members : {1, 2, 3, 7}) {
    SCOPED_TRACE(members);
    std::mutex one_at_a_time;
    const auto errors = run_in_group(members, [&](const std::shared_ptr<PatchSums>& group) {
      const Outcome outcome = solved(options, group);
      const std::lock_guard lock(one_at_a_time);
      expect_same(outcome, expected, group->rank());
    });
    for (const auto& error : errors) {
      EXPECT_EQ(error, nullptr);
    }
  }
}

TEST(ProcessGroup, HasTheBitsOfOneSolver) {
  expect_bits_of_one({.directions = 64});
  expect_bits_of_one({.directions = 64, .threads = 2});
  expect_bits_of_one({.directions = 65, .two_way = false});
  expect_bits_of_one({.directions = 64, .engine = Engine::local});
  expect_bits_of_one({.directions = 3});
}

TEST(ProcessGroup, HasTheBitsOfOneSolverWithReplicasAndNormalizations) {
  expect_bits_of_one({.directions = 64, .replicas = 4});
  expect_bits_of_one({.directions = 64, .normalize = Normalization::rows});
  expect_bits_of_one({.directions = 64, .normalize = Normalization::symmetric, .replicas = 2});
  expect_bits_of_one({.directions = 64, .first_shot = first_shot_where_it_pays});
  SolveOptions sky{.directions = 64};
  sky.sky.exitance = {1, 2, 3};
  expect_bits_of_one(sky);
}

TEST(ProcessGroup, HasTheBitsOfOneSolverWithLinearFunctions) {
  expect_bits_of_one({.directions = 32, .basis = Basis::linear, .first_shot = 0, .replicas = 2});
  expect_bits_of_one({.directions = 32, .normalize = Normalization::rows, .basis = Basis::linear});
}

TEST(ProcessGroup, HasTheBitsOfOneSolverInEveryScheme) {
  expect_bits_of_one({.directions = 128, .scheme = Scheme::growing});
  expect_bits_of_one(
      {.directions = 32, .scheme = Scheme::semi_iterative, .averaged_iterations = 9});
  expect_bits_of_one({.directions = 64, .scheme = Scheme::conjugate_gradients});
  expect_bits_of_one({.directions = 64,
                      .normalize = Normalization::symmetric,
                      .scheme = Scheme::conjugate_gradients,
                      .replicas = 2});
}

TEST(ProcessGroup, HasTheBitsOfOneSolverWithAGoal) {
  SolveOptions options;
  options.goal.accuracy = 0.05;
  expect_bits_of_one(options);
}

TEST(ProcessGroup, DropsFormFactorsOnAllMembers) {
  SolveOptions options{.directions = 64, .iterations = 3, .memory = 1};
  expect_bits_of_one(options);
  options.iterations = 0;
  options.scheme = Scheme::conjugate_gradients;
  const auto errors = run_in_group(3, [&](const std::shared_ptr<PatchSums>& group) {
    EXPECT_THROW(solved(options, group), MemoryLimitExceeded);
  });
  EXPECT_EQ(errors, std::vector<std::exception_ptr>(3));
}

TEST(ProcessGroup, KeepsAFractionOfTheFormFactors) {
  const SolveOptions options{.directions = 256, .iterations = 1};
  RadiositySolver alone(box(), options);
  alone.advance(Until::finished);
  // The form factors that four members keep fit into this memory; one member would need twice as
  // much.
  SolveOptions limited = options;
  limited.memory = static_cast<std::uint64_t>(alone.statistics().form_factors) * 16 * 2;
  EXPECT_FALSE(solved(limited).statistics.kept_form_factors);
  const auto errors = run_in_group(4, [&](const std::shared_ptr<PatchSums>& group) {
    EXPECT_TRUE(solved(limited, group).statistics.kept_form_factors);
  });
  EXPECT_EQ(errors, std::vector<std::exception_ptr>(4));
}

TEST(ProcessGroup, IsCanceledTogetherAndGoesOn) {
  const SolveOptions options{.directions = 256};
  const auto errors = run_in_group(3, [&](const std::shared_ptr<PatchSums>& group) {
    const Cancellation cancellation;
    RadiositySolver solver(box(), options, {.sums = group}, cancellation);
    EXPECT_THROW(solver.advance(Until::finished,
                                [&](const RadiositySolver& watched) {
                                  if (group->rank() == 1 && watched.progress().direction == 20) {
                                    cancellation.cancel();
                                  }
                                  return true;
                                }),
                 Canceled);
    const SolveProgress progress = solver.progress();
    EXPECT_GE(progress.direction, 20);
    EXPECT_LT(progress.direction, 256);
    // The estimate so far equals the estimate of one solver after the same passes.
    RadiositySolver alone(box(), options);
    while (alone.progress().direction < progress.direction) {
      alone.advance(Until::direction);
    }
    const Outcome here = outcome_of(solver.solution());
    EXPECT_EQ(solver.estimate_changes(), alone.estimate_changes());
    EXPECT_EQ(here.values, outcome_of(alone.solution()).values);
  });
  EXPECT_EQ(errors, std::vector<std::exception_ptr>(3));
}

TEST(ProcessGroup, PausesTogether) {
  const SolveOptions options{.directions = 64};
  const Outcome expected = solved(options);
  const auto errors = run_in_group(3, [&](const std::shared_ptr<PatchSums>& group) {
    RadiositySolver solver(box(), options, {.sums = group});
    EXPECT_TRUE(solver.advance(Until::finished, [&](const RadiositySolver& watched) {
      return group->rank() != 2 || watched.progress().direction != 10;
    }));
    EXPECT_LT(solver.progress().direction, 64);
    EXPECT_TRUE(solver.advance(Until::direction));
    EXPECT_FALSE(solver.advance(Until::finished));
    EXPECT_EQ(solver.radiosity().size(), box()->patches().size());
    const Outcome outcome = outcome_of(solver.solution());
    EXPECT_TRUE(std::equal(outcome.values.begin(), outcome.values.end(), expected.values.begin()));
  });
  EXPECT_EQ(errors, std::vector<std::exception_ptr>(3));
}

TEST(ProcessGroup, CompletesEstimatesForObservers) {
  const SolveOptions options{.directions = 64, .replicas = 2};
  std::vector<Rgb> expected;
  RadiositySolver alone(box(), options);
  alone.advance(Until::iteration, [&](const RadiositySolver& watched) {
    expected = watched.progress().direction == 11 ? watched.solution().radiosity : expected;
    return true;
  });
  const auto errors = run_in_group(3, [&](const std::shared_ptr<PatchSums>& group) {
    RadiositySolver solver(box(), options, {.sums = group});
    solver.advance(Until::iteration, [&](const RadiositySolver& watched) {
      if (watched.progress().direction == 11) {
        watched.complete_estimate();
        EXPECT_EQ(watched.solution().radiosity, expected);
      }
      return true;
    });
  });
  EXPECT_EQ(errors, std::vector<std::exception_ptr>(3));
}

TEST(ProcessGroup, IsSavedAsOneSolverAndRestoredByAnyNumber) {
  for (const bool two_way : {true, false}) {
    const SolveOptions options{.directions = 64, .two_way = two_way, .replicas = 2};
    const Outcome expected = solved(options);
    std::string state;
    const auto saving = run_in_group(3, [&](const std::shared_ptr<PatchSums>& group) {
      RadiositySolver solver(box(), options, {.sums = group});
      solver.advance(Until::finished, [](const RadiositySolver& watched) {
        return watched.progress().direction != 20;
      });
      std::ostringstream out;
      solver.save(out);
      if (group->rank() == 0) {
        state = out.str();
      }
    });
    EXPECT_EQ(saving, std::vector<std::exception_ptr>(3));
    const auto finish = [&](const std::shared_ptr<PatchSums>& group) {
      RadiositySolver solver(box(), options, {.sums = group});
      std::istringstream in(state);
      solver.restore(in, state.size());
      solver.complete_estimate();
      EXPECT_GE(solver.progress().direction, 20);
      solver.advance(Until::finished);
      const Outcome outcome = outcome_of(solver.solution());
      EXPECT_TRUE(
          std::equal(outcome.values.begin(), outcome.values.end(), expected.values.begin()));
    };
    finish(nullptr);
    EXPECT_EQ(run_in_group(2, finish), std::vector<std::exception_ptr>(2));
  }
}

TEST(ProcessGroup, FailsTogether) {
  const auto errors = run_in_group(3, [&](const std::shared_ptr<PatchSums>& group) {
    group->agree([&] {
      if (group->rank() == 1) {
        throw std::out_of_range("one");
      }
    });
  });
  EXPECT_THROW(std::rethrow_exception(errors[0]), OtherProcessFailed);
  EXPECT_THROW(std::rethrow_exception(errors[1]), std::out_of_range);
  EXPECT_THROW(std::rethrow_exception(errors[2]), OtherProcessFailed);
}

}  // namespace
}  // namespace transillum::process_group_test
