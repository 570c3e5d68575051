// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Finding small sources and shooting them, against closed forms and conservation of power.
#include "transillum/first_shot.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <iterator>

#include "support/scenes.h"
#include "transillum/at.h"
#include "visibility/pairs/patch_exchange.h"

namespace transillum::first_shot_test {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::SizeIs;
using testing::Sketch;

double power_received(const Scene& scene, const DirectLight& light) {
  double power = 0;
  for (PatchId i = 0; i < scene.patch_count(); ++i) {
    power += scene.patch(i).area * at(light.irradiance, i).g;
  }
  return power;
}

double power_sent(const Scene& scene, const DirectLight& light) {
  double power = 0;
  for (PatchId i = 0; i < scene.patch_count(); ++i) {
    power += scene.patch(i).area * at(light.exitance, i).g;
  }
  return power;
}

TEST(SmallSources, AreConnectedSmallAndBright) {
  EXPECT_THAT(find_small_sources(*load_scene("stars")), SizeIs(12 * 8));
  EXPECT_THAT(find_small_sources(*load_scene("cornell-box")), IsEmpty());
  EXPECT_THAT(find_small_sources(*load_scene("cornell-box"), 0), SizeIs(1));
  // Divided into many small patches, it is still one large source.
  EXPECT_THAT(find_small_sources(*load_scene("cornell-box", {.max_patch_area = 1e-4})), IsEmpty());
  EXPECT_THAT(find_small_sources(*load_scene("furnace")), IsEmpty());

  Sketch sketch;
  const int wall = sketch.material(0.5, 0), lamp = sketch.material(0.5, 100),
            ember = sketch.material(0.5, 1e-6);
  sketch.box({0, 0, 0}, {1, 1, 1}, true, wall);
  sketch.face({{.5, .5, .9}, {.5, .51, .9}, {.51, .51, .9}, {.51, .5, .9}}, lamp);
  sketch.face({{.2, .2, .1}, {.2, .21, .1}, {.21, .21, .1}, {.21, .2, .1}}, ember);
  EXPECT_THAT(find_small_sources(*sketch.scene()), ElementsAre(6));
  EXPECT_THAT(find_small_sources(*sketch.scene(), 29'000), ElementsAre(6)) << "R²/A is 30,000";
  EXPECT_THAT(find_small_sources(*sketch.scene(), 31'000), IsEmpty());
}

/// In a closed scene, all power sent is received.
TEST(Shoot, ConservesPower) {
  for (const auto& [spec, accuracy] :
       {std::pair{"stars", 1e-5}, {"cornell-box", 1e-4}, {"furnace", 1e-4}}) {
    const auto scene = load_scene(spec);
    const DirectLight light = shoot(*scene, find_small_sources(*scene, 0));
    EXPECT_DOUBLE_EQ(light.power_fraction, 1);
    EXPECT_GT(power_sent(*scene, light), 0);
    EXPECT_NEAR(power_received(*scene, light) / power_sent(*scene, light), 1, accuracy) << spec;
  }
}

/// Where all patches emit 1 W/m² and enclose, H = 1 W/m².
TEST(Shoot, EstimatesItsError) {
  for (const char* spec : {"furnace", "cornell-box"}) {
    SceneDescription description = describe_scene(spec);
    for (Material& material : description.materials) {
      material.exitance = {1, 2, 0};
    }
    const Scene scene(description);
    const DirectLight light = shoot(scene, find_small_sources(scene, 0));
    ASSERT_THAT(light.irradiance_error, SizeIs(scene.patches().size()));
    double largest = 0;
    for (PatchId i = 0; i < scene.patch_count(); ++i) {
      const Rgb& error = at(light.irradiance_error, i);
      const double off = std::abs(at(light.irradiance, i).r - 1);
      EXPECT_LE(off, 2 * error.r + 1e-12) << spec << ' ' << i;
      EXPECT_LT(error.r, 1e-2) << spec << ' ' << i;
      EXPECT_DOUBLE_EQ(error.g, 2 * error.r);
      EXPECT_EQ(error.b, 0);
      largest = std::max(largest, error.r);
    }
    EXPECT_GT(largest, 1e-6);
  }
  Sketch empty;
  empty.box({0, 0, 0}, {1, 1, 1}, true, empty.material(0.5, 1));
  for (const Rgb& error : shoot(*empty.scene(), {0, 1, 2}).irradiance_error) {
    EXPECT_EQ(max_abs(error), 0) << "all pairs see each other wholly";
  }
}

/// Past a turned box, some patches see so little of the lamp that none of their points does.
TEST(Shoot, EstimatesTheErrorWhereNoPointSeesLight) {
  const auto scene = load_scene("cornell-box", {.max_patch_area = 1.272e-3});
  const std::vector<PatchId> sources = find_small_sources(*scene, 0);
  const DirectLight light = shoot(*scene, sources);
  const DirectLight better = shoot(*scene, sources, {.points = 64});
  int unseen = 0;
  for (PatchId i = 0; i < scene->patch_count(); ++i) {
    const double exact = at(better.irradiance, i).r, error = at(light.irradiance_error, i).r;
    if (at(light.irradiance, i).r == 0) {
      EXPECT_LE(exact, 2 * error) << i;
      unseen += exact > 0 ? 1 : 0;
    } else if (error == 0) {
      EXPECT_NEAR(at(light.irradiance, i).r, exact, 1e-9 * exact) << i;
    }
  }
  EXPECT_GT(unseen, 0);
}

/// Every third patch by more points, which gives it the bits of a shot by as many.
TEST(Shoot, AgainReplacesTheLightOfThesePatchesAlone) {
  const auto scene = load_scene("cornell-box", {.max_patch_area = 0.05});
  const std::vector<PatchId> sources = find_small_sources(*scene, 0);
  const ShotOptions usual{.basis = Basis::linear}, more{.basis = Basis::linear, .points = 32};
  std::vector<PatchId> third, all;
  for (PatchId i = 0; i < scene->patch_count(); ++i) {
    all.push_back(i);
    if (i % 3 == 0) {
      third.push_back(i);
    }
  }
  const auto shot_at_all = [&](const ShotOptions& options) {
    DirectLight light = shoot(*scene, sources, options);
    light.paired = all;
    light.pairs = shoot_pairs(*scene, sources, all, options);
    return light;
  };
  const DirectLight coarse = shot_at_all(usual), fine = shot_at_all(more);
  DirectLight again = coarse;
  shoot_again(*scene, third, more, again);
  int changed = 0;
  for (const PatchId i : all) {
    const DirectLight& expected = i % 3 == 0 ? fine : coarse;
    EXPECT_EQ(at(again.irradiance, i), at(expected.irradiance, i)) << i;
    EXPECT_EQ(at(again.irradiance_error, i), at(expected.irradiance_error, i)) << i;
    EXPECT_EQ(at(again.linear_terms, i).first, at(expected.linear_terms, i).first) << i;
    EXPECT_EQ(at(again.linear_term_errors, i).second, at(expected.linear_term_errors, i).second);
    ASSERT_FALSE(again.contributions.empty());
    EXPECT_EQ(at(again.contributions[0].irradiance, i), at(expected.contributions[0].irradiance, i))
        << i;
    changed += at(coarse.irradiance, i) == at(fine.irradiance, i) ? 0 : 1;
  }
  EXPECT_GT(changed, 10);
  EXPECT_EQ(again.integrated_pairs, coarse.integrated_pairs);
  ASSERT_TRUE(std::is_sorted(again.pairs.begin(), again.pairs.end(),
                             [](const auto& a, const auto& b) { return a.receiver < b.receiver; }));
  std::vector<DirectLight::Pair> expected;
  for (const DirectLight* light : {&coarse, &fine}) {
    std::copy_if(light->pairs.begin(), light->pairs.end(), std::back_inserter(expected),
                 [&](const auto& pair) { return (pair.receiver % 3 == 0) == (light == &fine); });
  }
  ASSERT_EQ(again.pairs.size(), expected.size());
  for (const DirectLight::Pair& pair : expected) {
    EXPECT_TRUE(std::any_of(again.pairs.begin(), again.pairs.end(), [&](const auto& found) {
      return found.receiver == pair.receiver && found.source == pair.source &&
             found.irradiance == pair.irradiance;
    }));
  }
}

TEST(Shoot, MatchesTheFormulaForIrradiance) {
  Sketch sketch;
  const int gray = sketch.material(0.5, 0), light = sketch.material(0.5, 7);
  sketch.face({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, gray);
  sketch.face({{0, 0, 1}, {0, 1, 1}, {1, 1, 1}, {1, 0, 1}}, light);
  sketch.face({{0, 0, 0}, {0, 1, 0}, {0, 1, 1}, {0, 0, 1}}, light);
  const DirectLight shot = shoot(*sketch.scene(), {1});
  EXPECT_NEAR(shot.irradiance[0].g, 7 * 0.1998248957, 1e-9);
  EXPECT_EQ(shot.irradiance[1], Rgb{}) << "a patch does not see itself";
  EXPECT_NEAR(shot.irradiance[2].g, 7 * 0.2000437761, 1e-9);
  EXPECT_EQ(shot.exitance[1], (Rgb{7, 7, 7}));
  EXPECT_EQ(shot.exitance[2], Rgb{}) << "not shot";
  EXPECT_DOUBLE_EQ(shot.power_fraction, 0.5);
}

TEST(Shoot, IsTheSameForAnyNumberOfThreads) {
  const auto scene = load_scene("stars:n=3");
  const auto sources = find_small_sources(*scene);
  const DirectLight one = shoot(*scene, sources, {.threads = 1});
  for (const int threads : {2, 5}) {
    EXPECT_TRUE(shoot(*scene, sources, {.threads = threads}).irradiance == one.irradiance);
  }
}

/// Two large plates, and between them many triangles, so that one pair takes long: the plates are
/// compared at thousands of points, past every triangle.
std::shared_ptr<const Scene> cluttered() {
  Sketch sketch;
  const int lamp = sketch.material(0.5, 1), thing = sketch.material(0.5, 0);
  sketch.face({{0, 0, 1.1}, {0, 1, 1.1}, {1, 1, 1.1}, {1, 0, 1.1}}, lamp);
  sketch.face({{0, 0, -.1}, {1, 0, -.1}, {1, 1, -.1}, {0, 1, -.1}}, thing);
  sketch.triangles(50, 0.05, 3, thing);
  return sketch.scene();
}

// Progress used to be reported after 64 patches per thread, and the cancellation was checked
// between pairs, of which one can take minutes.
TEST(Shoot, ReportsProgressAndIsCanceledWithinAPair) {
  const auto scene = cluttered();
  int reports = 0, reports_of_pairs = 0;
  double last = 0;
  shoot(*scene, {0}, {.threads = 1}, {}, [&](double fraction) {
    EXPECT_GE(fraction, last);
    EXPECT_LE(fraction, 1);
    reports_of_pairs += fraction > last ? 1 : 0;
    last = fraction;
    ++reports;
  });
  EXPECT_EQ(last, 1);
  EXPECT_GT(reports, 2 * reports_of_pairs) << "most are made within a pair";

  for (const int until : {1, 2, reports / 2}) {
    const Cancellation cancellation;
    int seen = 0;
    EXPECT_THROW(shoot(*scene, {0}, {.threads = 1}, cancellation,
                       [&](double) {
                         if (++seen == until) {
                           cancellation.cancel();
                         }
                       }),
                 Canceled);
    EXPECT_EQ(seen, until) << "nothing is reported after it was canceled";
  }
}

TEST(ExactFormFactors, AreCanceledWithinAPair) {
  const auto scene = cluttered();
  const ExchangeFinder exchange(*scene);
  int ticks = 0;
  const auto stop = [&] {
    if (++ticks == 10) {
      throw Canceled();
    }
  };
  EXPECT_THROW(exchange(0, 1, stop), Canceled);
  EXPECT_EQ(ticks, 10);
  EXPECT_EQ(exchange(0, 1, [] {}).area, exchange(0, 1).area);
}

TEST(Shoot, CanBeCanceledAndReportsProgress) {
  const auto scene = load_scene("stars");
  Cancellation cancellation;
  std::vector<double> heard;
  shoot(*scene, find_small_sources(*scene), {.threads = 1}, cancellation,
        [&](double fraction) { heard.push_back(fraction); });
  EXPECT_TRUE(std::is_sorted(heard.begin(), heard.end()));
  EXPECT_EQ(heard.back(), 1);
  cancellation.cancel();
  EXPECT_THROW(shoot(*scene, find_small_sources(*scene), {}, cancellation), Canceled);
  EXPECT_THAT(shoot(*scene, {}).irradiance, SizeIs(scene->patches().size()));
}

}  // namespace
}  // namespace transillum::first_shot_test
