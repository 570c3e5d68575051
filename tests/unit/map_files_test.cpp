// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Maps of a small scene with known areas: their polygons, and the files written from them (SVG,
// PDF, PNG, VTP, JSON).
#include "transillum/map_files.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkIdList.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPNGReader.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>
#include <vtkXMLDataElement.h>
#include <vtkXMLPolyDataReader.h>
#include <vtkXMLUtilities.h>

#include <fmt/format.h>

#include <array>
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>

#include "support/pdf_content.h"
#include "support/program_call.h"
#include "support/scenes.h"
#include "transillum/at.h"
#include "transillum/errors.h"

namespace transillum::testing::map_files_test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

/// Areas by patch and facing.
using Areas = std::map<std::pair<PatchId, bool>, double>;

double area_of(const std::vector<Vec2>& outline) {
  double twice = 0;
  for (std::size_t k = 0; k < outline.size(); ++k) {
    const Vec2 &a = outline[k], &b = outline[(k + 1) % outline.size()];
    twice += a.x * b.y - b.x * a.y;
  }
  return twice / 2;
}

Areas without_specks(const Areas& areas, double speck = 1e-12) {
  Areas result;
  for (const auto& [key, area] : areas) {
    if (area > speck) {
      result[key] = area;
    }
  }
  return result;
}

void expect_same_areas(const Areas& areas, const Areas& expected, double tolerance) {
  const Areas found = without_specks(areas, tolerance);
  EXPECT_EQ(found.size(), expected.size());
  for (const auto& [key, area] : expected) {
    SCOPED_TRACE(key.first);
    ASSERT_TRUE(found.contains(key));
    EXPECT_NEAR(found.at(key), area, tolerance);
  }
}

/// Seen along +z: a floor of 2 m by 2 m; above it, extending half beyond it, a lamp of 1 m²; above
/// both a gray board of 1 m²; and close above the floor a shelf of 1 m² whose back faces the floor.
std::shared_ptr<const Scene> still_life(const std::string& name = "still life") {
  Sketch sketch(name);
  const int gray = sketch.material(0.5, 0), lamp = sketch.material(0, 3);
  const auto board = [&](double x0, double x1, double y0, double y1, double z, bool down, int m) {
    std::vector<Vec3> outline{{x0, y0, z}, {x1, y0, z}, {x1, y1, z}, {x0, y1, z}};
    if (down) {
      std::reverse(outline.begin(), outline.end());
    }
    sketch.face(outline, m);
  };
  board(0, 2, 0, 2, 0, false, gray);
  board(-0.5, 0.5, 0, 1, 1, true, lamp);
  board(0.25, 1.25, 0.5, 1.5, 1.5, true, gray);
  board(1.5, 2, 0, 2, 0.5, false, gray);
  return sketch.scene();
}
const Areas seen_by_floor{{{1, false}, 0.5}, {{2, false}, 0.875}, {{3, true}, 1}};
const Areas seen_from_below{{{0, true}, 4}, {{1, false}, 0.5}};

RecordedDirection recorded(const Scene& scene, const Vec3& omega = {0, 0, 1}) {
  return record_local_map(scene, BspTree(scene), omega);
}

Areas areas_in(const VisibilityMap& map) {
  Areas areas;
  for (const auto& polygon : map.polygons) {
    const auto outline = map.outline(polygon);
    areas[{polygon.patch, polygon.front_facing}] += area_of({outline.begin(), outline.end()});
  }
  return areas;
}

TEST(VisibilityMap, OfTheStillLifeIsKnown) {
  const auto scene = still_life();
  const RecordedDirection direction = recorded(*scene);
  expect_same_areas(areas_in(map_from_below(direction)), seen_from_below, 1e-13);
  expect_same_areas(areas_in(map_of_receiver(direction, 0)), seen_by_floor, 1e-13);
  const VisibilityMap floor = map_of_receiver(direction, 0);
  ASSERT_EQ(floor.window.size(), 1U);
  EXPECT_NEAR(floor.window[0].area, 4, 1e-14);
  expect_same_areas(areas_in(map_of_receiver(direction, 3)), {}, 1e-13);
  // The lamp and the board face down.
  EXPECT_THAT(map_of_receiver(direction, 1).window, IsEmpty());
  EXPECT_THAT(map_of_receiver(direction, 1).polygons, IsEmpty());
}

/// Compares receivers' maps with the engine's transfers.
TEST(VisibilityMap, OfAReceiverAddsUpToItsTransfers) {
  for (const char* spec : {"rooms", "boards"}) {
    const auto scene = load_scene(spec);
    const RecordedDirection direction = recorded(*scene, normalized(Vec3{0.3, -0.2, 0.8}));
    std::map<std::pair<PatchId, PatchId>, double> exchanged;
    for (const Transfer& t : direction.transfers.exchanges) {
      exchanged[{t.receiver, t.source}] = t.area;
    }
    std::size_t maps_with_polygons = 0;
    for (PatchId i = 0; i < scene->patch_count(); ++i) {
      const VisibilityMap map = map_of_receiver(direction, i);
      const Coverage& coverage = at(direction.transfers.forward, i);
      double covered = 0, window = 0;
      for (const auto& [key, area] : areas_in(map)) {
        covered += area;
        if (key.second) {
          continue;
        }
        EXPECT_NEAR(area, (exchanged[{i, key.first}]), 1e-12) << i;
      }
      for (const auto& polygon : map.window) {
        window += polygon.area;
      }
      EXPECT_NEAR(covered, coverage.covered, 1e-12);
      EXPECT_NEAR(window, coverage.projected, 1e-12);
      maps_with_polygons += map.polygons.empty() ? 0 : 1;
    }
    EXPECT_GT(maps_with_polygons, 10U);
  }
}

TEST(VisibilityMap, FromBelowCoversTheWholeProjectionOfAClosedRoom) {
  const auto scene = load_scene("furnace");
  const Vec3 omega = normalized(Vec3{0.5, 0.7, -0.3});
  double area = 0;
  for (const auto& [key, part] : areas_in(map_from_below(recorded(*scene, omega)))) {
    area += part;
  }
  const Vec3 size = scene->bounds().high - scene->bounds().low;
  EXPECT_NEAR(area,
              std::abs(omega.x) * size.y * size.z + std::abs(omega.y) * size.z * size.x +
                  std::abs(omega.z) * size.x * size.y,
              1e-12 * area);
}

class MapFiles : public ::testing::Test {
 protected:
  std::string written(const std::string& name, const VisibilityMap& map,
                      const MapPictureOptions& options = {}) {
    write_map(folder_ / name, *scene_, map, options);
    EXPECT_THAT(folder_.names(), ElementsAre(name));
    return read_file(folder_ / name);
  }
  VisibilityMap of_floor() const { return map_of_receiver(direction_, 0); }

  TemporaryFolder folder_;
  std::shared_ptr<const Scene> scene_ = still_life();
  RecordedDirection direction_ = recorded(*scene_);
};

TEST_F(MapFiles, JsonReadsBackBitForBit) {
  direction_ = recorded(*scene_, normalized(Vec3{0.1, 0.2, 0.9}));
  const VisibilityMap map = of_floor();
  const auto json = nlohmann::json::parse(written("m.json", map));
  EXPECT_EQ(json.at("scene"), "still life");
  EXPECT_EQ(json.at("patches"), 4);
  const auto same = [&](const char* name, const Vec3& v) {
    EXPECT_EQ(json.at("frame").at(name).get<std::vector<double>>(),
              (std::vector<double>{v.x, v.y, v.z}));
  };
  same("origin", map.frame.origin);
  same("u", map.frame.u);
  same("v", map.frame.v);
  same("omega", map.frame.omega);
  const auto expect_same = [&](const nlohmann::json& list, const auto& polygons) {
    ASSERT_EQ(list.size(), polygons.size());
    for (std::size_t k = 0; k < polygons.size(); ++k) {
      EXPECT_EQ(list[k].at("patch"), polygons[k].patch);
      EXPECT_EQ(list[k].at("facing"), polygons[k].front_facing ? "front" : "back");
      EXPECT_EQ(list[k].at("area").template get<double>(), polygons[k].area);
      const auto outline = map.outline(polygons[k]);
      ASSERT_EQ(list[k].at("corners").size(), outline.size());
      for (std::size_t c = 0; c < outline.size(); ++c) {
        EXPECT_EQ(list[k]["corners"][c][0].template get<double>(), outline[c].x);
        EXPECT_EQ(list[k]["corners"][c][1].template get<double>(), outline[c].y);
      }
    }
  };
  expect_same(json.at("polygons"), map.polygons);
  EXPECT_EQ(json.at("receiver").at("patch"), 0);
  expect_same(json.at("receiver").at("polygons"), map.window);
  const Coverage& coverage = direction_.transfers.forward[0];
  EXPECT_NEAR(json.at("area").get<double>(), coverage.covered, 1e-14);
  EXPECT_NEAR(json.at("receiver").at("area").get<double>(), coverage.projected, 1e-14);
}

TEST_F(MapFiles, JsonFromBelowHasNoReceiver) {
  const auto json = nlohmann::json::parse(written("m.json", map_from_below(direction_)));
  EXPECT_TRUE(json.at("receiver").is_null());
  EXPECT_NEAR(json.at("area").get<double>(), 4.5, 1e-13);
}

TEST_F(MapFiles, VtpKeepsPolygonsAndTheirPatches) {
  const VisibilityMap map = of_floor();
  written("m.vtp", map);
  vtkNew<vtkXMLPolyDataReader> reader;
  reader->SetFileName((folder_ / "m.vtp").c_str());
  reader->Update();
  vtkPolyData& mesh = *reader->GetOutput();
  vtkCellData& cells = *mesh.GetCellData();
  for (const char* name : {"patch", "front", "area"}) {
    ASSERT_NE(cells.GetArray(name), nullptr);
  }
  ASSERT_EQ(mesh.GetNumberOfPolys(), static_cast<vtkIdType>(map.polygons.size()));
  Areas areas, by_array;
  vtkNew<vtkIdList> corners;
  for (vtkIdType k = 0; k < mesh.GetNumberOfPolys(); ++k) {
    mesh.GetCellPoints(k, corners);
    std::vector<Vec2> outline;
    for (vtkIdType c = 0; c < corners->GetNumberOfIds(); ++c) {
      double point[3];
      mesh.GetPoint(corners->GetId(c), point);
      EXPECT_EQ(point[2], 0);
      outline.push_back({point[0], point[1]});
    }
    const std::pair key{static_cast<PatchId>(cells.GetArray("patch")->GetTuple1(k)),
                        cells.GetArray("front")->GetTuple1(k) != 0};
    areas[key] += area_of(outline);
    by_array[key] += cells.GetArray("area")->GetTuple1(k);
  }
  expect_same_areas(areas, seen_by_floor, 1e-13);
  expect_same_areas(by_array, seen_by_floor, 1e-13);
  EXPECT_EQ(mesh.GetFieldData()->GetArray("receiver")->GetTuple1(0), 0);
  EXPECT_EQ(mesh.GetFieldData()->GetArray("direction")->GetTuple1(2), 1);
}

vtkSmartPointer<vtkXMLDataElement> parsed(const std::string& xml) {
  return vtkSmartPointer<vtkXMLDataElement>::Take(
      vtkXMLUtilities::ReadElementFromString(xml.c_str()));
}

/// All elements of a name below `element`.
std::vector<vtkXMLDataElement*> elements(vtkXMLDataElement& element, const std::string& name) {
  std::vector<vtkXMLDataElement*> found;
  for (int k = 0; k < element.GetNumberOfNestedElements(); ++k) {
    vtkXMLDataElement& child = *element.GetNestedElement(k);
    if (child.GetName() == name) {
      found.push_back(&child);
    }
    const auto below = elements(child, name);
    found.insert(found.end(), below.begin(), below.end());
  }
  return found;
}

std::string attribute(vtkXMLDataElement& element, const char* name) {
  const char* value = element.GetAttribute(name);
  return value ? value : "";
}

/// Area of the polygons of a path of M, L and Z, pixels.
double area_of_path(const std::string& path) {
  double area = 0;
  std::istringstream polygons(path);
  for (std::string polygon; std::getline(polygons, polygon, 'Z');) {
    for (char& c : polygon) {
      c = c == 'M' || c == 'L' ? ' ' : c;
    }
    std::istringstream numbers(polygon);
    std::vector<Vec2> outline;
    for (Vec2 p; numbers >> p.x >> p.y;) {
      outline.push_back(p);
    }
    area += std::abs(area_of(outline));
  }
  return area;
}

double pixels_per_meter(vtkXMLDataElement& svg) {
  const std::string text = elements(svg, "desc").at(0)->GetCharacterData();
  const std::size_t end = text.find(" pixels per meter");
  return std::stod(text.substr(text.rfind(' ', end - 1)));
}

TEST_F(MapFiles, SvgIsXmlWhosePathsHaveTheAreasOfThePatches) {
  for (const VisibilityMap& map : {of_floor(), map_from_below(direction_)}) {
    TemporaryFolder folder;
    write_map(folder / "m.svg", *scene_, map);
    const auto svg = parsed(read_file(folder / "m.svg"));
    ASSERT_NE(svg, nullptr);
    const double scale = pixels_per_meter(*svg);
    Areas drawn, by_attribute;
    for (vtkXMLDataElement* path : elements(*svg, "path")) {
      std::istringstream words(attribute(*path, "class"));
      std::string kind, patch, facing;
      words >> kind >> patch >> facing;
      if (kind != "patch") {
        continue;
      }
      const std::pair key{std::stoi(patch.substr(1)), facing == "front"};
      drawn[key] += area_of_path(attribute(*path, "d")) / (scale * scale);
      by_attribute[key] += std::stod(attribute(*path, "data-area"));
      EXPECT_EQ(elements(*path, "title").size(), 1U);
    }
    const Areas& expected = map.receiver == 0 ? seen_by_floor : seen_from_below;
    expect_same_areas(by_attribute, expected, 1e-13);
    expect_same_areas(drawn, expected, 1e-5);
  }
}

/// The areas of the filled paths of a page of PDF, square points, but of those with curves.
std::vector<double> filled_areas(const std::string& page) {
  std::istringstream words(page);
  std::vector<double> areas, numbers;
  std::vector<Vec2> outline;
  double sum = 0;
  bool has_curves = false;
  for (std::string word; words >> word;) {
    if (std::isdigit(static_cast<unsigned char>(word[0])) != 0 || word[0] == '-') {
      numbers.push_back(std::atof(word.c_str()));
      continue;
    }
    if (word == "m" || word == "h") {
      sum += std::abs(area_of(outline));
      outline.clear();
    }
    if ((word == "m" || word == "l") && numbers.size() >= 2) {
      outline.push_back({numbers[numbers.size() - 2], numbers.back()});
    } else if (word == "re" && numbers.size() >= 2) {
      sum += std::abs(numbers[numbers.size() - 2] * numbers.back());
    }
    has_curves = has_curves || word == "c";
    if (word == "f" || word == "S") {
      if (word == "f" && !has_curves) {
        areas.push_back(sum);
      }
      outline.clear();
      sum = 0;
      has_curves = false;
    }
    numbers.clear();
  }
  return areas;
}

TEST_F(MapFiles, PdfHasTheFigureOfTheSvgAsVectorsAndText) {
  for (const VisibilityMap& map : {of_floor(), map_from_below(direction_)}) {
    TemporaryFolder folder;
    write_map(folder / "m.svg", *scene_, map);
    write_map(folder / "m.pdf", *scene_, map);
    const auto svg = parsed(read_file(folder / "m.svg"));
    const std::string pdf = read_file(folder / "m.pdf"), page = page_of(pdf);
    // A pixel is 3/4 of a point.
    const double points = 0.75 * pixels_per_meter(*svg);
    EXPECT_THAT(pdf, HasSubstr(fmt::format("/MediaBox [ 0 0 {:g} ",
                                           0.75 * std::stod(attribute(*svg, "width")))));
    EXPECT_THAT(pdf, HasSubstr("/ToUnicode"));
    EXPECT_THAT(pdf, Not(HasSubstr("/Subtype /Image")));
    EXPECT_THAT(page, HasSubstr("still life)Tj"));
    std::vector<double> expected{std::stod(attribute(*svg, "width")) *
                                 std::stod(attribute(*svg, "height")) * 0.75 * 0.75 /
                                 (points * points)};
    if (!map.window.empty()) {
      expected.push_back(4);
    }
    for (vtkXMLDataElement* path : elements(*svg, "path")) {
      if (attribute(*path, "class").starts_with("patch ")) {
        expected.push_back(std::stod(attribute(*path, "data-area")));
      }
    }
    const std::vector<double> found = filled_areas(page);
    ASSERT_EQ(found.size(), expected.size());
    EXPECT_NEAR(found[0] / (points * points), expected[0], 0.01 * expected[0]);  // the page
    for (std::size_t k = 1; k < found.size(); ++k) {
      // Cairo rounds coordinates to 1/256 of a point; no perimeter but the page's exceeds 16 m.
      EXPECT_NEAR(found[k] / (points * points), expected[k], 16 / (256 * points)) << k;
    }
  }
}

TEST_F(MapFiles, SvgDescribesPatchesInToolTips) {
  const std::string below = written("m.svg", map_from_below(direction_));
  EXPECT_THAT(below, HasSubstr("patch 0 (m0): back side, sees patches 2, 1; area 4 m"));
  EXPECT_THAT(below, HasSubstr("patch 1 (m1): emits 3, 3, 3 W/m"));
  EXPECT_THAT(below, HasSubstr("class=\"patch p1 back emits\""));
  EXPECT_THAT(below, HasSubstr(">Visibility map of still life<"));
  EXPECT_THAT(below, HasSubstr(">0.5 m</text>"));  // the scale bar
}

TEST_F(MapFiles, SvgHasTheRequestedColors) {
  MapPictureOptions options;
  options.patch_colors.assign(static_cast<std::size_t>(scene_->patch_count()), {0x12, 0x34, 0x56});
  options.patch_colors[1] = {0xab, 0xcd, 0xef};
  const std::string colored = written("m.svg", map_from_below(direction_), options);
  EXPECT_THAT(colored, HasSubstr("fill=\"#abcdef\""));
  EXPECT_THAT(colored, ::testing::Not(HasSubstr(">emits<")));  // not what these colors mean
  EXPECT_THAT(colored, HasSubstr(">back side<"));
  EXPECT_THAT(written("m.svg", map_from_below(direction_)), HasSubstr(">emits<"));
}

TEST_F(MapFiles, SvgHasTheRequestedSize) {
  for (const int size : {200, 205, 300, 1200, 5000, 8192}) {
    const auto svg = parsed(written("m.svg", of_floor(), {.size = size}));
    EXPECT_GT(pixels_per_meter(*svg), 5) << size;
    const double width = std::stod(attribute(*svg, "width"));
    const double height = std::stod(attribute(*svg, "height"));
    EXPECT_NEAR(std::max(width, height), std::max(size, 470), 1) << width << " x " << height;
  }
}

TEST_F(MapFiles, AcceptAnySceneName) {
  const std::string names[] = {"a<b>&\"c\"']]>", "\x01\x1b[31m\x7f", "\xff\xfe broken \xc3",
                               std::string(3000, 'n'), "fertőrákos"};
  for (const std::string& name : names) {
    const auto scene = still_life(name);
    const VisibilityMap map = map_from_below(direction_);
    write_map(folder_ / "m.svg", *scene, map);
    const auto svg = parsed(read_file(folder_ / "m.svg"));
    ASSERT_NE(svg, nullptr) << name;
    EXPECT_GT(elements(*svg, "path").size(), 2U);
    write_map(folder_ / "m.json", *scene, map);
    EXPECT_TRUE(nlohmann::json::accept(read_file(folder_ / "m.json")));
  }
}

class Picture {
 public:
  explicit Picture(const std::string& path) {
    reader_->SetFileName(path.c_str());
    reader_->Update();
    reader_->GetOutput()->GetDimensions(size_.data());
  }
  int width() const { return size_[0]; }
  int height() const { return size_[1]; }
  std::array<int, 3> at(int x, int y) const {
    std::array<int, 3> rgb{};
    for (int c = 0; c < 3; ++c) {
      rgb.at(static_cast<std::size_t>(c)) = static_cast<int>(
          reader_->GetOutput()->GetScalarComponentAsDouble(x, height() - 1 - y, 0, c));
    }
    return rgb;
  }
  std::map<std::array<int, 3>, int> counts() const {
    std::map<std::array<int, 3>, int> counts;
    for (int y = 0; y < height(); ++y) {
      for (int x = 0; x < width(); ++x) {
        ++counts[at(x, y)];
      }
    }
    return counts;
  }

 private:
  vtkNew<vtkPNGReader> reader_;
  std::array<int, 3> size_{};
};

TEST_F(MapFiles, PngAreasArePixelCounts) {
  written("m.png", of_floor(), {.size = 1600});
  const Picture picture(folder_ / "m.png");
  EXPECT_EQ(std::max(picture.width(), picture.height()), 1600);
  // Pixels along the outlines have mixed colors: less than a thousandth of all.
  const auto counts = picture.counts();
  // The lamp is white; 0.5 m² of it are visible. The floor's 4 m² fill the picture up to a margin.
  ASSERT_TRUE(counts.contains({255, 255, 255}));
  const double floor_pixels = 1504.0 * 1504.0;
  EXPECT_NEAR(counts.at({255, 255, 255}) / floor_pixels, 0.5 / 4, 0.003);
  // The floor where nothing is above it: 1.625 m². Then the background.
  ASSERT_TRUE(counts.contains({0x2c, 0x32, 0x3b}));
  EXPECT_NEAR(counts.at({0x2c, 0x32, 0x3b}) / floor_pixels, 1.625 / 4, 0.003);
  ASSERT_TRUE(counts.contains({0x1d, 0x21, 0x27}));
  EXPECT_NEAR(counts.at({0x1d, 0x21, 0x27}), 1600 * 1600 - floor_pixels, 4 * 1600);
}

/// In a view along z, u points left and v up; the frame has the directions of u and v.
TEST_F(MapFiles, PngShowsTheLampAtItsPosition) {
  written("m.png", of_floor(), {.size = 400});
  const Picture picture(folder_ / "m.png");
  const Vec2 middle = direction_.record.frame.project({1, 1, 0});
  const Vec2 lamp = direction_.record.frame.project({0.2, 0.2, 1});
  const double scale = 376.0 / 2;
  const int x = static_cast<int>(200 - scale * (lamp.x - middle.x));
  const int y = static_cast<int>(200 - scale * (lamp.y - middle.y));
  EXPECT_EQ(picture.at(x, y), (std::array<int, 3>{255, 255, 255})) << x << ", " << y;
}

TEST_F(MapFiles, LabelsPointAtPlacesOfTheMap) {
  const Vec2 place = direction_.record.frame.project({0.5, 1.5, 0});
  MapPictureOptions options{.size = 400};
  options.labels = {{"a < b", place}, {"below it", place}};
  const std::string svg = written("m.svg", of_floor(), options);
  EXPECT_THAT(svg, HasSubstr(">a &lt; b</text>"));
  EXPECT_THAT(svg, HasSubstr(">below it</text>"));
  const auto figure = parsed(svg);
  ASSERT_NE(figure, nullptr);
  // Two labels at one place are drawn one below the other.
  std::vector<double> heights;
  for (vtkXMLDataElement* text : elements(*figure, "text")) {
    if (text->GetAttribute("class") && attribute(*text, "class").starts_with("label")) {
      heights.push_back(std::stod(attribute(*text, "y")));
    }
  }
  ASSERT_EQ(heights.size(), 2U);
  EXPECT_GT(heights[1] - heights[0], 15);

  write_map(folder_ / "plain.png", *scene_, of_floor(), {.size = 400});
  const Picture plain(folder_ / "plain.png");
  write_map(folder_ / "labeled.png", *scene_, of_floor(), options);
  const Picture labeled(folder_ / "labeled.png");
  const Vec2 middle = direction_.record.frame.project({1, 1, 0});
  const double scale = 376.0 / 2;
  const int x = static_cast<int>(200 - scale * (place.x - middle.x));
  const int y = static_cast<int>(200 - scale * (place.y - middle.y));
  EXPECT_EQ(labeled.at(x, y), (std::array<int, 3>{255, 255, 255}));
  EXPECT_NE(plain.at(x, y), labeled.at(x, y));
  // Colors far from the labels are the same.
  EXPECT_EQ(plain.at(2, 398), labeled.at(2, 398));
  EXPECT_EQ(plain.width(), labeled.width());
}

/// At a slanted edge between two polygons, no pixel shows the background.
TEST(MapPng, HasNoSeams) {
  Sketch sketch;
  const int lamp = sketch.material(0, 1);
  sketch.face({{0, 0, 0}, {0.31, 1, 0}, {1, 0, 0}}, lamp);
  sketch.face({{0.31, 1, 0}, {1, 1, 0}, {1, 0, 0}}, lamp);
  const auto scene = sketch.scene();
  VisibilityMap map = map_from_below(recorded(*scene));
  const TemporaryFolder folder;
  write_map(folder / "m.png", *scene, map, {.size = 301});
  const Picture picture(folder / "m.png");
  // Only the line along the edge darkens the white, but never as dark as the background.
  int row_minimum = 255;
  for (int x = 120; x < 200; ++x) {
    row_minimum = std::min(row_minimum, picture.at(x, 150)[0]);
  }
  EXPECT_GT(row_minimum, 100);
}

TEST_F(MapFiles, EmptyMapsCanBeWritten) {
  const RecordedDirection edge_on = recorded(*scene_, {1, 0, 0});
  const RecordedDirection from_above = recorded(*scene_, {0, 0, -1});
  for (const VisibilityMap& map :
       {map_of_receiver(edge_on, 0), map_of_receiver(from_above, 0), map_from_below(edge_on)}) {
    EXPECT_THAT(map.polygons, IsEmpty());
    const std::string reason = empty_map_reason(*scene_, map);
    EXPECT_NE(reason, "");
    for (const char* name : {"m.svg", "m.pdf", "m.png", "m.vtp", "m.json"}) {
      write_map(folder_ / name, *scene_, map);
    }
    EXPECT_NE(parsed(read_file(folder_ / "m.svg")), nullptr);
    EXPECT_THAT(read_file(folder_ / "m.svg"), HasSubstr(reason));
    EXPECT_THAT(page_of(read_file(folder_ / "m.pdf")), HasSubstr(reason.substr(0, 8)));
    EXPECT_GT(Picture(folder_ / "m.png").width(), 100);
    EXPECT_THAT(read_json(folder_ / "m.json").at("polygons"), IsEmpty());
  }
  EXPECT_THAT(empty_map_reason(*scene_, map_of_receiver(edge_on, 0)), HasSubstr("edge-on"));
  EXPECT_THAT(empty_map_reason(*scene_, map_of_receiver(from_above, 0)),
              HasSubstr("is back-facing"));
  EXPECT_EQ(empty_map_reason(*scene_, of_floor()), "");
}

TEST_F(MapFiles, EndingsAreChecked) {
  EXPECT_NO_THROW(check_map_path(folder_ / "a.SVG"));
  EXPECT_THROW(check_map_path(folder_ / "a.eps"), InputError);
  EXPECT_THROW(check_map_path(folder_ / "none/a.svg"), InputError);
  EXPECT_THROW(write_map(folder_ / "a.csv", *scene_, of_floor()), InputError);
  EXPECT_THAT(folder_.names(), IsEmpty());
}

}  // namespace
}  // namespace transillum::testing::map_files_test
