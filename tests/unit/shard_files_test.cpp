// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Shards: passes made elsewhere lead to the same bits, and shards that do not belong to the same
// solve are refused by name.
#include "io/runs/shard_files.h"
#include "transillum/solve_session.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <random>
#include <sstream>

#include "support/refusal.h"
#include "support/temporary_folder.h"

namespace transillum::shard_files_test {
namespace {

using test::refusal;
using test::TemporaryFolder;
using ::testing::AllOf;
using ::testing::HasSubstr;

class Shards : public ::testing::Test {
 protected:
  std::vector<std::string> write(int count, const SolveOptions& options,
                                 const std::string& name = "part") const {
    std::vector<std::string> files;
    for (int k = 1; k <= count; ++k) {
      files.push_back(folder_.path() / (name + std::to_string(k) + ".tsh"));
      write_shard(files.back(), scene_, options, tree_, {{k, count}, {"a note"}, {}});
    }
    return files;
  }
  Solution merged(const std::vector<std::string>& files, const SolveOptions& options) const {
    RadiositySolver solver(scene_, options,
                           {.tree = tree_, .engine = engine_of_shards(files, *scene_, options)});
    solver.advance(RadiositySolver::Until::finished);
    return solver.solution();
  }
  std::string refused(const std::vector<std::string>& files) const {
    return refusal([&] { engine_of_shards(files, *scene_, options_); });
  }

  TemporaryFolder folder_;
  std::shared_ptr<const Scene> scene_ = load_scene("cornell-box");
  std::shared_ptr<const BspTree> tree_ = std::make_shared<const BspTree>(*scene_);
  SolveOptions options_{.directions = 25};
};

TEST_F(Shards, HaveTheBitsOfOneSolve) {
  std::vector<SolveOptions> all(8, options_);
  all[1].two_way = false;
  all[2].replicas = 5;
  all[2].first_shot = 0;
  all[3].scheme = Scheme::growing;
  all[4].scheme = Scheme::conjugate_gradients;
  all[4].normalize = Normalization::symmetric;
  all[5].memory = 1;  // the passes are read in every iteration
  all[6].engine = Engine::zbuffer;
  all[7].sky.sun.irradiance = {3, 2, 1};
  all[7].sky.sun.direction = normalized(Vec3{0.1, 0.2, 1});
  for (const SolveOptions& options : all) {
    const Solution whole = solve(scene_, options);
    for (const int count : {1, 3, 25}) {
      const Solution solution = merged(write(count, options), options);
      EXPECT_TRUE(whole.radiosity == solution.radiosity);
      EXPECT_TRUE(whole.irradiance == solution.irradiance);
      EXPECT_EQ(whole.form_factor_sums, solution.form_factor_sums);
      EXPECT_EQ(whole.sky_fractions, solution.sky_fractions);
      EXPECT_EQ(whole.statistics.closure_defect_max, solution.statistics.closure_defect_max);
      EXPECT_EQ(whole.statistics.transfers, solution.statistics.transfers);
      EXPECT_EQ(whole.error.rms, solution.error.rms);
    }
  }
}

TEST_F(Shards, AreTheSameForAnyNumberOfThreads) {
  const auto content = [&](int threads) {
    SolveOptions options = options_;
    options.threads = threads;
    const std::string file = write(2, options).back();
    std::ostringstream text;
    text << std::ifstream(file, std::ios::binary).rdbuf();
    return text.str();
  };
  // Each pass ends with its times.
  EXPECT_EQ(content(1).size(), content(3).size());
}

TEST_F(Shards, SayWhatTheyAre) {
  const ShardInfo info = read_shard_info(write(4, options_)[2]);
  EXPECT_EQ(info.share, (Share{3, 4}));
  EXPECT_EQ(info.passes, 25);
  EXPECT_EQ(info.scene, "cornell-box");
  EXPECT_THAT(info.notes, ::testing::ElementsAre("a note"));
}

TEST_F(Shards, ThatDoNotBelongTogetherAreRefusedByName) {
  const auto three = write(3, options_), two = write(2, options_, "half");
  EXPECT_THAT(refused({three[0], three[2]}), HasSubstr("shards are missing: 2/3"));
  EXPECT_THAT(refused({three[0], three[1], three[1], three[2]}),
              AllOf(HasSubstr("part2.tsh: it is share 2/3, as is"), HasSubstr("part2.tsh")));
  EXPECT_THAT(refused({three[0], two[1]}), HasSubstr("half2.tsh: it is share 2/2, but"));
  EXPECT_THAT(refused({}), HasSubstr("there are no shards"));
  SolveOptions others = options_;
  others.seed = 5;
  EXPECT_THAT(refused({write(2, others, "other")[0]}),
              HasSubstr("other1.tsh: it is of a solve with other options: seed is 5 there"));
  EXPECT_THAT(refusal([&] { engine_of_shards(three, *load_scene("furnace"), options_); }),
              HasSubstr("part1.tsh: it is of another scene"));
  EXPECT_EQ(refused(three), "");
}

TEST_F(Shards, ThatAreDamagedOrUnfinishedAreRefused) {
  const std::string file = write(1, options_).front();
  std::ostringstream text;
  text << std::ifstream(file, std::ios::binary).rdbuf();
  const std::string content = text.str();
  const auto refusal_of = [&](const std::string& changed) {
    std::ofstream(file, std::ios::binary) << changed;
    return refused({file});
  };
  for (std::size_t size = 0; size < content.size(); size += 1 + content.size() / 200) {
    EXPECT_THAT(refusal_of(content.substr(0, size)), HasSubstr("part1.tsh: it ")) << size;
  }
  std::mt19937 random(2);
  for (int k = 0; k < 300; ++k) {
    std::string changed = content;
    changed[random() % changed.size()] ^= static_cast<char>(1u << (random() % 8));
    EXPECT_THAT(refusal_of(changed), HasSubstr("part1.tsh: it")) << k;
  }
}

TEST_F(Shards, AreRefusedWherePassesDependOnResults) {
  const auto refused_options = [](SolveOptions options, const Share& share = {1, 2}) {
    return refusal([&] { check_can_be_shared(options, share); });
  };
  SolveOptions options;
  EXPECT_EQ(refused_options(options), "");
  EXPECT_THAT(refused_options(options, {1, 1025}), HasSubstr("only 1024 passes"));
  options.scheme = Scheme::semi_iterative;
  EXPECT_THAT(refused_options(options), HasSubstr("scheme semi-iterative"));
  options = {};
  options.goal.accuracy = 0.1;
  EXPECT_THAT(refused_options(options), HasSubstr("accuracy"));
  options = {};
  options.engine = Engine::pairs;
  EXPECT_THAT(refused_options(options), HasSubstr("engine pairs"));
}

TEST_F(Shards, LeaveNothingBehindWhenCanceled) {
  const std::string file = folder_.path() / "none.tsh";
  Cancellation cancellation;
  const auto cancel_soon = [&](int done) {
    if (done == 5) {
      cancellation.cancel();
    }
  };
  EXPECT_THROW(write_shard(file, scene_, options_, tree_, {{1, 1}, {}, cancel_soon}, cancellation),
               Canceled);
  EXPECT_TRUE(std::filesystem::is_empty(folder_.path()));
}

TEST(FractionText, IsKOfN) {
  EXPECT_EQ(share_from_text("3/16"), (Share{3, 16}));
  EXPECT_EQ((Share{3, 16}.text()), "3/16");
  for (const char* text :
       {"", "3", "3/", "/3", "0/3", "4/3", "1/2/3", "a/b", "1/2 ", "-1/2", "1/99999999999"}) {
    EXPECT_THAT(refusal([&] { share_from_text(text); }), HasSubstr("is not a share such as 3/16"))
        << text;
  }
}

}  // namespace
}  // namespace transillum::shard_files_test
