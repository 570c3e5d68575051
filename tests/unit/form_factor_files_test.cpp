// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Form factors in files: written files are read back, matrices of other programs are read, and
// damaged or foreign files are refused in one line; drop_small_form_factors(); `solve --factors`.

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>
#include <sstream>
#include <utility>

#include "io/factors/factor_formats.h"
#include "io/factors/npy_array.h"
#include "io/factors/zip_archive.h"
#include "radiosity/form_factors/small_form_factors.h"
#include "support/form_factor_rows.h"
#include "support/program_call.h"
#include "support/refusal.h"
#include "support/scenes.h"
#include "transillum/at.h"
#include "transillum/files.h"
#include "transillum/pair_form_factors.h"
#include "transillum/radiosity_solver.h"
#include "transillum/solution.h"
#include "transillum/solve_options.h"

namespace transillum::testing::form_factor_files_test {
namespace {

using test::refusal;
using ::testing::HasSubstr;
using ::testing::StartsWith;

void expect_equal(const FormFactors& a, const FormFactors& b) {
  EXPECT_TRUE(a.row_begin == b.row_begin);
  EXPECT_TRUE(a.source == b.source);
  EXPECT_TRUE(a.value == b.value);
}

std::vector<double> row_sums(const FormFactors& f) {
  std::vector<double> sums;
  for (PatchId i = 0; i + 1 < std::ssize(f.row_begin); ++i) {
    sums.push_back(row_sum(f, i));
  }
  return sums;
}

class FormFactorFiles : public ::testing::Test {
 protected:
  std::string path(const char* name) const { return folder_ / name; }
  std::string refused(const std::string& name) const {
    std::string sentence = refusal([&] { read_form_factors(folder_ / name); });
    EXPECT_THAT(sentence, StartsWith(folder_ / name));
    EXPECT_EQ(sentence.find('\n'), std::string::npos);
    return sentence;
  }
  std::string refused_text(const std::string& text) const {
    write_text(path("m.mtx"), text);
    return refused("m.mtx");
  }

  TemporaryFolder folder_;
  std::shared_ptr<const Scene> scene_ = load_scene("cornell-box");
  FormFactors form_factors_ = form_factors_of(scene_, {.directions = 16});
};

TEST_F(FormFactorFiles, AreReadBackBitForBit) {
  for (const char* name : {"f.npz", "f.mtx", "F.NPZ"}) {
    write_form_factors(path(name), *scene_, form_factors_);
    const StoredFormFactors stored = read_form_factors(path(name));
    expect_equal(stored.form_factors, form_factors_);
    ASSERT_EQ(stored.areas.size(), scene_->patches().size());
    EXPECT_EQ(stored.areas[3], scene_->patch(3).area);
    EXPECT_EQ(refusal([&] { check_form_factors(*scene_, stored); }), "");
  }
}

TEST_F(FormFactorFiles, AnEmptyMatrixIsReadBack) {
  const auto lonely = load_scene("furnace");
  FormFactors none;
  none.row_begin.assign(lonely->patches().size() + 1, 0);
  for (const char* name : {"f.npz", "f.mtx"}) {
    write_form_factors(path(name), *lonely, none);
    expect_equal(read_form_factors(path(name)).form_factors, none);
  }
}

/// Written by scipy.sparse.save_npz(compressed=True), with 64-bit indices in rows that are not
/// sorted, and a duplicate.
TEST_F(FormFactorFiles, ReadsMatricesOfScipy) {
  const StoredFormFactors stored =
      read_form_factors(std::string(TRANSILLUM_DATA_DIR) + "/corpus/fuzz/factors/scipy.npz");
  EXPECT_TRUE(stored.areas.empty());
  EXPECT_THAT(stored.form_factors.row_begin, ::testing::ElementsAre(0, 2, 3, 3));
  EXPECT_THAT(stored.form_factors.source, ::testing::ElementsAre(1, 2, 0));
  EXPECT_THAT(stored.form_factors.value, ::testing::ElementsAre(0.25, 0.125, 0.5));
}

TEST_F(FormFactorFiles, View3dTextIsADenseMatrix) {
  write_form_factors(path("f.vf"), *scene_, form_factors_);
  std::ifstream file(path("f.vf"));
  std::string head;
  std::getline(file, head);
  EXPECT_EQ(head.size(), 30U);
  std::istringstream words(head);
  std::string program, version;
  int format = -1, enclosure = -1, emittances = -1, surfaces = 0;
  words >> program >> version >> format >> enclosure >> emittances >> surfaces;
  EXPECT_EQ(program, "View3D");
  EXPECT_EQ(format, 0);
  ASSERT_EQ(surfaces, scene_->patch_count());
  double value = 0;
  for (PatchId i = 0; i < surfaces; ++i) {
    file >> value;
    EXPECT_EQ(value, scene_->patch(i).area);
  }
  const std::vector<double> sums = row_sums(form_factors_);
  for (PatchId i = 0; i < surfaces; ++i) {
    double sum = 0;
    for (PatchId j = 0; j < surfaces; ++j) {
      file >> value;
      sum += value;
    }
    EXPECT_NEAR(sum, at(sums, i), 1e-12);
  }
  file >> value;
  const Rgb& rho = scene_->reflectance(0);
  EXPECT_NEAR(value, 1 - (rho.r + rho.g + rho.b) / 3, 1e-15);
}

TEST_F(FormFactorFiles, DamagedArchivesAreRefused) {
  write_form_factors(path("f.npz"), *scene_, form_factors_);
  const std::string whole = read_file(path("f.npz"));
  for (std::size_t size = 0; size < whole.size(); size += 1 + size / 7) {
    write_text(path("cut.npz"), whole.substr(0, size));
    EXPECT_NE(refused("cut.npz"), "");
  }
  // Any byte of the numbers changes the CRC.
  for (std::size_t at = 100; at < whole.size() - 700; at += 997) {
    std::string damaged = whole;
    damaged[at] = static_cast<char>(damaged[at] ^ 0x10);
    write_text(path("bad.npz"), damaged);
    refusal([&] { read_form_factors(path("bad.npz")); });  // or read, where the byte has no meaning
  }
  EXPECT_THAT(refused("missing.npz"), HasSubstr("no such file"));
  write_text(path("text.npz"), "i,j,F\n");
  EXPECT_THAT(refused("text.npz"), HasSubstr("not a ZIP archive"));
  EXPECT_THAT(refused("f.csv"), HasSubstr("read from .npz and .mtx"));
}

TEST_F(FormFactorFiles, ArraysThatAreNoMatrixAreRefused) {
  const auto archive = [&](const std::string& format, std::vector<std::int64_t> shape,
                           std::vector<std::int32_t> begin, std::vector<std::int32_t> source,
                           std::vector<double> value) {
    const auto bytes = [](const auto& list) {
      return std::string_view(reinterpret_cast<const char*>(list.data()),
                              list.size() * sizeof list[0]);
    };
    const auto head = [](const char* type, std::size_t size) {
      return npy_head(type, "(" + std::to_string(size) + ",)");
    };
    write_file_whole(path("x.npz"), [&](std::ostream& out) {
      ZipWriter zip(out);
      zip.add("format.npy", npy_head("|S3", "()"), format);
      zip.add("shape.npy", head("<i8", shape.size()), bytes(shape));
      zip.add("indptr.npy", head("<i4", begin.size()), bytes(begin));
      zip.add("indices.npy", head("<i4", source.size()), bytes(source));
      zip.add("data.npy", head("<f8", value.size()), bytes(value));
      zip.finish();
    });
    return "x.npz";
  };
  const std::string good = archive("csr", {2, 2}, {0, 1, 2}, {1, 0}, {0.5, 0.25});
  EXPECT_EQ(read_form_factors(path(good.c_str())).form_factors.size(), 2U);
  EXPECT_THAT(refused(archive("coo", {2, 2}, {0, 1, 2}, {1, 0}, {0.5, 0.25})),
              HasSubstr("a matrix of format `coo`"));
  EXPECT_THAT(refused(archive("csr", {2, 3}, {0, 1, 2}, {1, 0}, {0.5, 0.25})),
              HasSubstr("not square"));
  EXPECT_THAT(refused(archive("csr", {2, 2}, {0, 2, 1}, {1, 0}, {0.5, 0.25})),
              HasSubstr("do not fit"));
  EXPECT_THAT(refused(archive("csr", {2, 2}, {0, 3, 2}, {1, 0}, {0.5, 0.25})),
              HasSubstr("row 0 ends at 3"));
  EXPECT_THAT(refused(archive("csr", {2, 2}, {0, 1, 2}, {1, 2}, {0.5, 0.25})),
              HasSubstr("row 1 has column 2"));
  EXPECT_THAT(refused(archive("csr", {2, 2}, {0, 1, 2}, {1, 0}, {0.5, NAN})),
              HasSubstr("patches 1 and 0 is nan"));
}

TEST_F(FormFactorFiles, TextsThatAreNoMatrixAreRefused) {
  const std::string head = "%%MatrixMarket matrix coordinate real general\n";
  write_text(path("m.mtx"), head + "% a comment\n2 2 2\n1 2 0.5\n2 1 2.5e-1\n");
  EXPECT_EQ(read_form_factors(path("m.mtx")).form_factors.value[1], 0.25);
  EXPECT_THAT(refused_text(""), HasSubstr("not a matrix"));
  EXPECT_THAT(refused_text("%%MatrixMarket matrix array real general\n1 1\n0\n"),
              HasSubstr("`coordinate real general` is read"));
  EXPECT_THAT(refused_text(head + "2 2 2\n1 2 0.5\n"), HasSubstr("has 1 entries, not 2"));
  EXPECT_THAT(refused_text(head + "2 2 1\n1 3 0.5\n"), HasSubstr(":3: `3` is not a whole number"));
  EXPECT_THAT(refused_text(head + "2 2 1\n1 2 x\n"), HasSubstr("`x` is not a number"));
  EXPECT_THAT(refused_text(head + "2 2 1\n1 2 -1\n"), HasSubstr("is -1, not in the range"));
  EXPECT_THAT(refused_text(head + "2000000000 2000000000 0\n"), HasSubstr("whole number from 1"));
  EXPECT_THAT(refused_text(head + "2 2\n"), HasSubstr("three numbers"));
}

TEST_F(FormFactorFiles, OfAnotherSceneAreRefused) {
  write_form_factors(path("f.npz"), *scene_, form_factors_);
  StoredFormFactors stored = read_form_factors(path("f.npz"));
  const auto refused = [&](const Scene& scene) {
    return refusal([&] { check_form_factors(scene, stored); });
  };
  EXPECT_THAT(refused(*load_scene("furnace")), HasSubstr("but furnace has 12"));
  const Scene larger(moved(describe_scene("cornell-box"), [](const Vec3& p) { return 1.5 * p; }));
  EXPECT_THAT(refused(larger), HasSubstr("patch 0 has an area of"));
  // Without areas, reciprocity is checked, which does not depend on the scale.
  stored.areas.clear();
  stored.polygons.clear();
  EXPECT_EQ(refused(*scene_), "");
  EXPECT_EQ(refused(larger), "");
  std::vector<int> order(describe_scene("cornell-box").face_count());
  for (std::size_t k = 0; k < order.size(); ++k) {
    order[k] = static_cast<int>(order.size() - 1 - k);
  }
  EXPECT_THAT(refused(Scene(reordered(describe_scene("cornell-box"), order))),
              HasSubstr("% on average, most between patches"));
}

/// A box moved by 5 cm: all areas, and reciprocity, are as before.
TEST_F(FormFactorFiles, OfASceneInWhichAnObjectHasMovedAreRefused) {
  const auto scene = box_in_cube(4, 1).scene();
  const auto other = box_in_cube(4, 1, [](const Vec3& p) { return p + Vec3{0.05, 0, 0}; }).scene();
  const FormFactors form_factors = form_factors_of(scene, {.directions = 16});
  for (const char* name : {"f.npz", "f.mtx"}) {
    write_form_factors(path(name), *scene, form_factors);
    StoredFormFactors stored = read_form_factors(path(name));
    EXPECT_EQ(refusal([&] { check_form_factors(*scene, stored); }), "");
    EXPECT_THAT(refusal([&] { check_form_factors(*other, stored); }), HasSubstr("have moved"));
    stored.polygons.clear();  // like files of other programs
    EXPECT_EQ(refusal([&] { check_form_factors(*other, stored); }), "");
  }
}

/// The order in which a file lists the points does not matter.
TEST_F(FormFactorFiles, AreThoseOfTheSameSceneInAFile) {
  write_form_factors(path("f.npz"), *scene_, form_factors_);
  write_obj(path("box.obj"), describe_scene("cornell-box"));
  EXPECT_EQ(refusal([&] {
              check_form_factors(*load_scene(path("box.obj")), read_form_factors(path("f.npz")));
            }),
            "");
}

/// Row sums are as before, and pairs reciprocal.
void expect_balanced(const Scene& scene, const FormFactors& all, const FormFactors& rest) {
  const std::vector<double> before = row_sums(all), after = row_sums(rest);
  for (std::size_t i = 0; i < before.size(); ++i) {
    ASSERT_NEAR(after[i], before[i], 1e-10) << i;
  }
  for (PatchId i = 0; i < scene.patch_count(); ++i) {
    const auto row = static_cast<std::size_t>(i);
    for (std::size_t k = rest.row_begin[row]; k < rest.row_begin[row + 1]; ++k) {
      const auto j = static_cast<std::size_t>(rest.source[k]);
      const auto first = rest.source.begin() + static_cast<std::ptrdiff_t>(rest.row_begin[j]);
      const auto last = rest.source.begin() + static_cast<std::ptrdiff_t>(rest.row_begin[j + 1]);
      const auto back = std::lower_bound(first, last, i);
      ASSERT_TRUE(back != last && *back == i);
      const double there = scene.patch(i).area * rest.value[k];
      ASSERT_NEAR(scene.patches()[j].area *
                      rest.value[static_cast<std::size_t>(back - rest.source.begin())],
                  there, 1e-12 * there);
    }
  }
}

/// The sum of A_i F_ij over pairs of which both form factors are below the threshold, divided by
/// the sum over all pairs.
double fraction_below(const Scene& scene, const FormFactors& all, double threshold) {
  std::map<std::pair<PatchId, PatchId>, double> by_pair;
  for (PatchId i = 0; i < scene.patch_count(); ++i) {
    for (std::size_t k = at(all.row_begin, i); k < at(all.row_begin, i + 1); ++k) {
      by_pair[{i, all.source[k]}] = all.value[k];
    }
  }
  double below = 0, sum = 0;
  for (const auto& [pair, value] : by_pair) {
    const double power = scene.patch(pair.first).area * value;
    sum += power;
    below += std::max(value, by_pair.at({pair.second, pair.first})) < threshold ? power : 0;
  }
  return below / sum;
}

/// Rows and reciprocity of a closed scene stay, and only tiny form factors go.
TEST_F(FormFactorFiles, DroppingKeepsRowSumsAndReciprocity) {
  const auto scene = load_scene("cornell-box", {.max_patch_area = 0.05});
  const FormFactors all = form_factors_of(scene, {.directions = 64});
  const double threshold = 2e-3;
  const DroppedFormFactors rest = drop_small_form_factors(*scene, all, threshold);
  EXPECT_GT(rest.dropped, all.size() / 20);
  EXPECT_EQ(rest.form_factors.size(), all.size() - rest.dropped);
  EXPECT_EQ(rest.kept, 0U);
  EXPECT_GT(rest.fraction, 0);
  EXPECT_NEAR(rest.fraction, fraction_below(*scene, all, threshold), 1e-12);
  expect_balanced(*scene, all, rest.form_factors);
}

/// Rows that lose so much that they cannot be balanced keep their entries; others lose theirs. One
/// such row made all of the matrix stay.
TEST_F(FormFactorFiles, DroppingGoesOnWhereSomeRowsCannotBeBalanced) {
  const auto scene = load_scene("cornell-box", {.max_patch_area = 0.05});
  const FormFactors all = form_factors_of(scene, {.directions = 64});
  for (const double threshold : {0.03, 0.05, 0.1}) {
    const DroppedFormFactors rest = drop_small_form_factors(*scene, all, threshold);
    EXPECT_GT(rest.dropped, 2 * all.size() / 3) << threshold;
    EXPECT_EQ(rest.kept > 0, threshold == 0.1);
    EXPECT_LE(rest.row_error, 1e-10);
    expect_balanced(*scene, all, rest.form_factors);
  }
}

/// Three patches of which the middle one exchanges with both others: without the form factors
/// between these, rows cannot sum to what they did.
TEST_F(FormFactorFiles, DroppingKeepsWhatCannotBeBalanced) {
  Sketch sketch("three");
  const int gray = sketch.material(0.5, 1);
  for (int k = 0; k < 3; ++k) {
    const double z = k;
    sketch.face({{0, 0, z}, {1, 0, z}, {1, 1, z}, {0, 1, z}}, gray);
  }
  const auto scene = sketch.scene();
  const FormFactors f{{0, 2, 4, 6}, {1, 2, 0, 2, 0, 1}, {0.3, 1e-9, 0.3, 0.2, 1e-9, 0.2}};
  const DroppedFormFactors rest = drop_small_form_factors(*scene, f, 1e-6);
  EXPECT_EQ(rest.dropped, 0U);
  expect_equal(rest.form_factors, f);
  // Single rows can always be scaled.
  const FormFactors one_way{{0, 2, 3, 3}, {1, 2, 0}, {0.3, 1e-3, 0.2}};
  const DroppedFormFactors rows = drop_small_form_factors(*scene, one_way, 0.01);
  EXPECT_EQ(rows.dropped, 1U);
  EXPECT_DOUBLE_EQ(rows.form_factors.value[0], 0.301);
  EXPECT_THAT(refusal([&] { drop_small_form_factors(*scene, f, 1); }), HasSubstr("threshold"));
}

/// Programs that run in a temporary folder.
class CliFactorFiles : public ::testing::Test {
 protected:
  ProgramResult run(const Arguments& arguments) const {
    return expect_success(arguments, folder_.path());
  }
  void refused(const Arguments& arguments, const std::string& expected) const {
    expect_refused(arguments, expected, folder_.path());
  }
  std::string path(const char* name) const { return folder_ / name; }
  TemporaryFolder folder_;
};

TEST_F(CliFactorFiles, SolvesWithStoredFormFactors) {
  for (const char* file : {"f.npz", "f.mtx"}) {
    run({"factors", "cornell-box", "-m", "32", "--out", file});
    const ProgramResult stored =
        run({"solve", "cornell-box", "--factors", file, "--tolerance", "1e-12", "--out", "b.vtp"});
    EXPECT_THAT(stored.err, HasSubstr(" given, "));
    run({"solve", "cornell-box", "-m", "32", "--first-shot", "none", "--tolerance", "1e-12", "-q",
         "--out", "a.vtp"});
    run({"compare", "a.vtp", "b.vtp", "--tolerance", "1e-10"});
  }
}

/// B of stored form factors was up to 11 % off where a block had been moved.
TEST_F(CliFactorFiles, OfAMovedObjectAreRefusedAndOfAnUnknownSceneWarnedOf) {
  write_obj(path("before.obj"), box_in_cube(4, 1).description());
  write_obj(path("after.obj"), box_in_cube(4, 1, [](const Vec3& p) {
                                 return p + Vec3{0.05, 0, 0};
                               }).description());
  run({"factors", "before.obj", "-m", "32", "--out", "f.mtx"});
  EXPECT_EQ(run({"solve", "before.obj", "--factors", "f.mtx", "-q"}).err, "");
  refused({"solve", "after.obj", "--factors", "f.mtx"},
          "f.mtx: the form factors are of other polygons");
  std::string text = read_file(path("f.mtx"));
  text.erase(text.find("%polygons"), text.find("%area") - text.find("%polygons"));
  write_text(path("f.mtx"), text);
  EXPECT_THAT(run({"solve", "after.obj", "--factors", "f.mtx", "-q"}).err,
              HasSubstr("warning: f.mtx: "));
}

TEST_F(CliFactorFiles, LeavesOutTinyOnesAndNamesWhatIsWrong) {
  const ProgramResult all = run({"factors", "cornell-box", "-m", "32"});
  const ProgramResult rest = run({"factors", "cornell-box", "-m", "32", "--drop", "0.01"});
  EXPECT_LT(line_count(rest.out), line_count(all.out));
  EXPECT_THAT(rest.err, HasSubstr("form factors omitted"));
  refused({"factors", "furnace", "--drop", "1"}, "--drop");
  refused({"factors", "furnace", "--out", "f.txt"}, "must end in .csv");
  run({"factors", "furnace", "-m", "8", "--out", "f.npz"});
  refused({"solve", "cornell-box", "--factors", "f.npz"},
          "f.npz: the form factors are of 12 patches");
  for (const Arguments& options : {Arguments{"-m", "8"}, {"--sky", "1"}, {"--memory", "1G"}}) {
    refused(Arguments{"solve", "furnace", "--factors", "f.npz"} + options,
            "not used with --factors");
  }
  run({"solve", "furnace", "--factors", "f.npz", "-q", "--threads", "1", "--iterations", "2"});
}

}  // namespace
}  // namespace transillum::testing::form_factor_files_test
