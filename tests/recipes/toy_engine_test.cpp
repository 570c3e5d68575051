// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// An engine that was added by the recipe is there for options, names and solves.
#include <gtest/gtest.h>

#include <algorithm>

#include "options/option_table.h"
#include "transillum/solve_session.h"

namespace transillum::toy_engine_test {
namespace {

TEST(ToyEngine, IsAChoiceOfTheOption) {
  const auto& options_of_solves = options();
  const auto option = std::find_if(options_of_solves.begin(), options_of_solves.end(),
                                   [](const Option& o) { return o.name == "engine"; });
  ASSERT_NE(option, options_of_solves.end());
  EXPECT_EQ(option->choices.back(), "toy");
  RunOptions run;
  option->parse(run, "toy");
  EXPECT_EQ(run.solve.engine, Engine::toy);
  EXPECT_EQ(option->print(run), "toy");
}

TEST(ToyEngine, Solves) {
  const auto scene = load_scene("cornell-box");
  const Solution toy = solve(scene, {.directions = 16, .engine = Engine::toy});
  const Solution fast = solve(scene, {.directions = 16, .engine = Engine::fast});
  EXPECT_EQ(toy.radiosity, fast.radiosity);
}

}  // namespace
}  // namespace transillum::toy_engine_test
