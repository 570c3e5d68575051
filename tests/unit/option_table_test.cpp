// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// The table of options and the tables of engines. That all front ends agree is tested with the
// viewer, which has most of them (viewer/options_agree_test.cpp).
#include "options/option_table.h"

#include <gmock/gmock.h>

#include <set>

#include "support/refusal.h"
#include "support/scenes.h"
#include "transillum/errors.h"
#include "transillum/solve_session.h"
#include "visibility/pixels/pixel_map.h"

namespace transillum::option_table_test {
namespace {

using ::testing::HasSubstr;

TEST(OptionTable, ReadsWhatItPrints) {
  std::set<std::string> names;
  for (const Option& o : options()) {
    EXPECT_TRUE(names.insert(o.name).second) << o.name;
    const std::string text = o.print(RunOptions{});
    if (text.empty()) {
      EXPECT_FALSE(o.in_files) << o.name;
      continue;
    }
    RunOptions read;
    o.parse(read, text);
    EXPECT_EQ(o.print(read), text) << o.name;
    o.from_json(read, o.to_json(RunOptions{}));
    EXPECT_EQ(o.print(read), text) << o.name;
  }
}

TEST(OptionTable, RefusesValuesOfAnotherType) {
  RunOptions read;
  for (const auto& [name, json] : {std::pair{"directions", "true"},
                                   {"directions", "\"64\""},
                                   {"directions", "[64]"},
                                   {"glossy", "1"},
                                   {"glossy", "\"yes\""},
                                   {"engine", "3"},
                                   {"sky", "{}"},
                                   {"directions", "null"}}) {
    EXPECT_THAT(
        test::refusal([&, name = name, json = json] { option(name).from_json(read, json); }),
        HasSubstr("expected"))
        << name << ' ' << json;
  }
  EXPECT_EQ(read, RunOptions{});
}

TEST(OptionTable, ReadsZeroOfFormerFilesWhereItMeansNothing) {
  RunOptions read;
  for (const char* name : {"iterations", "resolution", "accuracy", "seconds", "patches",
                           "max-patch-area", "refine-until", "sky", "memory", "threads"}) {
    option(name).from_json(read, "0");
  }
  EXPECT_EQ(read, RunOptions{});
  option("max-reflectance").from_json(read, "0");
  EXPECT_EQ(read.input.read.max_reflectance, 0);
  option("rotate").from_json(read, "0");
  EXPECT_EQ(read.solve.rotation, 0U);
}

TEST(OptionTable, DividesLargeFacesInTheWindowUnlessToldHow) {
  using Differences = std::vector<std::pair<std::string, std::string>>;
  RunOptions run;
  set_dependent_defaults(run, {});
  EXPECT_TRUE(set_window_defaults(run, 2000));
  EXPECT_EQ(differences_from_default(run), (Differences{{"basis", "linear"}, {"patches", "2000"}}));
  RunOptions without_moments;
  without_moments.solve.engine = Engine::painter;
  EXPECT_TRUE(set_window_defaults(without_moments, 2000));
  EXPECT_EQ(without_moments.solve.basis, Basis::constant);
  EXPECT_EQ(without_moments.input.patches, 2000);
  RunOptions small_faces;
  EXPECT_FALSE(set_window_defaults(small_faces, 0));
  EXPECT_EQ(small_faces, RunOptions{});
  for (const auto& [name, value] : {std::pair{"patches", "9"},
                                    {"max-patch-area", "1"},
                                    {"refine-by", "jump"},
                                    {"total", "yes"}}) {
    RunOptions told;
    option(name).parse(told, value);
    const RunOptions before = told;
    EXPECT_FALSE(set_window_defaults(told, 2000)) << name;
    EXPECT_EQ(told, before) << name;
  }
}

TEST(OptionTable, MakesARunOfItsDifferences) {
  RunOptions run;
  run.solve.engine = Engine::painter;
  run.solve.engine_options.order = PaintersOrder::newell;
  run.solve.tolerance = 1e-4;
  run.solve.seed = 9;  // has no effect, so it would be refused
  const std::vector<std::pair<std::string, std::string>> expected{
      {"engine", "painter"}, {"order", "newell"}, {"tolerance", "0.0001"}};
  EXPECT_EQ(differences_from_default(run), expected);
}

/// The option did nothing in the library and the viewer: only the programs copied it to the engine.
TEST(OptionTable, TheSeedIsThatOfEngineRays) {
  const auto scene = testing::box_in_cube(3, 1).scene();
  const auto with_seed = [&](std::uint64_t seed) {
    return solve(scene, {.directions = 4, .seed = seed, .engine = Engine::rays}).radiosity;
  };
  EXPECT_EQ(with_seed(5), with_seed(5));
  EXPECT_NE(with_seed(1), with_seed(5));
}

/// A default never excludes anything: where there cannot be a first shot, there is none.
TEST(OptionTable, TheFirstShotIsAutomaticWhereThereCanBeOne) {
  SolveOptions options;
  EXPECT_EQ(options.used_first_shot(), first_shot_where_it_pays);
  options.engine = Engine::pairs;
  EXPECT_FALSE(options.used_first_shot());
  EXPECT_NO_THROW(options.validate());
  options = {};
  options.first_shot = 500;
  EXPECT_EQ(options.used_first_shot(), 500);
  RunOptions run{.solve = {.engine = Engine::hemicube}};
  EXPECT_FALSE(why_unused("first-shot", {run}).empty());
  run.solve.first_shot.reset();
  EXPECT_TRUE(why_unused("first-shot", {run}).empty());
}

RunOptions defaults_with(const std::vector<std::pair<const char*, const char*>>& given) {
  RunOptions run;
  std::set<std::string> names;
  for (const auto& [name, value] : given) {
    option(name).parse(run, value);
    names.insert(name);
  }
  set_dependent_defaults(run, names);
  return run;
}

/// Angles become a direction, once the vertical is known; that is what files and commands have.
TEST(OptionTable, PlacesTheSunByItsAzimuth) {
  const RunOptions run = defaults_with({{"sun", "90,0.001,800"}, {"up", "0,0,1"}});
  EXPECT_NEAR(run.solve.sky.sun.direction.x, 1, 1e-9);
  EXPECT_EQ(option("sun-irradiance").print(run), "800");
  EXPECT_EQ(differences_from_default(run).size(), 2U);
  const RunOptions night =
      defaults_with({{"sun", "90,-1,800"}, {"up", "0,0,1"}, {"north", "1,0,0"}});
  EXPECT_FALSE(night.solve.sky.is_set());
  EXPECT_EQ(night.solve.why_dark(false), "");
  EXPECT_THAT(test::refusal([] {
                defaults_with({{"sun", "90,30,800"}});
              }),
              HasSubstr("require a vertical"));
  EXPECT_THAT(test::refusal([] {
                defaults_with({{"site", "52,13"}, {"up", "0,0,1"}});
              }),
              HasSubstr("requires a time"));
  for (const char* text : {"90,30", "90,91,800", "90,30,-1", "90,30,1,2"}) {
    EXPECT_THAT(test::refusal([=] {
                  defaults_with({{"sun", text}, {"up", "0,0,1"}});
                }),
                HasSubstr("is not AZ,EL,W"));
  }
}

TEST(OptionTable, WithoutDirectionsAnAccuracyIsTheDefault) {
  const AccuracyGoal goal = defaults_with({}).solve.goal;
  EXPECT_EQ(goal.accuracy, 0.01);
  EXPECT_EQ(goal.passes, 16384);
  EXPECT_EQ(goal.of, AccuracyOf::surfaces);
  EXPECT_EQ(defaults_with({{"accuracy-of", "rms"}}).solve.goal.accuracy, 0.01);
  // One that is given has no limit of passes.
  EXPECT_EQ(defaults_with({{"accuracy", "2%"}}).solve.goal.passes, 0);
  using Given = std::vector<std::pair<const char*, const char*>>;
  for (const Given& given :
       {Given{{"directions", "64"}}, Given{{"iterations", "3"}}, Given{{"replicas", "4"}},
        Given{{"scheme", "growing"}}, Given{{"engine", "zbuffer"}}, Given{{"engine", "pairs"}},
        Given{{"accuracy", "none"}}, Given{{"paper", "yes"}}}) {
    const RunOptions run = defaults_with(given);
    EXPECT_FALSE(run.solve.goal.is_set()) << given[0].first << ' ' << given[0].second;
    EXPECT_NO_THROW(run.validate());
  }
}

TEST(OptionTable, ThePapersChoicesAreDefaultsOfTheRest) {
  const SolveOptions paper = defaults_with({{"paper", "yes"}}).solve;
  EXPECT_EQ(paper.directions, 1024);
  EXPECT_EQ(paper.used_sampling(), Sampling::hammersley);
  EXPECT_FALSE(paper.two_way);
  EXPECT_FALSE(paper.first_shot);
  EXPECT_EQ(paper.basis, Basis::constant);
  const SolveOptions other =
      defaults_with({{"directions", "64"}, {"sampling", "halton"}, {"paper", "yes"}}).solve;
  EXPECT_EQ(other.directions, 64);
  EXPECT_EQ(other.used_sampling(), Sampling::halton);
  EXPECT_FALSE(other.two_way);
}

/// The copied command of each run, made again, is the run.
TEST(OptionTable, DifferencesMakeTheRunAgain) {
  using Given = std::vector<std::pair<const char*, const char*>>;
  for (const Given& given :
       {Given{}, Given{{"paper", "yes"}}, Given{{"paper", "yes"}, {"directions", "64"}},
        Given{{"accuracy", "1%"}}, Given{{"accuracy", "none"}}, Given{{"directions", "1024"}},
        Given{{"directions", "64"}}, Given{{"most-passes", "99"}}, Given{{"engine", "pairs"}},
        Given{{"accuracy-of", "groups:a,b c"}}, Given{{"first-shot", "none"}}}) {
    const RunOptions run = defaults_with(given);
    const auto differences = differences_from_default(run);
    Given again;
    for (const auto& [name, value] : differences) {
      again.emplace_back(name.c_str(), value.c_str());
    }
    EXPECT_EQ(defaults_with(again), run);
    EXPECT_LE(again.size(), std::max<std::size_t>(given.size(), 1));
  }
}

TEST(EngineTraits, SayWhatMakeEngineDoes) {
  const auto scene = testing::box_in_cube(2, 1).scene();
  const auto tree = std::make_shared<const BspTree>(*scene);
  for (const EngineTraits& traits : engines()) {
    EXPECT_EQ(from_name<Engine>(traits.name), traits.value);
    if (!traits.takes_directions) {
      EXPECT_THROW(make_engine(traits.value, scene, tree), InputError) << traits.name;
      continue;
    }
    EXPECT_NO_THROW(make_engine(traits.value, scene, tree)) << traits.name;
    const auto sample = [&, &engine = traits.value] {
      pixel_map({engine, {.resolution = 8}}, *scene, *tree, {0, 0, 1});
    };
    if (has_pixels(traits.value)) {
      EXPECT_NO_THROW(sample()) << traits.name;
    } else {
      EXPECT_THROW(sample(), InputError) << traits.name;
    }
    if (traits.has_moments) {
      EXPECT_NO_THROW(make_engine(traits.value, scene, tree, {.moments = true})) << traits.name;
    } else {
      EXPECT_THROW(make_engine(traits.value, scene, tree, {.moments = true}), InputError)
          << traits.name;
    }
  }
}

}  // namespace
}  // namespace transillum::option_table_test
