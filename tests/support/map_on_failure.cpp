// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "support/map_on_failure.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <exception>
#include <filesystem>
#include <iostream>
#include <map>

#include "transillum/map_files.h"

namespace transillum::testing {
namespace {

namespace fs = std::filesystem;

int failures_so_far() {
  const ::testing::TestInfo* test = ::testing::UnitTest::GetInstance()->current_test_info();
  return test ? test->result()->total_part_count() : 0;
}

std::string current_test_name() {
  const ::testing::TestInfo* test = ::testing::UnitTest::GetInstance()->current_test_info();
  std::string name = test ? std::string(test->test_suite_name()) + "." + test->name() : "map";
  std::replace(name.begin(), name.end(), '/', '-');
  return name;
}

}  // namespace

std::string save_map(const Scene& scene, const BspTree& tree, const Vec3& omega,
                     const std::string& name) {
  const fs::path folder = TRANSILLUM_FAILED_MAPS_DIR;
  fs::create_directories(folder);
  const fs::path path = folder / (name + ".svg");
  write_map(path, scene, map_from_below(record_local_map(scene, tree, omega)));
  return path.string();
}

MapOnFailure::MapOnFailure(const Scene& scene, const BspTree& tree, const Vec3& omega)
    : scene_(scene), tree_(tree), omega_(omega), failures_(failures_so_far()) {}

MapOnFailure::~MapOnFailure() {
  if (failures_so_far() == failures_) {
    return;
  }
  // A few are enough.
  constexpr int most = 5;
  static std::map<std::string, int> written;
  const std::string test = current_test_name();
  const int number = ++written[test];
  if (number > most) {
    return;
  }
  try {
    std::cerr << "The visibility map of this direction: "
              << save_map(scene_, tree_, omega_, test + "-" + std::to_string(number)) << '\n';
  } catch (const std::exception& error) {
    std::cerr << "The visibility map of this direction could not be written: " << error.what()
              << '\n';
  }
}

}  // namespace transillum::testing
