// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// power_table(): sums by group and material against the statistics of the solve, the balance of
// energy and the furnace.
#include "radiosity/analysis/power_table.h"

#include <gmock/gmock.h>

#include "support/program_call.h"
#include "support/refusal.h"
#include "transillum/at.h"
#include "transillum/radiosity_solver.h"

namespace transillum::testing::power_table_test {
namespace {

using test::refusal;
using ::testing::ContainsRegex;
using ::testing::HasSubstr;
using ::testing::Not;

struct Solved {
  Solution solution;
  FormFactors form_factors;
};

Solved solved(const std::shared_ptr<const Scene>& scene, Normalization normalize,
              std::optional<double> first_shot = {}) {
  RadiositySolver solver(
      scene,
      {.directions = 64, .normalize = normalize, .first_shot = first_shot, .tolerance = 1e-13});
  solver.advance(RadiositySolver::Until::finished);
  return {solver.solution(), solver.form_factors()};
}

double sum(const Rgb& c) { return c.r + c.g + c.b; }

/// The first half of the faces in one group, some of the others in another.
std::shared_ptr<const Scene> grouped(const char* spec) {
  SceneDescription description = describe_scene(spec);
  description.groups = {"first half", "others"};
  description.face_group.clear();
  for (std::size_t f = 0; f < description.face_count(); ++f) {
    description.face_group.push_back(f < description.face_count() / 2 ? 0
                                     : f % 3 == 0                     ? no_group
                                                                      : 1);
  }
  return std::make_shared<const Scene>(description);
}

TEST(PowerTable, PartsSumToTheStatistics) {
  for (const auto& [by, first_shot] :
       {std::pair(SurfaceKind::group, std::optional<double>()),
        std::pair(SurfaceKind::material, std::optional<double>()),
        std::pair(SurfaceKind::group, std::optional(0.0)),
        std::pair(SurfaceKind::material, std::optional(first_shot_where_it_pays))}) {
    const Solved s = solved(grouped("cornell-box"), Normalization::none, first_shot);
    const PowerTable table = power_table(s.solution, by, &s.form_factors);
    ASSERT_GT(table.surfaces.size(), 2U);
    double area = 0;
    Rgb received, exchanged;
    std::int64_t patches = 0;
    for (std::size_t p = 0; p < table.surfaces.size(); ++p) {
      patches += table.surfaces[p].patches;
      area += table.surfaces[p].area;
      received += table.surfaces[p].received;
      Rgb row;
      for (const Rgb& power : table.exchanged[p]) {
        row += power;
      }
      // The power that a part receives comes from the parts.
      EXPECT_LE(max_abs(row - table.surfaces[p].received), 1e-9 * max_abs(row));
      exchanged += row;
    }
    EXPECT_EQ(patches, s.solution.scene->patch_count());
    EXPECT_DOUBLE_EQ(table.total.area, area);
    EXPECT_LE(max_abs(table.total.received - received), 1e-12 * max_abs(received));
    EXPECT_LE(max_abs(exchanged - received), 1e-9 * max_abs(received));
    EXPECT_NEAR(sum(table.total.absorbed) / sum(table.total.emitted),
                s.solution.statistics.energy_balance, 1e-12);
  }
}

TEST(PowerTable, ExchangesAreReciprocal) {
  // A part that emits B sends to another part the power that it would receive from it at the same
  // B.
  Solved s = solved(grouped("rooms"), Normalization::none);
  for (std::size_t i = 0; i < s.solution.radiosity.size(); ++i) {
    const double sum = s.solution.form_factor_sums[i];
    s.solution.radiosity[i] = {1, 1, 1};
    s.solution.irradiance[i] = {sum, sum, sum};
  }
  const auto exchanged = power_table(s.solution, SurfaceKind::group, &s.form_factors).exchanged;
  for (std::size_t i = 0; i < exchanged.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      EXPECT_NEAR(exchanged[i][j].r, exchanged[j][i].r, 1e-10 * exchanged[i][j].r);
    }
  }
}

TEST(PowerTable, EnergyOfClosedScenesIsConserved) {
  const Solved s = solved(grouped("cornell-box"), Normalization::symmetric);
  const SurfacePower total = power_table(s.solution, SurfaceKind::group).total;
  EXPECT_GT(sum(total.emitted), 0);
  EXPECT_NEAR(sum(total.absorbed + total.escaped) / sum(total.emitted), 1, 1e-8);
}

/// E = 1, rho = 0.5 gives B = H = 2 everywhere, and nothing escapes.
TEST(PowerTable, TheFurnaceAbsorbsWhatItEmits) {
  const Solved s = solved(load_scene("furnace"), Normalization::rows);
  const PowerTable table = power_table(s.solution, SurfaceKind::material);
  ASSERT_EQ(table.surfaces.size(), 1U);
  EXPECT_TRUE(table.escape_known);
  EXPECT_NEAR(table.total.emitted.r, table.total.area, 1e-9 * table.total.area);
  EXPECT_NEAR(table.total.absorbed.r, table.total.area, 1e-9 * table.total.area);
  EXPECT_NEAR(table.total.received.r, 2 * table.total.area, 1e-9 * table.total.area);
  EXPECT_NEAR(table.total.escaped.r, 0, 1e-9 * table.total.area);
}

/// Light that escapes from a box without a front is neither absorbed nor lost.
TEST(PowerTable, TheShareThatEscapesIsWhatIsNotAbsorbed) {
  const Solved s = solved(grouped("cornell-box:open=1"), Normalization::symmetric);
  const SurfacePower total = power_table(s.solution, SurfaceKind::group).total;
  const double escaped = escaped_share(total);
  EXPECT_GT(escaped, 0.01);
  EXPECT_NEAR(escaped, 1 - sum(total.absorbed) / sum(total.emitted), 0.02);
  EXPECT_TRUE(is_open(s.solution.statistics));
  EXPECT_EQ(escaped_share({}), 0);
  EXPECT_FALSE(is_open(solved(grouped("cornell-box"), Normalization::none).solution.statistics));
}

/// A part emits the exitance of its changed material; `index` finds the part in the scene.
TEST(PowerTable, TakesChangedMaterials) {
  const Solved s = solved(grouped("cornell-box"), Normalization::none);
  const Scene& scene = *s.solution.scene;
  const std::vector<Material> materials{{"a", {0.25, 0.5, 0.75}, {1, 2, 3}}};
  const std::vector<std::int32_t> all_the_same(scene.patches().size(), 0);
  const PowerTable table =
      power_table(s.solution, SurfaceKind::group, nullptr, materials, all_the_same);
  EXPECT_NEAR(table.total.emitted.g, 2 * table.total.area, 1e-12 * table.total.area);
  EXPECT_NEAR(table.total.absorbed.b, 0.25 * table.total.received.b,
              1e-12 * table.total.received.b);
  for (const SurfacePower& surface : table.surfaces) {
    EXPECT_EQ(surface.name, surface.index < 0 ? "" : at(scene.groups(), surface.index));
  }
  EXPECT_EQ(table.total.index, -1);
}

TEST(PowerTable, KnowsWhatIsNotKnown) {
  Solved s = solved(load_scene("boards"), Normalization::none);
  s.solution.sky_fractions.clear();
  const PowerTable table = power_table(s.solution, SurfaceKind::group);
  EXPECT_FALSE(table.escape_known);
  EXPECT_TRUE(table.exchanged.empty());
  ASSERT_EQ(table.surfaces.size(), 1U);
  EXPECT_EQ(table.surfaces[0].name, "");
  EXPECT_THAT(refusal([&] {
                power_table(s.solution, SurfaceKind::group, std::make_unique<FormFactors>().get());
              }),
              HasSubstr("number of patches differs"));
  EXPECT_EQ(refusal([] { from_name<SurfaceKind>("face"); }),
            "unknown kind of surfaces \"face\"; choose one of group, material");
}

TEST(CliSolveBy, PrintsTheTable) {
  const ProgramResult table =
      expect_success({"solve", "cornell-box", "-m", "32", "--by", "material", "-q"});
  EXPECT_THAT(table.out, ContainsRegex("material +patches +area, m2 +emitted, W"));
  EXPECT_THAT(table.out, HasSubstr("escaped, W"));
  EXPECT_THAT(table.out, ContainsRegex("total +[0-9]+ "));
  EXPECT_THAT(table.out, ContainsRegex("from +to +power, W"));
  EXPECT_THAT(table.out, HasSubstr("B mean, W/m2"));  // the summary follows
  const ProgramResult csv =
      run_program({"solve", "furnace", "-m", "8", "--by", "group", "-q", "-o", "-"});
  EXPECT_EQ(csv.out.rfind("face,", 0), 0U);
  EXPECT_THAT(csv.err, HasSubstr("(no group)"));
  const TemporaryFolder folder;
  write_text(folder / "open.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  const ProgramResult sky =
      expect_success({"solve", folder / "open.obj", "-m", "16", "--sky", "2", "--by", "group"});
  EXPECT_THAT(sky.out, HasSubstr("from the sky, W"));
  EXPECT_THAT(sky.out, Not(HasSubstr("from the sun, W")));
  // Half a square meter below 1000 W/m² from 30 degrees above the horizon, and no sky.
  const ProgramResult sun =
      expect_success({"solve", folder / "open.obj", "-m", "16", "--sun", "90,30,1000", "--up",
                      "0,0,1", "--by", "group", "-q"});
  EXPECT_THAT(sun.out, ContainsRegex("from the sun, W"));
  EXPECT_THAT(sun.out, ContainsRegex("total .* 250 "));
  EXPECT_THAT(sun.out, Not(HasSubstr("from the sky, W")));
}

TEST(CliSolveSky, ChecksItsOptions) {
  expect_all_refused({"solve", "boards", "-m", "8"},
                     {{{"--sky", "1,2"}, "--sky: \"1,2\" is not one or three numbers"},
                      {{"--sky", "-1"}, "--sky"},
                      {{"--sky-model", "uniform"}, "used only with a sky"},
                      {{"--sky", "1", "--sky-model", "blue"}, "model of the sky"},
                      {{"--sky", "1", "--up", "0,1,0"}, "cie-overcast"}});
  EXPECT_THAT(run_program({"solve", "boards", "--sky", "1", "--engine", "pairs"}).err,
              HasSubstr("backs of patches"));
  expect_success({"solve", "boards", "-m", "8", "--sky", "1,2,3", "--sky-model", "cie-overcast",
                  "--up", "-1,0,0"});
}

}  // namespace
}  // namespace transillum::testing::power_table_test
