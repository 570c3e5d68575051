// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
// Built-in scene `gallery`: a room of 6 by 4 by 3 m with a glossy floor of tiles, a polished ball
// above a pedestal, and three lamps of different colors. Its lobes are as narrow as some 250 passes
// resolve.
#include <cmath>
#include <numbers>

#include "scene/built_in/built_in_makers.h"

namespace transillum {
namespace {

using std::numbers::pi;
constexpr double hall_length = 6, hall_width = 4, hall_height = 3;

class Gallery {
 public:
  explicit Gallery(SceneMaker& maker)
      : maker_(maker),
        white_(maker.material("white", {0.7, 0.69, 0.66})),
        wood_(maker.material("wood", {0.4, 0.28, 0.18})),
        floor_(maker.material("floor", {0.16, 0.14, 0.13}, {}, floor_lobe())),
        brass_(maker.material("brass", {}, {}, brass_lobe())),
        red_(maker.material("red-lamp", {}, {24, 5, 3})),
        blue_(maker.material("blue-lamp", {}, {3, 7, 24})),
        day_(maker.material("white-lamp", {}, {16, 15, 13})) {}

  void add_room() {
    lit_side({0, 0, 0}, {0, hall_width, 0}, {0, 0, hall_height}, red_);
    lit_side({hall_length, hall_width, 0}, {0, -hall_width, 0}, {0, 0, hall_height}, blue_);
    maker_.face(
        std::vector<Vec3>{
            {0, 0, 0}, {0, 0, hall_height}, {hall_length, 0, hall_height}, {hall_length, 0, 0}},
        white_);
    maker_.face(std::vector<Vec3>{{0, hall_width, 0},
                                  {hall_length, hall_width, 0},
                                  {hall_length, hall_width, hall_height},
                                  {0, hall_width, hall_height}},
                white_);
    maker_.lit_ceiling({0, hall_length, 0, hall_width}, {2.25, 3.75, 1.5, 2.5}, hall_height, white_,
                       day_);
  }
  /// Tiles of half a meter, `divisions` along each side; none below the pedestal.
  void add_floor(int divisions) {
    const int nx = 12 * divisions, ny = 8 * divisions;
    const auto x = [&](int i) { return hall_length * i / nx; };
    const auto y = [&](int j) { return hall_width * j / ny; };
    for (int i = 0; i < nx; ++i) {
      for (int j = 0; j < ny; ++j) {
        const bool below =
            i >= 5 * divisions && i < 7 * divisions && j >= 3 * divisions && j < 5 * divisions;
        if (!below) {
          maker_.face(std::vector<Vec3>{{x(i), y(j), 0},
                                        {x(i + 1), y(j), 0},
                                        {x(i + 1), y(j + 1), 0},
                                        {x(i), y(j + 1), 0}},
                      floor_);
        }
      }
    }
    maker_.standing_block({{2.5, 1.5, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 0.6}}, wood_);
  }
  void add_ball(int slices, int stacks) {
    const auto point = [&](int j, int i) {
      const double polar = pi * j / stacks, around = 2 * pi * (i % slices) / slices;
      const double s = j == 0 || j == stacks ? 0 : std::sin(polar);
      return Vec3{3 + 0.5 * s * std::cos(around), 2 + 0.5 * s * std::sin(around),
                  1.2 + 0.5 * std::cos(polar)};
    };
    for (int j = 0; j < stacks; ++j) {
      for (int i = 0; i < slices; ++i) {
        std::vector<Vec3> outline{point(j, i), point(j + 1, i)};
        if (j + 1 < stacks) {
          outline.push_back(point(j + 1, i + 1));
        }
        if (j > 0) {
          outline.push_back(point(j, i + 1));
        }
        maker_.face(outline, brass_);
      }
    }
  }

 private:
  static Lobe floor_lobe() {
    Lobe lobe{.reflectance = {0.45, 0.45, 0.45}};
    lobe.exponent = 24;
    return lobe;
  }
  static Lobe brass_lobe() {
    Lobe lobe{.reflectance = {0.9, 0.75, 0.42}, .shape = LobeShape::ggx};
    lobe.roughness = 0.42;
    return lobe;
  }
  /// A wall with the lamp in its middle; u × v is the normal.
  void lit_side(const Vec3& corner, const Vec3& u, const Vec3& v, int lamp) {
    const auto at = [&](double s, double t) { return corner + s * u + t * v; };
    const std::vector<Vec3> inner{at(0.25, 0.4), at(0.75, 0.4), at(0.75, 0.7), at(0.25, 0.7)};
    const std::vector<Vec3> outer{at(0, 0), at(1, 0), at(1, 1), at(0, 1)};
    for (std::size_t k = 0; k < 4; ++k) {
      const std::size_t next = (k + 1) % 4;
      maker_.face({outer[k], outer[next], inner[next], inner[k]}, white_);
    }
    maker_.face(inner, lamp);
  }

  SceneMaker& maker_;
  int white_, wood_, floor_, brass_, red_, blue_, day_;
};

}  // namespace

void make_gallery(SceneMaker& maker, const ParameterValues& values, const Cancellation&) {
  Gallery gallery(maker);
  gallery.add_room();
  gallery.add_floor(values["tiles"]);
  gallery.add_ball(values["slices"], values["stacks"]);
}

}  // namespace transillum
