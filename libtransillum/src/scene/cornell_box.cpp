// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include <array>

#include "scene/built_in_makers.h"

namespace transillum {
namespace {

/// The published measurements are in millimetres: Cornell University Program of Computer
/// Graphics, "The Cornell Box: Physical measurements".
using Millimetres = std::array<double, 3>;

class CornellBox {
 public:
  explicit CornellBox(SceneMaker& maker)
      : maker_(maker),
        white_(maker.material("white", {0.725, 0.71, 0.68})),
        red_(maker.material("red", {0.63, 0.065, 0.05})),
        green_(maker.material("green", {0.14, 0.45, 0.091})),
        light_(maker.material("light", {0.78, 0.78, 0.78}, {53.4, 37.7, 12.6})) {}

  void add_room() {
    add({{552.8, 0, 0}, {0, 0, 0}, {0, 0, 559.2}, {549.6, 0, 559.2}}, white_);
    add_ceiling();
    add({{549.6, 0, 559.2}, {0, 0, 559.2}, {0, 548.8, 559.2}, {556, 548.8, 559.2}}, white_);
    add({{0, 0, 559.2}, {0, 0, 0}, {0, 548.8, 0}, {0, 548.8, 559.2}}, green_);
    // The measured corners of the red wall are not in one plane.
    add({{552.8, 0, 0}, {549.6, 0, 559.2}, {556, 548.8, 559.2}}, red_);
    add({{552.8, 0, 0}, {556, 548.8, 559.2}, {556, 548.8, 0}}, red_);
  }
  void add_front() {
    const int black = maker_.material("black", {});
    add({{0, 0, 0}, {552.8, 0, 0}, {556, 548.8, 0}, {0, 548.8, 0}}, black);
  }
  void add_blocks() {
    add_block({{{130, 0, 65}, {82, 0, 225}, {240, 0, 272}, {290, 0, 114}}}, 165);
    add_block({{{423, 0, 247}, {265, 0, 296}, {314, 0, 456}, {472, 0, 406}}}, 330);
  }

 private:
  void add(const std::vector<Millimetres>& outline, int material) {
    std::vector<Vec3> corners;
    for (const auto& [x, y, z] : outline) corners.push_back({x / 1000, y / 1000, z / 1000});
    maker_.face(corners, material);
  }
  void add_ceiling() {
    const std::array<Millimetres, 4> room{
        {{556, 548.8, 0}, {556, 548.8, 559.2}, {0, 548.8, 559.2}, {0, 548.8, 0}}};
    const std::array<Millimetres, 4> lamp{
        {{343, 548.8, 227}, {343, 548.8, 332}, {213, 548.8, 332}, {213, 548.8, 227}}};
    for (std::size_t i = 0; i < 4; ++i) {
      const std::size_t next = (i + 1) % 4;
      add({room[i], room[next], lamp[next], lamp[i]}, white_);
    }
    add({lamp.begin(), lamp.end()}, light_);
  }
  /// It stands on the floor: no bottom.
  void add_block(const std::array<Millimetres, 4>& foot, double height) {
    const auto raised = [height](const Millimetres& p) { return Millimetres{p[0], height, p[2]}; };
    add({raised(foot[0]), raised(foot[1]), raised(foot[2]), raised(foot[3])}, white_);
    for (std::size_t i = 0; i < 4; ++i) {
      const Millimetres& a = foot[i];
      const Millimetres& b = foot[(i + 1) % 4];
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
  if (values["open"] == 0) box.add_front();
}

}  // namespace transillum
