// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Compares the tables of data/FILES.md with the files that the program writes: names and order of
// CSV columns, PLY properties and VTP arrays, and the set of JSON keys.
#include <gmock/gmock.h>
#include <vtkCellData.h>
#include <vtkFieldData.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkXMLPolyDataReader.h>

#include <nlohmann/json.hpp>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "io/results/error_report_files.h"
#include "io/results/sensor_files.h"
#include "io/results/statistics_files.h"
#include "io/results/study_csv.h"
#include "session/measure_errors.h"
#include "support/program_call.h"
#include "transillum/files.h"
#include "transillum/map_files.h"
#include "transillum/solve_session.h"
#include "visibility/pixels/pixel_map.h"

namespace transillum::testing::file_tables_test {
namespace {

using ::testing::ElementsAreArray;
using ::testing::UnorderedElementsAreArray;
using Names = std::vector<std::string>;

/// The names in backquotes in the first cells of a table of data/FILES.md: the first table after
/// the line `after`, in the section with the heading `section`.
Names table(const std::string& section, const std::string& after = "") {
  std::istringstream lines(read_file(std::string(TRANSILLUM_DATA_DIR) + "/FILES.md"));
  bool in_section = false, after_line = after.empty(), in_table = false;
  Names names;
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("## ")) {
      in_section = line == "## " + section;
    }
    if (!in_section) {
      continue;
    }
    after_line = after_line || line.starts_with(after);
    if (!after_line) {
      continue;
    }
    if (!line.starts_with("|")) {
      if (in_table) {
        break;
      }
      continue;
    }
    in_table = true;
    std::istringstream cell(line.substr(1, line.find('|', 1) - 1));
    std::string between;
    for (std::string name; std::getline(cell, between, '`') && std::getline(cell, name, '`');) {
      names.push_back(name);
    }
  }
  EXPECT_FALSE(names.empty()) << section;
  return names;
}

Names split(const std::string& line) {
  Names names;
  std::istringstream in(line);
  for (std::string name; std::getline(in, name, ',');) {
    names.push_back(name);
  }
  return names;
}

Names header_of(const std::string& csv) { return split(csv.substr(0, csv.find('\n'))); }

/// The keys of all values; keys of inner objects are joined by points; `[]` marks lists of objects.
void add_keys(const nlohmann::json& json, const std::string& prefix, std::set<std::string>& keys) {
  for (const auto& [key, value] : json.items()) {
    const std::string name = prefix + key;
    if (value.is_object()) {
      add_keys(value, name + ".", keys);
    } else if (value.is_array() && !value.empty() && value[0].is_object()) {
      for (const auto& entry : value) {
        add_keys(entry, name + "[].", keys);
      }
    } else {
      keys.insert(name);
    }
  }
}

std::set<std::string> keys_of(const std::string& path) {
  std::set<std::string> keys;
  add_keys(read_json(path), "", keys);
  return keys;
}

/// The keys of a table, except keys of objects whose members the table lists too: these objects
/// have their own row because they may be null.
std::set<std::string> leaf_keys(const std::string& section) {
  const Names names = table(section);
  std::set<std::string> leaves(names.begin(), names.end());
  EXPECT_EQ(leaves.size(), names.size()) << "a key is listed twice";
  std::erase_if(leaves, [&](const std::string& name) {
    return std::any_of(names.begin(), names.end(), [&](const std::string& other) {
      return other.starts_with(name + ".") || other.starts_with(name + "[].");
    });
  });
  return leaves;
}

Names arrays_of(vtkFieldData& fields) {
  Names names;
  for (int k = 0; k < fields.GetNumberOfArrays(); ++k) {
    names.emplace_back(fields.GetAbstractArray(k)->GetName());
  }
  return names;
}

void expect_arrays(const std::string& path, const std::string& section) {
  vtkNew<vtkXMLPolyDataReader> reader;
  reader->SetFileName(path.c_str());
  reader->Update();
  EXPECT_THAT(arrays_of(*reader->GetOutput()->GetCellData()),
              ElementsAreArray(table(section, "Cell data:")));
  EXPECT_THAT(arrays_of(*reader->GetOutput()->GetFieldData()),
              UnorderedElementsAreArray(table(section, "Field data")));
}

class FileTables : public ::testing::Test {
 protected:
  FileTables() : scene_(load_scene("boards")) {
    options_.directions = 16;
    options_.replicas = 2;
    options_.sky.exitance = {1, 1, 1};
    options_.sky.sun = {{1, 1, 1}, {0, 0, 1}};
  }

  TemporaryFolder folder_;
  std::shared_ptr<const Scene> scene_;
  SolveOptions options_;
};

TEST_F(FileTables, Results) {
  const Solution solution = solve(scene_, options_);
  for (const char* name : {"r.csv", "r.ply", "r.vtp"}) {
    write_result(folder_ / name, solution);
  }
  EXPECT_THAT(header_of(read_file(folder_ / "r.csv")), ElementsAreArray(table("Result CSV")));

  Names properties;
  std::istringstream ply(read_file(folder_ / "r.ply"));
  for (std::string line; std::getline(ply, line) && line != "end_header";) {
    if (line.starts_with("property")) {
      properties.push_back(line.substr(line.rfind(' ') + 1));
    }
  }
  EXPECT_THAT(properties, ElementsAreArray(table("Result PLY")));
  expect_arrays(folder_ / "r.vtp", "Result VTP");
}

TEST_F(FileTables, Statistics) {
  options_.goal.accuracy = 0.5;
  Solution solution = solve(scene_, options_);
  solution.statistics.refinement = {{6, 0.5, 1}};
  solution.statistics.glossy.patches = 1;  // no solve has both
  PatchCosts costs{1, 0, {}};
  costs.patches.resize(static_cast<std::size_t>(solution.scene->patch_count()));
  write_statistics(folder_ / "s.json", {.solve = options_}, solution, &costs);
  EXPECT_THAT(keys_of(folder_ / "s.json"), ::testing::ContainerEq(leaf_keys("Statistics JSON")));
}

TEST_F(FileTables, ErrorReports) {
  options_.directions = 8;
  SolveSession session({.scene = scene_, .options = options_});
  session.advance(SolveSession::Until::finished);
  const MeasuredSolve solve = measured_solve(session);
  ErrorReport report = measure_errors(solve);
  report.steps.resize(1);
  write_error_report(folder_ / "errors.json", report, solve);
  EXPECT_THAT(keys_of(folder_ / "errors.json"),
              ::testing::ContainerEq(leaf_keys("Error report JSON")));
}

TEST_F(FileTables, CsvOfTransfersFactorsDirectionsAndStudies) {
  const auto header = [](const auto& write) {
    std::ostringstream out;
    write(out);
    return header_of(out.str());
  };
  EXPECT_THAT(header([](auto& out) { write_transfers_csv(out, Transfers{}); }),
              ElementsAreArray(table("Transfers CSV")));
  EXPECT_THAT(header([](auto& out) { write_form_factors_csv(out, FormFactors{}); }),
              ElementsAreArray(table("Factors CSV")));
  EXPECT_THAT(header([](auto& out) { write_sensor_factors_csv(out, FormFactors{}); }),
              ElementsAreArray(table("Sensors", "`--out")));
  EXPECT_THAT(header([](auto& out) { write_sensor_irradiance_csv(out, {}, FormFactors{}, {}); }),
              ElementsAreArray(table("Sensors", "`--irradiance")));
  EXPECT_THAT(header([](auto& out) { write_directions_csv(out, std::vector<DirectionSample>{}); }),
              ElementsAreArray(table("Directions CSV")));
  EXPECT_THAT(header([](auto& out) { write_study_csv(out, {StudySeries{}}, Study{}); }),
              ElementsAreArray(table("Study CSV")));
}

TEST_F(FileTables, Maps) {
  const Vec3 omega = normalized({0.3, 0.2, 0.9});
  const auto tree = std::make_shared<const BspTree>(*scene_);
  const PatchId receiver = 0;
  const PixelMap pixels =
      pixel_map({Engine::zbuffer, {.resolution = 40}}, *scene_, *tree, omega, receiver);
  VisibilityMap map = drawn_in_pixels(*scene_, pixels);
  mark_differences(pixels, map_of_receiver(record_local_map(*scene_, *tree, omega), receiver), map);
  ASSERT_FALSE(map.polygons.empty());
  ASSERT_FALSE(map.pixels.differences.empty());
  write_map(folder_ / "m.json", *scene_, map);
  EXPECT_THAT(keys_of(folder_ / "m.json"), ::testing::ContainerEq(leaf_keys("Map JSON")));
  write_map(folder_ / "m.vtp", *scene_, map);
  expect_arrays(folder_ / "m.vtp", "Map VTP");
}

TEST_F(FileTables, DirectionsAndBounds) {
  expect_success({"directions", "-m", "16", "--stats", folder_ / "d.json", "--scene", "furnace"});
  EXPECT_THAT(keys_of(folder_ / "d.json"), ::testing::ContainerEq(leaf_keys("Directions JSON")));
  write_statistics(folder_ / "s.json", {.solve = options_}, solve(scene_, options_));
  expect_success(
      {"bounds", "furnace", "-m", "16", "--run", folder_ / "s.json", "--out", folder_ / "b.json"});
  EXPECT_THAT(keys_of(folder_ / "b.json"), ::testing::ContainerEq(leaf_keys("Bounds JSON")));
}

}  // namespace
}  // namespace transillum::testing::file_tables_test
