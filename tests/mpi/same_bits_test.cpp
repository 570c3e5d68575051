// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// transillum-mpi writes the same bytes as transillum, for any number of processes.

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "mpi_call.h"

namespace transillum {
namespace {

using testing::read_file;
using testing::operator+;
using testing::run_alone;
using testing::run_mpi;
using testing::TemporaryFolder;
using Json = nlohmann::json;
using Words = std::vector<std::string>;

/// Removes what depends on the clock and on the machine.
void remove_times(Json& json) {
  if (json.is_object()) {
    for (auto entry = json.begin(); entry != json.end();) {
      const bool varies = entry.key().find("seconds") != std::string::npos ||
                          entry.key().find("per_pass") != std::string::npos ||
                          entry.key().find("memory") != std::string::npos ||
                          entry.key() == "threads" ||
                          entry.key() == "faces";  // by the time that they take
      entry = varies ? json.erase(entry) : std::next(entry);
    }
  }
  for (Json& part : json) {
    if (part.is_structured()) {
      remove_times(part);
    }
  }
}

Json statistics_in(const std::string& file) {
  Json json = Json::parse(read_file(file));
  remove_times(json);
  return json;
}

void expect_same_bytes(Words options, const std::vector<int>& ranks) {
  const TemporaryFolder folder;
  options.insert(options.begin(), {"solve", "-q", "--out"});
  const auto command = [&](const std::string& name) {
    Words words = options;
    words.insert(words.begin() + 3,
                 {folder / (name + ".csv"), "--stats", folder / (name + ".json")});
    return words;
  };
  const auto alone = run_alone(command("alone"));
  ASSERT_EQ(alone.status, 0) << alone.err;
  const std::string expected = read_file(folder / "alone.csv");
  for (const int count : ranks) {
    SCOPED_TRACE(count);
    const auto shared = run_mpi(count, command("shared"));
    ASSERT_EQ(shared.status, 0) << shared.err;
    EXPECT_EQ(shared.out, alone.out);
    EXPECT_EQ(shared.err, alone.err);
    EXPECT_TRUE(read_file(folder / "shared.csv") == expected);
    EXPECT_EQ(statistics_in(folder / "shared.json"), statistics_in(folder / "alone.json"));
  }
}

const Words box{"cornell-box"};

TEST(SameBits, ForAnyNumberOfProcesses) {
  expect_same_bytes({"cornell-box", "--max-patch-area", "0.1", "-m", "100", "--by", "group"},
                    {1, 2, 3, 7});
}

TEST(SameBits, LinearBasis) {
  expect_same_bytes(box + Words{"-m", "40", "--basis", "linear"}, {2, 3});
  expect_same_bytes(box + Words{"-m", "40", "--basis", "linear", "--one-way", "--replicas", "2"},
                    {2});
  expect_same_bytes(box + Words{"-m", "40", "--basis", "linear", "--scheme", "conjugate-gradients",
                                "--sky", "0.3"},
                    {3});
}

TEST(SameBits, OneWay) { expect_same_bytes(box + Words{"-m", "65", "--one-way"}, {2, 3}); }

TEST(SameBits, Replicas) { expect_same_bytes(box + Words{"-m", "64", "--replicas", "4"}, {3}); }

TEST(SameBits, Growing) {
  expect_same_bytes(box + Words{"-m", "128", "--scheme", "growing"}, {2, 3});
}

TEST(SameBits, SemiIterative) {
  expect_same_bytes(box + Words{"-m", "16", "--scheme", "semi-iterative", "--iterations", "10"},
                    {3, 7});
}

TEST(SameBits, ConjugateGradients) {
  expect_same_bytes(box + Words{"-m", "64", "--scheme", "conjugate-gradients", "--normalize",
                                "symmetric", "--replicas", "2"},
                    {3});
}

TEST(SameBits, NormalizedRows) {
  expect_same_bytes(box + Words{"-m", "64", "--normalize", "rows", "--sky", "1,2,3"}, {3});
}

TEST(SameBits, Accuracy) { expect_same_bytes(box + Words{"--accuracy", "5%"}, {3, 7}); }

/// The solves run by default, and to an accuracy; with sources, both would end after one iteration.
TEST(SameBits, SmallLamp) {
  const std::string lamp = std::string(TRANSILLUM_DATA_DIR) + "/corpus/small-lamp.obj";
  expect_same_bytes({lamp, "-m", "32"}, {3});
  expect_same_bytes({lamp, "--accuracy", "1%"}, {3});
}

TEST(SameBits, FirstShot) {
  expect_same_bytes(box + Words{"-m", "64", "--first-shot", "auto"}, {3});
}

TEST(SameBits, EngineLocal) {
  expect_same_bytes(box + Words{"-m", "32", "--engine", "local"}, {3});
}

TEST(SameBits, EngineZbuffer) {
  expect_same_bytes(box + Words{"-m", "32", "--engine", "zbuffer", "--resolution", "128"}, {3});
}

TEST(SameBits, WhereFormFactorsDoNotFit) {
  expect_same_bytes(box + Words{"-m", "16", "--memory", "1k"}, {3});
}

TEST(SameBits, TwoThreadsInEachProcess) {
  expect_same_bytes(box + Words{"-m", "64", "--threads", "2"}, {3});
}

TEST(SameBits, SeriesOfResults) {
  const TemporaryFolder folder;
  for (const std::string name : {"alone", "shared"}) {
    const Words words = Words{"solve", "cornell-box", "-q", "-m", "64", "--iterations", "2"} +
                        Words{"--out",          folder / (name + ".vtp"),
                              "--series",       folder / (name + ".pvd"),
                              "--series-every", "10"};
    const auto run = name == "alone" ? run_alone(words) : run_mpi(3, words);
    ASSERT_EQ(run.status, 0) << run.err;
  }
  // The files also contain times, so their values are compared.
  const auto compared_with = [&](const std::string& name, const std::string& other) {
    const std::string copy = folder / "copy.vtp";
    std::filesystem::copy_file(folder / other, copy,
                               std::filesystem::copy_options::overwrite_existing);
    return run_alone({"compare", folder / name, copy}).out;
  };
  int compared = 0;
  for (const std::string& name : folder.names()) {
    if (name.starts_with("alone-")) {
      const std::string same = compared_with(name, name);
      EXPECT_NE(same, "");
      EXPECT_EQ(compared_with(name, "shared" + name.substr(5)), same);
      ++compared;
    }
  }
  EXPECT_GE(compared, 8);
}

}  // namespace
}  // namespace transillum
