// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Studies, their reference cache and their plots.
#include "transillum/study.h"

#include <gmock/gmock.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPNGReader.h>
#include <vtkSmartPointer.h>

#include <cmath>
#include <cstdlib>

#include "io/drawing/study_chart.h"
#include "io/results/reference_cache.h"
#include "support/canceled.h"
#include "support/program_call.h"
#include "support/scenes.h"
#include "transillum/bounds.h"
#include "transillum/errors.h"
#include "transillum/solve_session.h"

namespace transillum::testing::study_test {
namespace {

using ::testing::AnyOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::SizeIs;
using ::testing::StartsWith;

struct Box {
  std::shared_ptr<const Scene> scene = load_scene("cornell-box");
  std::shared_ptr<const BspTree> tree = std::make_shared<const BspTree>(*scene);

  Study study(const StudyOptions& options, const StudyObserver& observer = {},
              const Cancellation& cancellation = {}) const {
    return run_study(scene, tree, options, {reference}, observer, cancellation);
  }
  std::vector<Rgb> reference = solve(scene, reference_options(4096)).radiosity;
};
const Box& box() {
  static const Box one;
  return one;
}

StudyPoint point(std::int64_t passes, double error) {
  StudyPoint point;
  point.passes = passes;
  point.rms_error = error;
  point.seconds = 2 * static_cast<double>(passes);
  return point;
}

TEST(Study, ErrorsAreRelativeToReflectedLightWithoutSources) {
  Sketch sketch;
  sketch.triangles(27, 0.1, 1, sketch.material(0.5, 0));
  sketch.triangles(3, 0.1, 2, sketch.material(0.5, 1e6));
  const auto scene = sketch.scene();
  std::vector<Rgb> one(27, {1, 1, 1});
  one.resize(30, {1e6, 1e6, 1e6});
  EXPECT_EQ(radiosity_error(*scene, one, one).rms, 0);
  auto off = one;
  off[3].g += 0.5;
  off[28].g += 1000;
  const RadiosityError error = radiosity_error(*scene, off, one);
  EXPECT_NEAR(error.rms, std::sqrt(0.25 / 27), 1e-15);
  EXPECT_DOUBLE_EQ(error.max, 0.5);
  for (std::vector<Rgb>* values : {&one, &off}) {
    for (Rgb& b : *values) {
      b = 2 * b;
    }
  }
  EXPECT_NEAR(radiosity_error(*scene, off, one).rms, error.rms, 1e-15);
}

TEST(Study, ErrorsOfADarkChannelAreRelativeToItsOwnLight) {
  Sketch sketch;
  sketch.triangles(10, 0.1, 1, sketch.material(0.5, 0));
  const std::vector<Rgb> one(10, {1, 0.5, 0.01});
  auto off = one;
  off[3].b += 0.005;
  off[4].r += 0.1;
  const RadiosityError error = radiosity_error(*sketch.scene(), off, one);
  EXPECT_NEAR(error.rms, 0.5 / std::sqrt(10.0), 1e-15);
  EXPECT_NEAR(error.max, 0.5, 1e-15);
}

TEST(Study, ErrorsCountAllPatchesWhereAllEmit) {
  Sketch sketch;
  sketch.triangles(4, 0.1, 1, sketch.material(0.5, 3));
  const auto scene = sketch.scene();
  const std::vector<Rgb> reference(4, {5, 5, 5}), b(4, {5.5, 5.5, 5.5});
  EXPECT_DOUBLE_EQ(radiosity_error(*scene, b, reference).rms, 0.25);  // relative to B - E = 2
}

TEST(Study, RandomErrorDecreasesAsOneOverTheRootAndFibonacciFaster) {
  StudyOptions options;
  options.series = {{Sampling::random}, {Sampling::fibonacci}};
  options.directions = {16, 32, 64, 128, 256, 512};
  options.rotations = 12;
  const Study study = box().study(options);
  ASSERT_TRUE(study.complete);
  ASSERT_THAT(study.points, SizeIs(12));
  EXPECT_NEAR(fitted_power_law(points_of(study, 0))->slope, -0.5, 0.1);
  EXPECT_LT(fitted_power_law(points_of(study, 1))->slope, -0.7);
  for (const StudyPoint& p : study.points) {
    EXPECT_EQ(p.directions, 2 * p.passes);
    EXPECT_GT(p.seconds, 0);
    EXPECT_GT(p.max_error, 0);
    const double rho = measure(*box().scene).rho_max;
    EXPECT_EQ(p.bound,
              homogeneous_error_bound(rho, quadrature_error_bound(static_cast<double>(p.passes))));
  }
}

TEST(Study, PointsEqualPlainSolves) {
  StudyOptions options;
  options.series = {{Sampling::hammersley, false, Normalization::rows},
                    {Sampling::random, true, Normalization::none, Scheme::semi_iterative}};
  options.directions = {24};
  options.solve.burn_in = 2;
  const Study study = box().study(options);
  const auto error = [](const SolveOptions& solve_options) {
    const auto b = solve(box().scene, solve_options).radiosity;
    return radiosity_error(*box().scene, b, box().reference);
  };
  ASSERT_THAT(study.points, SizeIs(2));
  const RadiosityError rows = error({.directions = 24,
                                     .sampling = Sampling::hammersley,
                                     .two_way = false,
                                     .normalize = Normalization::rows,
                                     .first_shot = {},
                                     .tolerance = 1e-8});
  EXPECT_EQ(study.points[0].rms_error, rows.rms);
  EXPECT_EQ(study.points[0].max_error, rows.max);
  EXPECT_EQ(study.points[0].directions, 24);
  const RadiosityError mean = error({.directions = 24,
                                     .sampling = Sampling::random,
                                     .scheme = Scheme::semi_iterative,
                                     .first_shot = {},
                                     .burn_in = 2,
                                     .iterations = 18});
  EXPECT_EQ(study.points[1].rms_error, mean.rms);
  EXPECT_EQ(study.points[1].passes, 24 * 18);
}

/// Relative to the exitance of the stars, the error of their light elsewhere is negligible.
TEST(Study, ShowsTheGainOfAFirstShotOnPatchesThatDoNotEmit) {
  const auto scene = load_scene("stars");
  const auto tree = std::make_shared<const BspTree>(*scene);
  StudyOptions options;
  options.series = {{Sampling::fibonacci}, {Sampling::fibonacci}};
  options.series[1].first_shot = small_source_ratio;
  options.directions = {64, 256};
  EXPECT_THAT(names_of(options.series),
              ElementsAre("fibonacci/no-shot", "fibonacci/first-shot 1000"));
  EXPECT_EQ(options.reference().directions, 1024);
  EXPECT_EQ(options.reference().first_shot, small_source_ratio);
  const auto reference = solve_reference(scene, tree, options.reference());
  const Study study = run_study(scene, tree, options, {reference});
  EXPECT_GT(study.points.at(1).rms_error, 10 * study.points.at(3).rms_error);
}

TEST(Study, NamesContainOnlyWhatDiffers) {
  std::vector<StudySeries> series{{Sampling::random}, {Sampling::hammersley}};
  EXPECT_THAT(names_of(series), ElementsAre("random", "hammersley"));
  series.push_back({Sampling::random, false, Normalization::none, Scheme::growing});
  EXPECT_THAT(names_of(series), ElementsAre("random/two-way/fixed", "hammersley/two-way/fixed",
                                            "random/one-way/growing"));
}

TEST(Study, FitsPowerLawsExactly) {
  std::vector<StudyPoint> points;
  for (const int m : {10, 30, 200}) {
    points.push_back(point(m, 3 * std::pow(m, -0.75)));
  }
  points.push_back(point(100, std::nan("")));  // did not converge
  const auto law = fitted_power_law(points);
  ASSERT_TRUE(law);
  EXPECT_NEAR(law->slope, -0.75, 1e-12);
  EXPECT_NEAR(law->factor, 3, 1e-11);
  EXPECT_FALSE(fitted_power_law(std::vector{point(10, 1)}));
  EXPECT_FALSE(fitted_power_law(std::vector{point(10, 1), point(10, 2)}));
}

TEST(Study, CostsAreInterpolated) {
  const std::vector<StudyPoint> points{point(100, 0.1), point(400, 0.025)};
  const auto cost = cost_of(points, 0.05);
  ASSERT_TRUE(cost);
  EXPECT_NEAR(cost->passes, 200, 1e-9);
  EXPECT_NEAR(cost->seconds, 400, 1e-9);
  EXPECT_FALSE(cost->at_most);
  EXPECT_TRUE(cost_of(points, 0.2)->at_most);
  EXPECT_EQ(cost_of(points, 0.2)->passes, 100);
  std::vector<StudyPoint> largest = points;
  for (StudyPoint& p : largest) {
    p.max_error = 4 * p.rms_error;
    p.rms_error = 1;
  }
  EXPECT_NEAR(cost_of(largest, 0.2, ErrorMeasure::max)->passes, 200, 1e-9);
  EXPECT_NEAR(fitted_power_law(largest, ErrorMeasure::max)->slope, -1, 1e-12);
  EXPECT_FALSE(cost_of(points, 0.01));
  // A dip by chance, after which the error is larger again, does not count.
  EXPECT_FALSE(cost_of(std::vector{point(1, 1e-9), point(2, 0.1)}, 0.05));
}

TEST(Study, RecordsThatDirectionsAreTooFew) {
  // Reflectance near 1: with three directions rows sum to far more than 1.
  SceneDescription description = describe_scene("furnace");
  for (Material& material : description.materials) {
    material.reflectance = {0.98, 0.98, 0.98};
  }
  const auto scene = std::make_shared<const Scene>(description);
  StudyOptions options;
  options.series = {{Sampling::random}};
  options.directions = {2, 4096};
  options.solve.tolerance = 1e-4;
  const std::vector<Rgb> reference(scene->patches().size(), {50, 50, 50});
  const Study study =
      run_study(scene, std::make_shared<const BspTree>(*scene), options, {reference});
  ASSERT_THAT(study.points, SizeIs(2));
  EXPECT_NE(study.points[0].failure, "");
  EXPECT_NE(study.points[0].remedy, Remedy::none);
  EXPECT_TRUE(std::isnan(study.points[0].rms_error));
}

/// Pixels so coarse that rows of form factors sum to far more than 1: B overflows.
TEST(Study, InfiniteRadiosityIsAFailure) {
  const auto scene = load_scene("sphere-flake:levels=1");
  StudyOptions options;
  options.series = {{Sampling::fibonacci}};
  options.series[0].engine = Engine::zbuffer;
  options.series[0].resolution = 8;
  options.directions = {8};
  const std::vector<Rgb> reference(scene->patches().size(), {1, 1, 1});
  const Study study =
      run_study(scene, std::make_shared<const BspTree>(*scene), options, {reference});
  ASSERT_THAT(study.points, SizeIs(1));
  EXPECT_NE(study.points[0].failure, "");
  EXPECT_TRUE(std::isnan(study.points[0].rms_error));
  EXPECT_TRUE(std::isnan(study.points[0].max_error));
}

TEST(Study, RecordsThatMemoryIsTooSmall) {
  StudyOptions options;
  options.series = {{Sampling::fibonacci},
                    {Sampling::fibonacci, true, Normalization::none, Scheme::conjugate_gradients}};
  options.directions = {16};
  options.solve.memory = 1;
  const Study study = box().study(options);
  ASSERT_THAT(study.points, SizeIs(2));
  EXPECT_EQ(study.points[0].failure, "");
  EXPECT_THAT(study.points[1].failure, HasSubstr("memory limit"));
  EXPECT_EQ(study.points[1].remedy, Remedy::memory);
}

TEST(Study, KeepsFinishedPointsWhenCanceled) {
  StudyOptions options;
  options.series = {{Sampling::random}, {Sampling::fibonacci}};
  options.directions = {64, 16};
  const Cancellation cancellation;
  double last_fraction = 0;
  const Study study = box().study(
      options,
      [&](const StudyProgress& now) {
        EXPECT_GE(now.fraction, last_fraction);
        EXPECT_LE(now.fraction, 1);
        last_fraction = now.fraction;
        // The callback is called within a point, and after it.
        const std::size_t before = (now.directions == 64 ? 2 : 0) + now.series;
        EXPECT_THAT(now.points, AnyOf(SizeIs(before), SizeIs(before + 1)));
        if (now.series == 1 && now.directions == 64) {
          cancellation.cancel();
        }
      },
      cancellation);
  EXPECT_FALSE(study.complete);
  ASSERT_THAT(study.points, SizeIs(3));
  EXPECT_EQ(study.points[1].passes, 64);  // by series, then M
  EXPECT_EQ(study.points[2].series, 1U);
  EXPECT_GT(last_fraction, 0.5);
}

TEST(Study, RejectsInvalidOptions) {
  StudyOptions options;
  EXPECT_THROW(box().study(options), InputError);
  options.series = {{Sampling::random, false, Normalization::symmetric}};
  options.directions = {16};
  EXPECT_THROW(box().study(options), InputError);
  options.series = {{Sampling::random}};
  EXPECT_THROW(run_study(box().scene, box().tree, options, {}), InputError);
  const std::vector<Rgb> dark(box().reference.size());
  EXPECT_THROW(run_study(box().scene, box().tree, options, {dark}), InputError);
}

/// The error of a constant on a patch where the reference is linear is the norm of its linear term.
TEST(FunctionError, IsTheL2NormOfFunctions) {
  const Scene& scene = *box().scene;
  const std::size_t patches = scene.patches().size();
  std::vector<Rgb> reference(3 * patches), constant(patches, {2, 2, 2});
  for (std::size_t i = 0; i < patches; ++i) {
    reference[3 * i] = {2, 2, 2};
    reference[3 * i + 1] = {0.3, 0.3, 0.3};
    reference[3 * i + 2] = {-0.4, -0.4, -0.4};
  }
  EXPECT_EQ(function_error(scene, reference, reference).rms, 0);
  const RadiosityError error = function_error(scene, constant, reference);
  EXPECT_NEAR(error.rms, 0.5 / std::sqrt(4.25), 1e-12);
  EXPECT_NEAR(error.max, 0.2, 1e-12);
}

/// A difference in any byte of the key is a miss.
TEST(ReferenceCache, FindsWhatItStoredAndNothingElse) {
  const TemporaryFolder folder;
  const Scene& scene = *box().scene;
  const ReferenceCache cache(folder / "cache");
  const SolveOptions options = reference_options(4096);
  EXPECT_FALSE(cache.find(scene, options));
  cache.store(scene, options, box().reference);
  EXPECT_EQ(cache.find(scene, options), box().reference);

  SolveOptions other = options;
  other.threads = 3;
  other.memory = 12345;
  EXPECT_TRUE(cache.find(scene, other));
  other = options;
  other.rotation.reset();
  EXPECT_FALSE(cache.find(scene, other));
  EXPECT_FALSE(cache.find(scene, reference_options(4097)));
  other = options;
  other.engine_options.points = 8;
  EXPECT_FALSE(cache.find(scene, other));
  SceneDescription moved = describe_scene("cornell-box");
  moved.points[0].x += 1e-9;
  EXPECT_FALSE(cache.find(Scene(moved), options));
  SceneDescription darker = describe_scene("cornell-box");
  darker.materials[0].reflectance.b *= 0.5;
  EXPECT_FALSE(cache.find(Scene(darker), options));
  EXPECT_TRUE(cache.find(Scene(describe_scene("cornell-box")), options));
}

TEST(ReferenceCache, RejectsDamagedFiles) {
  const TemporaryFolder folder;
  const Scene& scene = *box().scene;
  const ReferenceCache cache(folder / "");
  const SolveOptions options = reference_options(4096);
  cache.store(scene, options, box().reference);
  const std::string file = cache.file_of(scene, options);
  const std::string good = read_file(file);
  ASSERT_EQ(good.size(), 24 * box().reference.size() + 98);
  for (const std::size_t at : {std::size_t{0}, std::size_t{30}, good.size() / 2, good.size() - 1}) {
    std::string damaged = good;
    damaged[at] = static_cast<char>(damaged[at] ^ 1);
    write_text(file, damaged);
    EXPECT_FALSE(cache.find(scene, options)) << at;
  }
  for (const std::string& damaged : {std::string(), good.substr(0, good.size() - 1), good + "x"}) {
    write_text(file, damaged);
    EXPECT_FALSE(cache.find(scene, options));
  }
  write_text(file, good);
  EXPECT_TRUE(cache.find(scene, options));
}

TEST(ReferenceCache, WithoutAFolderThereIsNone) {
  const ReferenceCache cache({});
  cache.store(*box().scene, reference_options(1), box().reference);
  EXPECT_FALSE(cache.find(*box().scene, reference_options(1)));
  EXPECT_TRUE(cache.file_of(*box().scene, reference_options(1)).empty());
}

TEST(ReferenceCache, SolvesAReferenceOnceAndFindsItAgain) {
  const TemporaryFolder folder;
  const ReferenceCache cache(folder / "cache");
  const SolveOptions options = reference_options(8);
  int calls = 0;
  const auto count_calls = [&](const SolveProgress&) { ++calls; };
  const ReferenceSolution solved =
      find_or_solve_reference(cache, box().scene, box().tree, options, count_calls);
  EXPECT_FALSE(solved.from_cache);
  EXPECT_EQ(solved.store_error, "");
  EXPECT_GT(calls, 0);
  EXPECT_EQ(solved.radiosity, solve_reference(box().scene, box().tree, options));

  calls = 0;
  const ReferenceSolution found =
      find_or_solve_reference(cache, box().scene, box().tree, options, count_calls);
  EXPECT_TRUE(found.from_cache);
  EXPECT_EQ(calls, 0);
  EXPECT_EQ(found.radiosity, solved.radiosity);
}

TEST(ReferenceCache, ReportsThatAReferenceCannotBeStored) {
  const ReferenceSolution solved = find_or_solve_reference(
      ReferenceCache("/dev/null/cache"), box().scene, box().tree, reference_options(8));
  EXPECT_FALSE(solved.from_cache);
  EXPECT_NE(solved.store_error, "");
  EXPECT_EQ(solved.radiosity.size(), box().reference.size());
}

TEST(ReferenceCache, StoresNothingWhenTheSolveIsCanceled) {
  const TemporaryFolder folder;
  const ReferenceCache cache(folder / "cache");
  EXPECT_THROW(
      find_or_solve_reference(cache, box().scene, box().tree, reference_options(8), {}, canceled()),
      Canceled);
  EXPECT_FALSE(cache.find(*box().scene, reference_options(8)));
}

// Plots. Cairo writes text as glyph outlines, so the tests read lines: colors and dashes.

Study two_ways(double factor) {
  Study study;
  for (const std::size_t series : {0, 1}) {
    for (const int m : {16, 64, 256}) {
      study.points.push_back(point(m, factor / m));
      study.points.back().series = series;
      study.points.back().bound = 10.0 / m;
    }
  }
  return study;
}

TEST(StudyPlot, SvgHasALineWithItsOwnDashesForEverySeries) {
  const TemporaryFolder folder;
  const auto plot = [&](const std::vector<StudySeries>& series) {
    write_charts(folder / "p.svg", {study_chart("box", series, two_ways(1))});
    return read_file(folder / "p.svg");
  };
  const std::string both = plot({{Sampling::random}, {Sampling::random, false}});
  EXPECT_THAT(both, StartsWith("<?xml"));
  EXPECT_THAT(both, HasSubstr("stroke-dasharray"));
  EXPECT_THAT(both, HasSubstr("stroke=\"#0073b3\""));
  EXPECT_THAT(both, HasSubstr("stroke=\"#d65e00\""));
  const std::string samplings = plot({{Sampling::random}, {Sampling::halton}});
  EXPECT_THAT(samplings, Not(HasSubstr("stroke-dasharray")));
  EXPECT_THAT(samplings, HasSubstr("stroke=\"#d65e00\""));
}

/// Rows of red, green and blue, from the bottom.
vtkSmartPointer<vtkImageData> read_png(const std::string& file) {
  const vtkNew<vtkPNGReader> reader;
  reader->SetFileName(file.c_str());
  reader->Update();
  return reader->GetOutput();
}

TEST(StudyPlot, PngShowsTheSeriesInTheirColors) {
  const TemporaryFolder folder;
  write_charts(folder / "p.png",
               {study_chart("a name \xff that is no UTF-8",
                            {{Sampling::random}, {Sampling::halton}}, two_ways(1))});
  const auto image = read_png(folder / "p.png");
  const int* size = image->GetDimensions();
  EXPECT_EQ(size[0], 1600);
  int white = 0, orange = 0, blue = 0;
  const auto* byte = static_cast<const unsigned char*>(image->GetScalarPointer());
  for (int k = 0; k < size[0] * size[1]; ++k, byte += 3) {
    const auto near = [byte](int r, int g, int b) {
      return std::abs(byte[0] - r) + std::abs(byte[1] - g) + std::abs(byte[2] - b) < 6 ? 1 : 0;
    };
    white += near(255, 255, 255);
    orange += near(214, 94, 0);
    blue += near(0, 115, 179);
  }
  EXPECT_GT(white, size[0] * size[1] / 2);
  EXPECT_GT(orange, 2000);  // the second, drawn over the first
  EXPECT_GT(blue, 300);     // the first, in the legend
  EXPECT_LT(blue, orange);
}

TEST(StudyPlot, LegendShowsSlopesWorstFirst) {
  const std::vector<StudySeries> series{{Sampling::random}, {Sampling::halton}};
  Study study = two_ways(1);
  for (StudyPoint& point : study.points) {
    if (point.series == 1) {
      point.rms_error *= 2;
    }
  }
  const LineChart chart = study_chart("box", series, study);
  ASSERT_EQ(chart.legend.size(), 3U);
  EXPECT_EQ(chart.series[chart.legend[0]].name, "bound (eq. 37)");
  EXPECT_EQ(chart.series[chart.legend[1]].name, "halton");
  EXPECT_EQ(chart.series[chart.legend[2]].name, "random");
  EXPECT_EQ(chart.series[chart.legend[2]].note, "\u22121.00");
  EXPECT_NE(chart.series[chart.legend[1]].marker, chart.series[chart.legend[2]].marker);
  const LineChart by_seconds =
      study_chart("box", series, study, ErrorMeasure::rms, StudyAxis::seconds);
  EXPECT_EQ(by_seconds.series.size(), 2U);
  EXPECT_EQ(by_seconds.series[0].note, "");
}

TEST(StudyPlot, ExtremeValuesCanBeDrawn) {
  const TemporaryFolder folder;
  std::vector<StudySeries> series{{Sampling::random}};
  Study study;
  write_charts(folder / "none.svg", {study_chart("", series, study)});
  study.points = {point(16, 0.1)};
  write_charts(folder / "one.svg", {study_chart(std::string(500, 'x'), series, study)});
  study.points = {point(1, 1e-300), point(1 << 24, 1e300), point(5, std::nan("")), point(6, 0)};
  write_charts(folder / "far.png", {study_chart("far", series, study)});
  for (const std::string& name : folder.names()) {
    EXPECT_GT(read_file(folder / name).size(), 1000U) << name;
  }
  EXPECT_THROW(check_chart_path(folder / "p.jpg"), InputError);
  EXPECT_THROW(check_chart_path(folder / "no/p.png"), InputError);
  EXPECT_NO_THROW(check_chart_path(folder / "p.PNG"));
}

}  // namespace
}  // namespace transillum::testing::study_test
