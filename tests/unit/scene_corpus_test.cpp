// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
// Every file of data/scenes and data/corpus loads with the expected counts, also refined and
// two-sided; damaged copies of it load or are refused with an InputError.
#include <gtest/gtest.h>

#include <random>
#include <sstream>

#include "scene_test_support.h"

namespace transillum::scene_corpus_test {
namespace {

struct Entry {
  const char* file;
  PatchId patches;
  std::size_t pieces;
  double area;
  std::int64_t removed = 0, split = 0, coincident = 0, unused = 0;
};

/// The same counts are listed in data/README.md.
const std::vector<Entry>& entries() {
  static const std::vector<Entry> all{
      {"scenes/cube.obj", 6, 6, 6},
      {"scenes/parallel-squares.obj", 2, 2, 2},
      {"scenes/perpendicular-squares.obj", 2, 2, 2},
      {"scenes/lamp-in-ceiling.obj", 7, 7, 60},
      {"scenes/concave-room.obj", 8, 10, 72},
      {"scenes/box-in-cube.obj", 12, 12, 7.5},
      {"corpus/imperfect-crlf.obj", 3, 3, 2.5, 0, 0, 1, 1},
      {"corpus/non-planar.obj", 6, 6, 0, 0, 2, 0, 0},
      {"corpus/t-junctions.obj", 3, 3, 4},
      {"corpus/coincident.obj", 3, 3, 3, 0, 0, 2, 0},
      {"corpus/slivers.obj", 4, 4, 0, 2, 0, 0, 0},
      {"corpus/keyhole.obj", 1, 4, 8},
      {"corpus/far-away.obj", 1, 1, 0},
      {"corpus/interpenetrating.obj", 3, 3, 12},
      {"corpus/comb.obj", 1, 7, 0},
      {"corpus/cyclic.obj", 6, 6, 38.082762530298226},
      {"corpus/coplanar.obj", 9, 9, 39, 0, 0, 1, 0},
      {"corpus/book.obj", 7, 7, 14, 0, 0, 2, 0},
      {"corpus/combs.obj", 4, 12, 28, 0, 0, 1, 0},
      {"corpus/brickwork.obj", 11, 11, 27.1},
      {"corpus/tiny.obj", 19, 19, 5.162223938271391e-11},
      {"corpus/huge.obj", 19, 19, 51622239382713.914},
      {"corpus/needles.obj", 9, 9, 0},
      {"corpus/materials.obj", 9, 9, 6.1, 0, 0, 1, 0},
      {"corpus/no-materials.obj", 6, 6, 6},
      {"corpus/small-lamp.obj", 7, 7, 94.000025},
  };
  return all;
}

std::string path_of(const Entry& entry) {
  return std::string(TRANSILLUM_DATA_DIR) + "/" + entry.file;
}

class Corpus : public ::testing::TestWithParam<Entry> {};

TEST_P(Corpus, LoadsWithAReport) {
  const Entry& e = GetParam();
  const auto scene = load_scene(path_of(e));
  EXPECT_EQ(scene->patch_count(), e.patches);
  EXPECT_EQ(scene->pieces().size(), e.pieces);
  if (e.area > 0) {
    EXPECT_NEAR(total_area(*scene), e.area, 1e-12 * e.area);
  }
  EXPECT_EQ(scene->report().removed_degenerate, e.removed);
  EXPECT_EQ(scene->report().cut_non_planar, e.split);
  EXPECT_EQ(scene->report().coincident_faces, e.coincident);
  EXPECT_EQ(scene->report().unused_points, e.unused);
}

TEST_P(Corpus, LoadsTwoSidedAndRefined) {
  const auto once = load_scene(path_of(GetParam()));
  const auto twice = load_scene(path_of(GetParam()), {.two_sided = true});
  EXPECT_EQ(twice->patch_count(), 2 * once->patch_count());
  EXPECT_EQ(twice->pieces().size(), 2 * once->pieces().size());
  const double area = total_area(*once);
  const auto fine = load_scene(path_of(GetParam()), {.max_patch_area = area / 200});
  EXPECT_GE(fine->patch_count(), 200);
  EXPECT_NEAR(total_area(*fine), area, 1e-9 * area);
}

/// Bytes changed, removed or duplicated: the result is a scene or an InputError.
TEST_P(Corpus, DamagedFileLoadsOrIsRefused) {
  std::ifstream file(path_of(GetParam()), std::ios::binary);
  std::stringstream content;
  content << file.rdbuf();
  const test::TemporaryFolder folder;
  std::mt19937 random(12345);
  int loaded = 0, refused = 0;
  for (int copy = 0; copy < 100; ++copy) {
    std::string text = content.str();
    for (unsigned k = 0; k < 1 + copy % 4u; ++k) {
      const std::size_t at = random() % text.size();
      switch (random() % 4) {
        case 0:
          text[at] = static_cast<char>(random() % 256);
          break;
        case 1:
          text[at] = "0123456789-/. \n\\efv"[random() % 19];
          break;
        case 2:
          text.erase(at, 1 + random() % 8);
          break;
        default:
          text.insert(at, text.substr(random() % text.size(), 12));
      }
    }
    try {
      load_scene(folder.write("s.obj", text));
      ++loaded;
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()), "");
      ++refused;
    }
  }
  EXPECT_EQ(loaded + refused, 100);
}

INSTANTIATE_TEST_SUITE_P(Scene, Corpus, ::testing::ValuesIn(entries()), [](const auto& entry) {
  std::string name;
  for (const char c : std::string(entry.param.file)) {
    if (std::isalnum(static_cast<unsigned char>(c))) {
      name += c;
    }
  }
  return name;
});

}  // namespace
}  // namespace transillum::scene_corpus_test
