// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include <array>
#include <vector>

#include "scene/built_in/built_in_makers.h"

namespace transillum {
namespace {

/// The published measurements are in millimeters: Cornell University Program of Computer
/// Graphics, "The Cornell Box: Physical measurements". There the red wall's corners are up to 6 mm
/// off a plane; here the room is an exact box.
using Millimeters = std::array<double, 3>;

class CornellBox {
 public:
  explicit CornellBox(SceneMaker& maker)
      : maker_(maker),
        white_(maker.material("white", {0.725, 0.71, 0.68})),
        red_(maker.material("red", {0.63, 0.065, 0.05})),
        green_(maker.material("green", {0.14, 0.45, 0.091})),
        light_(maker.material("light", {0.78, 0.78, 0.78}, {53.4, 37.7, 12.6})) {}

  void add_room() {
    const std::vector<Millimeters> floor{
        {width, 0, 0}, {0, 0, 0}, {0, 0, depth}, {width, 0, depth}};
    for (const auto& part :
         floor_around_all(meters(floor), {meters(short_foot), meters(tall_foot)}, {0, 1, 0})) {
      maker_.face(part, white_);
    }
    add_ceiling();
    add({{width, 0, depth}, {0, 0, depth}, {0, height, depth}, {width, height, depth}}, white_);
    add({{0, 0, depth}, {0, 0, 0}, {0, height, 0}, {0, height, depth}}, green_);
    add({{width, 0, 0}, {width, 0, depth}, {width, height, depth}, {width, height, 0}}, red_);
  }
  void add_front() {
    const int black = maker_.material("black", {});
    add({{0, 0, 0}, {width, 0, 0}, {width, height, 0}, {0, height, 0}}, black);
  }
  void add_blocks() {
    add_block(short_foot, 165);
    add_block(tall_foot, 330);
  }

 private:
  static constexpr double width = 556, height = 548.8, depth = 559.2;
  inline static const std::vector<Millimeters> short_foot{
      {130, 0, 65}, {82, 0, 225}, {240, 0, 272}, {290, 0, 114}};
  inline static const std::vector<Millimeters> tall_foot{
      {423, 0, 247}, {265, 0, 296}, {314, 0, 456}, {472, 0, 406}};

  static std::vector<Vec3> meters(const std::vector<Millimeters>& outline) {
    std::vector<Vec3> corners;
    for (const auto& [x, y, z] : outline) {
      corners.push_back({x / 1000, y / 1000, z / 1000});
    }
    return corners;
  }
  void add(const std::vector<Millimeters>& outline, int material) {
    maker_.face(meters(outline), material);
  }
  void add_ceiling() {
    const std::array<Millimeters, 4> room{
        {{width, height, 0}, {width, height, depth}, {0, height, depth}, {0, height, 0}}};
    const std::array<Millimeters, 4> lamp{
        {{343, height, 227}, {343, height, 332}, {213, height, 332}, {213, height, 227}}};
    for (std::size_t i = 0; i < 4; ++i) {
      const std::size_t next = (i + 1) % 4;
      add({room[i], room[next], lamp[next], lamp[i]}, white_);
    }
    add({lamp.begin(), lamp.end()}, light_);
  }
  /// A block on the floor, without a bottom.
  void add_block(const std::vector<Millimeters>& foot, double top) {
    const auto raised = [top](const Millimeters& p) { return Millimeters{p[0], top, p[2]}; };
    add({raised(foot[0]), raised(foot[1]), raised(foot[2]), raised(foot[3])}, white_);
    for (std::size_t i = 0; i < 4; ++i) {
      const Millimeters& a = foot[i];
      const Millimeters& b = foot[(i + 1) % 4];
      add({b, raised(b), raised(a), a}, white_);
    }
  }

  SceneMaker& maker_;
  int white_, red_, green_, light_;
};

}  // namespace

void make_cornell_box(SceneMaker& maker, const ParameterValues& values, const Cancellation&) {
  CornellBox box(maker);
  box.add_room();
  box.add_blocks();
  if (values["open"] == 0) {
    box.add_front();
  }
}

}  // namespace transillum
