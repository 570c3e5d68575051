// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
// ALGORITHM.md, oracle 7: the engines agree to 1e-10 of the patch's area on all scenes.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <filesystem>
#include <iostream>
#include <map>

#include "support/imperfect_scenes.h"
#include "support/map_on_failure.h"
#include "support/random_scenes.h"
#include "support/scenes.h"
#include "support/transfer_difference.h"
#include "transillum/engine.h"
#include "transillum/files.h"
#include "visibility/fast/patch_blocks.h"

namespace transillum::agreement_test {
namespace {

using testing::TransferDifference;

constexpr double agreed = 1e-10;

/// An engine that must give the same numbers as the others, and the largest number of fragments
/// with which it is tested: the slow ones take seconds per direction with more.
struct TestedEngine {
  Engine engine;
  std::size_t max_fragments;
};
constexpr std::array tested_engines{
    TestedEngine{Engine::local, SIZE_MAX}, TestedEngine{Engine::fast, SIZE_MAX},
    TestedEngine{Engine::global, 400}, TestedEngine{Engine::exact, 200}};

/// The largest differences found by this program, per pair of engines.
class Table : public ::testing::Environment {
 public:
  void add(Engine a, Engine b, const TransferDifference& found) {
    Row& row = rows_[{a, b}];
    ++row.directions;
    if (!(found.fraction <= row.worst)) {
      row.worst = found.fraction;
    }
  }
  void TearDown() override {
    if (rows_.empty()) {
      return;
    }
    std::cout << "Largest differences, as shares of the patches' areas:\n";
    for (const auto& [pair, row] : rows_) {
      std::cout << fmt::format("  {:<6} {:<6} {:9.2e}  in {} directions\n", name_of(pair.first),
                               name_of(pair.second), row.worst, row.directions);
    }
  }

 private:
  struct Row {
    double worst = 0;
    std::int64_t directions = 0;
  };
  std::map<std::pair<Engine, Engine>, Row> rows_;
};
auto* const table = static_cast<Table*>(::testing::AddGlobalTestEnvironment(new Table));

/// The engines that are tested on a scene.
class EngineComparison {
 public:
  explicit EngineComparison(std::shared_ptr<const Scene> scene)
      : scene_(std::move(scene)), tree_(std::make_shared<const BspTree>(*scene_)) {
    for (const TestedEngine& tested : tested_engines) {
      if (tree_->fragments().size() > tested.max_fragments) {
        continue;
      }
      engines_.emplace_back(tested.engine, make_engine(tested.engine, scene_, tree_));
    }
  }

  void expect_agreement(const Vec3& omega) const {
    const testing::MapOnFailure map(*scene_, *tree_, omega);
    std::vector<Transfers> results;
    for (const auto& [engine, run] : engines_) {
      results.push_back(run(omega, {}));
    }
    for (std::size_t a = 0; a < results.size(); ++a) {
      for (std::size_t b = a + 1; b < results.size(); ++b) {
        const TransferDifference found = testing::difference(*scene_, results[a], results[b]);
        table->add(engines_[a].first, engines_[b].first, found);
        EXPECT_LE(found.fraction, agreed)
            << name_of(engines_[a].first) << " and " << name_of(engines_[b].first) << ", "
            << scene_->name() << ", direction "
            << fmt::format("{},{},{}", omega.x, omega.y, omega.z) << ", " << found.where;
      }
    }
  }
  Transfers local(const Vec3& omega) const { return engines_.front().second(omega, {}); }

 private:
  std::shared_ptr<const Scene> scene_;
  std::shared_ptr<const BspTree> tree_;
  std::vector<std::pair<Engine, TransferEngine>> engines_;
};

class AgreementBuiltIn : public ::testing::TestWithParam<const char*> {};

TEST_P(AgreementBuiltIn, InEveryDirection) {
  const auto scene = load_scene(GetParam());
  const EngineComparison comparison(scene);
  for (const Vec3& omega : testing::test_directions(scene->patch_count() > 100 ? 9 : 15, 21)) {
    comparison.expect_agreement(omega);
  }
}

INSTANTIATE_TEST_SUITE_P(Scenes, AgreementBuiltIn,
                         ::testing::Values("cornell-box", "furnace", "boards", "rooms", "stars",
                                           "rooms:n=10,seed=3", "sphere-flake:levels=0",
                                           "sphere-flake:levels=1"));

std::vector<std::string> corpus() {
  std::vector<std::string> files;
  for (const char* folder : {"/corpus", "/scenes"}) {
    for (const auto& entry :
         std::filesystem::directory_iterator(std::string(TRANSILLUM_DATA_DIR) + folder)) {
      if (entry.path().extension() == ".obj") {
        files.push_back(entry.path().string());
      }
    }
  }
  std::sort(files.begin(), files.end());
  return files;
}

class AgreementCorpus : public ::testing::TestWithParam<std::string> {};

TEST_P(AgreementCorpus, InEveryDirection) {
  for (const bool two_sided : {false, true}) {
    const auto scene = load_scene(GetParam(), {.two_sided = two_sided});
    const EngineComparison comparison(scene);
    for (const Vec3& omega : testing::test_directions(15, 22)) {
      comparison.expect_agreement(omega);
    }
    // Faces seen edge-on, along an edge and in their plane.
    for (PatchId i = 0; i < scene->patch_count(); i += 1 + scene->patch_count() / 8) {
      const auto outline = scene->outline(i);
      const Vec3 edge = scene->point(outline[1]) - scene->point(outline[0]);
      const Vec3 other = scene->point(outline.back()) - scene->point(outline[0]);
      comparison.expect_agreement(normalized(edge));
      comparison.expect_agreement(normalized(normalized(edge) + 0.7 * normalized(other)));
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Files, AgreementCorpus, ::testing::ValuesIn(corpus()),
                         [](const auto& file) {
                           std::string name = std::filesystem::path(file.param).stem();
                           std::erase_if(name, [](unsigned char c) { return !std::isalnum(c); });
                           return name;
                         });

TEST(MapOnFailure, IsDrawnAndNamed) {
  const auto scene = load_scene("furnace");
  const std::string path = testing::save_map(*scene, BspTree(*scene), {0, 0, 1}, "furnace");
  EXPECT_TRUE(path.ends_with("/failed-maps/furnace.svg")) << path;
  EXPECT_GT(std::filesystem::file_size(path), 1000U);
  std::filesystem::remove(path);
}

using MakeScene = testing::RandomScene (*)(std::uint64_t seed);

/// If the engines disagree on a random scene, writes it to an .obj file.
void expect_agreement_on(std::uint64_t seed, MakeScene make = testing::random_scene) {
  const testing::RandomScene random = make(seed);
  const auto scene = std::make_shared<const Scene>(random.description, random.options);
  SCOPED_TRACE(fmt::format("{}{}", scene->name(), random.options.two_sided ? ", two-sided" : ""));
  const EngineComparison comparison(scene);
  for (const Vec3& omega : random.directions) {
    comparison.expect_agreement(omega);
    if (!random.closed) {
      continue;
    }
    const ClosureDefect defect = closure_defect(comparison.local(omega), *scene);
    EXPECT_LE(defect.relative, 1e-10)
        << "patch " << defect.worst
        << fmt::format(", direction {},{},{}", omega.x, omega.y, omega.z);
    EXPECT_LE(defect.grazing, 1e-12);
  }
  if (!::testing::Test::HasFailure()) {
    return;
  }
  const std::string file = fmt::format("{}/random-{}.obj", ::testing::TempDir(), seed);
  write_obj(file, random.description);
  std::cerr << "The scene: " << file << '\n';
}

void expect_agreement_on(std::uint64_t first, std::uint64_t count,
                         MakeScene make = testing::random_scene) {
  for (std::uint64_t seed = first; seed < first + count; ++seed) {
    expect_agreement_on(seed, make);
    if (::testing::Test::HasFailure()) {
      return;
    }
  }
}

/// Ten scenes each, so that ctest can run them in parallel.
class AgreementRandom : public ::testing::TestWithParam<int> {};
TEST_P(AgreementRandom, OnDegenerateScenes) {
  expect_agreement_on(static_cast<std::uint64_t>(GetParam()) * 10, 10);
}
INSTANTIATE_TEST_SUITE_P(Tens, AgreementRandom, ::testing::Range(0, 20));

/// Scenes on which engines once disagreed.
class AgreementRegression : public ::testing::TestWithParam<int> {};
TEST_P(AgreementRegression, OnDegenerateScenes) {
  expect_agreement_on(static_cast<std::uint64_t>(GetParam()));
}
INSTANTIATE_TEST_SUITE_P(Seeds, AgreementRegression,
                         ::testing::Values(984, 1164, 2314, 4793, 5846, 6224, 6369, 8796, 8994,
                                           9809, 10317));

class NightlyAgreementRandom : public ::testing::TestWithParam<int> {};
TEST_P(NightlyAgreementRandom, OnDegenerateScenes) {
  expect_agreement_on(static_cast<std::uint64_t>(GetParam()) * 500, 500);
}
INSTANTIATE_TEST_SUITE_P(FiveHundreds, NightlyAgreementRandom, ::testing::Range(1, 21));

/// Scenes as files have them: rounded, turned, touching, interpenetrating.
class AgreementImperfect : public ::testing::TestWithParam<int> {};
TEST_P(AgreementImperfect, OnRoundedAndTurnedScenes) {
  expect_agreement_on(static_cast<std::uint64_t>(GetParam()) * 10, 10,
                      testing::random_imperfect_scene);
}
INSTANTIATE_TEST_SUITE_P(Tens, AgreementImperfect, ::testing::Range(0, 20));

/// Some twelve patches a face, which engine fast queries in blocks.
/// @param in_blocks counts the scenes with blocks
void expect_agreement_on_divided(std::uint64_t seed, MakeScene make, int& in_blocks) {
  testing::RandomScene random = make(seed);
  const Scene whole(random.description, random.options);
  double area = 0;
  for (const Patch& patch : whole.patches()) {
    area += patch.area;
  }
  random.options.max_patch_area = area / (12.0 * whole.patch_count());
  const auto scene = std::make_shared<const Scene>(random.description, random.options);
  in_blocks += PatchBlocks::of(*scene) ? 1 : 0;
  const auto tree = std::make_shared<const BspTree>(*scene);
  const TransferEngine fast = make_engine(Engine::fast, scene, tree);
  const TransferEngine local = make_engine(Engine::local, scene, tree);
  for (const Vec3& omega : random.directions) {
    const auto found = testing::difference(*scene, local(omega, {}), fast(omega, {}));
    ASSERT_LE(found.fraction, 1e-10) << fmt::format("{} {}, direction {},{},{}, {}", scene->name(),
                                                    seed, omega.x, omega.y, omega.z, found.where);
  }
}

void expect_agreement_on_divided(int first, int count) {
  int in_blocks = 0;
  for (int k = first; k < first + count; ++k) {
    const auto seed = static_cast<std::uint64_t>(k);
    for (const MakeScene make : {testing::random_scene, testing::random_imperfect_scene}) {
      ASSERT_NO_FATAL_FAILURE(expect_agreement_on_divided(seed, make, in_blocks));
    }
  }
  EXPECT_GT(4 * in_blocks, count);
}

class AgreementDivided : public ::testing::TestWithParam<int> {};
TEST_P(AgreementDivided, OnDegenerateAndRoundedScenes) {
  expect_agreement_on_divided(10 * GetParam(), 10);
}
INSTANTIATE_TEST_SUITE_P(Tens, AgreementDivided, ::testing::Range(0, 20));

/// Rails that touch sleepers but for rounding: which of both is in front has to be the same for
/// blocks. A plane tilted by rounding once divided the sleepers.
TEST(AgreementDividedRegression, OnFacesThatTouch) {
  int in_blocks = 0;
  for (const std::uint64_t seed : {1005, 3894}) {
    ASSERT_NO_FATAL_FAILURE(
        expect_agreement_on_divided(seed, testing::random_imperfect_scene, in_blocks));
  }
}

class NightlyAgreementDivided : public ::testing::TestWithParam<int> {};
TEST_P(NightlyAgreementDivided, OnDegenerateAndRoundedScenes) {
  expect_agreement_on_divided(500 * GetParam(), 500);
}
INSTANTIATE_TEST_SUITE_P(FiveHundreds, NightlyAgreementDivided, ::testing::Range(1, 11));

/// A small box whose back a large wall sees by less than rounding of the wall's own area.
TEST(AgreementImperfectRegression, OnASmallPatchSeenByALargeOne) {
  expect_agreement_on(661, testing::random_imperfect_scene);
}

/// A direction runs along bent faces: their parts project to more than the plane of the face.
TEST(AgreementImperfectRegression, OnBentFacesSeenEdgeOn) {
  expect_agreement_on(1129, testing::random_imperfect_scene);
}

class NightlyAgreementImperfect : public ::testing::TestWithParam<int> {};
TEST_P(NightlyAgreementImperfect, OnRoundedAndTurnedScenes) {
  expect_agreement_on(static_cast<std::uint64_t>(GetParam()) * 500, 500,
                      testing::random_imperfect_scene);
}
INSTANTIATE_TEST_SUITE_P(FiveHundreds, NightlyAgreementImperfect, ::testing::Range(1, 21));

}  // namespace
}  // namespace transillum::agreement_test
