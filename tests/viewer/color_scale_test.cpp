// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Color maps, ranges, ticks and exposure of ColorScale; decades of charts; numbers as text.
#include "colors/color_scale.h"

#include <QTest>
#include <cmath>

#include "colors/color_choice.h"
#include "registered.h"
#include "support/number_text.h"
#include "widgets/log_chart.h"

namespace transillum::viewer::color_scale_test {

namespace {

double linear(std::uint8_t x) { return std::pow(x / 255.0, 2.2); }

double lightness(const Color8& c) {
  return 0.2126 * linear(c[0]) + 0.7152 * linear(c[1]) + 0.0722 * linear(c[2]);
}

/// The lightness of a color for eyes without the cones for red, or without those for green
/// (Viénot, Brettel and Mollon 1999).
double lightness_without(bool red, const Color8& c) {
  const double r = linear(c[0]), g = linear(c[1]), b = linear(c[2]);
  const double yellow = red ? 0.1124 * r + 0.8876 * g : 0.2927 * r + 0.7073 * g;
  const double blue = red ? 0.004 * (r - g) + b : 0.0223 * (g - r) + b;
  return (0.2126 + 0.7152) * yellow + 0.0722 * blue;
}

}  // namespace

class ColorScaleTest : public QObject {
  Q_OBJECT

 private slots:
  void lightness_of_maps_increases() {
    for (const ColorMap map : {ColorMap::viridis, ColorMap::cividis, ColorMap::inferno}) {
      double last = -1;
      for (int k = 0; k <= 50; ++k) {
        const double now = lightness(color_of(map, k / 50.0));
        QVERIFY2(now > last, qPrintable(QString("map %1 at %2").arg(int(map)).arg(k)));
        last = now;
      }
      QCOMPARE(color_of(map, -3), color_of(map, 0));
      QCOMPARE(color_of(map, 7), color_of(map, 1));
      QCOMPARE(color_of(map, NAN), color_of(map, 0));
    }
  }

  void the_default_map_survives_gray_print_and_color_blindness() {
    Selection selection;
    const ColorMap map = ColorChoice(selection).map();
    for (int k = 1; k <= 50; ++k) {
      const Color8 before = color_of(map, (k - 1) / 50.0), now = color_of(map, k / 50.0);
      QVERIFY(lightness(now) > lightness(before));
      QVERIFY(lightness_without(true, now) > lightness_without(true, before));
      QVERIFY(lightness_without(false, now) > lightness_without(false, before));
    }
  }

  void the_color_of_zero_is_in_no_map() {
    for (const ColorMap map :
         {ColorMap::viridis, ColorMap::cividis, ColorMap::inferno, ColorMap::diverging}) {
      for (int k = 0; k <= 100; ++k) {
        const Color8 color = color_of(map, k / 100.0);
        int distance = 0;
        for (std::size_t c = 0; c < 3; ++c) {
          distance += std::abs(color[c] - zero_color[c]);
        }
        QVERIFY2(distance > (map == ColorMap::diverging ? 20 : 90), qPrintable(QString::number(k)));
      }
    }
  }

  void true_color_applies_exposure_then_gamma() {
    ColorScale scale;
    scale.exposure = -1;
    scale.gamma = 2;
    QCOMPARE(scale.color({0.5, 0, 2}), (Color8{128, 0, 255}));  // sqrt(1/4), 0, 1
  }

  void a_patch_that_is_too_bright_keeps_its_hue() {
    ColorScale scale;
    scale.gamma = 1;
    QCOMPARE(scale.color({4, 2, 1}), (Color8{255, 128, 64}));
  }

  void position_and_value_are_inverse() {
    for (const bool logarithmic : {false, true}) {
      ColorScale scale;
      scale.mode = ColorMode::luminance;
      scale.logarithmic = logarithmic;
      scale.low = 0.01;
      scale.high = 100;
      for (const double t : {0.0, 0.3, 1.0}) {
        QVERIFY(std::abs(scale.position(scale.value_at(t)) - t) < 1e-12);
      }
      const auto ticks = scale.ticks();
      QVERIFY(ticks.size() >= 3);
      QVERIFY(std::is_sorted(ticks.begin(), ticks.end()));
      QVERIFY(ticks.front() >= scale.low * (1 - 1e-9) && ticks.back() <= scale.high * (1 + 1e-9));
    }
  }

  void a_logarithmic_range_allows_zero_values() {
    const auto scene = load_scene("cornell-box");
    std::vector<Rgb> radiosity(static_cast<std::size_t>(scene->patch_count()));
    ColorScale scale;
    scale.mode = ColorMode::red;
    scale.logarithmic = true;
    scale.fit_range(*scene, radiosity);
    QVERIFY(scale.low > 0 && scale.high > scale.low);
    QCOMPARE(scale.color({0, 0, 0}), color_of(scale.map, 0));
    radiosity[1] = {0, 9, 9};
    radiosity[2] = {2, 0, 0};
    radiosity[3] = {50, 0, 0};
    scale.fit_range(*scene, radiosity);
    QCOMPARE(scale.low, 2.0);
    QCOMPARE(scale.high, 50.0);
    QVERIFY(scale.position(0) <= 0);
  }

  void a_linear_range_ends_at_the_brightest_receiver() {
    const auto scene = load_scene("cornell-box");
    std::vector<Rgb> radiosity;
    for (PatchId i = 0; i < scene->patch_count(); ++i) {
      radiosity.push_back(max_abs(scene->exitance(i)) > 0 ? Rgb{40, 40, 40} : Rgb{3, 3, 3});
    }
    ColorScale scale;
    scale.mode = ColorMode::red;
    scale.fit_range(*scene, radiosity);
    QCOMPARE(scale.low, 0.0);
    QCOMPARE(scale.high, 3.0);
    QVERIFY(scale.above);
  }

  void channels_and_luminance() {
    ColorScale scale;
    scale.mode = ColorMode::green;
    QCOMPARE(scale.value({1, 2, 3}), 2.0);
    scale.mode = ColorMode::luminance;
    QVERIFY(std::abs(scale.value({1, 1, 1}) - 1) < 1e-12);
  }

  void exposure_is_fitted_to_patches_that_do_not_emit() {
    const auto scene = load_scene("cornell-box");
    std::vector<Rgb> radiosity;
    for (PatchId i = 0; i < scene->patch_count(); ++i) {
      radiosity.push_back(max_abs(scene->exitance(i)) > 0 ? Rgb{1000, 1000, 1000}
                                                          : Rgb{0.25, 0.25, 0.25});
    }
    ColorScale scale;
    scale.fit_exposure(*scene, radiosity);
    QVERIFY(std::abs(std::exp2(scale.exposure) * 0.25 - 0.85) < 1e-9);
  }

  void decades_enclose_all_positive_values() {
    const LogChart::Line line{"a", {}, {0, -1, NAN, 3e-4, 0.2}, false};
    const Decades decades = decades_of({line}, {{"level", {}, 1e-6}});
    QCOMPARE(decades.first, -6);
    QCOMPARE(decades.last, 0);
    const Decades nothing = decades_of({}, {});
    QVERIFY(nothing.first < nothing.last);
  }

  void numbers_are_formatted() {
    QCOMPARE(number_text(0.000001), QString("10⁻⁶"));
    QCOMPARE(number_text(1.5e-9), QString("1.5\u00a0×\u00a010⁻⁹"));
    QCOMPARE(number_text(-0.25), QString("−0.25"));
    QCOMPARE(count_text(19976), QString("19\u2009976"));
    QCOMPARE(count_text(-1000), QString("−1\u2009000"));
    QCOMPARE(duration_text(59.2), QString("1 min 00 s"));
    QCOMPARE(duration_text(4000), QString("1 h 06 min"));
  }
};

const test::Registered registered("color_scale", test::run_without_application<ColorScaleTest>);

}  // namespace transillum::viewer::color_scale_test

#include "color_scale_test.moc"
